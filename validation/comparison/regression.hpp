// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A case beside the record of its engine's version: unchanged, better, worse. This says nothing of how near
// it is to the physics.
#pragma once

#include "validation/comparison/recorded.hpp"

namespace rigor::validation {

/// A run on one machine comes back bit for bit; a change of the code that means to change nothing moves
/// errors by rounding, which the floor holds, and what follows of it, which the tolerance holds.
inline constexpr double kSameShare = 0.01;
/// Rounding as a fraction of the metric's scale (1 in its unit if it has none), over the steps of a run, in
/// double and single precision (2^-53 and 2^-24 over some 1e4 to 1e6 operations that depend on each other).
inline constexpr double kRoundingDouble = 1e-9, kRoundingSingle = 1e-6;

/// Rounding of a metric of a case, in its unit.
double roundingOf(const results::CaseRow& row, const results::MetricRow& metric);

/// Sets regression, regressionReason and the `recorded` of the metrics. A number is unchanged within the
/// range of those on record, widened by kSameShare of the larger and by the rounding of the case's precision;
/// worse when farther from zero or lost. For scenes without an exact solution, whose motion is chaotic, the
/// outcome is compared, and numbers only if the record holds several: their scatter is then known.
void compareWithRecord(const Record& record, const results::ScenarioRow& scenario, results::CaseRow& row);

}  // namespace rigor::validation
