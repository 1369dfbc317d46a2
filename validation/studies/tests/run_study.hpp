// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A study run by the program itself, as a user runs it.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace rigor::validation {

/// What `rigor study` prints as JSON; its exit code in `code`.
inline nlohmann::json runStudy(const std::string& study, int& code) {
    const auto folder = std::filesystem::path(testing::TempDir()) /
                        (std::string("study-") + std::filesystem::path(study).stem().string());
    std::filesystem::remove_all(folder);
    const std::string command = std::string(RIGOR_BINARY_DIR) + "/bin/rigor study " + study +
                                " -q -j 2 --json --out " + folder.string();
    FILE* pipe = popen(command.c_str(), "r");
    std::string out;
    char buffer[4096];
    while (const std::size_t n = fread(buffer, 1, sizeof buffer, pipe)) out.append(buffer, n);
    const int status = pclose(pipe);
    code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return nlohmann::json::parse(out, nullptr, false);
}

}  // namespace rigor::validation
