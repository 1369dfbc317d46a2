// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The bootstrap: what a statistic does when the samples are drawn again from themselves, with replacement.
// Source: Efron and Tibshirani, An Introduction to the Bootstrap, 1993, chapter 13 (percentile intervals).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "validation/statistics/statistics.hpp"

namespace rigor::validation {

/// Indices drawn from each sample, in the order given.
using Picks = std::vector<std::vector<std::size_t>>;

/// 95 % intervals of the numbers that `statistic` makes of resampled data: the quantiles 2.5 % and 97.5 %
/// over `resamples` draws, an interval for each number. `sizes`: how many values each sample has, none zero;
/// samples are drawn independently. The same seed gives the same intervals on every machine. Intervals of few
/// values are too narrow: with six about 90 % of such intervals hold the truth
/// (comparison/tests/two_samples_test.cpp).
std::vector<Interval> bootstrap(const std::vector<std::size_t>& sizes, std::uint64_t seed, int resamples,
                                const std::function<std::vector<double>(const Picks&)>& statistic);

}  // namespace rigor::validation
