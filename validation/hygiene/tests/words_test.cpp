// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The engine is written in the words of its field. Private words that once stood for a thing with a name may
// not come back, neither as identifiers nor in comments. A failure prints the word to use.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "validation/hygiene/tests/source_tree.hpp"

namespace rigor::hygiene {
namespace {

struct Word {
    std::vector<std::string> privateWords;  ///< whole words or phrases; capitals count
    std::string fieldWord;
};

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
};

bool isWordCharacter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool hasWord(const std::string& line, const std::string& word) {
    for (std::size_t at = line.find(word); at != std::string::npos; at = line.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        const bool begins = at == 0 || !isWordCharacter(line[at - 1]);
        const bool ends = end == line.size() || !isWordCharacter(line[end]);
        if (begins && ends) return true;
    }
    return false;
}

/// A message for each private word in `text`.
std::vector<std::string> privateWords(const std::string& file, const std::string& text) {
    std::vector<std::string> found;
    std::size_t number = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string line = text.substr(at, end - at);
        at = end + 1;
        ++number;
        for (const Word& entry : kWords)
            for (const std::string& word : entry.privateWords)
                if (hasWord(line, word))
                    found.push_back(file + ":" + std::to_string(number) + ": \"" + word + "\", use \"" +
                                    entry.fieldWord + "\"");
    }
    return found;
}

TEST(Words, OfTheEngineAreThoseOfTheField) {
    std::size_t read = 0;
    for (const std::string& file : sourceFiles({".cpp", ".hpp", ".def"})) {
        if (!file.starts_with("engine/")) continue;
        ++read;
        for (const std::string& found : privateWords(file, readFile(file))) ADD_FAILURE() << found;
    }
    EXPECT_GT(read, 300u);
}

TEST(Words, TheRuleFindsWholeWords) {
    EXPECT_EQ(privateWords("a", "int patience;\n// Nobody waits.\nout.apart = 0;").size(), 3u);
    EXPECT_TRUE(privateWords("a", "impatience, scrub(), apart, settles, Meetings").empty());
    EXPECT_EQ(privateWords("a", "\nstruct FaceMeeting {").at(0),
              "a:2: \"FaceMeeting\", use \"face pair, feature pair, coupling\"");
}

}  // namespace
}  // namespace rigor::hygiene
