// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Verdicts from numbers.
#pragma once

#include <string>

#include "scenarios/model/scenario.hpp"
#include "validation/results/judgement.hpp"
#include "validation/runner/reference_guard.hpp"

namespace rigor::validation {

using results::kInHouseEngine;

/// The bound of a case for a metric: the entry for its engine and preset, else for its engine, else for "*";
/// null when there is none. Bounds that name an engine are meant for double precision: in single precision
/// everyone's holds. None judges a preset that only some engines have.
const scenario::Bound* boundFor(const scenario::Scenario& scenario, const results::CaseRow& row,
                                const std::string& metric);
const scenario::KnownDeviation* deviationFor(const scenario::Scenario& scenario, const std::string& engine,
                                             const std::string& preset, const std::string& metric);

/// max * (dt / first dt of the scenario)^order
double boundAt(const scenario::Bound& bound, const scenario::Scenario& scenario, double dt);

/// Sets bound, expectation, verdict and note of a whole-scene row ("" as subject) from the scenario, or from
/// what holds everywhere (what contacts say of themselves). A value that is NaN misses every bound. Without a
/// bound a known deviation is one of wrong physics: it counts where the relative error, set before, is of
/// grade E.
void judgeMetric(results::MetricRow& row, const scenario::Scenario& scenario, const results::CaseRow& judged);

/// Sets verdict (and reason where it has none) of a case from its outcome, metrics and read-back. A known
/// deviation whose metric is the outcome's name ("crashed", "timeout", ...) makes that outcome an expected
/// one.
void judgeCase(results::CaseRow& row, const scenario::Scenario& scenario);

/// To be called after judgeCase: a case that misses no bound, but whose reference failed, is neither a pass
/// nor a fail.
void judgeWithoutReference(results::CaseRow& row, const ReferenceCheck& check);

}  // namespace rigor::validation
