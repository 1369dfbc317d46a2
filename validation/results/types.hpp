// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A finished or unfinished run as it is stored and reported. All that reports/ may see, with store.hpp and
// trajectory_file.hpp beside it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "validation/results/bench_types.hpp"
#include "validation/results/grades.hpp"

namespace rigor::results {

/// End of a case. Text in the store is the snake_case name.
enum class Outcome { Completed, Unsupported, Crashed, Timeout, NonFinite, OutOfMemory, Error };
/// Judgement of a case, derived from the outcome and its metrics.
/// NoReference: it ran, and nothing that could be judged is missed, but its reference could not be computed.
enum class Verdict { Pass, Fail, KnownDeviation, Unsupported, Crashed, Timeout, NonFinite, NoReference };
const char* outcomeName(Outcome outcome);
const char* verdictName(Verdict verdict);  ///< "pass", "fail", "known deviation", "unsupported", "crashed",
                                           ///< "timeout", "non-finite", "no reference"
Outcome parseOutcome(const std::string& name);
Verdict parseVerdict(const std::string& name);

/// A case beside the record of its engine's version.
enum class Regression { NoRecord, Unchanged, Better, Worse };
const char* regressionName(Regression regression);  ///< "no record", "unchanged", "better", "worse"
Regression parseRegression(const std::string& name);

struct MetricRow {
    std::string name;     ///< name in the table of validation/metrics
    std::string subject;  ///< body, joint, quantity; "" the whole scene
    std::string unit;
    std::string kind;  ///< "exact", "scheme_exact", "measured", "invariant", "contact", "joint", "rest"
    double value = 0.0;
    double at = -1.0;                   ///< time of the largest contribution [s], -1 unknown
    std::optional<double> bound;        ///< acceptance bound at this dt
    std::optional<double> expectation;  ///< recorded expectation of a known deviation at this dt
    Verdict verdict = Verdict::Pass;    ///< Pass, Fail or KnownDeviation; Pass where there is no bound
    std::string note;                   ///< reason of a known deviation or of a miss: no value, too small
    /// Scale of the value, in its unit: from the scenario and its exact solution alone. Empty if the metric
    /// has none (validation/accuracy).
    std::optional<double> scale = std::nullopt;
    std::optional<double> relative = std::nullopt;  ///< error over scale, >= 0, infinite for no number
    std::optional<double> ideal = std::nullopt;     ///< the same of an ideal run of the engine's scheme
    std::optional<double> recorded = std::nullopt;  ///< value on record for this version of the engine
    /// Least and greatest value over the orders of insertion in which the case was run, the one as written
    /// included, and how many of them have a value; none where no other order has one (`--orders`).
    std::optional<double> orderMin = std::nullopt, orderMax = std::nullopt;
    std::optional<std::int64_t> orderCount = std::nullopt;
    std::optional<double> boundMin = std::nullopt;  ///< lower bound of the value, where the scenario sets one
};

/// The worst relative error over the metrics that the scenario names: what its grade rests on.
struct AccuracyRow {
    Grade grade = Grade::None;
    std::string metric;              ///< metric that decides; "" for None
    std::optional<double> relative;  ///< relative error of that metric
    std::optional<double> ideal;     ///< error of an ideal run of the scheme; none: unknown
    std::string note;                ///< reason why there is no grade
};

/// Property of a case that depends on the order of insertion, the gravest alone: the verdict (or how it
/// ends), the grade, the value of a metric beyond rounding. Unknown: run in one order.
enum class OrderDependence { Unknown, None, Value, Grade, Verdict };
const char* orderDependenceName(OrderDependence d);  ///< "", "no", "value", "grade", "verdict"
OrderDependence parseOrderDependence(const std::string& name);

/// A case run once more for other orders in which bodies, shapes, joints and forces are passed to the engine.
/// An order whose reference broke down counts in `run` alone.
struct InsertionOrders {
    std::optional<std::int64_t> run;        ///< orders, the one as written included; none: that one alone
    std::optional<std::int64_t> completed;  ///< number of them that ended as a completed case
    /// Grades over the orders; one that does not complete counts as E. None: the case is not graded, or run.
    Grade best = Grade::None, worst = Grade::None;
    std::string note;  ///< reason why there is no other order, or the ends of others; "" also if none was
                       ///< requested
    /// Number of them with the verdict fail, crashed, timeout or non-finite; none in runs before schema 10.
    std::optional<std::int64_t> failed = std::nullopt;
    std::string verdicts = {};  ///< counted verdicts of the orders: "pass 3, fail 2"; "" in runs before
                                ///< schema 10
    OrderDependence dependence = OrderDependence::Unknown;
};

/// A number of the exact solution beside the engine's.
struct QuantityRow {
    std::string name, unit;
    double exact = 0.0;
    std::optional<double> schemeExact;
    std::optional<double> measured;  ///< empty: did not happen in this run
};

/// A setting as the engine resolved it.
struct SettingRow {
    std::string key, value;
};

struct LedgerRow {
    std::string topic, requested, resolved;
    std::string realisation;  ///< "exact", "approximate", "unsupported"
    std::string reason;
};

/// One comparison of what the engine says it was given with the scenario.
struct ReadBackRow {
    std::string quantity;                ///< "mass", "inertia", "position", "friction", ...
    std::string subject;                 ///< body name or "material|material"
    double expected = 0.0, found = 0.0;  ///< norms or the worst component, for display
    double error = 0.0;                  ///< absolute
    bool ok = true;
};

/// Contact audit: one collision engine queried at the sampled poses of this case.
struct AuditRow {
    std::string auditor;           ///< engine spec, or "oracle"
    std::string outcome;           ///< "completed", "crashed", "timeout", "unsupported"
    std::int64_t frames = 0;       ///< frames queried
    std::int64_t queries = 0;      ///< shape pairs queried
    std::int64_t overlapping = 0;  ///< reported as overlapping
    std::int64_t missed = 0;       ///< the oracle overlaps deeper than the tolerance, the auditor says apart
    std::int64_t spurious = 0;     ///< the reverse
    std::int64_t undecided = 0;    ///< no exact result for this shape pair
    std::optional<double> normalErrorMax, normalErrorMedian;  ///< [rad] to the nearest minimising normal
    std::optional<double> depthErrorMax, depthErrorMedian;    ///< [m]
    std::optional<double> pointErrorMax;  ///< [m], of witness points from the exact surfaces
    std::string worst;                    ///< "block|floor at t=0.25, step 15 (normal)"
    std::string note;
    /// The worst normal, depth, missed and false overlap with what is needed to draw them, as a JSON array
    /// (validation/results/README.md); empty in runs before schema 11.
    std::string findings = {};
};

/// Seconds of wall time.
struct TimingRow {
    std::string phase;                                       ///< "step", "build", "collide", ...
    double median = 0.0, p10 = 0.0, p90 = 0.0, total = 0.0;  ///< times per step, except total
    std::int64_t samples = 0;
    double meanContacts = 0.0;
    /// 95 % interval of the median; none for fewer than six samples and in runs before schema 3.
    std::optional<double> low = std::nullopt, high = std::nullopt;
    std::int64_t bodies = 0;  ///< number of moving bodies; 0 in runs before schema 3
    /// The first sample apart from the others: caches are cold and nothing is warm-started. Mean, quantiles
    /// and greatest of all others; none for fewer than two samples and in runs before schema 8.
    std::optional<double> first = std::nullopt, mean = std::nullopt, p95 = std::nullopt, p99 = std::nullopt,
                          worst = std::nullopt;
    std::optional<double> realTimeFactor = std::nullopt;  ///< speed of the step: dt over the mean
};

struct CaseRow {
    std::string id;             ///< stable hash of scenario text, spec, preset and dt
    std::int64_t position = 0;  ///< place in the plan: the order of Run::cases
    std::string scenario;
    std::string spec;    ///< spec as requested, with the preset: "ode:preset=matched,stepper=quickstep"
    std::string engine;  ///< "ode"
    std::string preset;  ///< "default" or "matched"
    double dt = 0.0;
    Outcome outcome = Outcome::Completed;
    Verdict verdict = Verdict::Pass;
    std::string reason;  ///< message of the failure, missing capability, signal name, ...
    /// Kind of refusal of an unsupported case: "adapter" (not in the adapter yet) or "library" (the library
    /// does not have it, by its documentation); "" in runs before schema 6.
    std::string refusal;
    double wallSeconds = 0.0;  ///< whole child process
    double cpuSeconds = 0.0;
    std::int64_t steps = 0;
    std::int64_t peakMemoryKiB = 0;
    std::string stateHash;                        ///< hash of the final states
    std::string trajectoryFile;                   ///< relative to the run folder, "" when none
    std::string command;                          ///< reproduces the numbers of this case
    std::map<std::string, std::string> settings;  ///< resolved
    std::vector<MetricRow> metrics;
    std::vector<QuantityRow> quantities;
    std::vector<LedgerRow> ledger;
    std::vector<ReadBackRow> readBack;
    std::vector<AuditRow> audit;
    std::vector<TimingRow> timings;
    AccuracyRow accuracy = {};
    Regression regression = Regression::NoRecord;
    std::string regressionReason = {};  ///< largest change, or the reason why there is no record
    InsertionOrders orders = {};
};

/// Observed order of convergence of a metric over a time-step refinement: slope of ln error on ln dt.
struct OrderRow {
    std::string scenario, spec, metric, unit;
    std::optional<double> order;          ///< order; empty: round-off at every step
    std::optional<double> low, high;      ///< 95 % interval; none for two points
    std::int64_t points = 0;              ///< time steps that count
    double finest = 0.0, coarsest = 0.0;  ///< time steps of those [s]
    std::string note;                     ///< data that were left out
};

/// One competitor's place in one of the four ways to compare.
struct FairnessRow {
    std::string mode;  ///< "engine_defaults", "matched_settings", "equal_time", "equal_accuracy"
    std::string scenario, metric, unit;
    std::string competitor;       ///< the spec without numeric options
    std::string caseId, spec;     ///< the run that stands for it
    double dt = 0.0;              ///< [s]
    double error = 0.0;           ///< value of the metric
    double cost = 0.0;            ///< [s] wall time of all its steps
    std::optional<double> limit;  ///< equal_time: the budget [s]; equal_accuracy: the target [unit]
};

struct ScenarioRow {
    std::string name, title, description, source;
    std::vector<std::string> isolates, tags, observed, metrics;
    int dimension = 3;
    double duration = 0.0;
    std::vector<double> timeSteps;
    std::string reference, referenceTitle, referenceFormula, referenceSource;  ///< "" when cross-engine only
    std::string referenceTex;      ///< the formula as TeX, display mode; "" in runs before schema 3
    std::string referenceProblem;  ///< reason why the reference does not hold for these values; "" if it does
    std::string text;              ///< the scenario file as run (JSON, overrides applied)
    /// "none", "holds", "reference_assumption", "reference_timeout", "reference_out_of_memory",
    /// "reference_crashed"; "" in runs before schema 8.
    std::string referenceOutcome = {};
};

struct EngineRow {
    std::string name, title, version, precision, buildNotes;
    std::string problem;  ///< "not installed", or why the module could not be loaded
    /// Declared features, JSON: {"capabilities": {...}, "options": [...], "presets": [...], "clock": "guest, wasm"}; "" in
    /// runs before schema 4.
    std::string capabilities = {};
    /// Version of its package, where that is another than the library says; "" in runs before schema 6.
    std::string package = {};
};

struct Run {
    std::string directory;
    int schemaVersion = 0;
    std::string suite, command, started, finished;   ///< ISO 8601 UTC; finished "" while running
    std::map<std::string, std::string> environment;  ///< cpu, kernel, compiler, flags, library versions, ...
    std::vector<EngineRow> engines;
    std::vector<ScenarioRow> scenarios;
    std::vector<CaseRow> cases;
    std::vector<OrderRow> orders;       ///< written when the run has ended
    std::vector<FairnessRow> fairness;  ///< written when the run has ended
    Bench bench;                        ///< results of `rigor bench`
    std::int64_t plannedCases = 0;
    /// Sentences about damage that was found on reading; damaged cases are left out. Not stored.
    std::vector<std::string> damage = {};
};

}  // namespace rigor::results
