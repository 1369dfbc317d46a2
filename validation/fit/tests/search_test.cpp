// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The search and its intervals on synthetic losses whose minimum is known.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "validation/fit/search.hpp"

namespace rigor::validation {
namespace {

const std::vector<FitParameter> kTwo{{"a", "a", 0.0, 1.0, 0.9}, {"b", "b", -2.0, 2.0, -1.5}};

/// Recordings whose own minima scatter about (0.37, 0.61), each rough: a chaotic toss is no smooth function.
class Rough {
  public:
    Rough(std::size_t recordings, double scatter, double roughness, std::uint64_t seed)
        : roughness_(roughness) {
        std::mt19937_64 random(seed);
        const auto uniform = [&] { return (random() >> 11) / 9007199254740992.0 - 0.5; };
        for (std::size_t k = 0; k < recordings; ++k)
            minima_.push_back({0.37 + scatter * uniform(), 0.61 + 4 * scatter * uniform()});
    }
    Losses operator()(const FitPoint& p) const {
        Losses losses;
        for (const auto& [a, b] : minima_)
            losses.push_back(0.1 + std::pow(p[0] - a, 2) + std::pow((p[1] - b) / 4, 2) +
                             roughness_ *
                                 (1 + std::sin(90 * p[0] + 1e3 * a) * std::cos(31 * p[1] + 1e3 * b)));
        return losses;
    }
    /// Minimum of the mean over these recordings without the roughness.
    FitPoint center() const {
        FitPoint c{0, 0};
        for (const auto& [a, b] : minima_) {
            c[0] += a / static_cast<double>(minima_.size());
            c[1] += b / static_cast<double>(minima_.size());
        }
        return c;
    }

  private:
    std::vector<std::pair<double, double>> minima_;
    double roughness_;
};

LossFunction counting(const Rough& rough, int& points) {
    return [&](const std::vector<FitPoint>& requested) -> std::optional<std::vector<Losses>> {
        std::vector<Losses> all;
        for (const FitPoint& p : requested) {
            all.push_back(rough(p));
            ++points;
        }
        return all;
    };
}

TEST(Search, FindsASmoothMinimumWithinItsBudget) {
    const Rough smooth(25, 0.0, 0.0, 1);
    for (const Summary summary : {Summary::Mean, Summary::Median}) {
        int points = 0;
        const auto found = searchMinimum(kTwo, summary, 140, 7, counting(smooth, points));
        ASSERT_TRUE(found);
        EXPECT_LE(points, 140);
        EXPECT_EQ(static_cast<int>(found->all.size()), points);
        EXPECT_NEAR(found->all[found->best].point[0], 0.37, 0.01);
        EXPECT_NEAR(found->all[found->best].point[1], 0.61, 0.04);
        const auto intervals = minimiserIntervals(*found, kTwo, summary, 7);
        EXPECT_LE(intervals[0].low, 0.37);
        EXPECT_GE(intervals[0].high, 0.37);
        EXPECT_LT(intervals[0].high - intervals[0].low, 0.05);
    }
}

TEST(Search, OneParameterAndThree) {
    const LossFunction valley =
        [](const std::vector<FitPoint>& requested) -> std::optional<std::vector<Losses>> {
        std::vector<Losses> all;
        for (const FitPoint& p : requested) {
            double sum = 0.0;
            for (std::size_t i = 0; i < p.size(); ++i) sum += std::abs(p[i] - 0.2 - 0.3 * i);
            all.push_back(Losses(5, sum));
        }
        return all;
    };
    for (const std::size_t count : {std::size_t{1}, std::size_t{3}}) {
        const std::vector<FitParameter> parameters(count, {"a", "a", 0.0, 1.0, 0.9});
        const auto found = searchMinimum(parameters, Summary::Mean, count == 1 ? 40 : 400, 7, valley);
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_NEAR(found->all[found->best].point[i], 0.2 + 0.3 * i, 0.05) << count;
    }
}

TEST(Search, AMinimumAtTheEdgeOfTheBoxStaysInIt) {
    const LossFunction slope =
        [](const std::vector<FitPoint>& requested) -> std::optional<std::vector<Losses>> {
        std::vector<Losses> all;
        for (const FitPoint& p : requested) {
            EXPECT_TRUE(p[0] >= 0.0 && p[0] <= 1.0 && p[1] >= -2.0 && p[1] <= 2.0);
            all.push_back(Losses(9, p[0] - p[1]));
        }
        return all;
    };
    const auto found = searchMinimum(kTwo, Summary::Mean, 90, 1, slope);
    EXPECT_EQ(found->all[found->best].point, (FitPoint{0.0, 2.0}));
}

TEST(Search, RunsThatBreakAreAvoided) {
    const Rough smooth(9, 0.0, 0.0, 1);
    const LossFunction losses =
        [&](const std::vector<FitPoint>& requested) -> std::optional<std::vector<Losses>> {
        std::vector<Losses> all;
        for (const FitPoint& p : requested) {
            all.push_back(smooth(p));
            if (p[0] < 0.45)
                all.back()[3] = std::numeric_limits<double>::infinity();  // one recording of nine
        }
        return all;
    };
    const auto mean = searchMinimum(kTwo, Summary::Mean, 140, 1, losses);
    EXPECT_GE(mean->all[mean->best].point[0], 0.45) << "a mean does not forgive";
    const auto median = searchMinimum(kTwo, Summary::Median, 140, 1, losses);
    EXPECT_NEAR(median->all[median->best].point[0], 0.37, 0.02) << "a median does";
    EXPECT_EQ(scoreOf(mean->all.front().losses, 1).broken, mean->all.front().point[0] < 0.45 ? 1 : 0);
}

/// Intervals of many synthetic data sets contain the true value (0.37, 0.61) about as often as their level
/// says.
TEST(Search, IntervalsCoverTheTruth) {
    constexpr int kSets = 60;
    int covered[2] = {}, informative = 0;
    for (int set = 0; set < kSets; ++set) {
        const Rough rough(30, 0.4, 0.004, 100 + static_cast<std::uint64_t>(set));
        int points = 0;
        const auto found = searchMinimum(kTwo, Summary::Mean, 140, 5, counting(rough, points));
        const auto intervals = minimiserIntervals(*found, kTwo, Summary::Mean, 5);
        covered[0] += intervals[0].low <= 0.37 && 0.37 <= intervals[0].high;
        covered[1] += intervals[1].low <= 0.61 && 0.61 <= intervals[1].high;
        informative += intervals[0].high - intervals[0].low < 0.25;
    }
    // Binomial(60, 0.95): 52 or more with probability 0.997.
    EXPECT_GE(covered[0], 52);
    EXPECT_GE(covered[1], 52);
    EXPECT_GE(informative, 52) << "an interval as wide as the box covers everything";
}

TEST(Scores, IntervalsOfMeanAndMedian) {
    Losses losses;
    for (int k = 1; k <= 100; ++k) losses.push_back(k);
    const ScoreSummary s = scoreOf(losses, 3);
    EXPECT_EQ(s.mean, 50.5);
    EXPECT_EQ(s.median, 50.5);
    // Standard error of the mean: 28.87 / 10; 1.96 of them on either side.
    EXPECT_NEAR(s.meanInterval.low, 50.5 - 5.66, 0.5);
    EXPECT_NEAR(s.meanInterval.high, 50.5 + 5.66, 0.5);
    EXPECT_EQ(s.medianInterval.low, 40);
    EXPECT_EQ(s.medianInterval.high, 61);
    Losses better = losses;
    for (double& x : better) x -= 2 + 0.01 * x;
    const auto [change, interval] = meanChange(losses, better, 3);
    EXPECT_NEAR(change, -2.505, 1e-12);
    EXPECT_LT(interval.high, -2.4) << "paired: the scatter between recordings does not matter";
}

}  // namespace
}  // namespace rigor::validation
