// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/statistics/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

namespace rigor::validation {
namespace {

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

/// Compared with the definition of the probability: the count over all ways to divide the ranks into two
/// samples.
TEST(Statistics, KolmogorovSmirnovIsExact) {
    constexpr int kOne = 4, kAll = 9;
    const auto distanceOf = [&](unsigned hand) {
        double d = 0.0;
        int a = 0, b = 0;
        for (int rank = 0; rank < kAll; ++rank) {
            ((hand >> rank) & 1u) != 0 ? ++a : ++b;
            d = std::max(d, std::abs(a / double(kOne) - b / double(kAll - kOne)));
        }
        return d;
    };
    std::vector<unsigned> hands;
    for (unsigned hand = 0; hand < (1u << kAll); ++hand)
        if (std::popcount(hand) == kOne) hands.push_back(hand);
    ASSERT_EQ(hands.size(), 126u);
    for (const unsigned hand : hands) {
        std::vector<double> one, other;
        for (int rank = 0; rank < kAll; ++rank) ((hand >> rank) & 1u ? one : other).push_back(rank);
        const KolmogorovSmirnov test = kolmogorovSmirnov(one, other);
        const double d = distanceOf(hand);
        EXPECT_NEAR(test.distance, d, 1e-15);
        const auto atLeast =
            std::count_if(hands.begin(), hands.end(), [&](unsigned h) { return distanceOf(h) >= d - 1e-12; });
        EXPECT_NEAR(test.p, atLeast / 126.0, 1e-14);
    }
}

TEST(Statistics, KolmogorovSmirnovDistinguishesDistributions) {
    std::vector<double> a, b, shifted;
    for (int i = 0; i < 30; ++i) {
        a.push_back(i);
        b.push_back(i + 0.5);
        shifted.push_back(i + 14.5);
    }
    EXPECT_GT(kolmogorovSmirnov(a, b).p, 0.99);
    EXPECT_LT(kolmogorovSmirnov(a, shifted).p, 0.003);
    EXPECT_EQ(kolmogorovSmirnov(a, a).p, 1.0);
    EXPECT_EQ(kolmogorovSmirnov({1, 1, 1}, {1, 1}).p, 1.0) << "ties are no difference";
    // Nothing in common: 2 / C(60, 30)
    std::vector<double> above;
    for (int i = 0; i < 30; ++i) above.push_back(100 + i);
    EXPECT_EQ(kolmogorovSmirnov(a, above).distance, 1.0);
    double paths = 1.0;
    for (int i = 1; i <= 30; ++i) paths *= (30.0 + i) / i;
    EXPECT_NEAR(kolmogorovSmirnov(a, above).p * paths, 2.0, 1e-9);
}

}  // namespace
}  // namespace rigor::validation
