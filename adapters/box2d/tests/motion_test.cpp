// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Free motion, mass properties, limits, joints and refusals, in a scaled world and in one of its own size.
#include <cmath>
#include <limits>

#include "adapters/interface/tests/joint_states.hpp"

namespace rigor::test {
namespace {

constexpr double kGravity = 9.81;

Scenario freeScene(double friction = 0.0, double restitution = 0.0) {
    return scene(friction, restitution, 2);
}

TEST(Box2dInfo, NamesVersionAndPrecisionOfTheLibrary) {
    const auto info = engine().info();
    EXPECT_EQ(info.name, "box2d");
    EXPECT_TRUE(info.version.starts_with("2.")) << info.version;
    // Version that the library reports, and that of the package if it is another.
    EXPECT_TRUE(info.package.empty() || info.package.starts_with("2.")) << info.package;
    EXPECT_NE(info.package, info.version);
    EXPECT_EQ(info.precision, "f32");
}

TEST(Box2dMotion, FreeFallIsSymplecticEulerWhateverTheScale) {
    for (const char* options : {"", "preset=matched", "preset=matched,scale=0.5"}) {
        const double dt = 1.0 / 240;
        Scenario s = freeScene();
        addBody(s, Sphere{0.1}, {1, 2, 0});
        s.bodies[0].velocity = {3, 4, 0};
        s.bodies[0].angularVelocity = {0, 0, 5};
        Simulation run(s, dt, options);
        run.steps(240);
        const auto state = run.state(0);
        EXPECT_NEAR(state.position.x, 4.0, 5e-5);
        EXPECT_NEAR(state.position.y, 6.0 - 0.5 * kGravity * (1 + dt), 5e-5);
        EXPECT_NEAR(state.velocity.y, 4 - kGravity, 2e-5);
        EXPECT_NEAR(angleAboutZ(state.orientation), 5.0 - 2 * M_PI, 2e-5);
        EXPECT_NEAR(state.angularVelocity.z, 5.0, 1e-6);
    }
}

/// b2MassData's inertia is about the body's origin, the scenario's about the centre of mass.
TEST(Box2dMotion, CenterOfMassOffset) {
    Scenario s = freeScene();
    s.gravity = {};
    addBody(s, Box{{1, 0.5, 0}}, {1, 0, 0}, 2.0, even(0.6));
    s.bodies[0].massProperties.centerOfMass = {0.3, 0.1, 0};
    s.bodies[0].velocity = {0, 1, 0};
    s.bodies[0].angularVelocity = {0, 0, 2};
    const double dt = 1.0 / 480;
    Simulation run(s, dt);
    const auto back = run.world->readBack().bodies[0];
    EXPECT_NEAR(back.mass, 2.0, 1e-6);
    EXPECT_NEAR(back.inertia(2, 2), 0.6, 1e-6);
    EXPECT_NEAR(norm(back.centerOfMass - Vec3{0.3, 0.1, 0}), 0.0, 1e-7);
    EXPECT_NEAR(norm(back.state.velocity - Vec3{0, 1, 0}), 0.0, 1e-6);
    run.steps(480);
    const auto state = run.state(0);
    const Vec3 center = state.position + rotate(state.orientation, Vec3{0.3, 0.1, 0});
    EXPECT_NEAR(norm(center - Vec3{1.3, 1.1, 0}), 0.0, 1e-4);
    EXPECT_NEAR(norm(state.velocity - Vec3{0, 1, 0}), 0.0, 1e-5);
    run.world->applyForce(0, {}, {0, 0, 3});
    run.steps(1);
    EXPECT_NEAR(run.state(0).angularVelocity.z, 2.0 + 3.0 / 0.6 * dt, 1e-5);
}

TEST(Box2dMotion, ForcesActForOneStepAndAddUp) {
    for (const char* options : {"", "preset=matched"}) {
        Scenario s = freeScene();
        s.gravity = {};
        addBody(s, Sphere{0.1}, {}, 2.0, even(0.5));
        const double dt = 1.0 / 60;
        Simulation run(s, dt, options);
        run.world->applyForce(0, {3, 0, 0}, {0, 0, 1});
        run.world->applyForce(0, {1, -2, 0}, {});
        run.steps(6);
        EXPECT_NEAR(run.state(0).velocity.x, 2.0 * dt, 1e-7);
        EXPECT_NEAR(run.state(0).velocity.y, -1.0 * dt, 1e-7);
        EXPECT_NEAR(run.state(0).angularVelocity.z, 2.0 * dt, 1e-7);
    }
}

/// Box2D's v /= 1 + dt c with c = -ln(kept) would leave .2549 of .25 at this step.
TEST(Box2dMotion, DampingKeepsTheGivenPartPerSecond) {
    Scenario s = freeScene();
    s.gravity = {};
    addBody(s, Sphere{0.1}, {});
    s.bodies[0].velocity = {1, 0, 0};
    s.bodies[0].angularVelocity = {0, 0, 2};
    s.bodies[0].linearVelocityKept = 0.25;
    s.bodies[0].angularVelocityKept = 0.5;
    Simulation run(s, 1.0 / 60);
    run.seconds(1);
    EXPECT_NEAR(run.state(0).velocity.x, 0.25, 1e-5);
    EXPECT_NEAR(run.state(0).angularVelocity.z, 1.0, 1e-5);
}

TEST(Box2dMotion, GravityScaleAndKinematicBodies) {
    Scenario s = freeScene();
    addBody(s, Sphere{0.1}, {});
    s.bodies[0].gravityScale = -0.5;
    addStatic(s, Box{{1, 1, 0}}, {5, 0, 0});
    s.bodies[1].type = BodyType::Kinematic;
    s.bodies[1].velocity = {0.5, -1, 0};
    s.bodies[1].angularVelocity = {0, 0, 1.5};
    Simulation run(s, 1.0 / 240);
    EXPECT_NEAR(run.world->readBack().bodies[0].gravity.y, 0.5 * kGravity, 1e-5);
    run.seconds(1);
    EXPECT_NEAR(run.state(0).velocity.y, 0.5 * kGravity, 1e-4);
    EXPECT_NEAR(norm(run.state(1).position - Vec3{5.5, -1, 0}), 0.0, 1e-4);
    EXPECT_NEAR(angleAboutZ(run.state(1).orientation), 1.5, 1e-4);
}

TEST(Box2dMotion, MatchedHasNoSleepingDefaultHas) {
    Scenario s = freeScene();
    s.gravity = {};
    addBody(s, Sphere{0.1}, {});
    s.bodies[0].velocity = {0.009, 0, 0};
    Simulation matched(s, 1.0 / 60), byDefault(s, 1.0 / 60, "");
    matched.seconds(2);
    byDefault.seconds(2);
    EXPECT_NEAR(matched.state(0).velocity.x, 0.009, 1e-8);
    EXPECT_EQ(byDefault.state(0).velocity.x, 0.0);
}

/// Limits compiled into the library: they can only be reported, in numbers that are true.
TEST(Box2dMotion, SpeedLimitsAreThoseOfTheLedger) {
    Scenario s = freeScene();
    s.gravity = {};
    addBody(s, Sphere{0.1}, {});
    s.bodies[0].velocity = {500, 0, 0};
    s.bodies[0].angularVelocity = {0, 0, 500};
    for (const double scale : {1.0, 4.0}) {
        Simulation run(s, 1.0 / 60, "preset=matched,scale=" + std::to_string(scale));
        run.steps(1);
        EXPECT_NEAR(run.state(0).velocity.x, 120.0 / scale, 1e-3);
        EXPECT_NEAR(run.state(0).angularVelocity.z, 30.0 * M_PI, 1e-3);
        EXPECT_NEAR(std::stod(run.ledgerLine("linear_step_limit")->resolved), 120.0 / scale, 1e-3);
        EXPECT_NEAR(std::stod(run.ledgerLine("angular_step_limit")->resolved), 30.0 * M_PI, 1e-3);
    }
}

TEST(Box2dMotion, ContinuousCollisionIsOffInMatched) {
    for (const bool matched : {true, false}) {
        Scenario s = freeScene();
        s.gravity = {};
        addStatic(s, Box{{0.01, 5, 0}}, {2.1, 0, 0});
        addBody(s, Sphere{0.05}, {0.6, 0, 0}, 1.0, even(1e-3));
        s.bodies[1].velocity = {25, 0, 0};
        Simulation run(s, 1.0 / 60, matched ? "preset=matched" : "");
        run.steps(30);
        // 0.42 m per step over a 2 cm wall.
        EXPECT_EQ(run.state(1).position.x > 2.5, matched);
    }
}

TEST(Box2dJoints, HingeHoldsItsAnchorAndTurns) {
    Scenario s = freeScene();
    const int a = addBody(s, Box{{0.1, 0.1, 0}}, {1, 0, 0}, 2.0, even(0.02));
    s.bodies[0].massProperties.centerOfMass = {0.05, -0.1, 0};
    s.bodies[0].pose.orientation = scenario::fromAxisAngle({0, 0, 1}, 0.5);
    const Vec3 anchor = inverse(s.bodies[0].pose) * Vec3{};
    s.joints.push_back(jointOf(JointType::Hinge, scenario::kNone, a, {}, anchor));
    Simulation run(s, 1.0 / 480);
    double worst = 0.0;
    for (int i = 0; i < 480; ++i) {
        const auto state = run.steps(1).state(a);
        worst = std::max(worst, norm(state.position + rotate(state.orientation, anchor)));
    }
    EXPECT_LT(worst, 1e-4);
    EXPECT_LT(run.state(a).position.x, 0.5);
}

TEST(Box2dJoints, SliderKeepsAxisAndAngle) {
    Scenario s = freeScene();
    const int a = addBody(s, Box{{0.1, 0.1, 0}}, {0, 0, 0}, 2.0, even(0.02));
    s.bodies[0].pose.orientation = scenario::fromAxisAngle({0, 0, 1}, 0.3);
    Joint j = jointOf(JointType::Slider, scenario::kNone, a, {}, {});
    const Vec3 axis{0.6, -0.8, 0};
    j.axisA = axis;
    j.axisB = rotateInverse(s.bodies[0].pose.orientation, axis);
    s.joints.push_back(j);
    Simulation run(s, 1.0 / 480);
    run.seconds(0.5);
    const double along = dot(run.state(a).position, axis);
    EXPECT_NEAR(along, 0.5 * kGravity * 0.8 * 0.25, 0.01);
    EXPECT_NEAR(norm(run.state(a).position - along * axis), 0.0, 1e-4);
    EXPECT_NEAR(angleAboutZ(run.state(a).orientation), 0.3, 1e-4);
}

TEST(Box2dJoints, FixedHoldsAndRodKeepsItsLength) {
    Scenario s = freeScene();
    const int held = addBody(s, Box{{0.1, 0.1, 0}}, {1, 0, 0}, 2.0, even(0.02));
    const int bob = addBody(s, Sphere{0.1}, {4, 0, 0}, 1.0, even(0.004));
    s.joints.push_back(jointOf(JointType::Fixed, scenario::kNone, held, {0, 0, 0}, {-1, 0, 0}));
    s.joints.push_back(jointOf(JointType::Distance, scenario::kNone, bob, {3, 0, 0}, {}));
    s.joints[1].length = 1.0;
    Simulation run(s, 1.0 / 480);
    double worst = 0.0;
    for (int i = 0; i < 480; ++i)
        worst = std::max(worst, std::abs(norm(run.steps(1).state(bob).position - Vec3{3, 0, 0}) - 1.0));
    EXPECT_LT(worst, 2e-3);
    EXPECT_LT(run.state(bob).position.x, 3.8);
    EXPECT_NEAR(norm(run.state(held).position - Vec3{1, 0, 0}), 0.0, 1e-3);
}

TEST(Box2dJoints, ConnectedBodiesCollideOnlyIfRequested) {
    for (const bool collide : {false, true}) {
        Scenario s = freeScene();
        s.gravity = {};
        addBody(s, Sphere{0.5}, {0, 0, 0});
        addBody(s, Sphere{0.5}, {0.8, 0, 0});
        s.joints.push_back(jointOf(JointType::Hinge, 0, 1, {0.4, 0, 0}, {-0.4, 0, 0}));
        s.joints[0].collideConnected = collide;
        Simulation run(s, 1.0 / 240);
        run.steps(2);
        EXPECT_EQ(run.contacts().empty(), !collide);
    }
}

Scenario withPolygon(std::vector<Vec3> vertices) {
    Scenario s = freeScene();
    ConvexHull hull;
    hull.vertices = std::move(vertices);
    addBody(s, hull, {});
    return s;
}

/// Box2D's asserts abort: none of these may reach it.
TEST(Box2dRefuses, WhatWouldAbortTheLibrary) {
    const auto build = [](const Scenario& s, const std::string& options = "preset=matched") {
        Simulation run(s, 1.0 / 60, options);
    };
    std::vector<Vec3> nine;
    for (int i = 0; i < 9; ++i) nine.push_back({std::cos(0.69813 * i), std::sin(0.69813 * i), 0});
    EXPECT_THROW(build(withPolygon(nine)), adapter::Unsupported);
    nine.pop_back();
    EXPECT_NO_THROW(build(withPolygon(nine)));
    const std::vector<Vec3> tiny{{0, 0, 0}, {1e-3, 0, 0}, {1e-3, 1e-3, 0}, {0, 1e-3, 0}};
    EXPECT_THROW(build(withPolygon(tiny), "preset=default"), adapter::Unsupported);
    EXPECT_NO_THROW(build(withPolygon(tiny), "preset=matched,scale=10"));
    Scenario sharp = withPolygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    sharp.bodies[0].massProperties.centerOfMass = {1000, 0, 0};
    EXPECT_THROW(build(sharp), adapter::Unsupported);
    Scenario nan = withPolygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    nan.bodies[0].pose.position.x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(build(nan), adapter::BadInput);
    Scenario far = withPolygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    far.bodies[0].pose.position.x = 1e7;
    EXPECT_THROW(build(far), adapter::Unsupported);
    Scenario solid = scene();
    addBody(solid, Sphere{0.1}, {});
    EXPECT_THROW(build(solid), adapter::Unsupported);
}

}  // namespace
}  // namespace rigor::test
