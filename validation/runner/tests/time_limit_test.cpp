// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/time_limit.hpp"

#include <gtest/gtest.h>

namespace rigor::validation {
namespace {

TEST(TimeLimit, WhoHasHadItsProcessorTimeIsOver) {
    TimeLimit limit(10.0);
    EXPECT_FALSE(limit.isOver(9.9, 9.9));
    EXPECT_TRUE(limit.isOver(10.0, 10.0));
    EXPECT_TRUE(TimeLimit(10.0).isOver(10.0, -1.0)) << "nothing is known of its processor time";
}

TEST(TimeLimit, WhoWorksOnABusyMachineGoesOn) {
    TimeLimit limit(10.0);
    for (double elapsed = 0.0; elapsed < 30.0; elapsed += 0.5)
        EXPECT_FALSE(limit.isOver(elapsed, 0.3 * elapsed)) << elapsed;
    EXPECT_TRUE(limit.isOver(34.0, 10.2));
}

TEST(TimeLimit, WhoIsBlockedIsOverTwoSecondsAfterTheLimitOrItsLastWork) {
    TimeLimit sleeper(10.0);
    EXPECT_FALSE(sleeper.isOver(11.9, 0.0));
    EXPECT_TRUE(sleeper.isOver(12.0, 0.0));
    TimeLimit worker(10.0);
    EXPECT_FALSE(worker.isOver(15.0, 5.0));
    EXPECT_FALSE(worker.isOver(16.9, 5.0005)) << "that much it takes to be looked at";
    EXPECT_TRUE(worker.isOver(17.0, 5.0005));
}

TEST(TimeLimit, NoWorkGoesOnForEver) {
    TimeLimit limit(10.0);
    for (double elapsed = 10.0; elapsed < 199.5; elapsed += 1.0)
        EXPECT_FALSE(limit.isOver(elapsed, 0.01 * elapsed)) << elapsed;
    EXPECT_TRUE(limit.isOver(200.0, 2.0));
}

}  // namespace
}  // namespace rigor::validation
