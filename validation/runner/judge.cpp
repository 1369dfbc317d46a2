// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/judge.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adapters/interface/presets.hpp"
#include "validation/results/judgement.hpp"
#include "validation/results/values.hpp"
#include "validation/runner/read_back.hpp"
#include "validation/runner/runner.hpp"

namespace rigor::validation {
namespace {

using results::CaseRow;
using results::MetricRow;
using results::Outcome;
using results::Verdict;
using scenario::Scenario;

/// The most specific entry for engine, preset and metric; an engine without a name finds everyone's alone.
template <class Entry>
const Entry* entryFor(const std::vector<Entry>& entries, const std::string& engine, const std::string& preset,
                      const std::string& metric) {
    const Entry* best = nullptr;
    int bestRank = -1;
    for (const Entry& e : entries) {
        const bool named = e.engine == engine;
        if (e.metric != metric || (!named && e.engine != "*") || (!e.preset.empty() && e.preset != preset))
            continue;
        const int rank = (named ? 2 : 0) + (e.preset.empty() ? 0 : 1);
        if (rank > bestRank) {
            best = &e;
            bestRank = rank;
        }
    }
    return best;
}

/// Bounds and recorded deviations are written for the presets that every engine has. An engine's further
/// presets trade accuracy for something else: what they miss by is shown, not judged.
bool isJudgedByScenario(const std::string& preset) {
    const auto& usual = adapter::usualPresets();
    return std::find(usual.begin(), usual.end(), preset) != usual.end();
}

/// Bound of a metric in every scenario that gives none.
const scenario::Bound* boundEverywhere(const std::string& metric) {
    static const std::vector<scenario::Bound> bounds = [] {
        std::vector<scenario::Bound> all(2);
        all[0].metric = "normal_error_median";
        all[0].max = std::numbers::pi / 4;
        all[1].metric = "contact_inconsistency";
        all[1].max = 0.5;
        return all;
    }();
    const auto it =
        std::find_if(bounds.begin(), bounds.end(), [&](const auto& b) { return b.metric == metric; });
    return it == bounds.end() ? nullptr : &*it;
}

Verdict verdictOf(Outcome outcome) {
    switch (outcome) {
        case Outcome::Completed:
            return Verdict::Pass;
        case Outcome::Unsupported:
            return Verdict::Unsupported;
        case Outcome::Timeout:
            return Verdict::Timeout;
        case Outcome::NonFinite:
            return Verdict::NonFinite;
        case Outcome::Crashed:
        case Outcome::OutOfMemory:
            return Verdict::Crashed;
        case Outcome::Error:
            return Verdict::Fail;
    }
    return Verdict::Fail;
}

void judgeEnding(CaseRow& row, const Scenario& scenario) {
    row.verdict = verdictOf(row.outcome);
    const auto* expected = deviationFor(scenario, row.engine, row.preset, results::outcomeName(row.outcome));
    if (expected == nullptr || row.outcome == Outcome::Unsupported) return;
    row.verdict = Verdict::KnownDeviation;
    row.reason = expected->reason + (row.reason.empty() ? "" : " (" + row.reason + ")");
}

void judgeCompleted(CaseRow& row) {
    row.verdict = Verdict::Pass;
    for (const MetricRow& m : row.metrics) {
        if (m.verdict == Verdict::KnownDeviation && row.verdict == Verdict::Pass) {
            row.verdict = Verdict::KnownDeviation;
            row.reason = m.name + ": " + m.note;
        } else if (m.verdict == Verdict::Fail && row.verdict != Verdict::Fail) {
            row.verdict = Verdict::Fail;
            row.reason = m.name + " misses its bound" + (m.note.empty() ? "" : ": " + m.note);
        }
    }
    if (const std::string problem = readBackProblem(row.readBack, row.ledger); !problem.empty()) {
        row.verdict = Verdict::Fail;
        row.reason = problem;
    }
}

}  // namespace

const scenario::Bound* boundFor(const Scenario& scenario, const CaseRow& row, const std::string& metric) {
    if (!isJudgedByScenario(row.preset)) return nullptr;
    const auto precision = row.settings.find("precision");
    const bool isSingle = precision != row.settings.end() && precision->second == "f32";
    return entryFor(scenario.accept, isSingle ? "" : row.engine, row.preset, metric);
}

const scenario::KnownDeviation* deviationFor(const Scenario& scenario, const std::string& engine,
                                             const std::string& preset, const std::string& metric) {
    if (!isJudgedByScenario(preset)) return nullptr;
    return entryFor(scenario.knownDeviations, engine, preset, metric);
}

double boundAt(const scenario::Bound& bound, const Scenario& scenario, double dt) {
    if (bound.order == 0.0 || scenario.timeSteps.empty()) return bound.max;
    return bound.max * std::pow(dt / scenario.timeSteps.front(), bound.order);
}

void judgeMetric(MetricRow& row, const Scenario& scenario, const CaseRow& judged) {
    const auto* bound = boundFor(scenario, judged, row.name);
    if (bound == nullptr) bound = boundEverywhere(row.name);
    const auto* known = deviationFor(scenario, judged.engine, judged.preset, row.name);
    if (bound != nullptr) row.bound = boundAt(*bound, scenario, judged.dt);
    if (bound != nullptr && std::isfinite(bound->min)) row.boundMin = bound->min;
    if (known != nullptr && std::isfinite(known->max)) row.expectation = known->max;
    const bool isBelow = bound != nullptr && row.value < bound->min;
    const bool misses = bound != nullptr && (isBelow || !(row.value <= *row.bound));  // true for NaN
    const bool asKnown = known != nullptr && !isBelow && row.value <= known->max;
    const bool isWrong = row.relative && results::gradeOf(*row.relative) == results::Grade::E;
    if (misses)
        row.verdict = asKnown ? Verdict::KnownDeviation : Verdict::Fail;
    else if (bound == nullptr && known != nullptr && !asKnown)
        row.verdict = Verdict::Fail;
    else
        row.verdict =
            bound == nullptr && known != nullptr && isWrong ? Verdict::KnownDeviation : Verdict::Pass;
    if (row.verdict == Verdict::KnownDeviation) row.note = known->reason;
    if (isBelow) row.note = "less than its lower bound " + results::exactText(bound->min);
}

void judgeCase(CaseRow& row, const Scenario& scenario) {
    if (row.outcome == Outcome::Completed)
        judgeCompleted(row);
    else
        judgeEnding(row, scenario);
}

namespace {

bool lacksReference(const CaseRow& c) {
    return c.verdict == Verdict::NoReference;
}

}  // namespace

bool runIsGreen(const results::Run& run) {
    return std::none_of(run.cases.begin(), run.cases.end(),
                        [](const CaseRow& c) { return results::isRed(c) || lacksReference(c); });
}

bool lacksReferencesAlone(const results::Run& run) {
    return std::none_of(run.cases.begin(), run.cases.end(), results::isRed) &&
           std::any_of(run.cases.begin(), run.cases.end(), lacksReference);
}

bool judgesNothing(const results::Run& run) {
    return !run.cases.empty() && std::all_of(run.cases.begin(), run.cases.end(), [](const CaseRow& c) {
        return c.verdict == Verdict::Unsupported;
    });
}

void judgeWithoutReference(CaseRow& row, const ReferenceCheck& check) {
    if (row.outcome != Outcome::Completed || row.verdict == Verdict::Fail || !check.brokeDown()) return;
    row.verdict = Verdict::NoReference;
    row.reason = check.text();
}

}  // namespace rigor::validation
