// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Distribution-free intervals and tests.
#pragma once

#include <optional>
#include <vector>

namespace rigor::validation {

struct Interval {
    double low = 0.0, high = 0.0;
};

/// Interval of the median, of at least 95 %, from order statistics: x(k) .. x(n + 1 - k) with the largest k for
/// which P(Bin(n, 1/2) < k) <= 0.025 (Conover, Practical Nonparametric Statistics, 1999, 3.2). Empty below
/// six values.
std::optional<Interval> medianInterval(std::vector<double> values);

/// Two-sided sign test: the probability of a split at least as uneven when both outcomes are equally likely
/// (Conover 1999, 3.4). 1 without a pair.
double signTest(int one, int other);

struct KolmogorovSmirnov {
    double distance = 0.0;  ///< largest difference of the two empirical distributions
    double p = 1.0;         ///< probability of one at least as large when both are of one distribution
};

/// Two-sample test of equal distributions, neither empty. The probability is exact for continuous ones, by
/// counting lattice paths (Hodges, Arkiv for Matematik 3, 1957, 469); ties make it larger than it is.
KolmogorovSmirnov kolmogorovSmirnov(std::vector<double> one, std::vector<double> other);

}  // namespace rigor::validation
