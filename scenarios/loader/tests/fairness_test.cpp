// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The same rules hold for every engine: the library grades accuracy by one scale and bounds no engine by a
// result. Every known deviation names the engine, the reason, and its evidence.
#include <gtest/gtest.h>

#include <cmath>

#include "scenarios/loader/loader.hpp"

namespace rigor::scenario {
namespace {

TEST(Fairness, TheLibrarySetsNoBounds) {
    for (const auto& entry : listScenarios()) {
        const Scenario s = loadScenario(entry.file).scenario;
        EXPECT_TRUE(s.accept.empty())
            << s.name << ": accuracy is graded, changes are seen against the record";
    }
}

TEST(Fairness, DeviationsAreWrongPhysicsWithTheirEvidence) {
    int found = 0;
    for (const auto& entry : listScenarios())
        for (const KnownDeviation& d : loadScenario(entry.file).scenario.knownDeviations) {
            ++found;
            EXPECT_TRUE(d.reason.ends_with("(isolated by experiment)") ||
                        d.reason.ends_with("(inferred, not isolated)"))
                << entry.name << " " << d.engine << " " << d.metric << ": " << d.reason;
            EXPECT_FALSE(std::isfinite(d.max)) << entry.name << ": amounts are on record";
            EXPECT_NE(d.engine, "rigor") << entry.name;
        }
    EXPECT_GT(found, 100);
}

}  // namespace
}  // namespace rigor::scenario
