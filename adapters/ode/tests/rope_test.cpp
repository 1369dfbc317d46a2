// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bounds of a distance: a contact joint along the line of the anchors, which acts in one sense alone.
#include <cmath>

#include "adapters/interface/tests/scenes.hpp"
#include "adapters/ode/tests/free_body.hpp"

namespace rigor::test {
namespace {

using scenario::AxisMode;
using scenario::Pose;

constexpr double kRopeStep = 1.0 / 480.0;

Joint ropeOf(int a, int b, const Vec3& anchorA, const Vec3& anchorB, double lower, double upper) {
    Joint joint;
    joint.name = "rope";
    joint.type = JointType::Distance;
    joint.bodyA = a;
    joint.bodyB = b;
    joint.anchorA = anchorA;
    joint.anchorB = anchorB;
    joint.length = 1.0;
    joint.axes[0].mode = AxisMode::Limited;
    joint.axes[0].lower = lower;
    joint.axes[0].upper = upper;
    return joint;
}

/// Two bodies that whirl about each other, tied beside their centres of mass: as long as the rope is taut it
/// is a rod, whichever end is A, and momentum and angular momentum stay.
TEST(OdeRopes, ATautRopeIsARod) {
    for (const bool turned : {false, true}) {
        Scenario s = scene();
        s.gravity = {};
        const int a = addFree(s, {0, 0, 0}, 1.0, {0.1, 0.2, 0.3}),
                  b = addFree(s, {1.5, 0, 0}, 3.0, even(0.4));
        s.bodies[0].velocity = {0, -3, 0};
        s.bodies[1].velocity = {0, 1, 0};
        s.bodies[0].angularVelocity = {0.3, 0.2, 2.5};
        const Vec3 onA{0.25, 0.1, 0}, onB{-0.25, 0.1, 0};
        Joint rope = turned ? ropeOf(b, a, onB, onA, 0.0, 1.0) : ropeOf(a, b, onA, onB, 0.0, 1.0);
        Scenario rod = s;
        s.joints.push_back(rope);
        rope.axes[0] = {};
        rod.joints.push_back(rope);
        Simulation tied(s, kRopeStep), held(rod, kRopeStep);
        for (int i = 0; i < 480; ++i) {
            tied.steps(1);
            held.steps(1);
            ASSERT_NEAR(norm(tied.state(a).position - held.state(a).position), 0.0, 1e-3) << i;
            ASSERT_NEAR(norm(tied.state(a).velocity + 3.0 * tied.state(b).velocity), 0.0, 1e-11);
        }
        const auto anchor = [&](int body, const Vec3& local) {
            const BodyState state = tied.state(body);
            return Pose{state.position, state.orientation} * local;
        };
        EXPECT_NEAR(norm(anchor(b, onB) - anchor(a, onA)), 1.0, 1e-3);
        EXPECT_NE(tied.ledgerLine("distance_limit"), nullptr);
    }
}

/// The lower bound pushes and does not pull; between the bounds nothing acts.
TEST(OdeRopes, TheLowerBoundPushes) {
    Scenario s = scene(0.0, 0.0, 2);
    s.gravity = {};
    const int b = addFree(s, {0, 1.0, 0}, 2.0, even(0.1));
    s.bodies[0].velocity = {0, -1, 0};
    s.joints.push_back(ropeOf(scenario::kNone, b, {}, {}, 0.4, 1.0));
    Simulation simulation(s, kRopeStep);
    simulation.seconds(0.5);
    EXPECT_NEAR(simulation.state(b).position.y, 0.5, 1e-12) << "free in between";
    const auto press = [&](double force, int steps) {
        for (int i = 0; i < steps; ++i) {
            simulation.world->applyForce(b, {0, force, 0}, {});
            simulation.steps(1);
        }
    };
    press(-2.0, 480);
    EXPECT_NEAR(simulation.state(b).position.y, 0.4, 1e-4);
    press(2.0, 48);
    EXPECT_NEAR(simulation.state(b).velocity.y, 0.1, 1e-3) << "let go at once";
}

/// A spring within bounds: each acts as if alone.
TEST(OdeRopes, ASpringHasBounds) {
    Scenario s = scene();
    s.gravity = {};
    const int b = addFree(s, {1, 0, 0}, 1.0, even(0.1));
    Joint joint = ropeOf(scenario::kNone, b, {}, {}, 0.7, 1.0);
    joint.axes[0].stiffness = 4.0;
    joint.axes[0].target = 0.5;
    s.joints.push_back(joint);
    Simulation simulation(s, kRopeStep);
    simulation.seconds(0.2);
    EXPECT_NEAR(simulation.state(b).position.x, 0.5 + 0.5 * std::cos(0.4), 2e-3);
    simulation.seconds(2.0);
    EXPECT_NEAR(simulation.state(b).position.x, 0.7, 2e-3);
}

/// A hanging weight of 19.62 N, on which a second one pulls for a while.
TEST(OdeRopes, BreakByTheirPull) {
    Scenario s = scene();
    s.gravity = {0, -9.81, 0};
    const int b = addFree(s, {0, -1, 0}, 2.0, even(0.1));
    Joint joint = ropeOf(scenario::kNone, b, {}, {}, 0.0, 1.0);
    joint.breakForce = 25.0;
    s.joints.push_back(joint);
    Simulation simulation(s, kRopeStep);
    for (int i = 0; i < 240; ++i) {
        simulation.world->applyForce(b, {0, i < 120 ? -5.2 : -5.5, 0}, {});
        simulation.steps(1);
        EXPECT_EQ(simulation.world->jointHolds(0), i < 120) << i;
    }
    EXPECT_LT(simulation.state(b).position.y, -1.3);
}

/// The contact joint is made anew in each step: nothing of it is state.
TEST(OdeRopes, SnapshotsOfATautRopeBringTheSameFutureBack) {
    Scenario s = scene();
    s.gravity = {0, -9.81, 0};
    const int b = addFree(s, {0.8, -0.6, 0}, 2.0, even(0.1));
    s.joints.push_back(ropeOf(scenario::kNone, b, {}, {0.05, 0.02, 0.01}, 0.0, 1.0));
    Simulation simulation(s, kRopeStep);
    simulation.steps(300);
    std::vector<unsigned char> bytes;
    simulation.world->snapshots()->save(bytes);
    const Vec3 first = simulation.steps(200).state(b).position;
    ASSERT_TRUE(simulation.world->snapshots()->restore(bytes));
    EXPECT_EQ(simulation.steps(200).state(b).position, first);
}

}  // namespace
}  // namespace rigor::test
