// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/model/view_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "reports/encoding/json.hpp"
#include "reports/encoding/text.hpp"
#include "validation/results/clock.hpp"
#include "validation/results/judgement.hpp"
#include "validation/results/spec_labels.hpp"

namespace rigor::report {
namespace {

using results::CaseRow;
using results::MetricRow;
using results::Run;
using results::Verdict;

/// Error up to which engines count as equal in a scenario.
double negligibleOf(const results::ScenarioRow& scenario) {
    const double least = results::gradeLimit(results::Grade::A);
    if (scenario.text.find("\"negligible_error\"") == std::string::npos) return least;
    const Json file = Json::parse(scenario.text, nullptr, false);
    if (!file.is_object()) return least;
    const Json value = file.value(Json::json_pointer("/negligible_error/value"), Json());
    return value.is_number() ? std::max(least, value.get<double>()) : least;
}

SpecColumn describe(const CaseRow& row) {
    SpecColumn column{row.spec, row.engine, row.preset, "", "", "", {}};
    const auto colon = row.spec.find(':');
    std::string rest = colon == std::string::npos ? "" : row.spec.substr(colon + 1);
    while (!rest.empty()) {
        const auto comma = rest.find(',');
        const std::string part = rest.substr(0, comma);
        rest = comma == std::string::npos ? "" : rest.substr(comma + 1);
        if (part.rfind("preset=", 0) == 0) continue;
        column.options += (column.options.empty() ? "" : ", ") + part;
    }
    column.label = row.engine + (row.preset.empty() ? "" : " " + row.preset) +
                   (column.options.empty() ? "" : " " + column.options);
    return column;
}

/// The preset that brings all engines near to each other is solid, and so is an engine's only one; the
/// shipped one is dashed; an engine's own presets and options take the next patterns.
void chooseDashes(std::vector<SpecColumn>& columns) {
    static const std::vector<std::vector<double>> patterns{{2, 3}, {8, 3, 2, 3}, {12, 3}, {1, 5}};
    const bool alone = std::all_of(columns.begin(), columns.end(),
                                   [&](const SpecColumn& c) { return c.preset == columns.front().preset; });
    std::map<std::string, std::size_t> further;  // number of further patterns by engine
    for (SpecColumn& c : columns) {
        const bool usual = c.preset.empty() || c.preset == results::kMatchedPreset || alone;
        if (c.options.empty() && usual) continue;
        if (c.options.empty() && c.preset == results::kDefaultPreset)
            c.dash = {6, 4};
        else
            c.dash = patterns[further[c.engine]++ % patterns.size()];
    }
}

/// Columns in the order of the engine list, presets and options in order of appearance within an engine.
std::vector<SpecColumn> columnsOf(const Run& run) {
    std::vector<SpecColumn> columns;
    for (const auto& row : run.cases)
        if (std::none_of(columns.begin(), columns.end(),
                         [&](const SpecColumn& c) { return c.spec == row.spec; }))
            columns.push_back(describe(row));
    const auto rank = [&](const SpecColumn& c) {
        const auto found = std::find_if(run.engines.begin(), run.engines.end(),
                                        [&](const results::EngineRow& e) { return e.name == c.engine; });
        return found - run.engines.begin();
    };
    std::stable_sort(columns.begin(), columns.end(),
                     [&](const SpecColumn& a, const SpecColumn& b) { return rank(a) < rank(b); });
    for (SpecColumn& c : columns)
        if (const auto place = static_cast<std::size_t>(rank(c)); place < run.engines.size())
            c.clock = results::clockOf(run.engines[place]);
    chooseDashes(columns);
    return columns;
}

MainMetric chooseMain(const Run& run, const results::ScenarioRow& scenario) {
    const auto find = [&](const auto& accept) {
        for (const auto& row : run.cases)
            if (row.scenario == scenario.name)
                for (const auto& m : row.metrics)
                    if (accept(m)) return MainMetric{m.name, m.unit, m.kind};
        return MainMetric{};
    };
    for (const auto& name : scenario.metrics)
        if (auto m = find([&](const MetricRow& r) { return r.name == name && std::isfinite(r.value); });
            !m.name.empty())
            return m;
    if (auto m = find([](const MetricRow& r) { return r.bound.has_value(); }); !m.name.empty()) return m;
    if (auto m = find([](const MetricRow& r) { return r.kind == "exact"; }); !m.name.empty()) return m;
    return find([](const MetricRow&) { return true; });
}

bool isBad(Shown s) {
    return s == Shown::Fail || s == Shown::Crashed || s == Shown::Timeout || s == Shown::NonFinite;
}

Offender offenderOf(const CaseRow& row) {
    Offender offender{&row, nullptr, std::numeric_limits<double>::infinity(), ""};
    if (!isBad(shownOf(row)) && row.regression == results::Regression::Worse) {
        offender.excess = 1.0;
        offender.text = "worse than on record: " + row.regressionReason;
        return offender;
    }
    if (row.verdict != Verdict::Fail) {
        offender.text = row.reason.empty() ? results::verdictName(row.verdict) : row.reason;
        return offender;
    }
    double worst = -1.0;
    for (const auto& m : row.metrics) {
        if (m.verdict != Verdict::Fail) continue;
        const double limit = m.bound ? *m.bound : m.expectation.value_or(0.0);
        const double excess = excessOf(m.value, limit, m.boundMin);
        if (excess > worst) {
            worst = excess;
            offender.metric = &m;
            offender.excess = excess;
        }
    }
    if (offender.metric) {
        const auto& m = *offender.metric;
        offender.text = m.name + " " + shortNumber(m.value);
        if (m.bound && !(m.value <= *m.bound)) offender.text += " > " + shortNumber(*m.bound);
        if (!m.unit.empty() && m.unit != "1") offender.text += " " + m.unit;
        if (m.bound && m.value <= *m.bound) offender.text += ", " + m.note;
    } else {
        offender.text = row.reason.empty() ? "fails" : row.reason;
    }
    return offender;
}

}  // namespace

std::string refusalText(const std::string& refusal) {
    return refusal == "library" ? "not in the library" : "not in the adapter yet";
}

std::string detailOf(const Totals& totals, Shown shown) {
    std::string text;
    if (shown != Shown::Unsupported) return text;
    for (const auto& [refusal, count] : totals.refusals)
        text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + refusalText(refusal);
    return text;
}

ShownText shownText(Shown shown) {
    static constexpr std::array<ShownText, 9> table{{{"pass", "✓", "bounds kept"},
                                                     {"no_bound", "○", "ran"},
                                                     {"no_reference", "?", "no reference"},
                                                     {"known_deviation", "△", "known deviation"},
                                                     {"fail", "✗", "fail"},
                                                     {"non_finite", "∞", "non-finite"},
                                                     {"timeout", "…", "timeout"},
                                                     {"crashed", "!", "crashed"},
                                                     {"unsupported", "–", "unsupported"}}};
    return table.at(static_cast<std::size_t>(shown));
}

Shown shownOf(const CaseRow& row) {
    switch (row.verdict) {
        case Verdict::Pass:
            break;
        case Verdict::Fail:
            return Shown::Fail;
        case Verdict::KnownDeviation:
            return Shown::KnownDeviation;
        case Verdict::Unsupported:
            return Shown::Unsupported;
        case Verdict::Crashed:
            return Shown::Crashed;
        case Verdict::Timeout:
            return Shown::Timeout;
        case Verdict::NonFinite:
            return Shown::NonFinite;
        case Verdict::NoReference:
            return Shown::NoReference;
    }
    const bool judged = std::any_of(row.metrics.begin(), row.metrics.end(),
                                    [](const MetricRow& m) { return m.bound || m.expectation; });
    return judged ? Shown::Pass : Shown::NoBound;
}

double excessOf(double value, double bound, const std::optional<double>& boundMin) {
    if (boundMin && value < *boundMin)
        return value > 0.0 ? *boundMin / value : std::numeric_limits<double>::infinity();
    return std::isnan(value) || bound <= 0.0 ? std::numeric_limits<double>::infinity() : value / bound;
}

Shown shownOf(const MetricRow& metric) {
    if (metric.verdict == Verdict::Fail) return Shown::Fail;
    if (metric.verdict == Verdict::KnownDeviation) return Shown::KnownDeviation;
    return metric.bound || metric.expectation ? Shown::Pass : Shown::NoBound;
}

std::vector<std::size_t> byTrouble(const ViewModel& view) {
    std::vector<std::size_t> all(view.run().scenarios.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    const auto trouble = [&](std::size_t s) {
        int count = 0;
        for (std::size_t c = 0; c < view.columns().size(); ++c)
            for (const auto* row : view.cell(s, c).cases) count += results::isRed(*row);
        return count;
    };
    std::stable_sort(all.begin(), all.end(), [&](auto a, auto b) { return trouble(a) > trouble(b); });
    return all;
}

std::string worstSubject(const CaseRow& row, const std::string& name) {
    const MetricRow* worst = nullptr;
    for (const auto& m : row.metrics) {
        if (m.name != name || m.subject.empty()) continue;
        if (!worst || std::abs(m.value) > std::abs(worst->value)) worst = &m;
    }
    return worst ? worst->subject : "";
}

const MetricRow* findMetric(const CaseRow& row, const std::string& name) {
    const MetricRow* worst = nullptr;
    for (const auto& m : row.metrics) {
        if (m.name != name) continue;
        if (m.subject.empty()) return &m;
        if (!worst || std::abs(m.value) > std::abs(worst->value)) worst = &m;
    }
    return worst;
}

std::string precisionOf(const Run& run, const CaseRow& row) {
    if (const auto it = row.settings.find("precision"); it != row.settings.end()) return it->second;
    for (const auto& e : run.engines)
        if (e.name == row.engine) return e.precision;
    return "";
}

const results::TimingRow* stepTiming(const CaseRow& row) {
    for (const auto& t : row.timings)
        if (t.phase == "step") return &t;
    return nullptr;
}

ViewModel::ViewModel(const Run& run) : run_(run), columns_(columnsOf(run)) {
    std::map<std::string, std::size_t> scenarioIndex, columnIndex;
    for (std::size_t i = 0; i < run.scenarios.size(); ++i) {
        scenarioIndex.emplace(run.scenarios[i].name, i);
        mainMetrics_.push_back(chooseMain(run, run.scenarios[i]));
        negligible_.push_back(negligibleOf(run.scenarios[i]));
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) columnIndex.emplace(columns_[i].spec, i);
    cells_.resize(run.scenarios.size() * columns_.size());
    for (const auto& row : run.cases) {
        ++totals_.total;
        ++totals_.cases[shownOf(row)];
        if (!row.refusal.empty()) ++totals_.refusals[row.refusal];
        ++totals_.regressions[row.regression];
        if (row.outcome == results::Outcome::Completed) ++totals_.grades[row.accuracy.grade];
        totals_.red += results::isRed(row);
        const auto scenario = scenarioIndex.find(row.scenario);
        if (scenario == scenarioIndex.end()) continue;
        cells_[scenario->second * columns_.size() + columnIndex.at(row.spec)].cases.push_back(&row);
    }
    // Unsupported is the mildest: a cell is what became of the time steps that could run.
    const auto severity = [](Shown s) { return s == Shown::Unsupported ? -1 : static_cast<int>(s); };
    for (auto& cell : cells_) {
        std::stable_sort(cell.cases.begin(), cell.cases.end(),
                         [](const CaseRow* a, const CaseRow* b) { return a->dt < b->dt; });
        for (const auto* row : cell.cases)
            if (severity(shownOf(*row)) > severity(cell.worst)) cell.worst = shownOf(*row);
    }
    ratios_ = ratiosOf(*this);
}

std::vector<Offender> ViewModel::offenders() const {
    std::vector<Offender> list;
    for (const auto& row : run_.cases)
        if (results::isRed(row)) list.push_back(offenderOf(row));
    std::stable_sort(list.begin(), list.end(),
                     [](const Offender& a, const Offender& b) { return a.excess > b.excess; });
    return list;
}

std::vector<GatheredLedger> ViewModel::ledger() const {
    std::vector<GatheredLedger> all;
    std::map<
        std::tuple<std::string, std::string, std::string, std::string, std::string, std::string, std::string>,
        std::size_t>
        index;
    for (const auto& column : columns_)
        for (const auto& row : run_.cases) {
            if (row.spec != column.spec) continue;
            for (const auto& line : row.ledger) {
                const auto key = std::tuple(column.engine, column.preset, line.topic, line.requested,
                                            line.resolved, line.realisation, line.reason);
                const auto [it, isNew] = index.emplace(key, all.size());
                if (isNew) all.push_back({column.engine, column.preset, line, {}});
                auto& names = all[it->second].scenarios;
                if (std::find(names.begin(), names.end(), row.scenario) == names.end())
                    names.push_back(row.scenario);
            }
        }
    return all;
}

}  // namespace rigor::report
