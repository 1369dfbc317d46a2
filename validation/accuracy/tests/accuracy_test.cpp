// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Made-up runs whose relative errors are known: the metric, its scale and its grade, the ideal run of the
// scheme, and that nothing in a scale depends on the run.
#include "validation/accuracy/accuracy.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "scenarios/loader/loader.hpp"
#include "validation/references/tests/scene.hpp"

namespace rigor::validation::testing {
namespace {

using results::Grade;
using results::MetricRow;

constexpr double kDt = 0.01;
constexpr int kLast = 100;
const Vec3 kVelocity{3, 4, 0};

/// Balls that fly straight for a second, 5 m; the scheme's ideal run is late by the fraction `late` of the
/// way.
class Glide : public Reference {
  public:
    explicit Glide(const Scenario& scenario, double late) : scenario_(scenario), late_(late) {}
    std::vector<int> bodies() const override { return {0}; }
    PartialState exact(int body, double t) const override {
        return {scenario_.bodies[body].pose.position + t * kVelocity, fromAxisAngle({0, 0, 1}, turn * t),
                kVelocity, Vec3{0, 0, turn}};
    }
    std::optional<PartialState> schemeExact(int body, std::size_t step, double dt,
                                            adapter::Scheme) const override {
        if (late_ < 0.0) return std::nullopt;
        PartialState s = exact(body, step * dt);
        s.position = *s.position - late_ * step * dt * kVelocity;
        return s;
    }
    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        Quantity end{"end", "s", 0.5, 0.5 * (1.0 + late_), 0.0, {}};
        end.measure = [this](const Trajectory&) { return std::optional<double>(0.5 + lateEvent); };
        return {end};
    }
    double turn = 0.0, lateEvent = 0.0;

  private:
    const Scenario& scenario_;
    double late_;
};

struct Flight {
    explicit Flight(double late = -1.0) {
        scenario = emptyScene(3, {}, 1);
        addBall(scenario, "ball", 0.1, 2, 0.4, {}, kVelocity);
        scenario.metrics = {"position_final", "velocity_final"};
        reference = std::make_unique<Glide>(scenario, late);
        run = exactRun(scenario, *reference, kDt, kLast);
    }
    MetricInput input() const { return {scenario, run, reference.get(), adapter::Scheme::SymplecticEuler}; }
    BodyState& last() { return run.states[kLast * run.bodyCount]; }
    std::vector<MetricRow> rows(const std::string& metric) const {
        std::vector<MetricRow> rows;
        const MetricInput in = input();
        for (const auto& value : findMetric(metric)->evaluate(in)) {
            MetricRow& row = rows.emplace_back();
            row.name = metric;
            row.subject = value.subject;
            row.value = value.value;
        }
        RelativeErrors(in).fill(*findMetric(metric), rows);
        return rows;
    }
    results::AccuracyRow accuracy() const {
        std::vector<MetricRow> all;
        for (const auto& name : scenario.metrics)
            for (const auto& row : rows(name)) all.push_back(row);
        const MetricInput in = input();
        return RelativeErrors(in).accuracyOf(all);
    }
    Scenario scenario;
    std::unique_ptr<Glide> reference;
    Trajectory run;
};

TEST(RelativeError, OfAPositionIsOverTheWayGone) {
    Flight flight;
    flight.last().position.z += 0.05;  // the fall is 5 m
    const auto rows = flight.rows("position_final");
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_NEAR(*rows[0].relative, 0.01, 1e-12);
    EXPECT_NEAR(*rows[0].scale, 5.0, 1e-12);
    EXPECT_NEAR(*rows[1].relative, 0.01, 1e-12);
}

TEST(RelativeError, EveryGradeIsMetByAnErrorOfItsSize) {
    struct Row {
        double share;
        Grade grade;
    };
    for (const Row& r :
         {Row{0.0, Grade::A}, Row{0.9e-6, Grade::A}, Row{1.1e-6, Grade::B}, Row{0.9e-4, Grade::B},
          Row{1.1e-4, Grade::C}, Row{0.9e-2, Grade::C}, Row{1.1e-2, Grade::D}, Row{0.09, Grade::D},
          Row{0.11, Grade::E}, Row{1.0, Grade::E}}) {
        Flight flight;
        flight.last().position.y += 5.0 * r.share;
        const auto accuracy = flight.accuracy();
        EXPECT_EQ(accuracy.grade, r.grade) << r.share;
        EXPECT_NEAR(*accuracy.relative, r.share, 1e-12);
    }
}

TEST(RelativeError, TheWorstOfTheNamedMetricsDecides) {
    Flight flight;
    flight.last().position.y += 5.0 * 1e-3;
    flight.last().velocity.y += 5.0 * 2e-3;
    flight.last().angularVelocity.y = 100.0;  // spin_final is not named
    EXPECT_EQ(flight.accuracy().metric, "velocity_final");
    EXPECT_NEAR(*flight.accuracy().relative, 2e-3, 1e-12);
    EXPECT_EQ(flight.accuracy().grade, Grade::C);
}

TEST(RelativeError, WhatDoesNotMoveIsMeasuredByItsSize) {
    Flight flight;
    flight.scenario.gravity = {0, -10, 0};
    flight.scenario.metrics = {"rest_motion"};
    class Still : public Reference {
        std::vector<int> bodies() const override { return {0}; }
        PartialState exact(int, double) const override { return {Vec3{}, Quat{}, Vec3{}, Vec3{}}; }
    } still;
    flight.scenario.bodies[0].velocity = {};
    const auto scales = sceneScales(flight.scenario, &still);
    EXPECT_DOUBLE_EQ(*scales.distance, 0.2) << "the ball's width";
    EXPECT_DOUBLE_EQ(*scales.speed, 2.0) << "sqrt(2 g w)";
    EXPECT_DOUBLE_EQ(*scales.spin, 10.0);
    EXPECT_DOUBLE_EQ(*scales.angle, 1.0);
    EXPECT_DOUBLE_EQ(*scales.energy, 2.0) << "m g r";
}

TEST(RelativeError, AnAttitudeThatIsLostIsNotNearForHavingTurnedOften) {
    Flight flight;
    flight.reference->turn = 100.0;
    EXPECT_NEAR(*sceneScales(flight.scenario, flight.reference.get()).angle, std::numbers::pi, 0.1);
    flight.reference->turn = 0.5;
    EXPECT_NEAR(*sceneScales(flight.scenario, flight.reference.get()).angle, 0.5, 1e-12);
}

TEST(RelativeError, AnEventsTimeIsOverTheTimeToIt) {
    Flight flight;
    flight.reference->lateEvent = 0.005;
    const auto rows = flight.rows("event_time_error");
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_NEAR(*rows[0].relative, 0.01, 1e-12);
    EXPECT_DOUBLE_EQ(*rows[0].scale, 0.5);
}

TEST(RelativeError, EnergiesAreOverTheLargestKineticEnergy) {
    Flight flight;
    flight.scenario.metrics = {"energy_drift"};
    flight.last().velocity = std::sqrt(1.02) * kVelocity;
    EXPECT_NEAR(*flight.rows("energy_drift")[0].relative, 0.02, 1e-12);
    EXPECT_DOUBLE_EQ(*sceneScales(flight.scenario, flight.reference.get()).energy, 25.0);
}

TEST(RelativeError, ScalesDoNotDependOnTheRun) {
    Flight good, wild;
    for (std::size_t k = 1; k < wild.run.states.size(); ++k)  // the first is the scenario's own
    {
        wild.run.states[k].position.x += 1e3;
        wild.run.states[k].velocity.y *= 1e3;
    }
    for (const char* metric : {"position_final", "velocity_final", "energy_drift"})
        EXPECT_EQ(good.rows(metric)[0].scale.value(), wild.rows(metric)[0].scale.value()) << metric;
}

TEST(IdealRun, HasTheErrorOfItsScheme) {
    Flight flight(0.02);
    flight.last().position.z += 0.05;
    const auto row = flight.rows("position_final")[0];
    EXPECT_NEAR(*row.relative, 0.01, 1e-12);
    ASSERT_TRUE(row.ideal);
    EXPECT_NEAR(*row.ideal, 0.02, 1e-12) << "0.02 of the way late";
    EXPECT_NEAR(*flight.rows("velocity_final")[0].ideal, 0.0, 1e-15);
    EXPECT_FALSE(flight.rows("orientation_final")[0].ideal) << "not named by the scenario";
    flight.scenario.metrics = {"event_time_error"};
    EXPECT_NEAR(*flight.rows("event_time_error")[0].ideal, 0.02, 1e-12);
    Flight unknown;
    EXPECT_FALSE(unknown.rows("position_final")[0].ideal) << "no closed form of this scheme";
}

TEST(NoGrade, WithoutAnExactAnswerAndAgainstARecording) {
    Flight flight;
    EXPECT_EQ(whyNotGraded(flight.scenario, nullptr), "no exact solution");
    class Filmed : public Reference {
        std::vector<int> bodies() const override { return {0}; }
        std::optional<PartialState> measured(int, double) const override { return PartialState{}; }
    } filmed;
    EXPECT_THAT(whyNotGraded(flight.scenario, &filmed), ::testing::HasSubstr("recording"));
    MetricInput input = flight.input();
    input.reference = nullptr;
    const RelativeErrors none(input);
    EXPECT_EQ(none.accuracyOf({}).grade, Grade::None);
    EXPECT_EQ(none.accuracyOf({}).note, "no exact solution");
}

/// A metric that a scenario names is graded, unless it compares with no exact solution at all.
TEST(Table, EveryMetricOfTheTableExistsAndTheLibrarysAreInIt) {
    for (const auto& entry : scaleTable()) EXPECT_NE(findMetric(entry.metric), nullptr) << entry.metric;
    for (const auto& listed : scenario::listScenarios()) {
        const Scenario s = scenario::loadScenario(listed.file).scenario;
        for (const auto& name : s.metrics) {
            const MetricEntry* metric = findMetric(name);
            ASSERT_NE(metric, nullptr) << name;
            const bool isGraded = metric->kind != MetricKind::SchemeExact &&
                                  metric->kind != MetricKind::Measured && metric->kind != MetricKind::Outcome;
            EXPECT_EQ(findScale(name) != nullptr, isGraded) << s.name << " " << name;
        }
    }
}

}  // namespace
}  // namespace rigor::validation::testing
