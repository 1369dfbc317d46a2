// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Two independent samples of the same quantity: is one larger than the other, and by what factor?
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "validation/statistics/statistics.hpp"

namespace rigor::validation {

/// Two-sided probability of a rank sum at least as uneven when both samples are of one distribution. Exact,
/// by counting, for samples without ties of at most 50 values together; else the normal approximation with
/// correction for ties and continuity (Mann and Whitney, Ann. Math. Statist. 18, 1947, 50; Conover
/// 1999, 5.1). 1 when a sample is empty or all values are equal.
double mannWhitney(const std::vector<double>& one, const std::vector<double>& other);

struct RatioOfMedians {
    double ratio = 1.0;  ///< median(other) / median(one)
    Interval interval;   ///< 95 %, percentile bootstrap
};

/// Both samples must be positive and not empty. The interval is that of bootstrap.hpp; the same seed gives
/// the same one.
RatioOfMedians ratioOfMedians(const std::vector<double>& one, const std::vector<double>& other,
                              std::uint64_t seed, int resamples = 4000);

/// The ratio other[i] / one[i] of pairs that were taken beside each other: its median, and an interval of
/// that median from order statistics (medianInterval; none below six pairs). The samples must not be empty
/// and have equal length.
struct PairedRatio {
    double ratio = 1.0;
    std::optional<Interval> interval;
};
PairedRatio pairedRatio(const std::vector<double>& one, const std::vector<double>& other);

/// Probabilities of several tests corrected so that the chance of any false alarm among them stays what it is
/// for one (Holm, Scand. J. Statist. 6, 1979, 65), in the order given.
std::vector<double> holm(const std::vector<double>& probabilities);

}  // namespace rigor::validation
