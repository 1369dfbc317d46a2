// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Search points of the fit and the uncertainty of its result.
#pragma once

#include <cstdint>
#include <optional>

#include "validation/fit/fit.hpp"

namespace rigor::validation {

/// Values of one metric at a point: one per recording. Infinite where the run broke.
using Losses = std::vector<double>;

double summarise(const Losses& losses, Summary summary);
/// Scores with 95 % intervals; `seed` for the bootstrap.
ScoreSummary scoreOf(const Losses& losses, std::uint64_t seed);
/// Mean of b - a over the recordings at which both are finite, with its bootstrap interval.
std::pair<double, Interval> meanChange(const Losses& a, const Losses& b, std::uint64_t seed);

/// Points that were evaluated.
struct Evaluated {
    FitPoint point;
    Losses losses;
};
/// Returns the losses at each point; empty when interrupted.
using LossFunction = std::function<std::optional<std::vector<Losses>>(const std::vector<FitPoint>&)>;

/// Minimises the summary by nested grids, which need no derivatives and are not misled by the roughness of
/// chaotic recordings: a grid over the whole box and the start; then steps of half the width about the best
/// point, all neighbours at once, moving while one is better and halving when none is (compass search:
/// Kolda, Lewis, Torczon, SIAM Review 45 (2003) 385). The last third of the budget goes to an even grid over
/// the region in which resampled recordings put the minimum (`survey`), so that the intervals below do not
/// inherit the spacing of the search. Everything that was evaluated comes back; empty when interrupted.
struct SearchResult {
    std::vector<Evaluated> all;
    std::size_t best = 0;
    std::vector<double> resolution;  ///< grid step of the survey, per parameter
};
std::optional<SearchResult> searchMinimum(const std::vector<FitParameter>& parameters, Summary summary,
                                          int budget, std::uint64_t seed, const LossFunction& losses);

/// 95 % interval of each coordinate of the minimiser: over resamples of the recordings (with replacement),
/// the evaluated point that is best for the resample; percentiles of these, half a resolution wider on either
/// side, and never without the best point itself. Source: Efron and Tibshirani, An Introduction to the
/// Bootstrap, 1993, ch. 13.
std::vector<Interval> minimiserIntervals(const SearchResult& search,
                                         const std::vector<FitParameter>& parameters, Summary summary,
                                         std::uint64_t seed);

}  // namespace rigor::validation
