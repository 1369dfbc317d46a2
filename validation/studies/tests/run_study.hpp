// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A study run by the program itself, as a user runs it.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace rigor::validation {

/// A new folder that no other process has: a study whose folder another run of the test takes away ends with
/// "attempt to write a readonly database".
inline std::filesystem::path newFolder() {
    std::string name = (std::filesystem::path(testing::TempDir()) / "rigor-study-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
    return name;
}

/// JSON output of `rigor study`; its exit code in `code`.
inline nlohmann::json runStudy(const std::string& study, int& code) {
    const auto folder = newFolder();
    const std::string command = std::string(RIGOR_BINARY_DIR) + "/bin/rigor study " + study +
                                " -q -j 2 --json --out " + folder.string();
    FILE* pipe = popen(command.c_str(), "r");
    std::string out;
    char buffer[4096];
    while (const std::size_t n = fread(buffer, 1, sizeof buffer, pipe)) out.append(buffer, n);
    const int status = pclose(pipe);
    code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    std::filesystem::remove_all(folder);
    return nlohmann::json::parse(out, nullptr, false);
}

}  // namespace rigor::validation
