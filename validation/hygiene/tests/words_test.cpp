// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rigor is written in the words of its field. Private words that once stood for a thing with a name may not
// come back, neither as identifiers nor in comments and documentation. A failure prints the word to use.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "validation/hygiene/tests/source_tree.hpp"

namespace rigor::hygiene {
namespace {

struct Word {
    std::vector<std::string> privateWords;  ///< whole words or phrases; capitals count
    std::string fieldWord;
};

/// Words of the whole tree.
const std::vector<Word> kWords{
    {{"rub", "rubs", "rubK", "rubInvK", "rubImpulse", "rubTotal", "PatchRubs"},
     "friction impulse, tangent mass"},
    {{"Pressed"}, "normal load"},
    {{"PatchTwist", "twistImpulse", "twistTotal"}, "torsional friction"},
    {{"PatchRest", "PatchPlan"}, "cold data, descriptor"},
    {{"kAlone", "kSlices", "kMostRegions", "occupants", "occupants_"},
     "overflow constraints, intervals, partitions, lane contents"},
    {{"Walker", "walkers_", "patience", "kPatience", "Companion", "keeps company", "tickets"},
     "worker, spin count, worker loop, work queue"},
    {{"forShares", "ofShare"}, "chunk (of work)"},
    {{"kShare", "linearJointShare", "endShare", "stiffShare"}, "Baumgarte factor, fraction"},
    {{"fastestPush", "pushApart"}, "maximum bias velocity, penetration bias"},
    {{"aimSettled", "strays", "curvedJoints"}, "re-linearised joint bias, divergence test"},
    {{"bounceAhead"}, "speculative restitution"},
    {{"spoil", "spoils", "spoiled", "spoilPairs", "spoilManifolds", "spoilRows"}, "inject a fault"},
    {{"untidy", "tidy"}, "fragmented, defragment"},
    {{"Tally", "tally", "tallies_"}, "counters"},
    {{"Gone", "gone_", "turned_", "fresh_", "dropped_"}, "ended, touch-state change, begun, removed"},
    {{"stillValid", "keptFor_", "askedDistance", "visitAnswers", "forgetOtherAnswers", "reuseDistance"},
     "contact cache, query distance"},
    {{"EnlargedBoxes", "enlarged boxes", "enlarged box"}, "fat AABB"},
    {{"out.apart", "manifold.apart", "Manifold::apart"}, "separation lower bound"},
    {{"coreReach", "innerRadius"}, "bounding radius, inscribed radius"},
    {{"RowRole::Hold", "rows that hold"}, "equality rows"},
    {{"widestStart", "sharpen"}, "initial tetrahedron, refine the normal"},
    {{"WayOut"}, "penetration vector"},
    {{"Stretch"}, "interval"},
    {{"Meeting", "FaceMeeting", "SideMeeting", "meetings_"}, "face pair, feature pair, coupling"},
    {{"Dice"}, "Rng"},
    {{"Perch", "Footing", "Deed", "Asking", "Servant"}, "support point, contact step, query runner, worker"},
    {{"centre_", "findCentre", "offCentre", "deadCentre"}, "center, in identifiers"},
    {{"nobody", "Nobody", "somebody", "Somebody", "everybody", "Everybody", "whoever", "Whoever"},
     "which object, which thread, which index"},
    {{"in the plane", "In the plane", "in space"}, "in 2D, in 3D"},
    {{"told apart", "tell apart", "tells apart"}, "distinguished"},
    {{"asked for", "asked about", "asking", "askAuditor"}, "requested, queried"},
    {{"says of itself", "declare of themselves", "What it does"}, "declared properties, effect"},
    {{"What came of", "what came of", "What became of"}, "result, outcome"},
    {{"liar", "liars", "LIAR"}, "false entry"},
    {{"taught"}, "not in the adapter yet"},
};

/// Words of code and its comments. In the documentation some of them have their usual meaning.
const std::vector<Word> kWordsOfCode{
    {{"told", "Told", "tell", "tells", "Tells"}, "reported, passed, identified, sent"},
    {{"ask", "asks", "asked", "Asks", "Asked"}, "request, query, require, evaluate"},
    {{"made-up", "cries wolf"}, "synthetic, false alarm"},
};

/// Words of the folders around the engine. In the engine some of them have another meaning: a lane is one of
/// the lanes of a SIMD register.
const std::vector<Word> kWordsOutsideTheEngine{
    {{"lane", "lanes", "Lane", "LanePlan", "LaneProcess", "LaneSlot", "LaneWorld", "LaneSource"},
     "engine instance"},
    {{"wish", "wishes", "wished", "wishGoTo", "wishStage", "wishDrag", "wishNow"}, "request"},
    {{"Ladder", "Ladders", "LadderPoint", "ladders", "rung", "rungs"},
     "time-step refinement, iteration count"},
    {{"yardstick", "yardsticks", "Yardstick"}, "baseline"},
    {{"companion", "companions", "CompanionPlanner"}, "derived run"},
    {{"FrozenProblem", "FreezeRequest", "freezeStep", "frozen problem", "frozen contact problem"},
     "exported contact problem"},
    {{"parting", "partings", "Parting", "Parted", "onset", "onsets"}, "divergence, divergence time"},
    {{"Standing", "standings", "standingsOver"}, "ranking"},
    {{"veil", "veilingBodies"}, "occluder fade"},
    {{"Knock", "knock", "knockOf", "Welcome"}, "credentials, redirect"},
    {{"anybody", "Anybody"}, "which object, which user, which engine"},
    {{"spoilers", "Spoiled", "manieth"}, "injected fault, defect, n-th"}};

/// Continuations of a phrase of geometry: "in the plane z = 0" names a plane, "in the plane" alone a
/// dimension.
const std::vector<std::string> kNamesAPlane{" z", " of ", " through ", " across ", " in which "};

bool hasWord(const std::string& line, const std::string& word) {
    for (std::size_t at = line.find(word); at != std::string::npos; at = line.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        const bool begins = at == 0 || !isWordCharacter(line[at - 1]);
        const bool ends = end == line.size() || !isWordCharacter(line[end]);
        const bool namesAPlane =
            word == "in the plane" &&
            std::any_of(kNamesAPlane.begin(), kNamesAPlane.end(),
                        [&](const std::string& next) { return line.compare(end, next.size(), next) == 0; });
        if (begins && ends && !namesAPlane) return true;
    }
    return false;
}

/// A message for each word of `words` in `text`.
std::vector<std::string> privateWords(const std::vector<Word>& words, const std::string& file,
                                      const std::string& text) {
    std::vector<std::string> found;
    std::size_t number = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string line = text.substr(at, end - at);
        at = end + 1;
        ++number;
        for (const Word& entry : words)
            for (const std::string& word : entry.privateWords)
                if (hasWord(line, word))
                    found.push_back(file + ":" + std::to_string(number) + ": \"" + word + "\", use \"" +
                                    entry.fieldWord + "\"");
    }
    return found;
}

/// Old names of stored data and options, which go on being understood.
const std::set<std::pair<std::string, std::string>> kOldNames{
    {"cli/list.cpp", "asked"},
    {"validation/collide/print.cpp", "asked"},
    {"cli/view/live_site.cpp", "lane"},
    {"validation/live/session_commands.cpp", "lane"},
    {"validation/live/tests/session_test.cpp", "lane"},
    {"cli/view/tests/view_command_test.cpp", "lane"},
    {"validation/studies/columns.hpp", "onset"},
    {"validation/studies/tests/study_test.cpp", "onset"},
    {"reports/model/derived_runs.cpp", "companion"},
    {"reports/tests/view_model_test.cpp", "companion"}};

bool isOldName(const std::string& file, const std::string& message) {
    return std::any_of(kOldNames.begin(), kOldNames.end(), [&](const auto& known) {
        return known.first == file && message.find("\"" + known.second + "\"") != std::string::npos;
    });
}

/// Private words left in the references: the number may fall, not rise.
constexpr std::size_t kMostLeft = 38;

TEST(Words, OfTheTreeAreThoseOfTheField) {
    std::size_t read = 0, left = 0;
    for (const std::string& file :
         sourceFiles({".cpp", ".hpp", ".def", ".ts", ".css", ".md", "CMakeLists.txt"})) {
        const bool engine = file.starts_with("engine/");
        if (file.starts_with("validation/hygiene/") || file == "CHANGELOG.md")
            continue;  // they name old words
        ++read;
        const std::string text = readFile(file);
        std::vector<std::string> found = privateWords(kWords, file, text);
        if (!engine)
            for (std::string& message : privateWords(kWordsOutsideTheEngine, file, text))
                found.push_back(std::move(message));
        if (!file.ends_with(".md"))
            for (std::string& message : privateWords(kWordsOfCode, file, text))
                found.push_back(std::move(message));
        for (const std::string& message : found)
            if (file.starts_with("validation/references/"))
                ++left;
            else if (!isOldName(file, message))
                ADD_FAILURE() << message;
    }
    EXPECT_GT(read, 1400u);
    EXPECT_LE(left, kMostLeft);
}

TEST(Words, TheRuleFindsWholeWords) {
    EXPECT_EQ(privateWords(kWords, "a", "int patience;\n// Nobody waits.\nout.apart = 0;").size(), 3u);
    EXPECT_TRUE(privateWords(kWords, "a", "impatience, scrub(), apart, settles, Meetings").empty());
    EXPECT_EQ(privateWords(kWords, "a", "\nstruct FaceMeeting {").at(0),
              "a:2: \"FaceMeeting\", use \"face pair, feature pair, coupling\"");
    EXPECT_EQ(privateWords(kWords, "a", "in the plane\nin the plane, too\nin the plane z = 0").size(), 2u);
    EXPECT_EQ(privateWords(kWordsOutsideTheEngine, "a", "a lane\na plane").size(), 1u);
}

}  // namespace
}  // namespace rigor::hygiene
