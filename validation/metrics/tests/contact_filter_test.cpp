// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// No metric blames an engine for a contact that layers or groups do not allow: shapes that overlap, bodies that
// pass through a surface, energy that contacts would take.
#include <gtest/gtest.h>

#include "validation/metrics/metric.hpp"
#include "validation/references/tests/scene.hpp"

namespace rigor::validation::testing {
namespace {

/// A body with two balls, 0.3 m left and right of it, 0.1 m deep in a half-space.
struct Sunk {
    Scenario scenario = emptyScene(3, {0, -10, 0}, 1);
    Trajectory run;
    Sunk() {
        addBody(scenario, "floor", BodyType::Static, HalfSpace{{0, 1, 0}, 0.0}, {});
        addBall(scenario, "pair", 0.2, 1, 0.4, {0, 0.1, 0});
        auto& shapes = scenario.bodies[1].shapes;
        shapes.push_back(shapes[0]);
        shapes[0].pose.position = {-0.3, 0, 0};
        shapes[1].pose.position = {0.3, 0.05, 0};
        run.bodyCount = 2;
        for (int k = 0; k < 3; ++k) {
            run.times.push_back(0.1 * k);
            BodyState pair;
            pair.position = {0, 0.1, 0};
            run.states.insert(run.states.end(), {BodyState{}, pair});
        }
    }
    std::vector<MetricValue> rows(const char* metric) const {
        return findMetric(metric)->evaluate({scenario, run, nullptr, adapter::Scheme::Unknown});
    }
    ContactFilter& filter(std::size_t shape) { return scenario.bodies[1].shapes[shape].filter; }
};

TEST(FilteredContacts, AreNoOverlap) {
    Sunk sunk;
    EXPECT_NEAR(sunk.rows("overlap_max")[0].value, 0.1, 1e-15);
    sunk.filter(0) = {2, 2, 0};
    EXPECT_NEAR(sunk.rows("overlap_max")[0].value, 0.05, 1e-15) << "the other ball";
    sunk.filter(1).group = sunk.scenario.bodies[0].shapes[0].filter.group = -4;
    EXPECT_TRUE(sunk.rows("overlap_max").empty());
    EXPECT_TRUE(sunk.rows("penetration_max").empty()) << "no contact is possible";
}

TEST(FilteredContacts, TakeNoEnergy) {
    Sunk sunk;
    // The run stays where it is: nothing is gained or lost.
    EXPECT_TRUE(sunk.rows("energy_drift").empty()) << "friction and impacts may take some";
    for (const std::size_t i : {0U, 1U}) sunk.filter(i) = {2, 2, 0};
    ASSERT_FALSE(sunk.rows("energy_drift").empty());
    EXPECT_EQ(sunk.rows("energy_drift")[0].value, 0);
}

TEST(FilteredContacts, LetBodiesThrough) {
    Scenario s = emptyScene(2, {0, -10, 0}, 1);
    addBody(s, "floor", BodyType::Static, Chain{{{-1, 0, 0}, {1, 0, 0}}, false}, {});
    addBall(s, "goes", 0.1, 1, 0.4, {0, 1, 0});
    Trajectory run;
    run.bodyCount = 2;
    for (int k = 0; k < 3; ++k) {
        run.times.push_back(0.1 * k);
        BodyState goes;
        goes.position = {0.2, 1.0 - k, 0};
        run.states.insert(run.states.end(), {BodyState{}, goes});
    }
    const auto count = [&] {
        return findMetric("bodies_through")->evaluate({s, run, nullptr, adapter::Scheme::Unknown})[0].value;
    };
    EXPECT_EQ(count(), 1);
    s.bodies[1].shapes[0].filter.collidesWith = 2;
    EXPECT_EQ(count(), 0);
    s.bodies[1].shapes.push_back({Sphere{0.05}, {}, 0});
    EXPECT_EQ(count(), 0) << "its middle is that of a shape that may pass";
}

}  // namespace
}  // namespace rigor::validation::testing
