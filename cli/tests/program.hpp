// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The program as a user calls it.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace rigor::cli_test {

struct Result {
    int code = -1;
    std::string out;  ///< standard output and error together unless `only stdout` was requested
};

inline Result rigor(const std::string& arguments, bool withErrors = true,
                    const std::string& environment = "") {
    const std::string command = environment + (environment.empty() ? "" : " ") +
                                std::string(RIGOR_BINARY_DIR) + "/bin/rigor " + arguments +
                                (withErrors ? " 2>&1" : " 2>/dev/null");
    FILE* pipe = popen(command.c_str(), "r");
    Result result;
    std::array<char, 4096> buffer;
    while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe))
        result.out.append(buffer.data(), n);
    const int status = pclose(pipe);
    result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
}

}  // namespace rigor::cli_test
