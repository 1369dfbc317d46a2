// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A module with answers that fit nothing: one red row each, with a sentence of bounded length; or a line of the ledger
// where the answer can still be used.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "validation/runner/tests/fixtures.hpp"

namespace rigor::validation {
namespace {

using namespace fixtures;
using results::Outcome;
using results::Verdict;
using testing::HasSubstr;

class HostileModules : public RunnerTest {
  protected:
    results::CaseRow rowOf(const std::string& fault) {
        const std::string spec = "double_hostile:fault=" + fault + ",preset=default";
        return run(plan({thrownBall("ball")}, spec), options(fault)).cases.at(0);
    }
};

TEST_F(HostileModules, AnswersThatDoNotFitAreErrors) {
    struct Expected {
        const char* fault;
        const char* reason;
    };
    for (const Expected& e :
         {Expected{"contact", "contact 0 of a step names body 1000000, expected 0 to 1"},
          Expected{"material", "a pair of the read-back names material 1000000, expected 0 to 0"},
          Expected{"ledger", "the parity ledger has 1000000 lines, expected at most 10000"},
          Expected{"phases", "a step has 1000 phases, expected at most 64"}}) {
        const results::CaseRow row = rowOf(e.fault);
        EXPECT_EQ(row.outcome, Outcome::Error) << e.fault;
        EXPECT_EQ(row.verdict, Verdict::Fail) << e.fault;
        EXPECT_EQ(row.reason, e.reason);
    }
}

TEST_F(HostileModules, LongTextsAreCutAndCannotSteerATerminal) {
    const results::CaseRow thrown = rowOf("long_exception"), refused = rowOf("long_refusal");
    EXPECT_EQ(thrown.outcome, Outcome::Error);
    EXPECT_EQ(refused.outcome, Outcome::Unsupported);
    EXPECT_THAT(thrown.reason, testing::StartsWith("\\x1b[31mxxx"));
    EXPECT_THAT(thrown.reason, HasSubstr("(cut: 104857605 bytes, at most 4096 are kept)"));
    EXPECT_LT(thrown.reason.size(), 4300u);
    EXPECT_LT(refused.reason.size(), 4300u);
}

/// The module changes the environment after it has computed its step: numbers and metrics are those of the honest
/// double, and the ledger says what happened.
TEST_F(HostileModules, TheFloatingPointEnvironmentIsPutBack) {
    const auto honest =
        run(plan({thrownBall("ball")}, "double_free_flight:preset=default"), options("honest")).cases.at(0);
    struct Expected {
        const char* fault;
        const char* found;
    };
    for (const Expected& e :
         {Expected{"rounding", "rounds upward after step()"},
          Expected{"denormals", "flushes denormals, reads denormals as zero after step()"}}) {
        const results::CaseRow row = rowOf(e.fault);
        EXPECT_EQ(row.outcome, Outcome::Completed);
        EXPECT_EQ(row.stateHash, honest.stateHash);
        ASSERT_EQ(row.ledger.size(), 1u) << e.fault;
        EXPECT_EQ(row.ledger[0].topic, "floating_point_environment");
        EXPECT_EQ(row.ledger[0].resolved, e.found);
        for (const auto& m : honest.metrics) {
            if (m.kind != honest.metrics[0].kind) continue;
            const auto same = std::find_if(row.metrics.begin(), row.metrics.end(), [&](const auto& other) {
                return other.name == m.name && other.subject == m.subject;
            });
            ASSERT_NE(same, row.metrics.end()) << m.name;
            if (std::isnan(m.value)) continue;
            EXPECT_EQ(same->value, m.value) << m.name << " with " << e.fault;
        }
    }
    EXPECT_TRUE(honest.ledger.empty());
}

}  // namespace
}  // namespace rigor::validation
