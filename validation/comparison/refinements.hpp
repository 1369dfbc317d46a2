// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Results of a run beyond its single cases: orders of convergence, and engines compared in four labelled
// ways.
#pragma once

#include <string>
#include <vector>

#include "validation/results/types.hpp"

namespace rigor::validation {

/// A case as a point of the error-against-cost plane.
struct WorkPoint {
    const results::CaseRow* row = nullptr;
    std::string competitor;  ///< spec without its numeric options, see competitorOf()
    double error = 0.0;      ///< error in the requested metric
    double cost = 0.0;       ///< [s] wall time of all steps (results::steppingTime)
    bool best = false;       ///< no other point of its competitor has less error at no more cost
};

/// Competitor of a spec: the spec without its numeric options. `rigor:solver=pgs,velocity_iterations=8` and
/// the same with 64 are one competitor with two settings; another solver is another competitor.
std::string competitorOf(const std::string& spec);

/// Completed cases of one scenario with a finite value of `metric` (whole scene), by competitor and cost.
std::vector<WorkPoint> workPoints(const results::Run& run, const std::string& scenario,
                                  const std::string& metric);

/// One row for each scenario, spec and metric that was run at three time steps or more: errors against exact
/// values, drifts of invariants, joint errors.
std::vector<results::OrderRow> observedOrders(const results::Run& run);

/// Engines compared by their errors against exact values:
///   engine_defaults   preset `default` at the first time step
///   matched_settings  preset `matched` at the first time step
///   equal_time        least error of each competitor within a budget: the cost of the cheapest run of the
///                     competitor whose cheapest run costs most, so that each has one
///   equal_accuracy    cheapest run of each competitor within a target: the least error of the competitor
///                     whose least error is largest, so that each reaches it
/// The last two where competitors were run at three settings or more; those with fewer do not take part. They compare
/// competitors whose times are of the same clock.
std::vector<results::FairnessRow> fairComparisons(const results::Run& run);

}  // namespace rigor::validation
