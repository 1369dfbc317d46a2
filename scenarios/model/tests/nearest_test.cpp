// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/model/nearest.hpp"

#include <gtest/gtest.h>

namespace rigor::scenario {
namespace {

TEST(Nearest, EditDistances) {
    EXPECT_EQ(editDistance("", ""), 0u);
    EXPECT_EQ(editDistance("", "abc"), 3u);
    EXPECT_EQ(editDistance("solver", "sover"), 1u) << "an insertion";
    EXPECT_EQ(editDistance("solver", "slover"), 1u) << "neighbours swapped";
    EXPECT_EQ(editDistance("solver", "solvar"), 1u) << "a substitution";
    EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
    EXPECT_EQ(editDistance("ca", "abc"), 3u) << "no part is edited twice";
}

TEST(Nearest, TheNearestNameOrNone) {
    const std::vector<std::string> keys{"iterations", "integrator", "solver", "slop"};
    EXPECT_EQ(nearestName("itertions", keys), "iterations");
    EXPECT_EQ(nearestName("slver", keys), "solver");
    EXPECT_EQ(nearestName("SLOP", keys), std::nullopt);
    EXPECT_EQ(nearestName("gravity_of_mars", keys), std::nullopt);
    EXPECT_EQ(nearestName("solver", {}), std::nullopt);
    EXPECT_EQ(didYouMean("iteratons", keys), "; did you mean 'iterations'?");
    EXPECT_EQ(didYouMean("xyz", keys), "");
    EXPECT_EQ(nearestName("nope", {"ode", "rope"}), "rope") << "one letter";
    EXPECT_EQ(nearestName("nope", {"ode"}), std::nullopt) << "two edits of four letters";
    EXPECT_EQ(nearestName("od", {"ode"}), "ode");
    EXPECT_EQ(nearestName("bulet", {"box2d", "bullet"}), "bullet");
}

}  // namespace
}  // namespace rigor::scenario
