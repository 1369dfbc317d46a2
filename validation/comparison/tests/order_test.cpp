// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/order.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rigor::validation {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<RefinementPoint> power(double factor, double order, int points) {
    std::vector<RefinementPoint> refinement;
    for (int i = 0; i < points; ++i) {
        const double dt = std::ldexp(1.0 / 60.0, -i);
        refinement.push_back({dt, factor * std::pow(dt, order)});
    }
    return refinement;
}

TEST(ObservedOrder, IsThatOfAPowerLaw) {
    for (const double order : {0.5, 1.0, 2.0, 4.0}) {
        const auto fit = observedOrder(power(3.0, order, 4));
        ASSERT_TRUE(fit);
        EXPECT_NEAR(fit->order, order, 1e-12);
        ASSERT_TRUE(fit->low && fit->high);
        EXPECT_NEAR(*fit->high - *fit->low, 0.0, 1e-11);
        EXPECT_EQ(fit->points, 4);
        EXPECT_EQ(fit->coarsest, 1.0 / 60.0);
        EXPECT_EQ(fit->note, "");
    }
}

TEST(ObservedOrder, TwoPointsGiveASlopeAndNoInterval) {
    const auto fit = observedOrder(power(2.0, 1.0, 2));
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->order, 1.0, 1e-12);
    EXPECT_FALSE(fit->low || fit->high);
}

/// x = 0, 1, 2, 3; y = 0, 1.1, 1.9, 3: slope 0.98, residuals give s^2 = 0.009, Sxx = 5, t(0.975, 2)
/// = 4.30265.
TEST(ObservedOrder, IntervalIsThatOfTheRegression) {
    std::vector<RefinementPoint> refinement;
    const double y[] = {0.0, 1.1, 1.9, 3.0};
    for (int i = 0; i < 4; ++i) refinement.push_back({std::exp(double(i)), std::exp(y[i])});
    const auto fit = observedOrder(refinement);
    ASSERT_TRUE(fit && fit->low && fit->high);
    EXPECT_NEAR(fit->order, 0.98, 1e-12);
    const double half = 4.302652729911275 * std::sqrt(0.009 / 5.0);
    EXPECT_NEAR(*fit->high - fit->order, half, 1e-9);
    EXPECT_NEAR(fit->order - *fit->low, half, 1e-9);
}

TEST(ObservedOrder, LeavesOutRoundOffAndSaysSo) {
    auto refinement = power(1.0, 4.0, 5);
    refinement.push_back({1e-5, 3e-15});
    refinement.push_back({1e-6, 0.0});
    const auto fit = observedOrder(refinement);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->order, 4.0, 1e-9);
    EXPECT_EQ(fit->points, 5);
    EXPECT_EQ(fit->note, "left out: 2 at round-off");
}

TEST(ObservedOrder, LeavesOutTheFineEndThatNoLongerShrinks) {
    auto refinement = power(1.0, 2.0, 4);
    const double least = refinement.back().error;
    refinement.push_back({1e-4, 2.0 * least});
    refinement.push_back({1e-5, 9.0 * least});
    const auto fit = observedOrder(refinement);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->order, 2.0, 1e-9);
    EXPECT_EQ(fit->note, "left out: 2 no longer shrinking");
}

TEST(ObservedOrder, AnErrorThatOnlyGrowsIsShownAsItIs) {
    const auto fit = observedOrder(power(1.0, -1.0, 4));
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->order, -1.0, 1e-9);
    EXPECT_EQ(fit->points, 4);
}

TEST(ObservedOrder, NothingToFit) {
    EXPECT_FALSE(observedOrder({}));
    EXPECT_FALSE(observedOrder({{0.1, 1.0}}));
    EXPECT_FALSE(observedOrder({{0.1, 1e-16}, {0.01, 0.0}, {0.001, 1e-15}}));
    EXPECT_FALSE(observedOrder({{0.1, 1.0}, {0.1, 1.1}}));
    EXPECT_FALSE(observedOrder({{0.1, std::nan("")}, {0.01, kInfinity}}));
}

}  // namespace
}  // namespace rigor::validation
