// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints, solvers, refusals.
#include <cmath>
#include <limits>

#include "adapters/bullet/tests/joints.hpp"
#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

/// Largest distance of the two anchors over a run, both bodies moving.
double worstGap(Simulation& run, const Joint& j, int steps) {
    double worst = 0.0;
    for (int i = 0; i < steps; ++i) {
        run.steps(1);
        const auto b = run.state(j.bodyB);
        const Vec3 onB = b.position + rotate(b.orientation, j.anchorB);
        Vec3 onA = j.anchorA;
        if (j.bodyA != scenario::kNone) {
            const auto a = run.state(j.bodyA);
            onA = a.position + rotate(a.orientation, j.anchorA);
        }
        worst = std::max(worst, norm(onA - onB));
    }
    return worst;
}

/// A hanging body with its centre of mass off its frame and a full tensor: anchors go through that frame.
int addOffsetBody(Scenario& s, Vec3 position) {
    const int body = addBody(s, Box{{0.1, 0.1, 0.1}}, position, 2.0);
    auto& properties = s.bodies[body].massProperties;
    const Mat3 turn = toMatrix(normalized(Quat{0.8, 0.1, 0.5, -0.3}));
    properties.inertia = turn * Mat3::diagonal(0.04, 0.05, 0.06) * transpose(turn);
    properties.centerOfMass = {0.05, -0.1, 0.02};
    return body;
}

TEST(BulletJoints, BallAndHingeHoldTheirAnchors) {
    for (const auto type : {JointType::Ball, JointType::Hinge}) {
        Scenario s = scene();
        const int a = addOffsetBody(s, {1, 0, 0});
        const int b = addOffsetBody(s, {2, 0, 0});
        s.joints.push_back(joint(type, scenario::kNone, a, {0, 0, 0}, {-1, 0, 0}));
        s.joints.push_back(joint(type, a, b, {0.5, 0, 0}, {-0.5, 0, 0}));
        for (const auto& j : s.joints) {
            Simulation run(s, 1.0 / 480);
            EXPECT_LT(worstGap(run, j, 480), 5e-3) << jointName(type);
        }
        Simulation run(s, 1.0 / 480);
        run.seconds(0.5);
        EXPECT_LT(run.state(b).position.y, -0.5);  // it swings
    }
}

TEST(BulletJoints, HingeAxisStaysWhereItIs) {
    Scenario s = scene();
    const int a = addOffsetBody(s, {0.5, 0, 0});
    const Vec3 axis{0, 0.6, 0.8};
    s.joints.push_back(joint(JointType::Hinge, scenario::kNone, a, {}, {-0.5, 0, 0}, axis));
    Simulation run(s, 1.0 / 480);
    run.seconds(0.7);
    const auto state = run.state(a);
    EXPECT_NEAR(norm(rotate(state.orientation, axis) - axis), 0.0, 2e-3);
    EXPECT_GT(std::abs(2 * std::acos(std::min(1.0, std::abs(state.orientation.w)))), 0.3);  // it turned
}

TEST(BulletJoints, SliderMovesAlongItsAxisOnly) {
    Scenario s = scene();
    const int a = addOffsetBody(s, {0, 0, 0});
    const Vec3 axis = Vec3{0.6, -0.8, 0};
    s.joints.push_back(joint(JointType::Slider, scenario::kNone, a, {}, {}, axis));
    Simulation run(s, 1.0 / 480);
    run.seconds(0.5);
    const auto state = run.state(a);
    const double along = dot(state.position, axis);
    EXPECT_NEAR(along, 0.5 * 9.81 * 0.8 * 0.25, 0.02);
    EXPECT_NEAR(norm(state.position - along * axis), 0.0, 2e-3);
    EXPECT_NEAR(std::abs(state.orientation.w), 1.0, 1e-4);
}

TEST(BulletJoints, FixedHoldsACantilever) {
    Scenario s = scene();
    const int a = addOffsetBody(s, {1, 0, 0});
    s.bodies[0].pose.orientation = scenario::fromAxisAngle({0, 1, 0}, 0.7);
    Joint j = joint(JointType::Fixed, scenario::kNone, a, {0, 0, 0}, {});
    j.anchorB = rotateInverse(s.bodies[0].pose.orientation, Vec3{-1, 0, 0});
    s.joints.push_back(j);
    Simulation run(s, 1.0 / 240);
    run.seconds(1);
    EXPECT_NEAR(norm(run.state(a).position - Vec3{1, 0, 0}), 0.0, 1e-3);
    const Quat d = conjugate(s.bodies[0].pose.orientation) * run.state(a).orientation;
    EXPECT_NEAR(std::abs(d.w), 1.0, 1e-6);
}

TEST(BulletJoints, HalfPeriodOfAPhysicalPendulum) {
    // Small swing about a pivot 1 m from the centre of mass: T = 2 pi sqrt(I / (m g l)).
    Scenario s = scene();
    const int a = addBody(s, Sphere{0.1}, {0, -1, 0}, 2.0, even(0.5));
    s.bodies[0].collides = false;
    s.bodies[0].angularVelocity = {0, 0, 0.05};
    s.bodies[0].velocity = {0.05, 0, 0};
    s.joints.push_back(joint(JointType::Hinge, scenario::kNone, a, {}, {0, 1, 0}));
    const double half = M_PI * std::sqrt((0.5 + 2.0) / (2.0 * 9.81));
    const double dt = half / 1000;
    Simulation run(s, dt);
    run.steps(1000);
    EXPECT_NEAR(run.state(a).angularVelocity.z, -0.05, 5e-4);
    EXPECT_NEAR(run.state(a).position.x, 0.0, 5e-4);
}

/// The connected bodies overlap: they may collide or not, as the joint says.
TEST(BulletJoints, ConnectedBodiesCollideOnlyIfRequested) {
    for (const bool collide : {false, true}) {
        Scenario s = scene();
        s.gravity = {};
        addBody(s, Sphere{0.5}, {0, 0, 0});
        addBody(s, Sphere{0.5}, {0.8, 0, 0});
        s.joints.push_back(joint(JointType::Ball, 0, 1, {0.4, 0, 0}, {-0.4, 0, 0}));
        s.joints[0].collideConnected = collide;
        Simulation run(s, 1.0 / 240);
        run.steps(2);
        EXPECT_EQ(run.contacts().empty(), !collide);
    }
}

TEST(BulletJoints, PlanarHingeSwingsInThePlane) {
    Scenario s = scene(0, 0, 2);
    const int a = addBody(s, Box{{0.1, 0.1, 0}}, {1, 0, 0}, 1.0, even(0.02));
    s.joints.push_back(joint(JointType::Hinge, scenario::kNone, a, {}, {-1, 0, 0}));
    Simulation run(s, 1.0 / 480);
    EXPECT_LT(worstGap(run, s.joints[0], 480), 5e-3);
    EXPECT_EQ(run.state(a).position.z, 0.0);
}

class BulletSolvers : public testing::TestWithParam<const char*> {};

/// Every solver carries a small tower (Lemke is left out: it is known to diverge on towers).
TEST_P(BulletSolvers, CarriesATower) {
    Scenario s = scene(0.5, 0.0);
    addStatic(s, HalfSpace{{0, 1, 0}, 0.0});
    for (int i = 0; i < 3; ++i) addBody(s, Box{{0.5, 0.5, 0.5}}, {0, 0.5 + i, 0}, 1.0, even(1.0 / 6));
    Simulation run(s, 1.0 / 240, std::string("preset=matched,solver=") + GetParam());
    run.seconds(1);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(run.state(1 + i).position.y, 0.5 + i, 1e-3);
        EXPECT_NEAR(run.state(1 + i).position.x, 0.0, 1e-3);
    }
    EXPECT_NE(run.ledgerLine("solver")->resolved.find(GetParam()), std::string::npos);
}
INSTANTIATE_TEST_SUITE_P(Names, BulletSolvers, testing::Values("si", "nncg", "mlcp_dantzig", "mlcp_pgs"),
                         [](const auto& test) { return std::string(test.param); });

TEST(BulletSolver, IterationsAreBulletsOwn) {
    Scenario s = scene(0.5, 0.0);
    addStatic(s, HalfSpace{{0, 1, 0}, 0.0});
    addBody(s, Box{{0.5, 0.5, 0.5}}, {0, 0.5, 0}, 1.0, even(1.0 / 6));
    for (const int n : {7, 40}) {
        Simulation run(s, 1.0 / 240, "preset=matched,iterations=" + std::to_string(n));
        run.steps(1);
        EXPECT_EQ(run.world->counters().solverIterations, n);
        EXPECT_EQ(run.world->counters().contacts, 4);
        EXPECT_EQ(run.world->counters().pairs, 1);
    }
}

TEST(BulletRefuses, WhatItDoesNotHaveAndWhatIsNotANumber) {
    const auto build = [](const Scenario& s, double dt = 1.0 / 60) { Simulation run(s, dt); };
    Scenario distance = scene();
    addBody(distance, Sphere{0.1}, {0, -1, 0});
    distance.joints.push_back(joint(JointType::Distance, scenario::kNone, 0, {}, {}));
    distance.joints[0].length = 1.0;
    EXPECT_THROW(build(distance), adapter::Unsupported);

    Scenario good = scene();
    addBody(good, Sphere{0.1}, {});
    EXPECT_NO_THROW(build(good));
    Scenario nan = good;
    nan.bodies[0].velocity.y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(build(nan), adapter::BadInput);
    Scenario massless = good;
    massless.bodies[0].massProperties.mass = 0.0;
    EXPECT_THROW(build(massless), adapter::BadInput);
    EXPECT_THROW(build(good, 0.0), adapter::BadInput);
}

}  // namespace
}  // namespace rigor::test
