// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Free motion, mass properties, forces, damping, gyroscopic term, sleeping, planar lock.
#include <cmath>

#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

constexpr double kGravity = 9.81;

TEST(BulletInfo, NamesVersionAndPrecisionOfTheLibrary) {
    const auto info = engine().info();
    EXPECT_EQ(info.name, "bullet");
    EXPECT_TRUE(info.version.starts_with("3.") || info.version.starts_with("2.")) << info.version;
    const bool single = std::string(RIGOR_MODULE).find(".f32.") != std::string::npos;
    EXPECT_EQ(info.precision, single ? "f32" : "f64");
}

TEST(BulletMotion, FreeFallIsSymplecticEulerStepForStep) {
    for (const double dt : {1.0 / 60, 1.0 / 240}) {
        Scenario s = scene();
        const int ball = addBody(s, Sphere{0.1}, {1, 2, 3});
        s.bodies[0].velocity = {3, 4, 5};
        Simulation run(s, dt);
        const int n = 100;
        run.steps(n);
        const double t = n * dt;
        const auto state = run.state(ball);
        EXPECT_NEAR(state.position.x, 1 + 3 * t, tol(1e-12, 1e-5));
        EXPECT_NEAR(state.position.y, 2 + 4 * t - 0.5 * kGravity * t * (t + dt), tol(1e-12, 2e-5));
        EXPECT_NEAR(state.velocity.y, 4 - kGravity * t, tol(1e-12, 1e-5));
    }
}

TEST(BulletMotion, VelocityIsOfTheCenterOfMassAndPositionOfTheBodyFrame) {
    Scenario s = scene();
    s.gravity = {};
    addBody(s, Box{{0.5, 0.5, 0.5}}, {1, 0, 0}, 2.0, {0.4, 0.5, 0.6});
    s.bodies[0].massProperties.centerOfMass = {0.3, 0, 0};
    s.bodies[0].velocity = {0, 1, 0};
    s.bodies[0].angularVelocity = {0, 0, 2};  // the spin is about a principal axis
    const double dt = 1.0 / 240;
    Simulation run(s, dt);
    run.steps(240);
    const auto state = run.state(0);
    // The centre of mass goes straight; the body frame's origin circles around it.
    EXPECT_NEAR(state.position.x, 1.3 - 0.3 * std::cos(2.0), tol(1e-10, 1e-5));
    EXPECT_NEAR(state.position.y, 1.0 - 0.3 * std::sin(2.0), tol(1e-10, 1e-5));
    EXPECT_NEAR(state.velocity.y, 1.0, tol(1e-12, 1e-6));
    EXPECT_NEAR(angleAboutZ(state.orientation), 2.0, tol(1e-10, 1e-5));
}

/// Bullet computes .10417 (its bounding box) for this capsule; the scenario's tensor has to win.
TEST(BulletMotion, TorqueTurnsACapsuleWithTheScenariosInertia) {
    Scenario s = scene();
    s.gravity = {};
    addBody(s, Capsule{0.25, 0.25}, {}, 1.0, {0.075625, 0.02, 0.075625});
    const double dt = 1.0 / 240;
    Simulation run(s, dt);
    run.world->applyForce(0, {}, {0, 0, 1});
    run.steps(1);
    EXPECT_NEAR(run.state(0).angularVelocity.z, dt / 0.075625, tol(1e-12, 1e-6));
}

TEST(BulletMotion, ForcesActForOneStepAndAddUp) {
    Scenario s = scene();
    s.gravity = {};
    addBody(s, Sphere{0.1}, {}, 2.0);
    const double dt = 1.0 / 60;
    Simulation run(s, dt);
    run.world->applyForce(0, {3, 0, 0}, {});
    run.world->applyForce(0, {1, 0, 0}, {});
    run.steps(1);
    EXPECT_NEAR(run.state(0).velocity.x, 2.0 * dt, tol(1e-14, 1e-8));
    run.steps(5);
    EXPECT_NEAR(run.state(0).velocity.x, 2.0 * dt, tol(1e-14, 1e-8));
}

TEST(BulletMotion, DampingKeepsTheGivenPartPerSecond) {
    Scenario s = scene();
    s.gravity = {};
    addBody(s, Sphere{0.1}, {});
    s.bodies[0].velocity = {2, 0, 0};
    s.bodies[0].angularVelocity = {0, 0, 3};
    s.bodies[0].linearVelocityKept = 0.25;
    s.bodies[0].angularVelocityKept = 0.5;
    Simulation run(s, 1.0 / 60);
    run.seconds(1);
    EXPECT_NEAR(run.state(0).velocity.x, 0.5, tol(1e-12, 1e-5));
    EXPECT_NEAR(run.state(0).angularVelocity.z, 1.5, tol(1e-12, 1e-5));
}

/// The world overwrites a body's own gravity when the body is added.
TEST(BulletMotion, GravityScaleIsPerBody) {
    Scenario s = scene();
    addBody(s, Sphere{0.1}, {});
    addBody(s, Sphere{0.1}, {5, 0, 0});
    s.bodies[0].gravityScale = 0.0;
    s.bodies[1].gravityScale = -0.5;
    Simulation run(s, 1.0 / 60);
    run.seconds(1);
    EXPECT_EQ(run.state(0).velocity.y, 0.0);
    EXPECT_NEAR(run.state(1).velocity.y, 0.5 * kGravity, tol(1e-12, 1e-5));
    EXPECT_NEAR(run.world->readBack().bodies[1].gravity.y, 0.5 * kGravity, tol(1e-12, 1e-5));
}

/// A slow body in free space: Bullet's sleeping stops it after 2 s.
TEST(BulletMotion, MatchedHasNoSleepingDefaultHas) {
    Scenario s = scene();
    s.gravity = {};
    addBody(s, Sphere{0.1}, {});
    s.bodies[0].velocity = {0.5, 0, 0};
    Simulation matched(s, 1.0 / 60), byDefault(s, 1.0 / 60, "");
    matched.seconds(4);
    byDefault.seconds(4);
    EXPECT_NEAR(matched.state(0).velocity.x, 0.5, 1e-7);
    EXPECT_EQ(byDefault.state(0).velocity.x, 0.0);
    EXPECT_EQ(matched.ledgerLine("sleeping")->realisation, adapter::Realisation::Exact);
    EXPECT_EQ(byDefault.ledgerLine("sleeping")->realisation, adapter::Realisation::Approximate);
}

TEST(BulletReadBack, FullInertiaTensorAndOffsetComeBackInTheBodyFrame) {
    Scenario s = scene();
    addBody(s, Box{{0.5, 0.5, 0.5}}, {0, 5, 0}, 3.0);
    auto& properties = s.bodies[0].massProperties;
    const Mat3 turn = toMatrix(normalized(Quat{0.7, 0.3, -0.4, 0.5}));
    properties.inertia = turn * Mat3::diagonal(0.5, 0.9, 1.2) * transpose(turn);
    properties.centerOfMass = {0.1, -0.2, 0.05};
    s.bodies[0].pose.orientation = scenario::fromAxisAngle({0, 1, 0}, 0.4);
    const auto back = Simulation(s, 1.0 / 60).world->readBack().bodies.at(0);
    EXPECT_NEAR(back.mass, 3.0, tol(1e-12, 1e-6));
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            EXPECT_NEAR(back.inertia(i, j), properties.inertia(i, j), tol(1e-12, 1e-6)) << i << j;
    EXPECT_NEAR(norm(back.centerOfMass - properties.centerOfMass), 0.0, 1e-12);
    EXPECT_NEAR(norm(back.state.position - s.bodies[0].pose.position), 0.0, tol(1e-12, 1e-5));
    const Quat difference = conjugate(back.state.orientation) * s.bodies[0].pose.orientation;
    EXPECT_NEAR(std::abs(difference.w), 1.0, tol(1e-12, 1e-6));
}

/// A torque about a body axis of a full tensor: alpha = I^-1 tau has off-axis parts.
TEST(BulletMotion, FullInertiaTensorGovernsTheResponse) {
    Scenario s = scene();
    s.gravity = {};
    addBody(s, Sphere{0.1}, {});
    Mat3 inertia = Mat3::diagonal(1.0, 2.0, 2.5);
    inertia(0, 1) = inertia(1, 0) = 0.4;
    s.bodies[0].massProperties.inertia = inertia;
    const double dt = 1.0 / 240;
    Simulation run(s, dt);
    run.world->applyForce(0, {}, {1, 0, 0});
    run.steps(1);
    const Vec3 back = inertia * run.state(0).angularVelocity;
    EXPECT_NEAR(back.x, dt, tol(1e-12, 1e-7));
    EXPECT_NEAR(back.y, 0.0, tol(1e-12, 1e-7));
    EXPECT_LT(run.state(0).angularVelocity.y, -1e-4);
}

/// A free symmetric top precesses at L / I1 about its angular momentum.
double precessionError(const std::string& gyroscopic, double dt) {
    const double i1 = 1.0, i3 = 2.0, w1 = 0.5, w3 = 2.0, time = 2.0;
    Scenario s = scene();
    s.gravity = {};
    addBody(s, Sphere{0.1}, {}, 1.0, {i1, i1, i3});
    s.bodies[0].angularVelocity = {w1, 0, w3};
    Simulation run(s, dt, "preset=matched,gyroscopic=" + gyroscopic);
    run.seconds(time);
    const Vec3 momentum{i1 * w1, 0, i3 * w3};
    const double rate = norm(momentum) / i1;
    // The body's axis turns about L; so does it in the exact solution.
    const Quat turn = scenario::fromAxisAngle(momentum / norm(momentum), rate * time);
    const Vec3 exact = rotate(turn, Vec3{0, 0, 1});
    return norm(rotate(run.state(0).orientation, Vec3{0, 0, 1}) - exact);
}

TEST(BulletMotion, ImplicitGyroscopicTermConvergesToThePrecession) {
    const double coarse = precessionError("implicit_body", 1.0 / 120);
    const double fine = precessionError("implicit_body", 1.0 / 480);
    EXPECT_LT(coarse, 0.02);
    EXPECT_LT(fine, 0.4 * coarse);  // first order
    EXPECT_GT(precessionError("none", 1.0 / 480), 10 * fine);
}

TEST(BulletMotion, ExternalGyroscopicTermKeepsTheAngularMomentum) {
    Scenario s = scene();
    s.gravity = {};
    addBody(s, Sphere{0.1}, {}, 1.0, {1, 2, 3});
    s.bodies[0].angularVelocity = {0.1, 4, 0.1};
    Simulation run(s, 1.0 / 240, "preset=matched,gyroscopic=external");
    run.seconds(5);
    const auto state = run.state(0);
    const Vec3 w = rotateInverse(state.orientation, state.angularVelocity);
    const Vec3 momentum = rotate(state.orientation, Vec3{w.x, 2 * w.y, 3 * w.z});
    EXPECT_NEAR(norm(momentum - Vec3{0.1, 8, 0.3}), 0.0, tol(1e-10, 1e-3));
}

TEST(BulletMotion, KinematicBodiesMoveAtTheirVelocity) {
    Scenario s = scene();
    addStatic(s, Box{{1, 1, 1}}, {0, 3, 0});
    s.bodies[0].type = BodyType::Kinematic;
    s.bodies[0].velocity = {0.5, -1, 2};
    s.bodies[0].angularVelocity = {0, 0, 1.5};
    Simulation run(s, 1.0 / 60);
    run.seconds(1);
    const auto state = run.state(0);
    EXPECT_NEAR(norm(state.position - Vec3{0.5, 2, 2}), 0.0, tol(1e-12, 1e-5));
    EXPECT_NEAR(angleAboutZ(state.orientation), 1.5, tol(1e-10, 1e-5));
    EXPECT_NEAR(norm(state.velocity - Vec3{0.5, -1, 2}), 0.0, 1e-6);
}

TEST(BulletPlanar, TwoDimensionalScenariosStayInThePlane) {
    Scenario s = scene(0.5, 0.3, 2);
    addStatic(s, HalfSpace{{0, 1, 0}, 0.0});
    for (int i = 0; i < 4; ++i) {
        addBody(s, Box{{0.5, 0.3, 0}}, {0.2 * i, 1.0 + i, 0}, 1.0, even(0.1));
        s.bodies.back().pose.orientation = scenario::fromAxisAngle({0, 0, 1}, 0.3 * i);
    }
    Simulation run(s, 1.0 / 240);
    run.seconds(2);
    for (int i = 1; i <= 4; ++i) {
        const auto state = run.state(i);
        EXPECT_EQ(state.position.z, 0.0);
        EXPECT_EQ(state.velocity.z, 0.0);
        EXPECT_NEAR(std::hypot(state.orientation.x, state.orientation.y), 0.0, 1e-12);
    }
    EXPECT_NE(run.ledgerLine("planar"), nullptr);
}

/// The 2D inertia is used: a disc with I = 0.4 m r^2 that slips ends at 5/7 of its speed.
TEST(BulletPlanar, RollingDiscEndsWithFiveSevenths) {
    Scenario s = scene(0.3, 0.0, 2);
    addStatic(s, HalfSpace{{0, 1, 0}, 0.0});
    addBody(s, Sphere{0.5}, {0, 0.5, 0}, 1.0, even(sphereMoment(1.0, 0.5)));
    s.bodies[1].velocity = {2, 0, 0};
    Simulation run(s, 1.0 / 240);
    run.seconds(1.5);
    EXPECT_NEAR(run.state(1).velocity.x, 2.0 * 5.0 / 7.0, 1e-3);
    EXPECT_NEAR(run.state(1).angularVelocity.z, -2.0 * 5.0 / 7.0 / 0.5, 2e-3);
}

}  // namespace
}  // namespace rigor::test
