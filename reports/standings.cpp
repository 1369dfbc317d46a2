// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// How engines did over sets of scenarios: counted here once, for terminal, summary, tables and page.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "reports/view_model.hpp"
#include "validation/results/judgement.hpp"
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
        if (value > 0.0 && std::isfinite(value)) sum_ += std::log(value), ++count_;
    }
    double value() const { return count_ > 0 ? std::exp(sum_ / count_) : kNoNumber; }

  private:
    double sum_ = 0.0;
    int count_ = 0;
};

/// The main error, at least what counts as rounding (of one unit where the metric has no scale); NaN where
/// there is none.
double errorOf(const ViewModel& view, std::size_t scenario, const CaseRow& row) {
    if (row.outcome != Outcome::Completed) return kNoNumber;
    const MetricRow* m = findMetric(row, view.mainMetric(scenario).name);
    if (m == nullptr || !std::isfinite(m->value)) return kNoNumber;
    return std::max(std::abs(m->value), results::gradeLimit(Grade::A) * m->scale.value_or(1.0));
}

/// The in-house engine's case that another stands beside; null where it has none.
const CaseRow* oursBeside(const ViewModel& view, std::size_t scenario, const CaseRow& row) {
    const CaseRow* found = nullptr;
    for (std::size_t c = 0; c < view.columns().size(); ++c) {
        const SpecColumn& column = view.columns()[c];
        if (column.engine != results::kInHouseEngine || !column.options.empty()) continue;
        const bool samePreset = column.preset == row.preset;
        if (!samePreset && column.preset != "default") continue;
        for (const CaseRow* other : view.cell(scenario, c).cases)
            if (other->dt == row.dt && (samePreset || found == nullptr)) found = other;
    }
    return found;
}

/// The finest time step that anybody completed; infinite where nobody did.
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
    std::vector<double> costs;
};

void count(const ViewModel& view, const Cell& cell, const CaseRow* at, double cheapest, Standing& standing,
           Sums& sums) {
    if (cell.cases.empty() || cell.worst == Shown::Unsupported) return;
    ++standing.scenarios;
    standing.lost += isLost(cell.worst);
    standing.red +=
        std::any_of(cell.cases.begin(), cell.cases.end(), [](const CaseRow* row) { return isRed(*row); });
    if (at == nullptr || at->outcome != Outcome::Completed) return;
    if (const double cost = costOf(at); cost > 0.0)
        sums.costs.push_back(cost), sums.costRatio.add(cost / cheapest);
    standing.known += at->verdict == results::Verdict::KnownDeviation;
    const auto& accuracy = at->accuracy;
    if (accuracy.grade == Grade::None) {
        ++standing.ungraded;
        return;
    }
    ++standing.grades.at(static_cast<std::size_t>(accuracy.grade) - 1);
    standing.farther +=
        results::againstScheme(accuracy.relative, accuracy.ideal) == results::AgainstScheme::Farther;
    sums.toBest.add(view.ratios(*at).toBest), sums.toOurs.add(view.ratios(*at).toOurs);
}

/// Whoever ran less than half of what somebody ran, or has no error to show, can not be the best.
bool isCandidate(const Mechanism& m, std::size_t column) {
    int most = 0;
    for (const auto& s : m.standings) most = std::max(most, s.scenarios - s.lost);
    const Standing& s = m.standings[column];
    return s.scenarios > s.lost && 2 * (s.scenarios - s.lost) >= most && std::isfinite(s.toBest);
}

/// Least share of lost cases and grade E first, then the most within a hundredth, then the smallest error.
void rank(Mechanism& m) {
    for (std::size_t c = 0; c < m.standings.size(); ++c)
        if (m.standings[c].scenarios > 0) m.order.push_back(c);
    const auto key = [&](std::size_t c) {
        const Standing& s = m.standings[c];
        const double all = s.scenarios;
        return std::tuple(!isCandidate(m, c), (s.lost + s.grades[4]) / all, -(s.within() / all),
                          std::isfinite(s.toBest) ? s.toBest : 1e300);
    };
    std::stable_sort(m.order.begin(), m.order.end(), [&](auto a, auto b) { return key(a) < key(b); });
    if (!m.order.empty() && isCandidate(m, m.order.front())) m.best = static_cast<int>(m.order.front());
}

}  // namespace

std::map<const CaseRow*, Ratios> ratiosOf(const ViewModel& view) {
    std::map<const CaseRow*, Ratios> all;
    for (const CaseRow& row : view.run().cases) all[&row] = {};
    for (std::size_t s = 0; s < view.run().scenarios.size(); ++s) {
        if (view.run().scenarios[s].reference.empty()) continue;  // nobody knows who is right
        std::map<double, double> best;                            // by time step
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

Mechanism standingsOver(const ViewModel& view, const std::vector<std::size_t>& scenarios) {
    Mechanism m;
    m.standings.resize(view.columns().size());
    std::vector<Sums> sums(view.columns().size());
    for (const std::size_t s : scenarios) {
        m.scenarios.push_back(view.run().scenarios[s].name);
        const double finest = finestOf(view, s);
        double cheapest = std::numeric_limits<double>::infinity();
        for (std::size_t c = 0; c < view.columns().size(); ++c)
            if (const double cost = costOf(caseAt(view.cell(s, c), finest)); cost < cheapest) cheapest = cost;
        for (std::size_t c = 0; c < view.columns().size(); ++c)
            count(view, view.cell(s, c), caseAt(view.cell(s, c), finest), cheapest, m.standings[c], sums[c]);
    }
    for (std::size_t c = 0; c < sums.size(); ++c) {
        m.standings[c].toBest = sums[c].toBest.value(), m.standings[c].toOurs = sums[c].toOurs.value();
        m.standings[c].cost = sums[c].costs.empty() ? kNoNumber : validation::median(sums[c].costs);
        m.standings[c].costRatio = sums[c].costRatio.value();
    }
    rank(m);
    return m;
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
        all.push_back(standingsOver(*this, scenarios));
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
    return standingsOver(*this, every);
}

}  // namespace rigor::report
