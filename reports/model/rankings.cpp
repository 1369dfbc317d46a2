// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ranking of engines over sets of scenarios: counted here once, for terminal, summary, tables and page.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <tuple>

#include "reports/model/view_model.hpp"
#include "validation/results/judgement.hpp"
#include "validation/results/spec_labels.hpp"
#include "validation/statistics/quantile.hpp"

namespace rigor::report {
namespace {

using results::CaseRow;
using results::Grade;
using results::MetricRow;
using results::Outcome;

/// Geometric mean of what is positive and finite; NaN of nothing.
class GeometricMean {
  public:
    void add(double value) {
        if (value > 0.0 && std::isfinite(value)) {
            sum_ += std::log(value);
            ++count_;
        }
    }
    double value() const { return count_ > 0 ? std::exp(sum_ / count_) : kNoNumber; }

  private:
    double sum_ = 0.0;
    int count_ = 0;
};

bool isGraded(const ViewModel& view, std::size_t scenario) {
    for (std::size_t c = 0; c < view.columns().size(); ++c)
        for (const CaseRow* row : view.cell(scenario, c).cases)
            if (row->accuracy.relative) return true;
    return false;
}

/// Error that Ratios compare, at least the size of rounding (of one unit if a metric has no scale); NaN if
/// there is none.
double errorOf(const ViewModel& view, std::size_t scenario, const CaseRow& row) {
    if (row.outcome != Outcome::Completed) return kNoNumber;
    const double least = view.negligibleError(scenario);
    if (row.accuracy.relative) return std::max(*row.accuracy.relative, least);
    if (isGraded(view, scenario)) return kNoNumber;
    const MetricRow* m = findMetric(row, view.mainMetric(scenario).name);
    if (m == nullptr || !std::isfinite(m->value)) return kNoNumber;
    return std::max(std::abs(m->value), least * m->scale.value_or(1.0));
}

/// The in-house engine's case that another is compared with; null where it has none.
const CaseRow* oursBeside(const ViewModel& view, std::size_t scenario, const CaseRow& row) {
    const CaseRow* found = nullptr;
    for (std::size_t c = 0; c < view.columns().size(); ++c) {
        const SpecColumn& column = view.columns()[c];
        if (column.engine != results::kInHouseEngine || !column.options.empty()) continue;
        const bool samePreset = column.preset == row.preset;
        if (!samePreset && column.preset != results::kDefaultPreset) continue;
        for (const CaseRow* other : view.cell(scenario, c).cases)
            if (other->dt == row.dt && (samePreset || found == nullptr)) found = other;
    }
    return found;
}

/// The finest time step that any engine completed; infinite where none did.
double finestOf(const ViewModel& view, std::size_t scenario) {
    double finest = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < view.columns().size(); ++c)
        for (const CaseRow* row : view.cell(scenario, c).cases)
            if (row->outcome == Outcome::Completed) finest = std::min(finest, row->dt);
    return finest;
}

const CaseRow* caseAt(const Cell& cell, double dt) {
    for (const CaseRow* row : cell.cases)
        if (row->dt == dt) return row;
    return nullptr;
}

double costOf(const CaseRow* row) {
    const auto* step = row == nullptr ? nullptr : stepTiming(*row);
    return step != nullptr && step->median > 0.0 ? step->median : kNoNumber;
}

bool isLost(Shown s) {
    return s == Shown::Fail || s == Shown::Crashed || s == Shown::Timeout || s == Shown::NonFinite;
}

struct Sums {
    GeometricMean toBest, toOurs, costRatio;
    std::vector<double> costs;       ///< costs of graded scenarios, whose errors stand beside them
    std::vector<double> otherCosts;  ///< costs of those that ran without an exact solution
};

void count(const ViewModel& view, const Cell& cell, const CaseRow* at, double cheapest, Ranking& ranking,
           Sums& sums) {
    if (cell.cases.empty() || cell.worst == Shown::Unsupported) return;
    ++ranking.scenarios;
    ranking.lost += isLost(cell.worst);
    ranking.red +=
        std::any_of(cell.cases.begin(), cell.cases.end(), [](const CaseRow* row) { return isRed(*row); });
    if (at == nullptr || at->outcome != Outcome::Completed) return;
    const bool isGraded = at->accuracy.grade != Grade::None;
    if (const double cost = costOf(at); cost > 0.0) {
        (isGraded ? sums.costs : sums.otherCosts).push_back(cost);
        sums.costRatio.add(cost / cheapest);
    }
    ranking.known += at->verdict == results::Verdict::KnownDeviation;
    const auto& accuracy = at->accuracy;
    if (!isGraded) {
        ++ranking.ungraded;
        return;
    }
    ++ranking.grades.at(static_cast<std::size_t>(accuracy.grade) - 1);
    ranking.farther +=
        results::againstScheme(accuracy.relative, accuracy.ideal) == results::AgainstScheme::Farther;
    sums.toBest.add(view.ratios(*at).toBest);
    sums.toOurs.add(view.ratios(*at).toOurs);
}

/// An engine that ran less than half of what another one ran, or has no error to show, can not be the best.
bool isCandidate(const Mechanism& m, std::size_t column) {
    int most = 0;
    for (const auto& s : m.rankings) most = std::max(most, s.scenarios - s.lost);
    const Ranking& s = m.rankings[column];
    return s.scenarios > s.lost && 2 * (s.scenarios - s.lost) >= most && std::isfinite(s.toBest);
}

/// Candidates before the others; then by the least share of scenarios that were lost or of grade E, then the largest share
/// of gradable ones within a hundredth, then the smallest error, then the least cost by the same clock.
void rank(const ViewModel& view, Mechanism& m) {
    for (std::size_t c = 0; c < m.rankings.size(); ++c)
        if (m.rankings[c].scenarios > 0) m.order.push_back(c);
    const auto key = [&](std::size_t c) {
        const Ranking& s = m.rankings[c];
        return std::tuple(!isCandidate(m, c), (s.lost + s.grades[4]) / static_cast<double>(s.scenarios),
                          -(s.within() / static_cast<double>(std::max(1, s.gradable()))),
                          std::isfinite(s.toBest) ? s.toBest : 1e300, view.columns()[c].clock,
                          std::isfinite(s.cost) ? s.cost : 1e300);
    };
    std::stable_sort(m.order.begin(), m.order.end(), [&](auto a, auto b) { return key(a) < key(b); });
    if (!m.order.empty() && isCandidate(m, m.order.front())) m.best = m.order.front();
    std::set<std::string> seen;
    for (const std::size_t c : m.order)
        if (seen.insert(view.columns()[c].engine).second) m.engines.push_back(c);
}

}  // namespace

std::map<const CaseRow*, Ratios> ratiosOf(const ViewModel& view) {
    std::map<const CaseRow*, Ratios> all;
    for (const CaseRow& row : view.run().cases) all[&row] = {};
    for (std::size_t s = 0; s < view.run().scenarios.size(); ++s) {
        if (view.run().scenarios[s].reference.empty())
            continue;                   // no engine is known to be right without a reference
        std::map<double, double> best;  // best error by time step
        for (std::size_t c = 0; c < view.columns().size(); ++c)
            for (const CaseRow* row : view.cell(s, c).cases) {
                const double error = errorOf(view, s, *row);
                const auto [it, isNew] = best.emplace(row->dt, error);
                if (!isNew && !(it->second <= error)) it->second = std::isnan(error) ? it->second : error;
            }
        for (std::size_t c = 0; c < view.columns().size(); ++c)
            for (const CaseRow* row : view.cell(s, c).cases) {
                const double error = errorOf(view, s, *row);
                const CaseRow* ours = oursBeside(view, s, *row);
                all[row] = {error / best.at(row->dt),
                            ours == nullptr ? kNoNumber : error / errorOf(view, s, *ours)};
            }
    }
    return all;
}

Mechanism rankingsOver(const ViewModel& view, const std::vector<std::size_t>& scenarios) {
    Mechanism m;
    m.rankings.resize(view.columns().size());
    std::vector<Sums> sums(view.columns().size());
    for (const std::size_t s : scenarios) {
        m.scenarios.push_back(view.run().scenarios[s].name);
        const double finest = finestOf(view, s);
        std::map<std::string, double> cheapest;  // key: the clock; times of different clocks are not compared
        for (std::size_t c = 0; c < view.columns().size(); ++c) {
            const auto it =
                cheapest.emplace(view.columns()[c].clock, std::numeric_limits<double>::infinity()).first;
            if (const double cost = costOf(caseAt(view.cell(s, c), finest)); cost < it->second)
                it->second = cost;
        }
        for (std::size_t c = 0; c < view.columns().size(); ++c)
            count(view, view.cell(s, c), caseAt(view.cell(s, c), finest),
                  cheapest.at(view.columns()[c].clock), m.rankings[c], sums[c]);
    }
    const bool anyGraded =
        std::any_of(sums.begin(), sums.end(), [](const Sums& column) { return !column.costs.empty(); });
    for (std::size_t c = 0; c < sums.size(); ++c) {
        m.rankings[c].toBest = sums[c].toBest.value();
        m.rankings[c].toOurs = sums[c].toOurs.value();
        const std::vector<double>& costs = anyGraded ? sums[c].costs : sums[c].otherCosts;
        m.rankings[c].timed = static_cast<int>(costs.size());
        m.rankings[c].cost = costs.empty() ? kNoNumber : validation::median(costs);
        m.rankings[c].costRatio = sums[c].costRatio.value();
    }
    rank(view, m);
    return m;
}

namespace {

/// Value of a step's timing that is gathered over scenarios.
struct CostField {
    double StepCost::*to;
    std::optional<double> (*of)(const results::TimingRow&);
};
constexpr CostField kCostFields[] = {
    {&StepCost::median, [](const results::TimingRow& t) { return std::optional(t.median); }},
    {&StepCost::mean, [](const results::TimingRow& t) { return t.mean; }},
    {&StepCost::p95, [](const results::TimingRow& t) { return t.p95; }},
    {&StepCost::p99, [](const results::TimingRow& t) { return t.p99; }},
    {&StepCost::worst, [](const results::TimingRow& t) { return t.worst; }},
    {&StepCost::first, [](const results::TimingRow& t) { return t.first; }},
    {&StepCost::realTimeFactor, [](const results::TimingRow& t) { return t.realTimeFactor; }}};

/// The step of every column in one scenario; null where it was not timed or did not complete.
std::vector<const results::TimingRow*> stepsOf(const ViewModel& view, std::size_t scenario) {
    std::vector<const results::TimingRow*> steps;
    const double finest = finestOf(view, scenario);
    for (std::size_t c = 0; c < view.columns().size(); ++c) {
        const CaseRow* row = caseAt(view.cell(scenario, c), finest);
        const bool completed = row != nullptr && row->outcome == Outcome::Completed;
        steps.push_back(completed ? stepTiming(*row) : nullptr);
    }
    return steps;
}

/// The least value of each clock.
std::map<std::string, double> leastOf(const ViewModel& view,
                                      const std::vector<const results::TimingRow*>& steps,
                                      const CostField& field) {
    std::map<std::string, double> least;
    for (std::size_t c = 0; c < steps.size(); ++c) {
        const auto it = least.emplace(view.columns()[c].clock, std::numeric_limits<double>::infinity()).first;
        if (const auto value = steps[c] ? field.of(*steps[c]) : std::nullopt; value && *value > 0.0)
            it->second = std::min(it->second, *value);
    }
    return least;
}

}  // namespace

std::vector<StepCost> stepCosts(const ViewModel& view) {
    std::vector<StepCost> costs(view.columns().size());
    std::vector<std::array<std::vector<double>, std::size(kCostFields)>> values(costs.size());
    std::vector<GeometricMean> medianRatios(costs.size()), meanRatios(costs.size());
    for (std::size_t s = 0; s < view.run().scenarios.size(); ++s) {
        const auto steps = stepsOf(view, s);
        const auto leastMedian = leastOf(view, steps, kCostFields[0]);
        const auto leastMean = leastOf(view, steps, kCostFields[1]);
        for (std::size_t c = 0; c < steps.size(); ++c) {
            if (steps[c] == nullptr) continue;
            ++costs[c].scenarios;
            for (std::size_t f = 0; f < std::size(kCostFields); ++f)
                if (const auto value = kCostFields[f].of(*steps[c]); value && std::isfinite(*value))
                    values[c][f].push_back(*value);
            const std::string& clock = view.columns()[c].clock;
            medianRatios[c].add(steps[c]->median / leastMedian.at(clock));
            if (steps[c]->mean) meanRatios[c].add(*steps[c]->mean / leastMean.at(clock));
        }
    }
    for (std::size_t c = 0; c < costs.size(); ++c) {
        for (std::size_t f = 0; f < std::size(kCostFields); ++f)
            if (!values[c][f].empty()) costs[c].*kCostFields[f].to = validation::median(values[c][f]);
        costs[c].clock = view.columns()[c].clock;
        costs[c].medianRatio = medianRatios[c].value();
        costs[c].meanRatio = meanRatios[c].value();
    }
    return costs;
}

std::vector<std::size_t> byCost(const std::vector<StepCost>& costs) {
    std::vector<std::size_t> order;
    for (std::size_t c = 0; c < costs.size(); ++c)
        if (costs[c].scenarios > 0) order.push_back(c);
    const auto key = [&](std::size_t c) {
        return std::pair(costs[c].clock,
                         std::isnan(costs[c].meanRatio) ? costs[c].medianRatio : costs[c].meanRatio);
    };
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
    return order;
}

std::vector<Mechanism> ViewModel::mechanisms() const {
    std::vector<std::pair<std::string, std::vector<std::size_t>>> words;
    for (std::size_t s = 0; s < run_.scenarios.size(); ++s)
        for (const auto& word : run_.scenarios[s].isolates) {
            auto found =
                std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.first == word; });
            if (found == words.end()) found = words.insert(words.end(), {word, {}});
            found->second.push_back(s);
        }
    std::vector<Mechanism> all;
    for (const auto& [word, scenarios] : words) {
        all.push_back(rankingsOver(*this, scenarios));
        all.back().name = word;
    }
    std::stable_sort(all.begin(), all.end(), [](const Mechanism& a, const Mechanism& b) {
        return a.scenarios.size() > b.scenarios.size();
    });
    return all;
}

Mechanism ViewModel::overall() const {
    std::vector<std::size_t> every(run_.scenarios.size());
    for (std::size_t s = 0; s < every.size(); ++s) every[s] = s;
    return rankingsOver(*this, every);
}

}  // namespace rigor::report
