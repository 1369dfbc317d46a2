// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Observed order of convergence: p of error ~ C dt^p, from errors at a time-step refinement.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rigor::validation {

struct RefinementPoint {
    double dt = 0.0;     ///< [s], > 0
    double error = 0.0;  ///< >= 0, any unit
};

/// The straight line through (ln dt, ln error) by least squares.
struct ObservedOrder {
    double order = 0.0;                   ///< its slope
    std::optional<double> low, high;      ///< 95 % interval of the slope; none for two points
    int points = 0;                       ///< number of points that the line is fitted to
    double finest = 0.0, coarsest = 0.0;  ///< time steps of the first and last of them [s]
    std::string note;                     ///< points left out, and why; "" when none were
};

/// Errors at or below this count as round-off and are left out, whatever their unit (SI, scenes of about 1
/// m).
inline constexpr double kRoundOff = 1e-12;

/// The interval is t(0.975, n - 2) s / sqrt(Sxx) (Draper and Smith, Applied Regression Analysis, 1998, 1.4).
/// Deviations from the line are systematic (terms of higher order, a floor), not noise: a wide interval says
/// that one power of dt does not describe this refinement. Left out are round-off and, at the fine end,
/// points whose errors no longer shrink with dt. Empty when fewer than two points are left.
std::optional<ObservedOrder> observedOrder(std::vector<RefinementPoint> refinement,
                                           double roundOff = kRoundOff);

}  // namespace rigor::validation
