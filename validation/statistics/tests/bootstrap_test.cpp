// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/statistics/bootstrap.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <numeric>

namespace rigor::validation {
namespace {

/// The mean of resampled zeros and ones is binomial: its quantiles are known without drawing.
TEST(Bootstrap, TheMeanOfZerosAndOnesIsBinomial) {
    for (const int n : {20, 90}) {
        const int ones = n / 4;
        const auto share = [&](const Picks& picks) {
            double sum = 0.0;
            for (const std::size_t i : picks[0]) sum += static_cast<int>(i) < ones ? 1.0 : 0.0;
            return std::vector<double>{sum};
        };
        const boost::math::binomial law(n, static_cast<double>(ones) / n);
        const Interval found = bootstrap({static_cast<std::size_t>(n)}, 5, 20000, share)[0];
        // The smallest count with at least that probability at or below it, and one beside it for the
        // drawing.
        const auto count = [&](double q) {
            int k = 0;
            while (boost::math::cdf(law, k) < q) ++k;
            return k;
        };
        EXPECT_NEAR(found.low, count(0.025), 1.0) << n;
        EXPECT_NEAR(found.high, count(0.975), 1.0) << n;
    }
}

/// The interval of a mean of n values of variance s^2 is 1.96 s / sqrt(n) to either side; of the difference
/// of two independent means the variances add.
TEST(Bootstrap, MeansHaveTheirStandardErrors) {
    constexpr std::size_t kOne = 400, kOther = 900;
    const auto meanOf = [](const std::vector<std::size_t>& picks, double scale) {
        double sum = 0.0;
        for (const std::size_t i : picks) sum += scale * i;
        return sum / picks.size();
    };
    // 0 ... n - 1 has the variance (n^2 - 1) / 12.
    const auto errorOf = [](std::size_t n, double scale) {
        const double size = n;
        return scale * std::sqrt((size * size - 1) / 12 / size);
    };
    const auto found = bootstrap({kOne, kOther}, 2, 4000, [&](const Picks& picks) {
        const double one = meanOf(picks[0], 1.0), other = meanOf(picks[1], 0.5);
        return std::vector<double>{one, other - one};
    });
    ASSERT_EQ(found.size(), 2u);
    const double one = 0.5 * (kOne - 1), other = 0.25 * (kOther - 1);
    const double alone = 1.96 * errorOf(kOne, 1.0),
                 both = 1.96 * std::hypot(errorOf(kOne, 1.0), errorOf(kOther, 0.5));
    EXPECT_NEAR(found[0].low, one - alone, 0.08 * alone);
    EXPECT_NEAR(found[0].high, one + alone, 0.08 * alone);
    EXPECT_NEAR(found[1].low, other - one - both, 0.08 * both);
    EXPECT_NEAR(found[1].high, other - one + both, 0.08 * both);
}

TEST(Bootstrap, IsTheSameForTheSameSeed) {
    const auto sum = [](const Picks& picks) {
        return std::vector<double>{
            static_cast<double>(std::accumulate(picks[0].begin(), picks[0].end(), std::size_t{0}))};
    };
    const Interval a = bootstrap({50}, 9, 300, sum)[0], b = bootstrap({50}, 9, 300, sum)[0],
                   other = bootstrap({50}, 10, 300, sum)[0];
    EXPECT_EQ(a.low, b.low);
    EXPECT_EQ(a.high, b.high);
    EXPECT_TRUE(a.low != other.low || a.high != other.high);
    // One value is what it is.
    const Interval single = bootstrap({1}, 1, 10, sum)[0];
    EXPECT_EQ(single.low, 0.0);
    EXPECT_EQ(single.high, 0.0);
}

}  // namespace
}  // namespace rigor::validation
