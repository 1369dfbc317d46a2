// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What every report format says about a run: columns, main metrics, cell verdicts, who to trust for what,
// worst offenders, the parity ledger over everything. Computed once, so that page, summary and terminal
// agree.
#pragma once

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
};

/// The number shown in the scoreboard: the first metric that the scenario says matters and somebody has.
struct MainMetric {
    std::string name, unit, kind;  ///< empty name: no case of this scenario has a metric
};

/// A verdict as shown: a completed case that nothing was demanded of is not shown as a pass.
enum class Shown { Pass, NoBound, KnownDeviation, Fail, NonFinite, Timeout, Crashed, Unsupported };
struct ShownText {
    const char* key;     ///< stable name, also the CSS class: "pass", "no_bound", ...
    const char* symbol;  ///< one character
    const char* word;    ///< "pass", "no bound", ...
};
ShownText shownText(Shown shown);
/// Of CaseRow::refusal, which is not empty: "not in the adapter yet" or "not in the library".
std::string refusalText(const std::string& refusal);

/// All cases of one scenario on one spec.
struct Cell {
    std::vector<const results::CaseRow*> cases;  ///< by time step, finest first; empty: not in the plan
    Shown worst = Shown::Unsupported;            ///< over all time steps
};

/// One row of "who to trust for what": how a spec did in the scenarios that isolate one mechanism.
struct Standing {
    int scenarios = 0;   ///< that have this mechanism and a case of this spec
    int ran = 0;         ///< completed at the finest time step
    int good = 0;        ///< scenarios where every time step passed, was unjudged, or deviates as recorded
    int bad = 0;         ///< scenarios with a fail, crash, timeout or non-finite value at any time step
    double ratio = 0.0;  ///< geometric mean of main error over the best engine's; NaN without a number
};
struct Mechanism {
    std::string name;
    std::vector<std::string> scenarios;
    std::vector<Standing> standings;  ///< per column
    int best = -1;                    ///< column; -1: nobody
};

struct Offender {
    const results::CaseRow* row = nullptr;
    const results::MetricRow* metric = nullptr;  ///< null where the case has no numbers
    double excess = 0.0;                         ///< value over bound; infinite without a number
    std::string text;                            ///< "energy_drift 0.12 > 0.02 (1/60 s)" or the reason
};

/// Equal ledger lines of one engine and preset, gathered over scenarios.
struct GatheredLedger {
    std::string engine, preset;
    results::LedgerRow row;
    std::vector<std::string> scenarios;
};

/// What each auditor found in the runs of one scenario, pairs of auditors left out: numbers added up, errors
/// the greatest.
struct GatheredAudit {
    std::string scenario;
    std::vector<results::AuditRow> rows;
};

struct Totals {
    std::map<Shown, int> cases;
    std::map<std::string, int> refusals;  ///< unsupported cases by CaseRow::refusal, where it is known
    int total = 0;
};
/// What a count of `shown` consists of: "68 not in the adapter yet, 220 not in the library"; mostly "".
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
    std::vector<Mechanism> mechanisms() const;
    /// Cases that fail, crash, time out or blow up, worst first.
    std::vector<Offender> offenders() const;
    std::vector<GatheredLedger> ledger() const;

  private:
    const results::Run& run_;
    std::vector<SpecColumn> columns_;
    std::vector<MainMetric> mainMetrics_;
    std::vector<Cell> cells_;
    Totals totals_;
};

/// "standard: 12 of 1430 cases fail"; failing, crashed, timed out or not finite. Text of the run, unescaped.
std::string verdictSentence(const ViewModel& view);
Shown shownOf(const results::CaseRow& row);
Shown shownOf(const results::MetricRow& metric);
/// The columns that took part in a mechanism, the most trusted first: bestOf()'s order, then the others.
std::vector<std::size_t> ranked(const Mechanism& mechanism);
/// Scenarios, those in which the most engines fail first.
std::vector<std::size_t> byTrouble(const ViewModel& view);
std::vector<GatheredAudit> gatherAudit(const results::Run& run);
/// Whole-scene row of a metric, or its worst subject; null when the case does not have it.
const results::MetricRow* findMetric(const results::CaseRow& row, const std::string& name);
/// Precision of the numbers of a case: from its settings, else from its engine.
std::string precisionOf(const results::Run& run, const results::CaseRow& row);
/// The phase "step", or null.
const results::TimingRow* stepTiming(const results::CaseRow& row);

}  // namespace rigor::report
