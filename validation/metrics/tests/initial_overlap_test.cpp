// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shapes that stick out of the scenario's are seen by the contacts of the first step, and by those alone.
#include <gtest/gtest.h>

#include "validation/metrics/metric.hpp"
#include "validation/references/tests/scene.hpp"

namespace rigor::validation::testing {
namespace {

/// A turned hull, 5 mm deep in a box, on a floor that it does not touch; three frames.
struct Scene {
    Scenario scenario;
    Trajectory run;
    Vec3 normal;

    Scene() {
        scenario = emptyScene(3, {0, -10, 0}, 1);
        addFloor(scenario);
        addBox(scenario, "box", {0.5, 0.5, 0.5}, 2, {0, 0.5, 0});
        addBox(scenario, "hull", {0.25, 0.25, 0.25}, 1, {0, 1.245, 0});
        scenario.bodies[2].shapes[0].geometry =
            ConvexHull{{{-0.25, -0.25, -0.25}, {0.25, -0.25, -0.25}, {0, -0.25, 0.25}, {0, 0.25, 0}}};
        const Quat turn = fromAxisAngle({0, 0, 1}, 0.3);
        normal = rotate(turn, {0, 1, 0});
        for (Body& body : scenario.bodies) body.pose = Pose{{}, turn} * body.pose;
        run.dt = 0.01;
        run.bodyCount = 3;
        run.contacts.resize(3);
        for (int k = 0; k < 3; ++k) {
            run.times.push_back(0.01 * k);
            for (const Body& body : scenario.bodies)
                run.states.push_back({body.pose.position, body.pose.orientation, {}, {}});
        }
        run.contacts[1] = {contact(1, 2, 0.2)};
    }
    ContactPoint contact(int a, int b, double depth) const {
        ContactPoint c;
        c.bodyA = a;
        c.bodyB = b;
        c.normal = normal;
        c.depth = depth;
        return c;
    }
    std::vector<MetricValue> rows() const {
        return findMetric("initial_overlap")->evaluate({scenario, run, nullptr, adapter::Scheme::Unknown});
    }
};

TEST(InitialOverlap, IsWhatThePosesDoNotHave) {
    Scene s;
    s.run.contacts[0] = {s.contact(1, 2, 0.005), s.contact(1, 2, 0.045), s.contact(0, 1, 0.0)};
    const auto rows = s.rows();
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0].subject, "");
    EXPECT_NEAR(rows[0].value, 0.04, 1e-12);
    EXPECT_EQ(rows[0].at, 0.0);
    EXPECT_EQ(rows[1].subject, "box");
    EXPECT_NEAR(rows[2].value, 0.04, 1e-12);
}

/// A contact found though the shapes are apart, and one that is too shallow, are no overlap.
TEST(InitialOverlap, IsNeverNegative) {
    Scene s;
    s.run.contacts[0] = {s.contact(1, 2, 0.001), s.contact(0, 1, -0.01)};
    ASSERT_FALSE(s.rows().empty());
    EXPECT_EQ(s.rows()[0].value, 0.0);
}

/// The engine's normal of a floor may be rounded to single precision.
TEST(InitialOverlap, ARoundedNormalOfAHalfSpaceIsItsOwn) {
    Scene s;
    ContactPoint c = s.contact(0, 1, 0.02);
    c.normal = c.normal + Vec3{1e-6, -1e-6, 0};
    s.run.contacts[0] = {c};
    EXPECT_NEAR(s.rows().at(0).value, 0.02, 1e-12);
}

TEST(InitialOverlap, ABodyOfSeveralShapesHasTheDeepestOfThem) {
    Scene s;
    s.scenario.bodies[1].shapes.push_back({Box{{0.1, 0.51, 0.1}}, {}, 0});
    s.run.contacts[0] = {s.contact(1, 2, 0.045)};
    EXPECT_NEAR(s.rows().at(0).value, 0.03, 1e-12);
}

TEST(InitialOverlap, DoesNotApplyWithoutContactsOfTheFirstStep) {
    Scene s;
    EXPECT_TRUE(s.rows().empty());
    s.run.contacts[0] = s.run.contacts[1];
    EXPECT_FALSE(s.rows().empty());
    s.scenario.bodies[1].shapes[0].geometry = TriangleMesh{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, {{0, 1, 2}}};
    EXPECT_TRUE(s.rows().empty()) << "no exact depth of a mesh";
}

}  // namespace
}  // namespace rigor::validation::testing
