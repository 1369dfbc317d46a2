// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/statistics/quantile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace rigor::validation {
namespace {

TEST(Quantile, Median) {
    EXPECT_EQ(median({3.0}), 3.0);
    EXPECT_EQ(median({5.0, 1.0, 3.0}), 3.0);
    EXPECT_EQ(median({4.0, 1.0, 3.0, 2.0}), 2.5);
}

/// The quantile of type 7 of 0, 1, ..., n - 1 is (n - 1) q: types 1 to 6, 8 and 9 give something else.
TEST(Quantile, IsLinearInThePlace) {
    std::mt19937_64 random(3);
    for (const int n : {1, 2, 3, 7, 10, 100}) {
        std::vector<double> values;
        for (int i = 0; i < n; ++i) values.push_back(i);
        std::vector<double> shuffled = values;
        std::shuffle(shuffled.begin(), shuffled.end(), random);
        for (const double q : {0.0, 0.025, 0.1, 0.25, 0.5, 0.6, 0.95, 0.975, 1.0}) {
            EXPECT_NEAR(quantile(shuffled, q), (n - 1) * q, 1e-13) << n << " " << q;
            EXPECT_EQ(quantileOfSorted(values, q), quantile(shuffled, q)) << n << " " << q;
        }
    }
}

/// Hyndman and Fan's type 7 as R has it: quantile(c(1, 2, 4, 8, 16), c(0.1, 0.9)) is 1.4 and 12.8.
TEST(Quantile, OfUnevenSteps) {
    EXPECT_NEAR(quantile({16.0, 1.0, 8.0, 2.0, 4.0}, 0.1), 1.4, 1e-15);
    EXPECT_NEAR(quantile({16.0, 1.0, 8.0, 2.0, 4.0}, 0.9), 12.8, 1e-14);
}

TEST(Quantile, OfWhatBroke) {
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(median({1.0, infinite, 2.0}), 2.0);
    EXPECT_EQ(median({1.0, infinite}), infinite);
    EXPECT_EQ(median({infinite, infinite}), infinite);
    EXPECT_EQ(median({-infinite, 1.0}), -infinite);
    EXPECT_EQ(quantile({1.0, infinite}, 0.0), 1.0);
    EXPECT_EQ(median({1e308, 1.5e308}), 1.25e308);
}

}  // namespace
}  // namespace rigor::validation
