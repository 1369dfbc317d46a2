// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/compare.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <tuple>

#include "validation/comparison/regression.hpp"
#include "validation/results/values.hpp"
#include "validation/statistics/quantile.hpp"

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

std::string nameOf(const CaseRow& c) {
    char dt[32];
    std::snprintf(dt, sizeof dt, "%.6g", c.dt);
    return c.scenario + " " + c.spec + " dt=" + dt;
}

/// The cases of each run of a side.
std::vector<Cases> casesOf(const std::vector<Run>& runs) {
    std::vector<Cases> all(runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i)
        for (const CaseRow& c : runs[i].cases) all[i][keyOf(c)] = &c;
    return all;
}

/// Rank from good to bad.
int badness(Verdict verdict) {
    switch (verdict) {
        case Verdict::Pass:
            return 0;
        case Verdict::KnownDeviation:
        case Verdict::NoReference:
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

ComparedPlace placeOf(const CasePair& pair) {
    return {pair.before->scenario, pair.before->spec, pair.after->spec, pair.before->dt, pair.after->dt};
}

const MetricRow* find(const CaseRow& c, const MetricRow& like) {
    for (const MetricRow& m : c.metrics)
        if (m.name == like.name && m.subject == like.subject) return &m;
    return nullptr;
}

/// Size of a change (MetricChange::size). From nothing to rounding is no large change, whatever the ratio.
double sizeOf(const CasePair& pair, const MetricRow& before, const MetricRow& after,
              const CompareOptions& options) {
    if (!std::isfinite(before.value) || !std::isfinite(after.value))
        return std::numeric_limits<double>::infinity();
    const double least =
        std::max({options.floor, roundingOf(*pair.before, before), roundingOf(*pair.after, after)});
    return std::abs(
        std::log(std::max(std::abs(after.value), least) / std::max(std::abs(before.value), least)));
}

/// Errors of one case depend on each other: the case counts once, by where more of its errors went.
void compareMetrics(const CasePair& pair, const results::ScenarioRow* scenario, const CompareOptions& options,
                    SpecChange& spec, RunComparison& all) {
    int better = 0, worse = 0;
    for (const MetricRow& m : pair.before->metrics) {
        const MetricRow* other = find(*pair.after, m);
        if (m.kind == "cost" || m.kind == "outcome" || other == nullptr || !m.subject.empty()) continue;
        const double ratio = growth(m.value, other->value, options);
        const bool isJudged = scenario == nullptr || results::isError(*other, *scenario) ||
                              !std::isfinite(m.value) || !std::isfinite(other->value);
        if (isJudged) ++(ratio > 1.0 ? worse : ratio < 1.0 ? better : spec.same);
        if (ratio != 1.0)
            all.metrics.push_back({placeOf(pair), m.name, m.subject, m.unit, m.value, other->value,
                                   isJudged && ratio > 1.0, isJudged && ratio < 1.0,
                                   sizeOf(pair, m, *other, options)});
    }
    spec.better += better;
    spec.worse += worse;
    spec.casesBetter += better > worse;
    spec.casesWorse += worse > better;
}

void compareVerdicts(const CasePair& pair, RunComparison& all) {
    const Verdict before = pair.before->verdict, after = pair.after->verdict;
    if (before == after) return;
    const bool isRefused = before == Verdict::Unsupported || after == Verdict::Unsupported;
    const int change = isRefused ? 0 : badness(after) - badness(before);
    all.verdicts.push_back({placeOf(pair), results::verdictName(before), results::verdictName(after),
                            pair.after->reason, change > 0, change < 0, std::abs(change)});
}

/// Worse before better before other, each by size.
void sortChanges(RunComparison& all) {
    std::stable_sort(all.verdicts.begin(), all.verdicts.end(), [](const auto& a, const auto& b) {
        return std::tuple(a.worse, a.better, a.size) > std::tuple(b.worse, b.better, b.size);
    });
    std::stable_sort(all.metrics.begin(), all.metrics.end(), [](const auto& a, const auto& b) {
        return std::pair(a.worse || a.better, a.size) > std::pair(b.worse || b.better, b.size);
    });
}

/// One way to say what a step costs [s].
using StepCost = std::optional<double> (*)(const results::TimingRow&);

/// Median over the runs of a side of what a step costs [s].
std::optional<double> stepTime(const std::vector<Cases>& runs, const Key& key, StepCost cost) {
    std::vector<double> costs;
    for (const Cases& cases : runs) {
        const auto it = cases.find(key);
        if (it == cases.end() || it->second->outcome != Outcome::Completed) continue;
        for (const auto& t : it->second->timings)
            if (const auto value = cost(t); t.phase == "step" && value && *value > 0.0)
                costs.push_back(*value);
    }
    if (costs.empty()) return std::nullopt;
    return median(costs);
}

/// Logarithms of after / before, one per case.
struct LogRatios {
    std::vector<double> median, mean, first;

    void add(const std::vector<Cases>& before, const std::vector<Cases>& after, const CasePair& pair) {
        const auto ratio = [&](StepCost cost, std::vector<double>& list) {
            const auto a = stepTime(before, keyOf(*pair.before), cost),
                       b = stepTime(after, keyOf(*pair.after), cost);
            if (a && b) list.push_back(std::log(*b / *a));
        };
        ratio([](const results::TimingRow& t) { return std::optional(t.median); }, median);
        ratio([](const results::TimingRow& t) { return t.mean; }, mean);
        ratio([](const results::TimingRow& t) { return t.first; }, first);
    }
};

/// Ratios are compared on a logarithmic scale: twice and half are equally far from equal.
void summariseTimes(const LogRatios& ratios, SpecChange& spec) {
    if (!ratios.mean.empty()) spec.meanRatio = std::exp(median(ratios.mean));
    if (!ratios.first.empty()) spec.firstRatio = std::exp(median(ratios.first));
    const std::vector<double>& logRatios = ratios.median;
    spec.timed = logRatios.size();
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

/// Cases that are in no pair: those that only one of two runs has, or that have no other to differ from.
void listUnpaired(const Run& before, const Run& after, const std::vector<CasePair>& pairs,
                  RunComparison& all) {
    std::set<const CaseRow*> paired;
    for (const CasePair& pair : pairs) paired.insert({pair.before, pair.after});
    const auto list = [&](const Run& run, const char* side, std::vector<std::string>& names) {
        for (const CaseRow& c : run.cases)
            if (!paired.contains(&c)) names.push_back(nameOf(c) + side);
    };
    if (all.pairBy == PairBy::Nothing) {
        list(before, "", all.onlyBefore);
        list(after, "", all.onlyAfter);
    } else if (&before == &after) {
        list(before, "", all.unpaired);
    } else {
        list(before, ", before", all.unpaired);
        list(after, ", after", all.unpaired);
    }
}

[[noreturn]] void refuse(const Run& before, const Run& after, const RunComparison& all) {
    std::string text = "nothing can be compared, as the runs have ";
    if (all.pairBy == PairBy::Nothing)
        text += "no case (scenario, spec, dt) in common";
    else
        text +=
            std::string("no two cases of one scenario that differ in ") + pairByName(all.pairBy) + " alone";
    if (!all.changedScenarios.empty()) {
        text += "; these scenarios have the same name and other physics:";
        for (const std::string& name : all.changedScenarios) text += " " + name;
    }
    text += "\n  before: " + contentsOf(before) + "\n  after:  " + contentsOf(after);
    if (all.pairBy == PairBy::Nothing)
        text +=
            "\n  --pair engine|spec|dt compares what differs on purpose; "
            "`rigor history RUN RUN --pair engine|spec|dt --out FOLDER` shows it on a page";
    throw std::invalid_argument(text);
}

}  // namespace

std::string physicsOf(const std::string& scenarioText) {
    auto scenario = nlohmann::json::parse(scenarioText, nullptr, false);
    if (!scenario.is_object()) return scenarioText;
    for (const char* key : {"accept", "known_deviations", "title", "description", "source", "isolates",
                            "tags", "metrics", "time_limit", "dt", "negligible_error"})
        scenario.erase(key);
    return scenario.dump();
}

RunComparison compareRuns(const std::vector<Run>& before, const std::vector<Run>& after,
                          const CompareOptions& options) {
    RunComparison all;
    all.pairBy = options.pairBy;
    all.runsBefore = before.size();
    all.runsAfter = after.size();
    const Run& one = before.front();
    const bool isSame = options.pairBy != PairBy::Nothing && isOneRun(one, after.front());
    const Run& other = isSame ? one : after.front();
    compareEnvironments(one, other, all);
    all.changedScenarios = changedScenarios(one, other);
    const auto pairs = pairCases(one, other, options.pairBy);
    listUnpaired(one, other, pairs, all);
    const auto casesBefore = casesOf(before), casesAfter = casesOf(after);
    using Place = std::tuple<std::string, std::string, double, double>;
    std::map<Place, SpecChange> specs;
    std::map<Place, LogRatios> times;
    for (const CasePair& pair : pairs) {
        const CaseRow &a = *pair.before, &b = *pair.after;
        if (std::find(all.changedScenarios.begin(), all.changedScenarios.end(), a.scenario) !=
            all.changedScenarios.end())
            continue;
        const bool steps = options.pairBy == PairBy::TimeStep;
        const Place place{a.spec, b.spec, steps ? a.dt : 0.0, steps ? b.dt : 0.0};
        SpecChange& spec = specs[place];
        std::tie(spec.spec, spec.specAfter, spec.dt, spec.dtAfter) = place;
        ++spec.cases;
        compareVerdicts(pair, all);
        compareMetrics(pair, results::scenarioOf(other, a.scenario), options, spec, all);
        times[place].add(casesBefore, casesAfter, pair);
    }
    if (specs.empty()) refuse(one, other, all);
    for (auto& [place, spec] : specs) {
        spec.pCases = signTest(spec.casesBetter, spec.casesWorse);
        summariseTimes(times[place], spec);
        all.specs.push_back(spec);
    }
    sortChanges(all);
    return all;
}

bool becameWorse(const RunComparison& comparison) {
    return std::any_of(comparison.verdicts.begin(), comparison.verdicts.end(),
                       [](const VerdictChange& v) { return v.worse; }) ||
           std::any_of(comparison.metrics.begin(), comparison.metrics.end(),
                       [](const MetricChange& m) { return m.worse; });
}

}  // namespace rigor::validation
