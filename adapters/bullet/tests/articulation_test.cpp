// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// articulation=multibody: btMultiBody against closed forms and integrated equations, and what its defaults
// do.
#include <cmath>
#include <numbers>

#include "adapters/bullet/tests/joints.hpp"
#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

const std::string kMatched = "preset=matched,articulation=multibody";

/// A rod of length 1 on a hinge at its end, let go level; angle below the level after `t` by fine RK4.
Scenario rodOnAHinge(bool turned = false) {
    Scenario s = scene();
    const int rod = addBody(s, Box{{0.5, 0.01, 0.01}}, {0.5, 0, 0}, 1.0, {0.001, 1.0 / 12, 1.0 / 12});
    Body post;
    post.name = "post";
    post.type = BodyType::Static;
    s.bodies.push_back(post);
    s.joints.push_back(turned ? joint(JointType::Hinge, rod, 1, {-0.5, 0, 0}, {})
                              : joint(JointType::Hinge, 1, rod, {}, {-0.5, 0, 0}));
    return s;
}
double rodAngle(double t) {
    double q = 0.0, w = 0.0;
    const int steps = 20000;
    const double h = t / steps;
    const auto rate = [](double angle) { return -1.5 * 9.81 * std::cos(angle); };
    for (int i = 0; i < steps; ++i) {
        const double w1 = w, a1 = rate(q), w2 = w + h / 2 * a1, a2 = rate(q + h / 2 * w1);
        const double w3 = w + h / 2 * a2, a3 = rate(q + h / 2 * w2), w4 = w + h * a3, a4 = rate(q + h * w3);
        q += h / 6 * (w1 + 2 * w2 + 2 * w3 + w4);
        w += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    return q;
}
double foundAngle(const BodyState& state) {
    return std::atan2(state.position.y, state.position.x);
}

TEST(BulletArticulation, APendulumIsOfFirstOrderAndItsJointExact) {
    double before = 0.0;
    for (const double dt : {1.0 / 60, 1.0 / 240}) {
        Simulation run(rodOnAHinge(), dt, kMatched);
        run.seconds(0.6);
        const BodyState state = run.state(0);
        const Vec3 onRod = state.position + rotate(state.orientation, Vec3{-0.5, 0, 0});
        EXPECT_LT(norm(onRod), tol(1e-12, 1e-5));
        const double error = std::abs(foundAngle(state) - rodAngle(0.6));
        EXPECT_LT(error, 5.0 * dt);
        if (before > 0.0) {
            EXPECT_NEAR(before / error, 4.0, 0.8);
        }
        before = error;
    }
}

/// useRK4Integration with a fixed base is of fourth order: poses read by forwardKinematics, since the cached
/// ones are those of the start of the step.
TEST(BulletArticulation, RungeKuttaOnAFixedBaseIsExactToFiveDigits) {
    Simulation run(rodOnAHinge(), 1.0 / 60, kMatched + ",multibody_integrator=rk4");
    run.seconds(0.6);
    EXPECT_NEAR(foundAngle(run.state(0)), rodAngle(0.6), tol(1e-5, 1e-4));
}

TEST(BulletArticulation, AJointRunsBackwardsWhereItsFirstBodyIsTheChild) {
    for (const bool turned : {false, true}) {
        Scenario s = rodOnAHinge(turned);
        s.gravity = {};
        auto& axis = s.joints[0].axes[0];
        axis.motorSpeed = 2.0;
        axis.motorMaxForce = 0.1;
        Simulation motor(s, 1.0 / 240, kMatched);
        motor.seconds(1);
        const double sign = turned ? -1.0 : 1.0;  // the motor turns the rod relative to the post
        EXPECT_NEAR(motor.state(0).angularVelocity.z, sign * 0.3, tol(1e-6, 1e-4));
        axis.motorMaxForce = 0.0;
        axis.mode = scenario::AxisMode::Limited;
        axis.lower = -0.2;
        axis.upper = 0.6;
        s.bodies[0].angularVelocity = {0, 0, 2};
        s.bodies[0].velocity = {0, 1, 0};
        Simulation stop(s, 1.0 / 240, kMatched);
        double most = 0.0;
        for (int i = 0; i < 240; ++i) most = std::max(most, foundAngle(stop.steps(1).state(0)));
        EXPECT_NEAR(most, turned ? 0.2 : 0.6, 0.02);
    }
}

TEST(BulletArticulation, DampingByDefaultTakesFromEveryMotion) {
    const auto height = [](const std::string& options) {
        Simulation run(rodOnAHinge(), 1.0 / 240, options);
        double highest = -1.0;
        for (int i = 0; i < 480; ++i) {
            run.steps(1);
            if (i > 240) highest = std::max(highest, run.state(0).position.y);
        }
        return highest;  // height in the second half period, which ideally ends at the level of the start
    };
    EXPECT_GT(height(kMatched), -0.02);
    EXPECT_LT(height("preset=default,articulation=multibody"), -0.05);
}

/// Spherical joint, unequal moments, all three velocities: the first order of the explicit scheme, and no
/// more without the gyroscopic term.
TEST(BulletArticulation, ASphericalJointTakesItsVelocityInTheLinksFrame) {
    Scenario s = scene();
    const int b = addBody(s, Box{{0.1, 0.1, 0.1}}, {0.1, -0.2, 0.2}, 1.0, {0.01, 0.02, 0.03});
    const Vec3 turn{0.3, 1.0, 0.2};
    s.bodies[0].pose.orientation = normalized(Quat{0.9, 0.1, 0.4, -0.2});
    s.bodies[0].angularVelocity = turn;
    s.bodies[0].velocity = cross(turn, s.bodies[0].pose.position);
    const Vec3 arm = rotateInverse(s.bodies[0].pose.orientation, -1.0 * s.bodies[0].pose.position);
    s.joints.push_back(joint(JointType::Ball, scenario::kNone, b, {}, arm));
    const auto at = [&](double dt, const std::string& more) {
        Simulation run(s, dt, kMatched + more);
        EXPECT_NEAR(norm(run.state(b).angularVelocity - turn), 0.0, tol(1e-12, 1e-5));
        EXPECT_NEAR(norm(run.state(b).velocity - s.bodies[0].velocity), 0.0, tol(1e-12, 1e-5));
        run.seconds(1);
        return run.state(b).position;
    };
    const Vec3 fine = at(1.0 / 7680, "");
    EXPECT_NEAR(norm(at(1.0 / 120, "") - fine) / norm(at(1.0 / 480, "") - fine), 4.0, 1.0);
    EXPECT_GT(norm(at(1.0 / 1920, ",gyroscopic=none") - fine), 20 * norm(at(1.0 / 1920, "") - fine));
}

/// A square of four bars: the fourth hinge closes the loop by two points of its axis.
TEST(BulletArticulation, ALoopStaysClosed) {
    Scenario s = scene();
    const Vec3 moments{0.01, 0.09, 0.09};
    const int left = addBody(s, Box{{0.05, 0.5, 0.05}}, {0, 0.5, 0}, 1.0, {0.09, 0.01, 0.09});
    const int top = addBody(s, Box{{0.5, 0.05, 0.05}}, {0.5, 1, 0}, 1.0, moments);
    const int right = addBody(s, Box{{0.05, 0.5, 0.05}}, {1, 0.5, 0}, 1.0, {0.09, 0.01, 0.09});
    s.bodies[0].velocity = s.bodies[2].velocity = {0.5, 0, 0};
    s.bodies[1].velocity = {1, 0, 0};
    s.bodies[0].angularVelocity = s.bodies[2].angularVelocity = {0, 0, -1};
    for (auto& body : s.bodies) body.collides = false;
    s.joints = {joint(JointType::Hinge, scenario::kNone, left, {}, {0, -0.5, 0}),
                joint(JointType::Hinge, left, top, {0, 0.5, 0}, {-0.5, 0, 0}),
                joint(JointType::Hinge, top, right, {0.5, 0, 0}, {0, 0.5, 0}),
                joint(JointType::Hinge, scenario::kNone, right, {1, 0, 0}, {0, -0.5, 0})};
    Simulation run(s, 1.0 / 480, kMatched);
    double gap = 0.0;
    for (int i = 0; i < 480; ++i) {
        run.steps(1);
        const BodyState state = run.state(right);
        const BodyState bar = run.state(top);
        gap =
            std::max(gap, norm(state.position + rotate(state.orientation, Vec3{0, -0.5, 0}) - Vec3{1, 0, 0}));
        gap = std::max(gap, norm(state.position + rotate(state.orientation, Vec3{0, 0.5, 0}) - bar.position -
                                 rotate(bar.orientation, Vec3{0.5, 0, 0})));
    }
    EXPECT_LT(gap, 5e-3);
    EXPECT_LT(run.state(top).position.y, 0.9);  // it moved
    EXPECT_EQ(run.ledgerLine("articulation")->resolved, "btMultiBody, 1 loops closed by constraints");
}

TEST(BulletArticulation, ATreeWithoutTheWorldFliesAsOne) {
    Scenario s = scene();
    const int a = addBody(s, Box{{0.2, 0.1, 0.1}}, {0, 0, 0}, 2.0, {0.1, 0.2, 0.2});
    const int b = addBody(s, Box{{0.2, 0.1, 0.1}}, {1, 0, 0}, 1.0, {0.1, 0.2, 0.2});
    s.bodies[1].angularVelocity = {0, 0, 3};
    s.bodies[1].velocity = {0, 1.5, 0};
    s.joints.push_back(joint(JointType::Hinge, a, b, {0.5, 0, 0}, {-0.5, 0, 0}));
    s.bodies[0].gravityScale = s.bodies[1].gravityScale = 0.5;
    Simulation run(s, 1.0 / 240, kMatched);
    run.seconds(1);
    const BodyState p = run.state(a), q = run.state(b);
    const Vec3 center = (2.0 * p.position + 1.0 * q.position) / 3.0;
    EXPECT_NEAR(center.x, 1.0 / 3, 0.02);
    EXPECT_NEAR(center.y, 0.5 - 0.25 * 9.81, 0.04);
    EXPECT_NEAR(norm(p.position + rotate(p.orientation, Vec3{0.5, 0, 0}) - q.position -
                     rotate(q.orientation, Vec3{-0.5, 0, 0})),
                0.0, tol(1e-12, 1e-5));
    const auto back = run.world->readBack();
    EXPECT_NEAR(back.bodies[1].mass, 1.0, 1e-6);
    EXPECT_NEAR(back.bodies[1].gravity.y, -0.5 * 9.81, 1e-5);
}

TEST(BulletArticulation, LinksTouchTheFloor) {
    Scenario s = scene(0.5);
    addStatic(s, HalfSpace{{0, 1, 0}, 0.0});
    const int a = addBody(s, Sphere{0.2}, {0, 1, 0}, 1.0, even(0.016));
    const int b = addBody(s, Sphere{0.2}, {0.6, 1, 0}, 1.0, even(0.016));
    s.joints.push_back(joint(JointType::Fixed, a, b, {0.3, 0, 0}, {-0.3, 0, 0}));
    Simulation run(s, 1.0 / 240, kMatched);
    run.seconds(2);
    EXPECT_NEAR(run.state(a).position.y, 0.2, 2e-3);
    EXPECT_NEAR(run.state(b).position.y, 0.2, 2e-3);
    double impulse = 0.0;
    for (const ContactPoint& contact : run.contacts()) impulse += contact.normalImpulse;
    EXPECT_NEAR(impulse, 2 * 9.81 / 240, 2e-3);
}

/// Symplectic Euler of I q'' = -k (q - target) - c q' with the spring's torque of the start of the step.
double swung(double inertia, double k, double c, double target, double dt, int steps) {
    double q = 0.0, rate = 0.0;
    for (int i = 0; i < steps; ++i) {
        rate -= dt / inertia * (k * (q - target) + c * rate);
        q += dt * rate;
    }
    return q;
}

TEST(BulletArticulation, SpringsPullWithTheForceOfTheStartOfTheStep) {
    for (const bool turned : {false, true}) {
        Scenario s = rodOnAHinge(turned);
        s.gravity = {};
        auto& axis = s.joints[0].axes[0];
        axis.stiffness = 20.0;
        axis.damping = 0.3;
        axis.target = turned ? -0.4 : 0.4;
        Simulation given(s, 1.0 / 120, kMatched);
        given.steps(100);
        EXPECT_NEAR(foundAngle(given.state(0)), swung(1.0 / 3, 20, 0.3, 0.4, 1.0 / 120, 100),
                    tol(1e-10, 1e-4));
        EXPECT_EQ(given.ledgerLine("joint_springs")->realisation, adapter::Realisation::Approximate);

        // 1 Hz on the rod's moment about its hinge.
        const double omega = 2.0 * std::numbers::pi;
        axis.stiffness = axis.damping = 0.0;
        axis.frequency = 1.0;
        axis.dampingRatio = 0.1;
        Simulation tuned(s, 1.0 / 120, kMatched);
        tuned.steps(100);
        EXPECT_NEAR(foundAngle(tuned.state(0)), swung(1, omega * omega, 0.2 * omega, 0.4, 1.0 / 120, 100),
                    tol(1e-10, 1e-4));
    }
}

TEST(BulletArticulation, ADamperOnASliderIsASpringWithoutStiffness) {
    Scenario s = scene();
    s.gravity = {0, -10, 0};
    const int b = addBody(s, Box{{0.1, 0.1, 0.1}}, {0, 0, 0}, 2.0);
    s.joints.push_back(joint(JointType::Slider, scenario::kNone, b, {}, {}, {0, 1, 0}));
    s.joints[0].axes[0].damping = 4.0;
    Simulation run(s, 1.0 / 240, kMatched);
    run.seconds(10);
    EXPECT_NEAR(run.state(b).velocity.y, -5.0, tol(1e-6, 1e-3)) << "m g / c";
}

TEST(BulletArticulation, WhatItLacksIsRefused) {
    Scenario s = rodOnAHinge();
    const auto refusal = [](const Scenario& scenario) {
        try {
            Simulation(scenario, 0.01, kMatched);
        } catch (const adapter::Unsupported& refused) {
            return std::string(adapter::refusalName(refused.refusal()));
        }
        return std::string("none");
    };
    s.joints[0].breakForce = 10;
    EXPECT_EQ(refusal(s), "adapter");
    s.joints[0].breakForce = 1e300;
    s.joints[0].type = JointType::Wheel;
    EXPECT_EQ(refusal(s), "library");
    s.joints[0].type = JointType::Hinge;
    s.joints[0].breakForce = 1e300;
    s.bodies[1].type = BodyType::Kinematic;
    EXPECT_THROW(Simulation(s, 0.01, kMatched), adapter::Unsupported);
    s.bodies[1].type = BodyType::Static;
    EXPECT_THROW(Simulation(s, 0.01, kMatched + ",solver=nncg"), adapter::Unsupported);
    EXPECT_NO_THROW(Simulation(s, 0.01, kMatched));
}

/// The scene of `space` in 2D.
Scenario inThePlane(Scenario space) {
    space.dimension = 2;
    return space;
}

TEST(BulletArticulation, APendulumOfThePlaneIsTheOneInSpace) {
    for (const JointType type : {JointType::Hinge, JointType::Ball}) {
        Scenario flat = inThePlane(rodOnAHinge());
        flat.joints[0].type = type;
        Simulation run(flat, 1.0 / 240, kMatched), space(rodOnAHinge(), 1.0 / 240, kMatched);
        run.seconds(1);
        space.seconds(1);
        EXPECT_NEAR(norm(run.state(0).position - space.state(0).position), 0.0, tol(1e-13, 1e-5));
    }
}

/// Nothing holds the two bodies to the world: their first body floats, in frames that do not turn.
TEST(BulletArticulation, ATreeOfThePlaneFloats) {
    Scenario s = scene(0.0, 0.0, 2);
    s.gravity = {0, -9.81, 0};
    const int a = addBody(s, Box{{0.2, 0.1, 0.0}}, {0, 0, 0}, 2.0);
    s.bodies[0].angularVelocity = {0, 0, 5};
    s.bodies[0].velocity = {1, 2, 0};
    const int b = addBody(s, Box{{0.2, 0.1, 0.0}}, {0, 0, 0}, 1.0);
    s.bodies[1].angularVelocity = {0, 0, -5};
    s.bodies[1].velocity = {1, 2, 0};
    s.bodies[1].pose.orientation = scenario::fromAxisAngle({0, 0, 1}, 0.7);
    for (auto& body : s.bodies) body.collides = false;
    s.joints.push_back(joint(JointType::Hinge, a, b, {}, {}));
    Simulation run(s, 1.0 / 120, kMatched);
    run.seconds(1);
    for (const int i : {a, b}) {
        EXPECT_NEAR(run.state(i).position.x, 1.0, tol(1e-12, 1e-4));
        // Symplectic Euler: g h^2 n (n + 1) / 2.
        EXPECT_NEAR(run.state(i).position.y, 2.0 - 9.81 * 121 / 240, tol(1e-11, 1e-4));
        EXPECT_NEAR(run.state(i).angularVelocity.z, i == a ? 5.0 : -5.0, tol(1e-12, 1e-4));
        EXPECT_EQ(run.state(i).position.z, 0.0);
    }
    EXPECT_NEAR(2.0 * std::acos(std::abs(run.state(b).orientation.w)),
                std::abs(std::remainder(0.7 - 5.0, 2 * std::numbers::pi)), tol(1e-7, 1e-3));
}

TEST(BulletArticulation, LinksOfThePlaneTouchTheFloorAndStayInIt) {
    Scenario s = scene(0.5, 0.0, 2);
    s.gravity = {0, -9.81, 0};
    addStatic(s, HalfSpace{{0, 1, 0}, 0.0});
    const int a = addBody(s, Box{{0.2, 0.2, 0.0}}, {0, 1, 0});
    const Quat tilted = scenario::fromAxisAngle({0, 0, 1}, 0.3);
    const int b = addBody(s, Box{{0.2, 0.2, 0.0}}, Vec3{0.3, 1, 0} + rotate(tilted, Vec3{0.3, 0, 0}));
    s.bodies[2].pose.orientation = tilted;
    s.joints.push_back(joint(JointType::Hinge, a, b, {0.3, 0, 0}, {-0.3, 0, 0}));
    Simulation run(s, 1.0 / 240, kMatched);
    run.seconds(2);
    for (const int i : {a, b}) {
        EXPECT_NEAR(run.state(i).position.y, 0.2, 5e-3);
        EXPECT_EQ(run.state(i).orientation.x, 0.0);
        EXPECT_EQ(run.state(i).velocity.z, 0.0);
    }
    double impulse = 0.0;
    for (const ContactPoint& contact : run.contacts()) impulse += contact.normalImpulse;
    EXPECT_NEAR(impulse, 2 * 9.81 / 240, 2e-3);
}

}  // namespace
}  // namespace rigor::test
