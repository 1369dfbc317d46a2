// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/statistics/bootstrap.hpp"

#include <algorithm>
#include <random>

#include "validation/statistics/quantile.hpp"

namespace rigor::validation {

std::vector<Interval> bootstrap(const std::vector<std::size_t>& sizes, std::uint64_t seed, int resamples,
                                const std::function<std::vector<double>(const Picks&)>& statistic) {
    std::mt19937_64 random(seed);
    Picks picks;
    for (const std::size_t n : sizes) picks.emplace_back(n);
    std::vector<std::vector<double>> seen;
    for (int k = 0; k < resamples; ++k) {
        for (auto& sample : picks)  // no distribution of the standard library is the same everywhere
            for (std::size_t& pick : sample) pick = random() % sample.size();
        const std::vector<double> numbers = statistic(picks);
        seen.resize(numbers.size());
        for (std::size_t i = 0; i < numbers.size(); ++i) seen[i].push_back(numbers[i]);
    }
    std::vector<Interval> intervals;
    for (auto& numbers : seen) {
        std::sort(numbers.begin(), numbers.end());
        intervals.push_back({quantileOfSorted(numbers, 0.025), quantileOfSorted(numbers, 0.975)});
    }
    return intervals;
}

}  // namespace rigor::validation
