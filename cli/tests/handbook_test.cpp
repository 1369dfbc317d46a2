// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every command of the handbook runs: those of the tutorials and chapters end with exit code 0, as do the right answers
// of the exercises; the wrong answers do not. The commands of both languages are the same (web_unit_test), so those of
// the English pages are run. A page is a test of its own, in a folder of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <regex>

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
        EXPECT_EQ(ended.code == 0, command.endsWell) << command.line << "\n" << ended.output;
    }
}

INSTANTIATE_TEST_SUITE_P(Pages, Handbook, testing::ValuesIn(pages()), [](const auto& page) {
    std::string name = page.param;
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
});

/// The place of a judge that the reader fills in: a word in capitals.
const std::regex kPlace(R"(\b[A-Z]+\b)");

/// The number that a command has in the place of the judge; none where the command differs elsewhere.
std::optional<double> numberIn(const std::string& judge, const std::string& command) {
    std::smatch place;
    if (!std::regex_search(judge, place, kPlace)) return std::nullopt;
    const std::string before = place.prefix(), after = place.suffix();
    if (!command.starts_with(before) || !command.ends_with(after)) return std::nullopt;
    return std::stod(command.substr(before.size()));
}

/// A place named NAME takes a word; any other a number, of which a smaller and a larger one must be wrong, so that
/// neither nothing at all nor too much of it passes.
TEST(HandbookPages, NumbersAreJudgedFromBothSides) {
    std::size_t numeric = 0, words = 0;
    for (const std::string& page : pages())
        for (const ShownExercise& exercise : readShownExercises(kPages / (page + ".md"))) {
            const std::string& judge = exercise.judges.front();
            std::smatch place;
            if (!std::regex_search(judge, place, kPlace)) continue;
            ASSERT_FALSE(exercise.answers.empty()) << judge;
            if (place.str() == "NAME") {
                EXPECT_FALSE(exercise.wrongs.empty()) << judge;
                ++words;
                continue;
            }
            const std::optional<double> right = numberIn(judge, exercise.answers[0]);
            ASSERT_TRUE(right) << exercise.answers[0];
            bool smaller = false, larger = false;
            for (const std::string& wrong : exercise.wrongs)
                if (const auto number = numberIn(judge, wrong)) (*number < *right ? smaller : larger) = true;
            EXPECT_TRUE(smaller && larger) << page << ": " << judge;
            ++numeric;
        }
    EXPECT_GE(numeric, 11u);
    EXPECT_GE(words, 6u);
}

/// Engines that do as good as nothing: the one that `rigor new engine` writes, which knows free flight only; the same that
/// says that it has shapes; and this without motion.
class EngineThatDoesNothing : public testing::TestWithParam<const char*> {};

TEST_P(EngineThatDoesNothing, IsRedInEveryExerciseForAnEngineOfOnesOwn) {
    const std::string name = GetParam();
    const fs::path folder = fs::path(RIGOR_BINARY_DIR) / "handbook-test" / name;
    fs::remove_all(folder);
    fs::create_directories(folder);
    ASSERT_EQ(runShownCommand(folder, "./rigor new engine mine --language python").code, 0);
    const std::string shapes =
        R"(s/"dimensions": .2, 3.,/& "shapes": ["box", "circle", "half_plane", "half_space", "sphere"],/)";
    if (name != "written") {
        ASSERT_EQ(runShownCommand(folder, "sed -i '" + shapes + "' mine/mine.py").code, 0);
    }
    if (name == "frozen") {
        ASSERT_EQ(runShownCommand(folder, "sed -i 's/if body.moves:/if False:/' mine/mine.py").code, 0);
    }
    std::size_t own = 0;
    for (const std::string& page : pages())
        for (const ShownExercise& exercise : readShownExercises(kPages / (page + ".md"))) {
            const std::string& judge = exercise.judges.front();
            if (!judge.starts_with("RIGOR_ADAPTER_PATH=mine")) continue;
            const Ended ended = runShownCommand(folder, judge);
            EXPECT_EQ(ended.code, name == "written" ? 4 : 1) << page << ": " << judge << "\n" << ended.output;
            ++own;
        }
    EXPECT_GE(own, 9u);
}

INSTANTIATE_TEST_SUITE_P(OwnEngine, EngineThatDoesNothing, testing::Values("written", "falling", "frozen"),
                         [](const auto& engine) { return std::string(engine.param); });

}  // namespace
}  // namespace rigor::cli_test
