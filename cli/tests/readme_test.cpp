// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every command of the README runs, in order, in an empty folder, and ends as a reader would expect: with
// exit code 0.
// `./rigor` stands for the program here; `./rigor test` is what runs this test, so it is not run again.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "cli/tests/shown_commands.hpp"

namespace rigor::cli_test {
namespace {

namespace fs = std::filesystem;

/// Commands of the launcher, not of the program.
bool isForTheLauncher(const std::string& line) {
    return line.starts_with("./rigor --with") || line.starts_with("./rigor docs");
}

TEST(Readme, EveryCommandRuns) {
    const ShownCommands readme = readShownCommands(fs::path(RIGOR_SOURCE_DIR) / "README.md");
    const fs::path folder = fs::path(RIGOR_BINARY_DIR) / "readme-test";
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (const auto& [name, text] : readme.files) std::ofstream(folder / name) << text;
    int validates = 0, tests = 0, others = 0;
    for (const ShownCommand& command : readme.commands) {
        if (command.line == "./rigor test") {
            ++tests;
            continue;
        }
        if (isForTheLauncher(command.line)) continue;
        // Commands on measured data, and those on what they make, need the data: they are not part of the
        // repo.
        if (std::getenv("RIGOR_DATA") == nullptr && command.line.find("toss") != std::string::npos) continue;
        command.line.starts_with("./rigor validate") ? ++validates : ++others;
        const auto start = std::chrono::steady_clock::now();
        const Ended ended = runShownCommand(folder, command.line);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        std::printf("%6.1f s  %s\n", seconds.count(), command.line.c_str());
        std::fflush(stdout);
        EXPECT_EQ(ended.code, 0) << command.line << "\n" << ended.output;
    }
    EXPECT_EQ(tests, 1);
    EXPECT_GE(validates, 2);
    EXPECT_GE(others, 5);
    EXPECT_TRUE(fs::exists(folder / "runs" / "latest" / "index.html"));
}

}  // namespace
}  // namespace rigor::cli_test
