// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/view_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "reports/text.hpp"

namespace rigor::report {
namespace {

using results::CaseRow;
using results::MetricRow;
using results::Run;
using results::Verdict;

SpecColumn describe(const CaseRow& row) {
    SpecColumn column{row.spec, row.engine, row.preset, "", ""};
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

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

bool isBad(Shown s) {
    return s == Shown::Fail || s == Shown::Crashed || s == Shown::Timeout || s == Shown::NonFinite;
}

/// Main errors of a scenario at the finest time step, per column; NaN where there is none.
std::vector<double> mainErrors(const ViewModel& view, std::size_t scenario) {
    std::vector<double> errors(view.columns().size(), std::numeric_limits<double>::quiet_NaN());
    if (view.run().scenarios[scenario].reference.empty()) return errors;  // nobody knows who is right
    double finest = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < errors.size(); ++c)
        for (const auto* row : view.cell(scenario, c).cases)
            if (row->outcome == results::Outcome::Completed) finest = std::min(finest, row->dt);
    for (std::size_t c = 0; c < errors.size(); ++c)
        for (const auto* row : view.cell(scenario, c).cases) {
            if (row->dt != finest) continue;  // errors are compared at the same time step alone
            const auto* m = findMetric(*row, view.mainMetric(scenario).name);
            if (m && std::isfinite(m->value)) errors[c] = std::abs(m->value);
        }
    return errors;
}

/// In SI units and scenes of about a metre: what single precision can hold. Below it errors count as equal.
constexpr double kRoundingFloor = 1e-6;

/// Error over the best one's. Differences far below the typical error, or below single-precision rounding,
/// count as none: a floor is added to both, so an engine that is exact to rounding does not make the next one
/// look 1e9 worse.
std::vector<double> ratiosToBest(const std::vector<double>& errors) {
    std::vector<double> finite;
    for (const double e : errors)
        if (std::isfinite(e)) finite.push_back(e);
    std::vector<double> ratios(errors.size(), std::numeric_limits<double>::quiet_NaN());
    if (finite.empty()) return ratios;
    const double floor = std::max(1e-3 * median(finite), kRoundingFloor);
    const double best = *std::min_element(finite.begin(), finite.end()) + floor;
    for (std::size_t i = 0; i < errors.size(); ++i)
        if (std::isfinite(errors[i])) ratios[i] = (errors[i] + floor) / best;
    return ratios;
}

/// Whoever ran less than half of what somebody ran, or has no error to show, can not be the best.
bool isCandidate(const Mechanism& m, std::size_t column) {
    int most = 0;
    for (const auto& s : m.standings) most = std::max(most, s.ran);
    const Standing& s = m.standings[column];
    return s.ran > 0 && 2 * s.ran >= most && std::isfinite(s.ratio);
}

int bestOf(const Mechanism& m) {
    const auto order = ranked(m);
    return order.empty() || !isCandidate(m, order.front()) ? -1 : static_cast<int>(order.front());
}

Offender offenderOf(const CaseRow& row) {
    Offender offender{&row, nullptr, std::numeric_limits<double>::infinity(), ""};
    if (row.verdict != Verdict::Fail) {
        offender.text = row.reason.empty() ? results::verdictName(row.verdict) : row.reason;
        return offender;
    }
    double worst = -1.0;
    for (const auto& m : row.metrics) {
        if (m.verdict != Verdict::Fail) continue;
        const double limit = m.bound ? *m.bound : m.expectation.value_or(0.0);
        const double excess =
            std::isnan(m.value) || limit <= 0.0 ? std::numeric_limits<double>::infinity() : m.value / limit;
        if (excess > worst) worst = excess, offender.metric = &m, offender.excess = excess;
    }
    if (offender.metric) {
        const auto& m = *offender.metric;
        offender.text = m.name + " " + shortNumber(m.value);
        if (m.bound) offender.text += " > " + shortNumber(*m.bound);
        if (!m.unit.empty() && m.unit != "1") offender.text += " " + m.unit;
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
    static constexpr std::array<ShownText, 8> table{{{"pass", "✓", "pass"},
                                                     {"no_bound", "○", "no bound"},
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
    }
    const bool judged = std::any_of(row.metrics.begin(), row.metrics.end(),
                                    [](const MetricRow& m) { return m.bound || m.expectation; });
    return judged ? Shown::Pass : Shown::NoBound;
}

Shown shownOf(const MetricRow& metric) {
    if (metric.verdict == Verdict::Fail) return Shown::Fail;
    if (metric.verdict == Verdict::KnownDeviation) return Shown::KnownDeviation;
    return metric.bound || metric.expectation ? Shown::Pass : Shown::NoBound;
}

std::vector<std::size_t> ranked(const Mechanism& mechanism) {
    std::vector<std::size_t> order;
    for (std::size_t c = 0; c < mechanism.standings.size(); ++c)
        if (mechanism.standings[c].scenarios > 0) order.push_back(c);
    // Fewest failing scenarios first, then the smallest error.
    const auto key = [&](std::size_t c) {
        const Standing& s = mechanism.standings[c];
        return std::tuple(!isCandidate(mechanism, c), static_cast<double>(s.bad) / s.scenarios,
                          std::isfinite(s.ratio) ? s.ratio : 1e300);
    };
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
    return order;
}

std::string verdictSentence(const ViewModel& view) {
    const std::string name = view.run().suite.empty() ? "run" : view.run().suite;
    const auto bad = view.offenders().size();
    if (bad == 0) return name + ": no case fails";
    return name + ": " + std::to_string(bad) + " of " + std::to_string(view.totals().total) +
           (bad == 1 ? " cases fails" : " cases fail");
}

std::vector<std::size_t> byTrouble(const ViewModel& view) {
    std::vector<std::size_t> all(view.run().scenarios.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    const auto trouble = [&](std::size_t s) {
        int count = 0;
        for (std::size_t c = 0; c < view.columns().size(); ++c) count += isBad(view.cell(s, c).worst);
        return count;
    };
    std::stable_sort(all.begin(), all.end(), [&](auto a, auto b) { return trouble(a) > trouble(b); });
    return all;
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
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) columnIndex.emplace(columns_[i].spec, i);
    cells_.resize(run.scenarios.size() * columns_.size());
    for (const auto& row : run.cases) {
        ++totals_.total;
        ++totals_.cases[shownOf(row)];
        if (!row.refusal.empty()) ++totals_.refusals[row.refusal];
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
}

std::vector<Mechanism> ViewModel::mechanisms() const {
    std::vector<Mechanism> all;
    std::vector<std::vector<double>> logSums;
    std::vector<std::vector<int>> counts;
    for (std::size_t s = 0; s < run_.scenarios.size(); ++s) {
        const auto ratios = ratiosToBest(mainErrors(*this, s));
        for (const auto& name : run_.scenarios[s].isolates) {
            auto found = std::find_if(all.begin(), all.end(), [&](const auto& m) { return m.name == name; });
            if (found == all.end()) {
                all.push_back({name, {}, std::vector<Standing>(columns_.size()), -1});
                logSums.emplace_back(columns_.size(), 0.0);
                counts.emplace_back(columns_.size(), 0);
                found = all.end() - 1;
            }
            const auto index = static_cast<std::size_t>(found - all.begin());
            found->scenarios.push_back(run_.scenarios[s].name);
            for (std::size_t c = 0; c < columns_.size(); ++c) {
                const Cell& here = cell(s, c);
                Standing& standing = found->standings[c];
                if (here.cases.empty() || here.worst == Shown::Unsupported) continue;
                ++standing.scenarios;
                standing.ran += here.cases.front()->outcome == results::Outcome::Completed;
                isBad(here.worst) ? ++standing.bad : ++standing.good;
                if (std::isfinite(ratios[c])) logSums[index][c] += std::log(ratios[c]), ++counts[index][c];
            }
        }
    }
    for (std::size_t m = 0; m < all.size(); ++m) {
        for (std::size_t c = 0; c < columns_.size(); ++c)
            all[m].standings[c].ratio = counts[m][c] ? std::exp(logSums[m][c] / counts[m][c])
                                                     : std::numeric_limits<double>::quiet_NaN();
        all[m].best = bestOf(all[m]);
    }
    std::stable_sort(all.begin(), all.end(), [](const Mechanism& a, const Mechanism& b) {
        return a.scenarios.size() > b.scenarios.size();
    });
    return all;
}

std::vector<Offender> ViewModel::offenders() const {
    std::vector<Offender> list;
    for (const auto& row : run_.cases)
        if (isBad(shownOf(row))) list.push_back(offenderOf(row));
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
