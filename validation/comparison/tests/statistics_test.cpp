// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rigor::validation {
namespace {

TEST(Statistics, Median) {
    EXPECT_EQ(median({3.0}), 3.0);
    EXPECT_EQ(median({5.0, 1.0, 3.0}), 3.0);
    EXPECT_EQ(median({4.0, 1.0, 3.0, 2.0}), 2.5);
}

/// Ranks of the 95 % interval, Conover 1999, table A3 and direct sums of binomial coefficients: P(Bin(6) = 0)
/// = 1/64 <= 0.025, P(Bin(10) <= 1) = 11/1024, P(Bin(20) <= 5) = 21700/1048576 = 0.0207.
TEST(Statistics, RanksOfTheMediansInterval) {
    const auto ranks = [](int n) {
        std::vector<double> values;
        for (int i = n; i > 0; --i) values.push_back(i);
        return medianInterval(values);
    };
    EXPECT_FALSE(ranks(5));
    EXPECT_EQ(ranks(6)->low, 1.0);
    EXPECT_EQ(ranks(6)->high, 6.0);
    EXPECT_EQ(ranks(10)->low, 2.0);
    EXPECT_EQ(ranks(10)->high, 9.0);
    EXPECT_EQ(ranks(20)->low, 6.0);
    EXPECT_EQ(ranks(20)->high, 15.0);
}

TEST(Statistics, TheIntervalCoversTheMedianAsOftenAsItSays) {
    std::mt19937_64 random(7);
    std::exponential_distribution<double> draw(1.0);
    int covered = 0;
    constexpr int kTrials = 2000;
    for (int t = 0; t < kTrials; ++t) {
        std::vector<double> values(15);
        for (double& v : values) v = draw(random);
        const auto interval = medianInterval(values);
        covered += interval->low <= std::log(2.0) && std::log(2.0) <= interval->high;
    }
    EXPECT_GE(covered, static_cast<int>(0.95 * kTrials));  // 96.5 % for 15 values
    EXPECT_LE(covered, static_cast<int>(0.98 * kTrials));
}

TEST(Statistics, SignTest) {
    EXPECT_EQ(signTest(0, 0), 1.0);
    EXPECT_EQ(signTest(3, 3), 1.0);
    EXPECT_NEAR(signTest(0, 5), 2.0 / 32.0, 1e-15);
    EXPECT_NEAR(signTest(9, 1), 2.0 * 11.0 / 1024.0, 1e-15);
    EXPECT_EQ(signTest(9, 1), signTest(1, 9));
}

}  // namespace
}  // namespace rigor::validation
