// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Content of every report format: columns, main metrics, cell verdicts, rankings by mechanism, worst
// offenders, the parity ledger over everything. Computed once, so that page, summary and terminal agree.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "validation/results/types.hpp"

namespace rigor::report {

/// One engine as it took part: a column of the scoreboard.
struct SpecColumn {
    std::string spec, engine, preset;
    std::string options;  ///< the spec without engine and preset, "stepper=quickstep"; often empty
    std::string label;    ///< "ode matched stepper=quickstep"
    std::string
        clock;  ///< "guest, wasm" where its times are not those of modules; only equal ones are compared
    std::vector<double> dash;  ///< dash pattern of its lines, no two of an engine's first six alike; empty:
                               ///< solid
};

/// The number shown in the scoreboard: the first metric that the scenario says matters and any case has.
struct MainMetric {
    std::string name, unit, kind;  ///< empty name: no case of this scenario has a metric
};

/// End of a case as shown. A completed case without bounds is not shown as a pass; its nearness to the
/// physics is its grade, and its change against the record its regression.
enum class Shown {
    Pass,
    NoBound,
    NoReference,
    KnownDeviation,
    Fail,
    NonFinite,
    Timeout,
    Crashed,
    Unsupported
};
struct ShownText {
    const char* key;     ///< stable name, also the CSS class: "pass", "no_bound", ...
    const char* symbol;  ///< one character
    const char* word;    ///< "pass", "no bound", ...
};
ShownText shownText(Shown shown);
/// Text of CaseRow::refusal, which is not empty: "not in the adapter yet" or "not in the library".
std::string refusalText(const std::string& refusal);

/// "scenario: reference_timeout: the reference did not finish within 20 s" for every scenario with cases that
/// are neither a pass nor a fail because its reference broke down.
std::vector<std::string> missingReferences(const results::Run& run);

/// All cases of one scenario on one spec.
struct Cell {
    std::vector<const results::CaseRow*> cases;  ///< cases by time step, finest first; empty: not in the plan
    Shown worst = Shown::Unsupported;            ///< worst end over all time steps
};

inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// The relative error that the grade rests on over other engines' at the same time step; where no
/// engine has a grade, the main metric. Errors within grade A, or within what the scenario calls negligible, count as
/// that limit: what is exact to rounding does not make the next one look 1e9 times worse.
struct Ratios {
    double toBest = kNoNumber;  ///< ratio to the smallest
    double toOurs = kNoNumber;  ///< ratio to the in-house engine's in the same preset, or in its default one
};

/// Results of a spec over some scenarios, each at the finest time step that any engine completed there.
struct Ranking {
    int scenarios = 0;            ///< number of scenarios that it could take part in
    int lost = 0;                 ///< crashed, timed out, not finite or failed, at any time step
    std::array<int, 5> grades{};  ///< scenarios of grade A to E
    int ungraded = 0;             ///< ran, without an exact solution
    int known = 0;                ///< wrong physics with a reason on file
    int farther = 0;              ///< farther from the exact solution than its own scheme
    int red = 0;                  ///< scenarios with a red case at any time step
    double toBest = kNoNumber;    ///< geometric means of Ratios
    double toOurs = kNoNumber;
    /// Median over the graded scenarios of the median of a step; over all scenarios where no column has a graded one [s].
    double cost = kNoNumber;
    int timed = 0;                 ///< scenarios that `cost` is the median of
    double costRatio = kNoNumber;  ///< geometric mean over the cheapest one's of the same clock

    /// Scenarios of grade C or better: within a hundredth of the scenario's own scale.
    int within() const { return grades[0] + grades[1] + grades[2]; }
    int graded() const { return within() + grades[3] + grades[4]; }
    /// Scenarios that can be graded, with those that were lost.
    int gradable() const { return scenarios - ungraded; }
};

/// Cost of a step on one spec, each scenario at the finest time step that any engine completed there: medians
/// over the scenarios [s].
struct StepCost {
    int scenarios = 0;  ///< timed
    double median = kNoNumber;
    /// Statistics of all steps but the first, which is separate: a first step that builds everything up is
    /// hidden by a median.
    double mean = kNoNumber, p95 = kNoNumber, p99 = kNoNumber, worst = kNoNumber;
    double first = kNoNumber;
    double realTimeFactor = kNoNumber;  ///< dt over the mean
    double medianRatio = kNoNumber,
           meanRatio = kNoNumber;  ///< geometric means over the cheapest one's of the same
                                   ///< clock
    std::string clock;             ///< clock of the column
};

/// Scenarios that speak to one mechanism, or to one thing that people simulate.
struct Mechanism {
    std::string name;          ///< name as in the scenarios' `isolates`; for a task its key
    std::string title, about;  ///< title and description of a task
    std::vector<std::string> scenarios;
    std::vector<Ranking> rankings;     ///< one ranking per column
    std::vector<std::size_t> order;    ///< columns that took part, the most trusted first
    std::vector<std::size_t> engines;  ///< columns of `order`, of each engine its first one: its best preset
    int best = -1;                     ///< column; -1: none
};

struct Offender {
    const results::CaseRow* row = nullptr;
    const results::MetricRow* metric = nullptr;  ///< null where the case has no numbers
    double excess = 0.0;  ///< value over bound; infinite without a number, 1 for a change
    std::string text;     ///< "energy_drift 0.12 > 0.02 (1/60 s)" or the reason
};

/// Equal ledger lines of one engine and preset, gathered over scenarios.
struct GatheredLedger {
    std::string engine, preset;
    results::LedgerRow row;
    std::vector<std::string> scenarios;
};

/// Results of each auditor in the runs of one scenario, without pairs of auditors: sums of numbers, maxima of
/// errors.
struct GatheredAudit {
    std::string scenario;
    std::vector<results::AuditRow> rows;
};

struct Totals {
    std::map<Shown, int> cases;
    std::map<std::string, int> refusals;   ///< unsupported cases by CaseRow::refusal, where it is known
    std::map<results::Grade, int> grades;  ///< counts of completed cases; None: no exact solution
    std::map<results::Regression, int> regressions;
    int total = 0, red = 0;
};
/// Parts of a count of `shown`: "68 not in the adapter yet, 220 not in the library"; mostly "".
std::string detailOf(const Totals& totals, Shown shown);

class ViewModel {
  public:
    /// `run` must outlive the view.
    explicit ViewModel(const results::Run& run);

    const results::Run& run() const { return run_; }
    const std::vector<SpecColumn>& columns() const { return columns_; }
    const MainMetric& mainMetric(std::size_t scenario) const { return mainMetrics_[scenario]; }
    const Cell& cell(std::size_t scenario, std::size_t column) const {
        return cells_[scenario * columns_.size() + column];
    }
    const Totals& totals() const { return totals_; }
    /// Relative error up to which engines count as equal: grade A's limit, or the scenario's `negligible_error`.
    double negligibleError(std::size_t scenario) const { return negligible_[scenario]; }
    const Ratios& ratios(const results::CaseRow& row) const { return ratios_.at(&row); }
    /// One for each word that scenarios isolate, the most frequent first.
    std::vector<Mechanism> mechanisms() const;
    /// Tasks of users (tasks.cpp); only those that the run has scenarios for.
    std::vector<Mechanism> tasks() const;
    /// Ranking over all scenarios of the run.
    Mechanism overall() const;
    /// Cases that make the run red, worst first.
    std::vector<Offender> offenders() const;
    std::vector<GatheredLedger> ledger() const;

  private:
    const results::Run& run_;
    std::vector<SpecColumn> columns_;
    std::vector<MainMetric> mainMetrics_;
    std::vector<double> negligible_;
    std::vector<Cell> cells_;
    std::map<const results::CaseRow*, Ratios> ratios_;
    Totals totals_;
};

/// The suite, or the first of the scenarios that were named: "slide_and_stop pile arch and 12 more".
std::string runTitle(const results::Run& run);
/// "standard: 12 of 1430 cases are red" (results::isRed). Text of the run, unescaped.
std::string verdictSentence(const ViewModel& view);
/// Totals in one line each: accuracy, regression, endings. Every report shows the same.
std::vector<std::pair<std::string, std::string>> totalsText(const ViewModel& view);
/// "C 0.0023", "E△ 1.2", "C▼ 0.004", "!": grade, known deviation, change against the record, and the relative
/// error that the grade rests on; "✓ 0.3" where there is no grade: how it ended, and the scenario's main
/// metric.
std::string cellText(const ViewModel& view, std::size_t scenario, std::size_t column, bool withNumber);
/// One sentence on the accuracy of a case and one on its record: what is claimed, and nothing more.
std::string accuracySentence(const results::CaseRow& row);
std::string regressionSentence(const results::CaseRow& row);
/// The same over several scenarios: rankings from the indices of scenarios.
Mechanism rankingsOver(const ViewModel& view, const std::vector<std::size_t>& scenarios);
/// Costs of a step by column.
std::vector<StepCost> stepCosts(const ViewModel& view);
/// Columns with a cost, modules first, then by clock; of a clock the cheapest by the mean ratio first.
std::vector<std::size_t> byCost(const std::vector<StepCost>& costs);
/// The ratios of every case of the run.
std::map<const results::CaseRow*, Ratios> ratiosOf(const ViewModel& view);
/// Mark of a case that depends on the order of insertion: "⇅" where its orders disagree about the verdict or
/// about how the run ends, "↕" where about the grade or a value alone, "" otherwise.
const char* orderMark(const results::CaseRow& row);
/// "C" or, where orders have other grades, "B … D".
std::string gradesText(const results::CaseRow& row);
/// "2 of 5 orders fail (pass 3, fail 2)", "orders end in other verdicts (pass 1, known deviation 3)"; "" where
/// all have one verdict.
std::string verdictsText(const results::CaseRow& row);
/// "0.0027 … 0.053 m over 5 orders"; "" where the metric has no range.
std::string orderRangeText(const results::MetricRow& metric);
struct OrderDependent {
    const results::CaseRow* row = nullptr;
    const results::MetricRow* metric = nullptr;  ///< metric that varies most; null if only endings vary
};
/// Cases that depend on the order of insertion: those that do so in their verdict, then the widest range over
/// its scale first.
std::vector<OrderDependent> orderDependents(const results::Run& run);
/// "⇅ 1 in verdict, ↕ 2 in grade, ↕ 3 in value": cases by the gravest thing that depends on the order.
std::string orderCountsText(const results::Run& run);
/// "6 of 12 cases order-dependent (⇅ 1 in verdict, ...)"; "" where no case was run in several orders.
std::string ordersTotalText(const results::Run& run);
/// "Depends on the order of insertion (6 of 12 cases run in several orders: ⇅ 1 in verdict, ...)"; "" where
/// none was run so.
std::string ordersHeading(const results::Run& run, std::size_t dependent);
/// "2 of 5 orders fail (pass 3, fail 2); rest_creep 0.0031 as written, 0.0027 … 0.053 m over 5 orders; grade C
/// as written, C … D; order 3: crashed".
std::string orderText(const OrderDependent& dependent);
/// One sentence on what the order of insertion makes of a case; "" where it was run in one order.
std::string orderSentence(const results::CaseRow& row);
Shown shownOf(const results::CaseRow& row);
Shown shownOf(const results::MetricRow& metric);
/// Ratio by which a value is beyond its bounds: value over `bound`, or below `boundMin` that over the value.
/// Infinite for NaN, and where a bound is zero.
double excessOf(double value, double bound, const std::optional<double>& boundMin);
/// Scenarios, those in which the most engines fail first.
std::vector<std::size_t> byTrouble(const ViewModel& view);
std::vector<GatheredAudit> gatherAudit(const results::Run& run);
/// Whole-scene row of a metric, or its worst subject; null when the case does not have it.
const results::MetricRow* findMetric(const results::CaseRow& row, const std::string& name);
/// Subject with the largest value of a metric: the quantity, body or joint that its whole-scene row is of; ""
/// where there is none.
std::string worstSubject(const results::CaseRow& row, const std::string& name);
/// Precision of the numbers of a case: from its settings, else from its engine.
std::string precisionOf(const results::Run& run, const results::CaseRow& row);
/// The phase "step", or null.
const results::TimingRow* stepTiming(const results::CaseRow& row);

}  // namespace rigor::report
