// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/compare.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

namespace rigor::validation {
namespace {

using results::CaseRow;
using results::MetricRow;
using results::Outcome;
using results::Run;
using results::Verdict;

using Key = std::tuple<std::string, std::string, double>;  // scenario, spec, dt
using Cases = std::map<Key, const CaseRow*>;

Key keyOf(const CaseRow& c) {
    return {c.scenario, c.spec, c.dt};
}

std::string nameOf(const Key& key) {
    char dt[32];
    std::snprintf(dt, sizeof dt, "%.6g", std::get<2>(key));
    return std::get<0>(key) + " " + std::get<1>(key) + " dt=" + dt;
}

/// The cases of each run of a side.
std::vector<Cases> casesOf(const std::vector<Run>& runs) {
    std::vector<Cases> all(runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i)
        for (const CaseRow& c : runs[i].cases) all[i][keyOf(c)] = &c;
    return all;
}

/// From good to bad; known deviations and what an engine lacks are as good as passing.
int badness(Verdict verdict) {
    switch (verdict) {
        case Verdict::Pass:
        case Verdict::Unsupported:
            return 0;
        case Verdict::KnownDeviation:
            return 1;
        case Verdict::Fail:
            return 2;
        default:
            return 3;
    }
}

/// > 1: the error grew; 1: equal within the options.
double growth(double before, double after, const CompareOptions& options) {
    const bool was = std::isfinite(before), is = std::isfinite(after);
    if (!was && !is) return 1.0;
    if (was != is) return is ? 0.0 : std::numeric_limits<double>::infinity();
    const double a = std::abs(before), b = std::abs(after);
    if (std::max(a, b) <= options.floor) return 1.0;
    const double ratio = b / std::max(a, options.floor * 1e-3);
    return std::abs(b - a) <= options.tolerance * std::max(a, b) ? 1.0 : ratio;
}

const MetricRow* find(const CaseRow& c, const MetricRow& like) {
    for (const MetricRow& m : c.metrics)
        if (m.name == like.name && m.subject == like.subject) return &m;
    return nullptr;
}

void compareMetrics(const CaseRow& before, const CaseRow& after, const CompareOptions& options,
                    SpecChange& spec, RunComparison& all) {
    for (const MetricRow& m : before.metrics) {
        const MetricRow* other = find(after, m);
        if (m.kind == "cost" || m.kind == "outcome" || other == nullptr) continue;
        const double ratio = growth(m.value, other->value, options);
        if (m.subject.empty()) ++(ratio > 1.0 ? spec.worse : ratio < 1.0 ? spec.better : spec.same);
        if (ratio != 1.0 && m.subject.empty())
            all.metrics.push_back({before.scenario, before.spec, m.name, m.subject, m.unit, before.dt,
                                   m.value, other->value, ratio > 1.0});
    }
}

void compareVerdicts(const CaseRow& before, const CaseRow& after, RunComparison& all) {
    if (before.verdict == after.verdict) return;
    all.verdicts.push_back({before.scenario, before.spec, results::verdictName(before.verdict),
                            results::verdictName(after.verdict), after.reason, before.dt,
                            badness(after.verdict) > badness(before.verdict)});
}

/// Median over the runs of a side of the median time of a step [s].
std::optional<double> stepTime(const std::vector<Cases>& runs, const Key& key) {
    std::vector<double> medians;
    for (const Cases& cases : runs) {
        const auto it = cases.find(key);
        if (it == cases.end() || it->second->outcome != Outcome::Completed) continue;
        for (const auto& t : it->second->timings)
            if (t.phase == "step" && t.median > 0.0) medians.push_back(t.median);
    }
    if (medians.empty()) return std::nullopt;
    return median(medians);
}

/// Ratios are compared on a logarithmic scale: twice and half are equally far from equal.
void summariseTimes(const std::vector<double>& logRatios, SpecChange& spec) {
    spec.timed = static_cast<int>(logRatios.size());
    if (logRatios.empty()) return;
    spec.timeRatio = std::exp(median(logRatios));
    if (const auto interval = medianInterval(logRatios))
        spec.timeInterval = Interval{std::exp(interval->low), std::exp(interval->high)};
    const auto slower =
        static_cast<int>(std::count_if(logRatios.begin(), logRatios.end(), [](double r) { return r > 0; }));
    const auto faster =
        static_cast<int>(std::count_if(logRatios.begin(), logRatios.end(), [](double r) { return r < 0; }));
    spec.pTime = signTest(slower, faster);
}

void compareEnvironments(const Run& before, const Run& after, RunComparison& all) {
    auto merged = before.environment;
    merged.insert(after.environment.begin(), after.environment.end());
    const auto valueIn = [](const Run& run, const std::string& key) {
        const auto it = run.environment.find(key);
        return it == run.environment.end() ? std::string("(none)") : it->second;
    };
    if (before.environment.empty() || after.environment.empty()) return;  // a record holds none
    for (const auto& [key, value] : merged)
        if (key != "date" && valueIn(before, key) != valueIn(after, key))
            all.environment.push_back(key + ": " + valueIn(before, key) + " -> " + valueIn(after, key));
}

std::vector<std::string> changedScenarios(const Run& before, const Run& after) {
    std::vector<std::string> names;
    for (const auto& a : before.scenarios)
        for (const auto& b : after.scenarios)
            if (a.name == b.name && a.text != b.text && physicsOf(a.text) != physicsOf(b.text))
                names.push_back(a.name);
    return names;
}

double sizeOf(const MetricChange& m) {
    const double ratio = std::abs(m.after) / std::abs(m.before);
    return std::isfinite(ratio) && ratio > 0.0 ? std::abs(std::log(ratio))
                                               : std::numeric_limits<double>::infinity();
}

}  // namespace

std::string physicsOf(const std::string& scenarioText) {
    auto scenario = nlohmann::json::parse(scenarioText, nullptr, false);
    if (!scenario.is_object()) return scenarioText;
    for (const char* key : {"accept", "known_deviations", "title", "description", "source", "isolates",
                            "tags", "metrics", "time_limit", "dt"})
        scenario.erase(key);
    return scenario.dump();
}

RunComparison compareRuns(const std::vector<Run>& before, const std::vector<Run>& after,
                          const CompareOptions& options) {
    RunComparison all;
    all.runsBefore = static_cast<int>(before.size()), all.runsAfter = static_cast<int>(after.size());
    compareEnvironments(before.front(), after.front(), all);
    all.changedScenarios = changedScenarios(before.front(), after.front());
    const auto casesBefore = casesOf(before), casesAfter = casesOf(after);
    const Cases &old = casesBefore.front(), &now = casesAfter.front();
    std::map<std::string, SpecChange> specs;
    std::map<std::string, std::vector<double>> times;
    for (const auto& [key, c] : old) {
        const auto it = now.find(key);
        if (it == now.end()) {
            all.onlyBefore.push_back(nameOf(key));
            continue;
        }
        const bool changed = std::find(all.changedScenarios.begin(), all.changedScenarios.end(),
                                       c->scenario) != all.changedScenarios.end();
        if (changed) continue;
        SpecChange& spec = specs[c->spec];
        spec.spec = c->spec, ++spec.cases;
        compareVerdicts(*c, *it->second, all);
        compareMetrics(*c, *it->second, options, spec, all);
        const auto a = stepTime(casesBefore, key), b = stepTime(casesAfter, key);
        if (a && b) times[c->spec].push_back(std::log(*b / *a));
    }
    for (const auto& [key, c] : now)
        if (!old.contains(key)) all.onlyAfter.push_back(nameOf(key));
    for (auto& [name, spec] : specs) {
        spec.pErrors = signTest(spec.better, spec.worse);
        summariseTimes(times[name], spec);
        all.specs.push_back(spec);
    }
    std::stable_sort(all.metrics.begin(), all.metrics.end(),
                     [](const MetricChange& a, const MetricChange& b) { return sizeOf(a) > sizeOf(b); });
    return all;
}

bool becameWorse(const RunComparison& comparison) {
    return std::any_of(comparison.verdicts.begin(), comparison.verdicts.end(),
                       [](const VerdictChange& v) { return v.worse; }) ||
           std::any_of(comparison.metrics.begin(), comparison.metrics.end(),
                       [](const MetricChange& m) { return m.worse; });
}

}  // namespace rigor::validation
