// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tests against tables, and against samples of known distributions: the rate of false alarms of a test, the
// coverage of an interval.
#include "validation/comparison/two_samples.hpp"
#include "validation/statistics/quantile.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rigor::validation {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

/// Times of a noisy machine: a median, and a tail towards longer ones.
std::vector<double> times(std::mt19937_64& random, std::size_t count, double scale) {
    std::lognormal_distribution<double> noise(0.0, 0.1);
    std::vector<double> values(count);
    for (double& x : values) x = scale * noise(random);
    return values;
}

TEST(MannWhitney, GivesTheProbabilitiesOfTheTable) {
    // All of one above all of the other: 2 / C(n + m, n).
    EXPECT_NEAR(mannWhitney({1, 2, 3}, {4, 5, 6}), 2.0 / 20.0, 1e-12);
    EXPECT_NEAR(mannWhitney({4, 5, 6, 7}, {0, 1, 2, 3}), 2.0 / 70.0, 1e-12);
    EXPECT_NEAR(mannWhitney({1, 2, 3, 4, 5}, {6, 7, 8, 9, 10}), 2.0 / 252.0, 1e-12);
    // U = 1 for 3 and 3: two of the twenty orders; U = 2 for 4 and 5: 4 of 126.
    EXPECT_NEAR(mannWhitney({1, 2, 4}, {3, 5, 6}), 2.0 * 2.0 / 20.0, 1e-12);
    EXPECT_NEAR(mannWhitney({1, 2, 3, 6}, {4, 5, 7, 8, 9}), 2.0 * 4.0 / 126.0, 1e-12);
    EXPECT_DOUBLE_EQ(mannWhitney({1, 4}, {2, 3}), 1.0);
}

TEST(MannWhitney, IsTheSameBothWaysAndOneOfNothing) {
    const std::vector<double> a{3.0, 1.5, 2.2, 8.1}, b{2.0, 9.4, 7.7, 6.0, 5.5};
    EXPECT_DOUBLE_EQ(mannWhitney(a, b), mannWhitney(b, a));
    EXPECT_DOUBLE_EQ(mannWhitney({}, b), 1.0);
    EXPECT_DOUBLE_EQ(mannWhitney({2, 2, 2}, {2, 2}), 1.0);
}

TEST(MannWhitney, TheApproximationMeetsTheCount) {
    std::mt19937_64 random(3);
    // 25 and 25 are counted; one tie more makes it the approximation, which may differ by little.
    auto one = times(random, 25, 1.0), other = times(random, 25, 1.06);
    const double exact = mannWhitney(one, other);
    one[1] = one[0];
    EXPECT_NEAR(mannWhitney(one, other), exact, 0.1 * exact + 0.01);
}

TEST(MannWhitney, CriesWolfAsOftenAsItSays) {
    std::mt19937_64 random(1);
    int alarms = 0, found = 0;
    constexpr int kTrials = 2000;
    for (int i = 0; i < kTrials; ++i) {
        alarms += mannWhitney(times(random, 10, 1.0), times(random, 10, 1.0)) < 0.05 ? 1 : 0;
        found += mannWhitney(times(random, 10, 1.0), times(random, 10, 1.3)) < 0.05 ? 1 : 0;
    }
    // Exact test of a discrete statistic: at most 5 %, 4.3 % for 10 and 10.
    EXPECT_LT(alarms, 0.06 * kTrials);
    EXPECT_GT(alarms, 0.03 * kTrials);
    EXPECT_GT(found, 0.99 * kTrials);
}

TEST(RatioOfMedians, HoldsTheTruthAsOftenAsItSays) {
    std::mt19937_64 random(2);
    constexpr int kTrials = 400;
    int few = 0, many = 0;
    for (int i = 0; i < kTrials; ++i) {
        const auto holds = [&](std::size_t count) {
            const auto found = ratioOfMedians(times(random, count, 2.0), times(random, count, 3.0), i, 400);
            return found.interval.low <= 1.5 && 1.5 <= found.interval.high ? 1 : 0;
        };
        few += holds(6);
        many += holds(25);
    }
    EXPECT_GT(few, 0.86 * kTrials);
    EXPECT_GT(many, 0.92 * kTrials);
    EXPECT_LT(many, kTrials);  // an interval that always holds is too wide
}

TEST(RatioOfMedians, IsRepeatable) {
    std::mt19937_64 random(4);
    const auto one = times(random, 9, 1.0), other = times(random, 7, 1.4);
    const auto a = ratioOfMedians(one, other, 5), b = ratioOfMedians(one, other, 5);
    EXPECT_EQ(a.interval.low, b.interval.low);
    EXPECT_EQ(a.interval.high, b.interval.high);
    EXPECT_DOUBLE_EQ(a.ratio, median(other) / median(one));
    EXPECT_LE(a.interval.low, a.ratio);
    EXPECT_GE(a.interval.high, a.ratio);
}

TEST(PairedRatio, IsNotMovedByLoadThatBothSee) {
    std::vector<double> one, other;
    for (int i = 0; i < 12; ++i) {
        const double load = 1.0 + 0.5 * i;  // the machine gets slower and slower
        one.push_back(2.0 * load);
        other.push_back(3.0 * load * (1.0 + 1e-3 * (i % 3 - 1)));
    }
    const PairedRatio found = pairedRatio(one, other);
    EXPECT_NEAR(found.ratio, 1.5, 1e-9);
    ASSERT_TRUE(found.interval);
    EXPECT_LT(found.interval->high - found.interval->low, 0.01);
    EXPECT_FALSE(pairedRatio({1, 2, 3}, {2, 4, 6}).interval);
}

TEST(Holm, CorrectsForTheNumberOfTests) {
    EXPECT_THAT(holm({0.01, 0.04, 0.03}),
                ElementsAre(DoubleNear(0.03, 1e-12), DoubleNear(0.06, 1e-12), DoubleNear(0.06, 1e-12)));
    EXPECT_THAT(holm({0.5, 0.9}), ElementsAre(1.0, 1.0));
    EXPECT_TRUE(holm({}).empty());
}

}  // namespace
}  // namespace rigor::validation
