// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every command of the README runs, in order, in an empty folder, and ends as a reader would expect: with
// exit code 0.
// `./rigor` stands for the program here; `./rigor test` is what runs this test, so it is not run again.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// Lines that start with "./rigor" inside ```sh fences, and the files the README shows (```json fences after
/// `FILE:` lines).
struct Readme {
    std::vector<std::string> commands;
    std::vector<std::pair<std::string, std::string>> files;
};

Readme parseReadme() {
    std::ifstream in(fs::path(RIGOR_SOURCE_DIR) / "README.md");
    Readme readme;
    std::string line, fence, body, fileName;
    while (std::getline(in, line)) {
        if (line.starts_with("```")) {
            if (fence == "json" && !fileName.empty()) readme.files.emplace_back(fileName, body);
            fence = fence.empty() ? line.substr(3) : "";
            body.clear();
            if (fence.empty()) fileName.clear();
            continue;
        }
        if (fence == "sh" && line.starts_with("./rigor"))
            readme.commands.push_back(line.substr(0, line.find("  #")));
        if (fence == "json") body += line + "\n";
        if (fence.empty() && line.starts_with("File `")) fileName = line.substr(6, line.find('`', 6) - 6);
    }
    return readme;
}

TEST(Readme, EveryCommandRuns) {
    const Readme readme = parseReadme();
    const fs::path folder = fs::path(RIGOR_BINARY_DIR) / "readme-test";
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (const auto& [name, text] : readme.files) std::ofstream(folder / name) << text;
    int validates = 0, tests = 0, others = 0;
    for (const std::string& command : readme.commands) {
        if (command == "./rigor test") {
            ++tests;
            continue;
        }
        // Commands on measured data, and those on what they make, need the data: they are not part of the
        // repo.
        if (std::getenv("RIGOR_DATA") == nullptr && command.find("toss") != std::string::npos) continue;
        command.starts_with("./rigor validate") ? ++validates : ++others;
        // Servers run until they are interrupted.
        const bool serves = command.starts_with("./rigor view");
        const std::string line = "cd '" + folder.string() + "' && " +
                                 (serves ? "timeout --preserve-status -s INT 4 " : "") + "'" +
                                 std::string(RIGOR_BINARY_DIR) + "/bin/rigor'" +
                                 command.substr(std::string("./rigor").size()) + " > output.txt 2>&1";
        const int status = std::system(line.c_str());
        std::ifstream output(folder / "output.txt");
        std::stringstream text;
        text << output.rdbuf();
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << command << "\n"
                                                                   << text.str().substr(0, 4000);
    }
    EXPECT_EQ(tests, 1);
    EXPECT_GE(validates, 2);
    EXPECT_GE(others, 5);
    EXPECT_TRUE(fs::exists(folder / "runs" / "latest" / "index.html"));
}

}  // namespace
