// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page of the cookbook holds its programs as they are. After a change
//     RIGOR_RENEW_COOKBOOK=1 build/release/tests/engine_embedding_test --gtest_filter=Cookbook.*
// writes it again. The programs themselves are run by tests of their own (cookbook_*).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace rigor::engine::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIntroduction =
    "# Cookbook\n\n"
    "Whole programs against the engine's package (`find_package(rigor)`, `rigor::engine`). Each is a file of "
    "`cookbook/`, "
    "and a test\nruns it and compares what it prints.\n";

std::string read(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

/// Title, program and output of one file.
std::string recipe(const fs::path& file) {
    std::istringstream lines(read(file));
    std::string title, printed, program;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("//> "))
            printed = line.substr(4);
        else if (line.starts_with("//") && program.empty()) {
            const bool isTitle = title.empty() && line.size() > 3 && !line.starts_with("// SPDX");
            if (isTitle) title = line.substr(3);
        } else
            program += line + "\n";
    }
    title.pop_back();  // the full stop
    return "\n## " + title + "\n\n```cpp\n" + program + "```\n\nprints `" + printed + "`\n";
}

TEST(Cookbook, ThePageHoldsTheProgramsAsTheyAre) {
    const fs::path folder = fs::path(RIGOR_SOURCE_DIR) / "engine/embedding", page = folder / "COOKBOOK.md";
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder / "cookbook")) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    ASSERT_GE(files.size(), 12u);
    std::string text = kIntroduction;
    for (const fs::path& file : files) text += recipe(file);
    if (std::getenv("RIGOR_RENEW_COOKBOOK") != nullptr) std::ofstream(page) << text;
    EXPECT_EQ(read(page), text) << "to renew: RIGOR_RENEW_COOKBOOK=1";
}

}  // namespace
}  // namespace rigor::engine::test
