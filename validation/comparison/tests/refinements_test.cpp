// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/refinements.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "validation/results/values.hpp"

namespace rigor::validation {
namespace {

using results::CaseRow;
using results::FairnessRow;

CaseRow caseRow(const std::string& spec, const std::string& preset, double dt, double error,
                double stepTime) {
    CaseRow c;
    c.id = spec + "@" + std::to_string(dt);
    c.scenario = "swing";
    c.spec = spec;
    c.dt = dt;
    c.engine = spec.substr(0, spec.find(':'));
    c.preset = preset;
    c.steps = std::lround(1.0 / dt);
    c.metrics = {{"position_max", "", "m", "exact", error, -1.0, {}, {}, {}, ""},
                 {"position_max", "bob", "m", "exact", 7.0, -1.0, {}, {}, {}, ""},
                 {"rest_sink", "", "m", "rest", 1.0, -1.0, {}, {}, {}, ""}};
    c.timings = {{"build", 1.0, 1.0, 1.0, 1.0, 1, 0.0},
                 {"step", stepTime, stepTime, stepTime, 99.0, c.steps, 0.0}};
    return c;
}

/// fast: first order, 1 us a step; slow: second order, 10 us a step, started at a tenth of the error.
results::Run twoEngines() {
    results::Run run;
    results::ScenarioRow scenario;
    scenario.name = "swing";
    run.scenarios = {scenario};
    for (const double dt : {1.0 / 50.0, 1.0 / 100.0, 1.0 / 200.0, 1.0 / 400.0}) {
        run.cases.push_back(caseRow("fast:preset=default", "default", dt, 5.0 * dt, 1e-6));
        run.cases.push_back(caseRow("slow:preset=matched", "matched", dt, 25.0 * dt * dt, 1e-5));
    }
    std::int64_t position = 0;
    for (auto& c : run.cases) c.position = position++;
    return run;
}

const FairnessRow& find(const std::vector<FairnessRow>& rows, const std::string& mode,
                        const std::string& competitor) {
    const auto it = std::find_if(rows.begin(), rows.end(), [&](const FairnessRow& r) {
        return r.mode == mode && r.competitor.starts_with(competitor);
    });
    if (it == rows.end()) throw std::runtime_error("no row " + mode + " " + competitor);
    return *it;
}

TEST(Competitor, IsTheSpecWithoutNumbers) {
    EXPECT_EQ(competitorOf("bullet"), "bullet");
    EXPECT_EQ(competitorOf("ode:preset=matched,iterations=50"), "ode:preset=matched");
    EXPECT_EQ(competitorOf("rigor:velocity_iterations=8"), "rigor");
    EXPECT_EQ(competitorOf("rigor:solver=pgs,substeps=4,precision=f32"), "rigor:solver=pgs,precision=f32");
    EXPECT_EQ(competitorOf("rigor:slop=1e-4,solver=nsgs"), "rigor:solver=nsgs");
}

TEST(Refinements, OrdersOfEachSpecAndExactMetric) {
    const auto orders = observedOrders(twoEngines());
    ASSERT_EQ(orders.size(), 2u);  // no order for one body and for metrics that need not shrink
    EXPECT_EQ(orders[0].spec, "fast:preset=default");
    EXPECT_EQ(orders[0].metric, "position_max");
    EXPECT_EQ(orders[0].unit, "m");
    EXPECT_NEAR(orders[0].order.value(), 1.0, 1e-12);
    EXPECT_NEAR(orders[1].order.value(), 2.0, 1e-12);
    EXPECT_EQ(orders[1].points, 4);
}

TEST(Refinements, CasesThatDidNotEndWellDoNotCount) {
    auto run = twoEngines();
    for (auto& c : run.cases)
        if (c.engine == "slow" && c.dt < 1.0 / 60.0) c.outcome = results::Outcome::Crashed;
    const auto orders = observedOrders(run);
    ASSERT_EQ(orders.size(), 1u);
    EXPECT_EQ(orders[0].spec, "fast:preset=default");
}

TEST(Refinements, CostIsMedianTimesSteps) {
    const auto run = twoEngines();
    EXPECT_DOUBLE_EQ(results::steppingTime(run.cases[0]).value(), 50.0 * 1e-6);
    EXPECT_FALSE(results::steppingTime(CaseRow{}));
}

TEST(Refinements, TheFrontHoldsWhatNothingCheaperBeats) {
    auto run = twoEngines();
    run.cases.push_back(caseRow("fast:preset=default", "default", 1.0 / 300.0, 1.0, 1e-6));
    const auto points = workPoints(run, "swing", "position_max");
    ASSERT_EQ(points.size(), 9u);
    for (const auto& p : points) EXPECT_EQ(p.best, p.error < 0.99) << p.row->id << " " << p.error;
}

/// Cheapest runs cost 50 us and 500 us: the budget is 500 us, which lets `fast` run at 1/400 (400 us).
TEST(Refinements, EqualTimeGivesEachEngineTheBudgetOfTheSlowest) {
    const auto rows = fairComparisons(twoEngines());
    const auto& fast = find(rows, "equal_time", "fast");
    const auto& slow = find(rows, "equal_time", "slow");
    EXPECT_DOUBLE_EQ(fast.limit.value(), 50 * 1e-5);
    EXPECT_DOUBLE_EQ(fast.dt, 1.0 / 400.0);
    EXPECT_DOUBLE_EQ(slow.dt, 1.0 / 50.0);
    EXPECT_DOUBLE_EQ(fast.error, 5.0 / 400.0);
}

/// Least errors are 1.25e-2 and 1.6e-4: the target is 1.25e-2, for which `slow` needs 1/50 (1e-2).
TEST(Refinements, EqualAccuracyIsTheBestThatEveryEngineReaches) {
    const auto rows = fairComparisons(twoEngines());
    const auto& fast = find(rows, "equal_accuracy", "fast");
    const auto& slow = find(rows, "equal_accuracy", "slow");
    EXPECT_DOUBLE_EQ(slow.limit.value(), 5.0 / 400.0);
    EXPECT_DOUBLE_EQ(slow.dt, 1.0 / 50.0);
    EXPECT_DOUBLE_EQ(fast.dt, 1.0 / 400.0);
    EXPECT_LT(fast.cost, slow.cost);
}

TEST(Refinements, PresetsAreComparedAtTheFirstTimeStepAlone) {
    const auto rows = fairComparisons(twoEngines());
    EXPECT_DOUBLE_EQ(find(rows, "engine_defaults", "fast").dt, 1.0 / 50.0);
    EXPECT_DOUBLE_EQ(find(rows, "matched_settings", "slow").dt, 1.0 / 50.0);
    EXPECT_THROW(find(rows, "engine_defaults", "slow"), std::runtime_error);
    EXPECT_EQ(rows.size(), 6u);
}

TEST(Refinements, TwoSettingsAreNoRefinement) {
    auto run = twoEngines();
    std::erase_if(run.cases, [](const CaseRow& c) { return c.dt < 1.0 / 150.0; });
    EXPECT_TRUE(observedOrders(run).empty());
    EXPECT_EQ(fairComparisons(run).size(), 2u);
}

/// Two more engines by another clock: each clock has a budget and a target of its own.
TEST(Refinements, TimesOfDifferentClocksAreNotCompared) {
    auto run = twoEngines();
    run.engines.resize(4);
    for (std::size_t i = 0; i < 4; ++i) run.engines[i].name = std::vector{"fast", "slow", "one", "two"}[i];
    for (const std::size_t guest : {2u, 3u}) run.engines[guest].capabilities = R"({"clock":"guest, wasm"})";
    const auto alone = fairComparisons(run);
    for (const double dt : {1.0 / 50.0, 1.0 / 100.0, 1.0 / 200.0}) {
        run.cases.push_back(caseRow("one:preset=default", "default", dt, 50.0 * dt, 1e-3));
        run.cases.push_back(caseRow("two:preset=default", "default", dt, 60.0 * dt, 2e-3));
    }
    const auto rows = fairComparisons(run);
    for (const char* mode : {"equal_time", "equal_accuracy"}) {
        EXPECT_EQ(find(rows, mode, "fast").limit, find(alone, mode, "fast").limit);
        EXPECT_EQ(find(rows, mode, "fast").dt, find(alone, mode, "fast").dt);
        EXPECT_EQ(find(rows, mode, "one").limit, find(rows, mode, "two").limit);
    }
    EXPECT_DOUBLE_EQ(find(rows, "equal_time", "one").limit.value(), 50 * 2e-3);
}

}  // namespace
}  // namespace rigor::validation
