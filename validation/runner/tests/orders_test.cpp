// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Least and greatest value over orders of insertion, for engines whose result depends on the order by a known
// amount, by nothing, and by whether they survive.
#include "validation/runner/orders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "validation/results/values.hpp"
#include "validation/runner/tests/fixtures.hpp"

namespace rigor::validation {
namespace {

using fixtures::plan;
using Orders = fixtures::RunnerTest;
using results::CaseRow;
using results::Grade;
using results::MetricRow;
using results::OrderDependence;
using results::Outcome;
using testing::HasSubstr;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// A thrown ball, a floor and a wall that it does not reach: three bodies in six orders.
std::string threeBodies() {
    std::string text = fixtures::thrownBall("three_bodies");
    const std::string floor = R"("shapes": [{"half_space": {"normal": [0, 1, 0]}}]},)";
    const auto end = text.find(floor) + floor.size();
    return text.insert(end, R"({"name": "wall", "type": "static", "position": [-90, 0, 0],
     "shapes": [{"half_space": {"normal": [1, 0, 0]}}]},)");
}

std::string ballAlone() {
    std::string text = fixtures::thrownBall("ball_alone");
    const auto begin = text.find(R"({"name": "floor")"), end = text.find(R"({"name": "ball")");
    return text.erase(begin, end - begin);
}

const MetricRow& positionFinal(const CaseRow& row) {
    const auto* metric = results::wholeScene(row, "position_final");
    if (metric == nullptr) throw std::runtime_error("no position_final: " + row.reason);
    return *metric;
}

/// Symplectic Euler is off by g h T / 2; the engine adds i mm along x for the place i of the ball.
double errorAtPlace(const CasePlan& c, int place) {
    const scenario::Vec3 scheme = 0.5 * c.dt * c.scenario.duration * c.scenario.gravity;
    return norm(scheme + scenario::Vec3{1e-3 * place, 0.0, 0.0});
}

TEST_F(Orders, TheRangeIsWhatTheOrderMakes) {
    const auto cases = plan({threeBodies()}, "double_order_dependent:preset=default");
    RunOptions o = options();
    o.orders = 6;
    const auto row = run(cases, o).cases.at(0);
    const MetricRow& m = positionFinal(row);
    EXPECT_NEAR(m.value, errorAtPlace(cases[0], 2), 1e-12) << "as written the ball is third";
    ASSERT_TRUE(m.orderMin && m.orderMax && m.orderCount);
    EXPECT_NEAR(*m.orderMin, errorAtPlace(cases[0], 0), 1e-12);
    EXPECT_NEAR(*m.orderMax, errorAtPlace(cases[0], 2), 1e-12);
    EXPECT_EQ(*m.orderCount, 6);
    EXPECT_EQ(row.orders.run, 6);
    EXPECT_EQ(row.orders.completed, 6);
    EXPECT_EQ(row.orders.note, "");
    EXPECT_EQ(row.orders.worst, row.accuracy.grade);
    EXPECT_LE(row.orders.best, row.accuracy.grade);
}

TEST_F(Orders, OfAnEngineThatDoesNotSeeThemHaveNoWidth) {
    RunOptions o = options();
    o.orders = 4;
    const auto row = run(plan({threeBodies()}, "double_free_flight:preset=default"), o).cases.at(0);
    int ranges = 0;
    for (const MetricRow& m : row.metrics) {
        if (!m.orderCount) continue;
        ++ranges;
        EXPECT_EQ(*m.orderMin, m.value) << m.name;
        EXPECT_EQ(*m.orderMax, m.value) << m.name;
        EXPECT_EQ(*m.orderCount, 4) << m.name;
    }
    EXPECT_GT(ranges, 3);
    EXPECT_EQ(row.orders.best, row.orders.worst);
}

TEST_F(Orders, AreNotCountedTwice) {
    RunOptions o = options();
    o.orders = 9;
    const auto run = this->run(
        plan({fixtures::thrownBall("two_bodies"), ballAlone()}, "double_order_dependent:preset=default"), o);
    EXPECT_EQ(run.cases.at(0).orders.run, 2) << "two bodies can be handed over in two orders";
    const CaseRow& alone = run.cases.at(1);
    EXPECT_FALSE(alone.orders.run);
    EXPECT_THAT(alone.orders.note, HasSubstr("nothing to reorder"));
    EXPECT_FALSE(positionFinal(alone).orderMin || positionFinal(alone).orderCount);
}

TEST_F(Orders, AreNotRunUnlessRequested) {
    const auto row =
        run(plan({threeBodies()}, "double_order_dependent:preset=default"), options()).cases.at(0);
    EXPECT_FALSE(row.orders.run || row.orders.completed);
    EXPECT_EQ(row.orders.note, "");
    EXPECT_EQ(row.orders.worst, Grade::None);
    EXPECT_FALSE(positionFinal(row).orderMin || positionFinal(row).orderMax || positionFinal(row).orderCount);
}

/// The ending of another order is reported and counts as the worst grade; the order as written keeps its own.
TEST_F(Orders, ThatCrashAreReportedAndDoNotAffectTheCase) {
    RunOptions o = options();
    o.orders = 2;
    const auto row = run(plan({threeBodies()}, "double_order_abort:preset=default"), o).cases.at(0);
    EXPECT_EQ(row.outcome, Outcome::Completed);
    EXPECT_EQ(row.orders.run, 2);
    EXPECT_EQ(row.orders.completed, 1);
    EXPECT_THAT(row.orders.note, HasSubstr("order 2: crashed (SIGABRT"));
    EXPECT_EQ(row.orders.best, row.accuracy.grade);
    EXPECT_EQ(row.orders.worst, Grade::E);
    EXPECT_FALSE(positionFinal(row).orderMin) << "no other order has a value";
    EXPECT_FALSE(row.trajectoryFile.empty());
}

TEST_F(Orders, AreAddedWhenARunIsResumed) {
    const auto cases = plan({threeBodies()}, "double_order_dependent:preset=default");
    RunOptions o = options();
    run(cases, o);
    o.resume = true;
    o.orders = 3;
    EXPECT_EQ(run(cases, o).cases.at(0).orders.run, 3);
    const std::atomic<bool> never{false};
    std::int64_t skipped = 0;
    const auto again = runCases(
        cases, o, [&](const Progress& p) { skipped = p.skipped; }, never);
    EXPECT_EQ(again.cases.at(0).orders.run, 3);
    o.orders = 1;
    EXPECT_EQ(run(cases, o).cases.at(0).orders.run, 3) << "kept";
}

CaseRow graded(Grade grade, std::vector<MetricRow> metrics) {
    CaseRow row;
    row.accuracy.grade = grade;
    row.metrics = std::move(metrics);
    return row;
}
MetricRow metric(const std::string& name, double value) {
    MetricRow m;
    m.name = name;
    m.value = value;
    return m;
}

TEST(AddOrders, ValuesThatAreNoneAreNotCounted) {
    CaseRow row = graded(Grade::C, {metric("a", 2.0), metric("b", kNotANumber), metric("c", 1.0)});
    addOrders(row, {{2, graded(Grade::D, {metric("a", 5.0), metric("b", 7.0)}), ""},
                    {1, graded(Grade::B, {metric("a", kNotANumber), metric("b", 3.0)}), ""}});
    EXPECT_EQ(std::tie(row.metrics[0].orderMin, row.metrics[0].orderMax),
              std::make_tuple(std::optional(2.0), std::optional(5.0)));
    EXPECT_EQ(row.metrics[0].orderCount, 2);
    EXPECT_EQ(std::tie(row.metrics[1].orderMin, row.metrics[1].orderMax),
              std::make_tuple(std::optional(3.0), std::optional(7.0)));
    EXPECT_EQ(row.metrics[1].orderCount, 2);
    EXPECT_FALSE(row.metrics[2].orderCount);
    EXPECT_EQ(row.orders.best, Grade::B);
    EXPECT_EQ(row.orders.worst, Grade::D);
    EXPECT_EQ(row.accuracy.grade, Grade::C) << "of the order as written";
}

/// A reference that broke down says nothing of the engine.
TEST(AddOrders, AReferenceThatBrokeDownIsNoGrade) {
    CaseRow row = graded(Grade::A, {metric("a", 2.0)});
    addOrders(row, {{1, {}, "reference_timeout: the reference did not finish within 20 s"}});
    EXPECT_EQ(row.orders.run, 2);
    EXPECT_EQ(row.orders.completed, 1);
    EXPECT_EQ(row.orders.worst, Grade::A);
    EXPECT_THAT(row.orders.note, HasSubstr("order 2: reference_timeout"));
}

/// A case that fails as written may go well in another order: the range says so.
TEST(AddOrders, TheOneAsWrittenMayBeTheOneThatFails) {
    CaseRow row;
    row.outcome = Outcome::NonFinite;
    row.verdict = results::Verdict::NonFinite;
    EXPECT_TRUE(isRunInOrders(row));
    addOrders(row, {{1, graded(Grade::B, {metric("a", 2.0)}), ""}});
    EXPECT_EQ(row.orders.run, 2);
    EXPECT_EQ(row.orders.completed, 1);
    EXPECT_EQ(row.orders.best, Grade::B);
    EXPECT_EQ(row.orders.worst, Grade::E);
    EXPECT_EQ(row.orders.note, "order 2: completes");
    EXPECT_EQ(row.accuracy.grade, Grade::None) << "of the order as written";
    EXPECT_EQ(row.orders.verdicts, "pass 1, non-finite 1");
    EXPECT_EQ(row.orders.failed, 1);
    EXPECT_EQ(row.orders.dependence, OrderDependence::Verdict);
    ASSERT_EQ(row.metrics.size(), 1u) << "the range of the orders that completed";
    EXPECT_TRUE(std::isnan(row.metrics[0].value));
    EXPECT_EQ(row.metrics[0].orderMin, 2.0);
    EXPECT_EQ(row.metrics[0].orderMax, 2.0);
    EXPECT_EQ(row.metrics[0].orderCount, 1);
    EXPECT_EQ(row.metrics[0].note, "the order as written: non_finite");
    row.outcome = Outcome::Unsupported;
    EXPECT_FALSE(isRunInOrders(row));
}

TEST(AddOrders, AnOrderThatMissesABoundIsReported) {
    const auto bounded = [](double value) {
        MetricRow m = metric("a", value);
        m.bound = 1.0;
        m.verdict = value <= 1.0 ? results::Verdict::Pass : results::Verdict::Fail;
        return m;
    };
    const auto judged = [&](double value) {
        CaseRow row = graded(Grade::B, {bounded(value)});
        row.verdict = row.metrics[0].verdict;
        return row;
    };
    CaseRow row = judged(0.5);
    addOrders(row, {{1, judged(0.6), ""}, {2, judged(2.0), ""}});
    EXPECT_EQ(row.orders.note, "order 3: fails a (2, bound 1)");
    EXPECT_EQ(row.orders.verdicts, "pass 2, fail 1");
    EXPECT_EQ(row.orders.failed, 1);
    EXPECT_EQ(row.orders.dependence, OrderDependence::Verdict);
    EXPECT_EQ(row.verdict, results::Verdict::Pass) << "of the order as written";
    CaseRow alike = judged(3.0);
    addOrders(alike, {{1, judged(2.0), ""}});
    EXPECT_EQ(alike.orders.note, "") << "the order as written fails it too";
    EXPECT_EQ(alike.orders.verdicts, "fail 2");
    EXPECT_EQ(alike.orders.failed, 2);
    EXPECT_EQ(alike.orders.dependence, OrderDependence::Value);
    CaseRow better = judged(3.0);
    addOrders(better, {{1, judged(0.5), ""}});
    EXPECT_EQ(better.orders.note, "order 2: pass");
    EXPECT_EQ(better.orders.dependence, OrderDependence::Verdict);
}

/// An event that does not happen in the order as written has the range of those in which it does.
TEST(AddOrders, AMetricThatOthersAloneHaveIsShownWithoutAValue) {
    CaseRow row = graded(Grade::C, {metric("a", 1.0)});
    addOrders(row, {{1, graded(Grade::C, {metric("a", 1.0), metric("event", 4.0)}), ""},
                    {2, graded(Grade::C, {metric("a", 1.0), metric("event", 7.0)}), ""}});
    ASSERT_EQ(row.metrics.size(), 2u);
    EXPECT_TRUE(std::isnan(row.metrics[1].value));
    EXPECT_EQ(row.metrics[1].note, "no value in the order as written");
    EXPECT_EQ(row.metrics[1].orderMin, 4.0);
    EXPECT_EQ(row.metrics[1].orderMax, 7.0);
    EXPECT_EQ(row.metrics[1].orderCount, 2);
    EXPECT_EQ(row.orders.dependence, OrderDependence::Value);
}

TEST(AddOrders, GradesThatDifferAreTheDependence) {
    CaseRow row = graded(Grade::C, {metric("a", 1.0)});
    addOrders(row, {{1, graded(Grade::D, {metric("a", 1.5)}), ""}});
    EXPECT_EQ(row.orders.dependence, OrderDependence::Grade);
    CaseRow same = graded(Grade::C, {metric("a", 1.0)});
    addOrders(same, {{1, graded(Grade::C, {metric("a", 1.0)}), ""}});
    EXPECT_EQ(same.orders.dependence, OrderDependence::None);
}

TEST(AddOrders, WithoutAGradeThereIsNone) {
    CaseRow row = graded(Grade::None, {metric("a", 2.0)});
    CaseRow crashed;
    crashed.outcome = Outcome::Crashed;
    addOrders(row, {{1, crashed, ""}});
    EXPECT_EQ(row.orders.worst, Grade::None);
    EXPECT_EQ(row.orders.completed, 1);
}

}  // namespace
}  // namespace rigor::validation
