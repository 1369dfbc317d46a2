// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Summary of the repetitions of a bench: medians with intervals, validity, ratios to a base, changes since
// another run.
#pragma once

#include <string>
#include <vector>

#include "validation/bench/schedule.hpp"
#include "validation/results/types.hpp"

namespace rigor::validation {

/// Fills every summary. A case is valid when all its repetitions, the look among them, completed with all
/// quality within bounds. Its base is the case of the same part, name and size on one thread whose spec is
/// `base` or of the engine `base`; with "" the first of the plan that is valid. Ratios are between valid
/// cases alone: the median over the rounds that both have of time / base's time in that round, by the clock
/// of the case.
void summarise(results::Bench& bench, const BenchTarget& target, const std::string& base);

struct BaselineOptions {
    double threshold = 0.05;  ///< a smaller slow-down does not count against an engine
    double level = 0.05;      ///< significance level of the tests, all cases together
};

/// Cases of `after` against the same cases of `before` (equal id: same work, same spec), valid on both sides.
/// "slower" or "faster" is a change that Mann and Whitney's test (corrected by Holm) finds significant, whose
/// interval of the ratio of medians does not hold 1, and whose ratio is beyond the threshold.
std::vector<results::BenchChange> changesSince(const results::Bench& before, const results::Bench& after,
                                               const BaselineOptions& options);
bool becameSlower(const std::vector<results::BenchChange>& changes);

/// Differences between the machines and builds of two runs that make times incomparable: "cpu: A -> B".
std::vector<std::string> otherMachine(const results::Run& before, const results::Run& after);

}  // namespace rigor::validation
