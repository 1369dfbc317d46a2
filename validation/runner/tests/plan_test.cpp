// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <gmock/gmock.h>

#include <set>

#include "validation/hash.hpp"
#include "validation/runner/tests/fixtures.hpp"

namespace rigor::validation {
namespace {

using fixtures::load;
using fixtures::thrownBall;
using testing::ElementsAre;

/// Published test vectors of FNV-1a 64: "" and "foobar".
TEST(Hash, IsFnv1a) {
    EXPECT_EQ(Fnv1a().hex(), "cbf29ce484222325");
    Fnv1a hash;
    for (const char c : std::string("foobar")) hash.byte(static_cast<std::uint8_t>(c));
    EXPECT_EQ(hash.hex(), "85944171f73967e8");
}

TEST(Plan, PresetsAreExpandedAndStepsMultiply) {
    const auto plan = planCases({load(thrownBall("a")), load(thrownBall("b"))},
                                adapter::parseSpecList("x,y:preset=matched"), {0.01, 0.005, 0.01});
    std::vector<std::string> rows;
    for (const CasePlan& c : plan)
        rows.push_back(c.scenario.name + " " + c.spec.text() + (c.dt == 0.01 ? " coarse" : " fine"));
    EXPECT_THAT(
        rows,
        ElementsAre("a x:preset=default coarse", "a x:preset=matched coarse", "a y:preset=matched coarse",
                    "a x:preset=default fine", "a x:preset=matched fine", "a y:preset=matched fine",
                    "b x:preset=default coarse", "b x:preset=matched coarse", "b y:preset=matched coarse",
                    "b x:preset=default fine", "b x:preset=matched fine", "b y:preset=matched fine"));
}

TEST(Plan, IdsAreStableAndTellCasesApart) {
    const auto once = planCases({load(thrownBall("a"))}, adapter::parseSpecList("x,y:k=1"), {0.01, 0.005});
    const auto again = planCases({load(thrownBall("a"))}, adapter::parseSpecList("x,y:k=1"), {0.01, 0.005});
    const auto other = planCases({load(thrownBall("a", R"(, "tags": ["t"])"))},
                                 adapter::parseSpecList("x,y:k=1"), {0.01, 0.005});
    std::set<std::string> ids;
    for (std::size_t i = 0; i < once.size(); ++i) {
        EXPECT_EQ(once[i].id, again[i].id);
        ids.insert(once[i].id);
        ids.insert(other[i].id);
    }
    EXPECT_EQ(ids.size(), 2 * once.size());
}

TEST(Plan, TheSameTwiceIsOneCaseAndANameMeansOneText) {
    EXPECT_EQ(
        planCases({load(thrownBall("a")), load(thrownBall("a"))}, adapter::parseSpecList("x,x"), {}).size(),
        2u);
    EXPECT_THROW(planCases({load(thrownBall("a")), load(thrownBall("a", R"(, "tags": ["t"])"))},
                           adapter::parseSpecList("x"), {}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace rigor::validation
