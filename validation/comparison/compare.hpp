// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Changes between two runs, or two sets of runs: case by case, and per engine with statistics.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/comparison/pairs.hpp"
#include "validation/results/types.hpp"
#include "validation/statistics/statistics.hpp"

namespace rigor::validation {

struct CompareOptions {
    /// Errors whose ratio is within 1 +- this count as equal: runs are deterministic, machines are not all
    /// alike.
    double tolerance = 0.01;
    double floor = 1e-9;  ///< errors that are both below this are equal, whatever their ratio
    PairBy pairBy = PairBy::Nothing;
};

/// Pair of compared cases.
struct ComparedPlace {
    std::string scenario, spec, specAfter;
    double dt = 0.0, dtAfter = 0.0;
};

/// A value of a metric that is not what it was.
struct MetricChange {
    ComparedPlace place;
    std::string metric, subject, unit;
    double before = 0.0, after = 0.0;
    /// Further from zero, or not finite any more; the reverse. Neither for a number that is no error (results::isError).
    bool worse = false, better = false;
    /// |ln(after / before)|, where both count as no less than rounding; infinite if one is not finite.
    double size = 0.0;
};

/// A case that ends or is judged differently.
struct VerdictChange {
    ComparedPlace place;
    std::string before, after, reason;
    bool worse = false,
         better = false;  ///< neither between a run and one that an engine can not take part in
    int size = 0;         ///< distance of the two in the order from good to bad
};

/// One engine spec over all cases that both have, or one pair of specs or of time steps over all scenarios.
struct SpecChange {
    std::string spec, specAfter;
    double dt = 0.0, dtAfter = 0.0;  ///< [s] of a pair of time steps, else 0
    int cases = 0;
    int better = 0, worse = 0, same = 0;  ///< errors
    int casesBetter = 0, casesWorse = 0;  ///< cases of which more errors are better than worse; the reverse
    double pCases = 1.0;                  ///< sign test of casesBetter against casesWorse
    int timed = 0;
    /// Medians over the cases of the ratio after / before of a step's median time, of its mean without the
    /// first step (which shows the rare slow step that a median hides), and of the first step.
    std::optional<double> timeRatio, meanRatio, firstRatio;
    std::optional<Interval> timeInterval;  ///< 95 % of timeRatio, from six cases on
    double pTime = 1.0;                    ///< sign test of slower against faster
};

struct RunComparison {
    PairBy pairBy = PairBy::Nothing;
    std::vector<SpecChange> specs;
    std::vector<VerdictChange> verdicts;  ///< worse, better, other; each by size, largest first
    std::vector<MetricChange> metrics;    ///< errors by size, largest first; then numbers that are no errors
    std::vector<std::string> onlyBefore, onlyAfter;  ///< "scenario spec dt"
    /// Cases with no case to be paired with: "scenario spec dt", of two runs with ", before" or ", after".
    std::vector<std::string> unpaired;
    std::vector<std::string> changedScenarios;  ///< scenarios whose physics differ: their numbers are
                                                ///< not compared
    std::vector<std::string> environment;       ///< "key: before -> after"
    int runsBefore = 0, runsAfter = 0;
};

/// Errors are those of the first run of each side (a case is deterministic); step times are medians over the
/// runs of a side. `before` and `after` may be the same object when something is paired on purpose. Throws
/// std::invalid_argument, with what each side has, when there is not one case to compare.
RunComparison compareRuns(const std::vector<results::Run>& before, const std::vector<results::Run>& after,
                          const CompareOptions& options = {});

/// A scenario without what does not change its motion: bounds, records, words. Text that is no JSON is
/// returned as it is.
std::string physicsOf(const std::string& scenarioText);

/// True if a verdict or an error became worse. Times do not count.
bool becameWorse(const RunComparison& comparison);

std::string comparisonText(const RunComparison& comparison, const CompareOptions& options, std::size_t most);
std::string comparisonJson(const RunComparison& comparison);

}  // namespace rigor::validation
