// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every command of the handbook runs: those of the tutorials and chapters end with exit code 0, as do the right answers
// of the exercises; the wrong answers do not. The commands of both languages are the same (web_unit_test), so those of
// the English pages are run. A page is a test of its own, in a folder of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "cli/tests/shown_commands.hpp"

namespace rigor::cli_test {
namespace {

namespace fs = std::filesystem;

const fs::path kPages = fs::path(RIGOR_SOURCE_DIR) / "reports" / "handbook" / "en";

std::vector<std::string> pages() {
    std::vector<std::string> all;
    for (const char* part : {"build", "use"})
        for (const auto& entry : fs::directory_iterator(kPages / part))
            all.push_back(std::string(part) + "/" + entry.path().stem().string());
    std::sort(all.begin(), all.end());
    return all;
}

class Handbook : public testing::TestWithParam<std::string> {};

TEST_P(Handbook, EveryCommandEndsAsThePageSays) {
    const ShownCommands shown = readShownCommands(kPages / (GetParam() + ".md"));
    const fs::path folder = fs::path(RIGOR_BINARY_DIR) / "handbook-test" / GetParam();
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (const auto& [name, text] : shown.files) std::ofstream(folder / name) << text;
    EXPECT_GE(shown.commands.size(), 3u);
    for (const ShownCommand& command : shown.commands) {
        const Ended ended = runShownCommand(folder, command.line);
        EXPECT_EQ(ended.well, command.endsWell) << command.line << "\n" << ended.output;
    }
}

INSTANTIATE_TEST_SUITE_P(Pages, Handbook, testing::ValuesIn(pages()), [](const auto& page) {
    std::string name = page.param;
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
});

TEST(HandbookPages, ExercisesHaveWrongAnswersThatAreNoticed) {
    std::size_t wrong = 0, right = 0;
    for (const std::string& page : pages())
        for (const ShownCommand& command : readShownCommands(kPages / (page + ".md")).commands)
            (command.endsWell ? right : wrong) += 1;
    EXPECT_GE(right, 50u);
    EXPECT_GE(wrong, 12u);
}

}  // namespace
}  // namespace rigor::cli_test
