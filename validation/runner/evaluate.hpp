// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Evaluation of a recorded trajectory: metrics with verdicts, quantities of the reference, curves.
#pragma once

#include <memory>
#include <string>

#include "validation/metrics/metric.hpp"
#include "validation/references/reference.hpp"
#include "validation/results/trajectory_file.hpp"
#include "validation/results/types.hpp"
#include "validation/runner/reference_guard.hpp"

namespace rigor::validation {

/// The reference of a scenario, or why there is none: its assumptions do not hold for these values.
struct ReferenceOrProblem {
    std::unique_ptr<Reference> reference;
    std::string problem;  ///< "" when the reference holds, or the scenario has none
};
/// Makes the reference in this process and without a limit, for a process that has one. An empty `make` is
/// makeReference.
ReferenceOrProblem referenceOf(const scenario::Scenario& scenario, const ReferenceMaker& make = {});

/// Fills metrics (those that matter to the scenario first), accuracy and quantities of `row`, whose engine,
/// preset and dt are set. `referenceProblem`: why the reference does not hold for this scenario, said of bounds on
/// rest that cannot be judged for it.
void evaluateCase(const MetricInput& input, results::CaseRow& row, const std::string& referenceProblem);

/// The trajectory, the exact states at the same times, and the diagnostic curves, ready to be written.
results::TrajectoryFile trajectoryFile(const MetricInput& input, const results::CaseRow& row);

}  // namespace rigor::validation
