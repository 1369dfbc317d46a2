// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/refinements.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <tuple>

#include "validation/comparison/order.hpp"
#include "validation/results/clock.hpp"
#include "validation/results/values.hpp"

namespace rigor::validation {
namespace {

using results::CaseRow;
using results::MetricRow;
using results::Outcome;
using results::Run;
using results::wholeScene;

constexpr std::size_t kMinRefinement = 3;

bool isNumber(const std::string& text) {
    char* end = nullptr;
    std::strtod(text.c_str(), &end);
    return !text.empty() && *end == '\0';
}

bool shrinksWithDt(const MetricRow& m) {
    return m.subject.empty() && (m.kind == "exact" || m.kind == "invariant" || m.kind == "joint");
}

/// Names of the whole-scene metrics of a scenario's cases that `wanted` accepts, each once, in their order.
template <class Wanted>
std::vector<std::string> metricsOf(const Run& run, const std::string& scenario, Wanted wanted) {
    std::vector<std::string> names;
    for (const CaseRow& c : run.cases) {
        if (c.scenario != scenario) continue;
        for (const MetricRow& m : c.metrics)
            if (wanted(m) && std::find(names.begin(), names.end(), m.name) == names.end())
                names.push_back(m.name);
    }
    return names;
}

void markBest(std::vector<WorkPoint>& points) {
    for (WorkPoint& p : points)
        p.best = std::none_of(points.begin(), points.end(), [&](const WorkPoint& q) {
            return q.competitor == p.competitor && q.cost <= p.cost && q.error < p.error;
        });
}

results::FairnessRow rowOf(const std::string& mode, const std::string& metric, const std::string& unit,
                           const WorkPoint& point, std::optional<double> limit) {
    results::FairnessRow row;
    row.mode = mode;
    row.scenario = point.row->scenario;
    row.metric = metric;
    row.unit = unit;
    row.competitor = point.competitor;
    row.caseId = point.row->id;
    row.spec = point.row->spec;
    row.dt = point.row->dt;
    row.error = point.error;
    row.cost = point.cost;
    row.limit = limit;
    return row;
}

using Competitors = std::map<std::string, std::vector<const WorkPoint*>>;

/// The two comparisons that have to choose a setting for each competitor.
void addChosen(const std::string& metric, const std::string& unit, const Competitors& all,
               std::vector<results::FairnessRow>& rows) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    double budget = 0.0, target = 0.0;
    Competitors refinements;
    for (const auto& [key, points] : all) {
        if (points.size() < kMinRefinement) continue;
        refinements[key] = points;
        double cheapest = kInfinity, nearest = kInfinity;
        for (const auto* p : points) {
            cheapest = std::min(cheapest, p->cost);
            nearest = std::min(nearest, p->error);
        }
        budget = std::max(budget, cheapest);
        target = std::max(target, nearest);
    }
    if (refinements.size() < 2) return;
    for (const auto& [key, points] : refinements) {
        const WorkPoint *within = nullptr, *reached = nullptr;
        for (const auto* p : points) {
            if (p->cost <= budget && (!within || p->error < within->error)) within = p;
            if (p->error <= target && (!reached || p->cost < reached->cost)) reached = p;
        }
        rows.push_back(rowOf("equal_time", metric, unit, *within, budget));
        rows.push_back(rowOf("equal_accuracy", metric, unit, *reached, target));
    }
}

}  // namespace

std::string competitorOf(const std::string& spec) {
    const auto colon = spec.find(':');
    if (colon == std::string::npos) return spec;
    std::string kept;
    for (std::size_t begin = colon + 1; begin <= spec.size();) {
        const auto end = std::min(spec.find(',', begin), spec.size());
        const std::string option = spec.substr(begin, end - begin);
        const auto equals = option.find('=');
        if (equals == std::string::npos || !isNumber(option.substr(equals + 1)))
            kept += (kept.empty() ? ":" : ",") + option;
        begin = end + 1;
    }
    return spec.substr(0, colon) + kept;
}

std::vector<WorkPoint> workPoints(const Run& run, const std::string& scenario, const std::string& metric) {
    std::vector<WorkPoint> points;
    for (const CaseRow& c : run.cases) {
        if (c.scenario != scenario || c.outcome != Outcome::Completed) continue;
        const MetricRow* m = wholeScene(c, metric);
        const auto cost = results::steppingTime(c);
        if (m != nullptr && std::isfinite(m->value) && cost && std::isfinite(*cost))
            points.push_back({&c, competitorOf(c.spec), m->value, *cost, false});
    }
    std::stable_sort(points.begin(), points.end(), [](const WorkPoint& a, const WorkPoint& b) {
        return std::tie(a.competitor, a.cost) < std::tie(b.competitor, b.cost);
    });
    markBest(points);
    return points;
}

std::vector<results::OrderRow> observedOrders(const Run& run) {
    std::vector<results::OrderRow> rows;
    for (const auto& scenario : run.scenarios) {
        for (const auto& metric : metricsOf(run, scenario.name, shrinksWithDt)) {
            std::map<std::string, std::vector<RefinementPoint>> refinements;
            std::map<std::string, std::int64_t> position;
            std::string unit;
            for (const CaseRow& c : run.cases) {
                if (c.scenario != scenario.name || c.outcome != Outcome::Completed) continue;
                const MetricRow* m = wholeScene(c, metric);
                if (m == nullptr) continue;
                refinements[c.spec].push_back({c.dt, m->value});
                unit = m->unit;
                position.emplace(c.spec, c.position);
            }
            std::vector<std::string> specs;
            for (const auto& [spec, refinement] : refinements)
                if (refinement.size() >= kMinRefinement) specs.push_back(spec);
            std::sort(specs.begin(), specs.end(),
                      [&](const auto& a, const auto& b) { return position.at(a) < position.at(b); });
            for (const auto& spec : specs) {
                results::OrderRow row;
                row.scenario = scenario.name;
                row.spec = spec;
                row.metric = metric;
                row.unit = unit;
                if (const auto fit = observedOrder(refinements.at(spec))) {
                    row.order = fit->order;
                    row.low = fit->low;
                    row.high = fit->high;
                    row.points = fit->points;
                    row.finest = fit->finest;
                    row.coarsest = fit->coarsest;
                    row.note = fit->note;
                } else {
                    row.note = "round-off at every time step but one or none";
                }
                rows.push_back(row);
            }
        }
    }
    return rows;
}

std::vector<results::FairnessRow> fairComparisons(const Run& run) {
    std::vector<results::FairnessRow> rows;
    std::map<std::string, std::string> clocks;
    for (const auto& engine : run.engines) clocks[engine.name] = results::clockOf(engine);
    for (const auto& scenario : run.scenarios) {
        for (const auto& metric : metricsOf(run, scenario.name, [](const MetricRow& m) {
                 return m.subject.empty() && m.kind == "exact";
             })) {
            const auto points = workPoints(run, scenario.name, metric);
            if (points.empty()) continue;
            const std::string unit = wholeScene(*points.front().row, metric)->unit;
            double first = 0.0;
            for (const auto& p : points) first = std::max(first, p.row->dt);
            std::map<std::string, Competitors> byClock;
            for (const auto& p : points) {
                byClock[clocks[p.row->engine]][p.competitor].push_back(&p);
                if (p.row->dt != first) continue;
                if (p.row->preset == "default") rows.push_back(rowOf("engine_defaults", metric, unit, p, {}));
                if (p.row->preset == "matched")
                    rows.push_back(rowOf("matched_settings", metric, unit, p, {}));
            }
            for (const auto& [clock, competitors] : byClock) addChosen(metric, unit, competitors, rows);
        }
    }
    return rows;
}

}  // namespace rigor::validation
