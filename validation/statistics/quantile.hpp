// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The quantile of a sample, by one definition everywhere: type 7 of Hyndman and Fan, The American
// Statistician 50 (1996) 361, which is the default of R and NumPy. Between the values x(1) <= ... <= x(n) it
// is linear in the place 1 + (n - 1) q.
#pragma once

#include <vector>

namespace rigor::validation {

/// Quantile of a list that is not empty and has no NaN, in any order; 0 <= q <= 1. Between a finite value and
/// an infinite one it is the infinite one.
double quantile(std::vector<double> values, double q);

/// The same of a list that ascends.
double quantileOfSorted(const std::vector<double>& ascending, double q);

/// quantile(values, 1/2): of an even number of values the mean of the middle two.
double median(std::vector<double> values);

}  // namespace rigor::validation
