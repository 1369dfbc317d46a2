// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/live.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <limits>
#include <string>

#include "adapters/interface/prepared_engine.hpp"
#include "validation/results/values.hpp"
#include "validation/runner/cost.hpp"
#include "validation/runner/judge.hpp"
#include "validation/runner/read_back.hpp"
#include "validation/runner/simulate.hpp"

namespace rigor::validation {
namespace {

using adapter::BadInput;
using results::CaseRow;
using scenario::Scenario;

std::vector<results::LedgerRow> ledgerRows(const std::vector<adapter::LedgerEntry>& entries) {
    std::vector<results::LedgerRow> rows;
    for (const auto& e : entries)
        rows.push_back({e.topic, e.requested, e.resolved, adapter::realisationName(e.realisation), e.reason});
    return rows;
}

/// Peak resident memory of this process image [KiB]. ru_maxrss would include the process it was forked from.
std::int64_t peakMemoryKiB() {
    std::ifstream status("/proc/self/status");
    std::string line;
    while (std::getline(status, line))
        if (line.starts_with("VmHWM:")) return std::stoll(line.substr(6));
    struct rusage usage {};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

std::int64_t movingBodies(const Scenario& scenario) {
    return std::count_if(scenario.bodies.begin(), scenario.bodies.end(),
                         [](const scenario::Body& body) { return body.type == scenario::BodyType::Dynamic; });
}

CaseRow startRow(const Scenario& scenario, const adapter::EngineSpec& spec, double dt) {
    CaseRow row;
    row.scenario = scenario.name;
    row.spec = spec.text();
    row.engine = spec.engine;
    row.preset = spec.preset();
    row.dt = dt;
    return row;
}

/// Judges the counters of the engine. A bound on one that the engine does not count is a miss: a bound that is set
/// must be evaluated.
void addCosts(std::vector<results::MetricRow> costs, const Scenario& scenario, CaseRow& row) {
    for (results::MetricRow& cost : costs) {
        judgeMetric(cost, scenario, row);
        row.metrics.push_back(std::move(cost));
    }
    for (const scenario::Bound& bound : scenario.accept) {
        if (!isCostMetric(bound.metric) || boundFor(scenario, row, bound.metric) != &bound ||
            results::wholeScene(row, bound.metric) != nullptr)
            continue;
        results::MetricRow missing;
        missing.name = bound.metric;
        missing.unit = "1";
        missing.kind = "cost";
        missing.value = std::numeric_limits<double>::quiet_NaN();
        judgeMetric(missing, scenario, row);
        missing.note = "no value: the engine does not count this";
        row.metrics.push_back(missing);
    }
}

}  // namespace

WholeCase runWholeCase(const Scenario& scenario, const adapter::EngineSpec& spec, double dt,
                       const LiveOptions& options) {
    using Clock = std::chrono::steady_clock;
    const auto since = [](Clock::time_point start) {
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    const auto started = Clock::now();
    WholeCase whole;
    CaseRow& row = whole.live.row;
    row = startRow(scenario, spec, dt);
    const Scenario& given = options.given ? options.given->scenario : scenario;
    const adapter::PreparedEngine engine = adapter::prepareEngine(spec, given, dt);
    row.settings = engine.settings;

    const auto buildStart = Clock::now();
    const auto world = engine.build(given, dt);
    const double buildSeconds = since(buildStart);
    row.readBack =
        compareReadBack(given, world->readBack(), readBackTolerance(engine.settings.at("precision")));
    whole.scheme = world->scheme();

    Simulation run = simulate(given, dt, *world, options);
    row.ledger = ledgerRows(world->ledger());  // Changes of the floating-point environment show in a step.
    row.steps = run.steps;
    row.stateHash = run.stateHash;
    row.timings = std::move(run.timings);
    row.timings.insert(row.timings.begin() + 1,
                       {"build", buildSeconds, buildSeconds, buildSeconds, buildSeconds, 1, 0.0});
    for (auto& timing : row.timings) timing.bodies = movingBodies(scenario);
    whole.live.trajectory = options.given ? options.given->back(run.trajectory) : std::move(run.trajectory);
    if (run.nonFinite.empty()) {
        if (options.onSimulated) options.onSimulated();
        ReferenceOrProblem made;
        if (options.withoutReference)
            made.problem = options.withoutReference->problem;
        else
            made = referenceOf(scenario, options.makeReference);
        whole.reference = std::move(made.reference);
        evaluateCase({scenario, whole.live.trajectory, whole.reference.get(), whole.scheme}, row,
                     made.problem);
    } else {
        row.outcome = results::Outcome::NonFinite;
        row.reason = run.nonFinite;
    }
    addCosts(std::move(run.costs), scenario, row);
    judgeCase(row, scenario);
    if (options.withoutReference) judgeWithoutReference(row, *options.withoutReference);
    row.peakMemoryKiB = peakMemoryKiB();
    row.wallSeconds = since(started);
    return whole;
}

LiveCase runInProcess(const Scenario& scenario, const adapter::EngineSpec& spec, double dt,
                      const LiveOptions& options) {
    return runWholeCase(scenario, spec, dt, options).live;
}

}  // namespace rigor::validation
