// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies that touch nothing: schemes, frames, inertia, forces.
#include <cmath>

#include "adapters/conformance/kit.hpp"

namespace rigor::conformance {
namespace {

class Motion : public DynamicsTest {};
INSTANTIATE_TEST_SUITE_P(Kit, Motion, testing::ValuesIn(dynamicsArenas()), arenaName);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Motion);

TEST_P(Motion, FreeFlightFollowsTheClosedFormOfTheEnginesScheme) {
    Scenario s = scene();
    s.gravity = flat({0.5, -9.81, 0.25});
    const int b = addBody(s, ball(0.5), flat({1.0, 2.0, 3.0}), 2.5);
    s.bodies[0].velocity = flat({3.0, 4.0, -1.0});
    const double dt = 1.0 / 120.0;
    auto world = build(s, dt);
    const auto scheme = world->scheme();
    for (int n = 1; n <= 120; ++n) {
        world->step();
        const BodyState state = stateOf(*world, s, b);
        const double t = n * dt;
        double squares = static_cast<double>(n) * n;
        if (scheme == adapter::Scheme::SymplecticEuler) squares = static_cast<double>(n) * (n + 1);
        if (scheme == adapter::Scheme::ExplicitEuler) squares = static_cast<double>(n) * (n - 1);
        const Vec3 velocity = s.bodies[0].velocity + t * s.gravity;
        const Vec3 position =
            s.bodies[0].pose.position + t * s.bodies[0].velocity + 0.5 * squares * dt * dt * s.gravity;
        // Rounding: n additions of numbers of size 10. An unknown scheme is held to first order.
        within("free_flight_velocity", norm(state.velocity - velocity), tol(1e-12, 3e-5));
        within("free_flight_position", norm(state.position - position),
               scheme == adapter::Scheme::Unknown ? 10.0 * t * dt : tol(1e-12, 3e-5));
    }
}

TEST_P(Motion, OrientationIsActiveAndTurnsAboutWorldAxes) {
    Scenario s = scene();
    const int b = addBody(s, block({0.3, 0.2, 0.1}), {});
    const Quat start =
        is2d() ? fromAxisAngle({0, 0, 1}, 0.7) : fromAxisAngle(Vec3{1, 2, 3} / std::sqrt(14.0), 0.7);
    const Vec3 spin = is2d() ? Vec3{0, 0, 1.5} : Vec3{1.5, 0, 0};
    s.bodies[0].pose.orientation = start;
    s.bodies[0].angularVelocity = spin;
    auto world = build(s, 1.0 / 240.0);
    EXPECT_LE(angleBetween(stateOf(*world, s, b).orientation, start), tol(1e-7, 1e-3));
    run(*world, 240);
    const Quat expected = fromAxisAngle(spin / norm(spin), norm(spin)) * start;
    // A first-order update turns by atan: (w dt)^3 / 12 per step, 5e-6 rad in all.
    within("spin_angle", angleBetween(stateOf(*world, s, b).orientation, expected), tol(2e-5, 2e-3));
    EXPECT_NEAR(norm(stateOf(*world, s, b).orientation), 1.0, 1e-6);
}

TEST_P(Motion, TorqueMeetsTheInverseInertiaOfTheTurnedBody) {
    Scenario s = scene();
    const int b = addBody(s, block({0.3, 0.2, 0.1}), {}, 2.0, {0.5, 1.0, 1.25});
    const Quat principal = fromAxisAngle(Vec3{2, -1, 1} / std::sqrt(6.0), 0.9);
    const Quat start = fromAxisAngle(Vec3{1, 2, 3} / std::sqrt(14.0), 1.1);
    Vec3 torque{0.02, -0.03, 0.01};
    Vec3 expected;
    const double dt = 1.0 / 100.0;
    if (is2d()) {
        torque = {0, 0, 0.01};
        expected = dt / 1.25 * torque;
    } else {
        const Mat3 axes = toMatrix(principal), moments = Mat3::diagonal(0.5, 1.0, 1.25);
        s.bodies[0].massProperties.inertia = axes * moments * transpose(axes);
        s.bodies[0].pose.orientation = start;
        const Vec3 inPrincipal = rotateInverse(start * principal, torque);
        expected = dt * rotate(start * principal,
                               Vec3{inPrincipal.x / 0.5, inPrincipal.y / 1.0, inPrincipal.z / 1.25});
    }
    auto world = build(s, dt);
    world->applyForce(b, {}, torque);
    world->step();
    const BodyState state = stateOf(*world, s, b);
    within("torque_response", norm(state.angularVelocity - expected) / norm(expected), tol(1e-5, 1e-4));
    EXPECT_LE(norm(state.velocity), tol(1e-14, 1e-6));
}

TEST_P(Motion, AFreeBodyTurnsAboutItsCenterOfMass) {
    Scenario s = scene();
    const int b = addBody(s, block({0.3, 0.2, 0.1}), flat({1.0, -2.0, 0.5}), 2.0, {0.3, 0.3, 0.3});
    const Vec3 com = flat({0.4, 0.2, -0.1});
    Body& body = s.bodies[0];
    body.shapes[0].pose.position = com;
    body.massProperties.centerOfMass = com;
    body.velocity = flat({0.5, 0.25, -0.5});
    body.angularVelocity = is2d() ? Vec3{0, 0, 3.0} : Vec3{0.0, 3.0, 0.0};
    body.pose.orientation = fromAxisAngle({0, 0, 1}, 0.4);
    if (!engine().capabilities().centerOfMassOffset) {
        EXPECT_THROW(build(s, 1.0 / 240.0), adapter::Unsupported);
        return;
    }
    auto world = build(s, 1.0 / 240.0);
    const Vec3 start = body.pose * com;
    for (int n = 1; n <= 240; ++n) {
        world->step();
        const BodyState state = stateOf(*world, s, b);
        // The velocity is that of the centre of mass, which moves on a line; the origin circles around it.
        const Vec3 center = start + (n / 240.0) * body.velocity;
        within("center_of_mass_line", norm(Pose{state.position, state.orientation} * com - center),
               tol(1e-11, 2e-5));
        within("center_of_mass_velocity", norm(state.velocity - body.velocity), tol(1e-12, 1e-5));
    }
    const Quat expected = fromAxisAngle(body.angularVelocity / 3.0, 3.0) * body.pose.orientation;
    within("spin_angle_offset", angleBetween(stateOf(*world, s, b).orientation, expected), tol(2e-4, 3e-3));
}

TEST_P(Motion, AForceActsForExactlyOneStepAndForcesAdd) {
    Scenario s = scene();
    const int b = addBody(s, ball(0.5), {}, 4.0, {0.5, 0.5, 0.5});
    const double dt = 1.0 / 50.0;
    auto world = build(s, dt);
    const Vec3 force = flat({3.0, -5.0, 7.0}), torque{0.0, 0.0, 0.25};
    world->applyForce(b, 0.25 * force, torque);
    world->applyForce(b, 0.75 * force, {});
    world->step();
    const BodyState after = stateOf(*world, s, b);
    within("force_velocity", norm(after.velocity - dt / 4.0 * force), tol(1e-15, 1e-6));
    within("torque_velocity", norm(after.angularVelocity - dt / 0.5 * torque), tol(1e-15, 1e-6));
    run(*world, 3);
    const BodyState later = stateOf(*world, s, b);
    within("force_ends", norm(later.velocity - after.velocity), tol(1e-15, 1e-7));
    within("torque_ends", norm(later.angularVelocity - after.angularVelocity), tol(1e-15, 1e-7));
}

TEST_P(Motion, DampingKeepsTheGivenPartPerSecond) {
    Scenario s = scene();
    const int b = addBody(s, ball(0.5), {});
    s.bodies[0].velocity = flat({2.0, 1.0, 0.0});
    s.bodies[0].angularVelocity = {0, 0, 3.0};
    s.bodies[0].linearVelocityKept = 0.6;
    s.bodies[0].angularVelocityKept = 0.3;
    if (!engine().capabilities().damping) {
        EXPECT_THROW(build(s, 0.01), adapter::Unsupported);
        return;
    }
    auto world = build(s, 0.01);
    run(*world, 100);
    const BodyState state = stateOf(*world, s, b);
    within("linear_damping", norm(state.velocity - 0.6 * s.bodies[0].velocity), tol(1e-9, 1e-4));
    within("angular_damping", std::abs(state.angularVelocity.z - 0.9), tol(1e-9, 1e-4));
}

TEST_P(Motion, GravityScalesPerBody) {
    Scenario s = scene();
    s.gravity = {0, -10.0, 0};
    const double scales[] = {0.0, 1.0, 2.5, -1.0};
    for (int i = 0; i < 4; ++i) {
        addBody(s, ball(0.2), {2.0 * i, 0, 0}, 1.0 + i);
        s.bodies.back().gravityScale = scales[i];
    }
    if (!engine().capabilities().gravityScale) {
        EXPECT_THROW(build(s, 0.01), adapter::Unsupported);
        return;
    }
    auto world = build(s, 0.01);
    run(*world, 50);
    for (int i = 0; i < 4; ++i)
        within("gravity_scale", std::abs(stateOf(*world, s, i).velocity.y + 5.0 * scales[i]),
               tol(1e-12, 3e-5));
}

TEST_P(Motion, NothingFallsAsleep) {
    if (!matched()) GTEST_SKIP() << "a preset as the engine ships may sleep";
    Scenario s = scene();
    const int b = addBody(s, ball(0.2), {});
    s.bodies[0].velocity = {0.004, 0.0, 0.0};
    auto world = build(s, 1.0 / 60.0);
    run(*world, 240);
    within("slow_flight", std::abs(stateOf(*world, s, b).velocity.x - 0.004), tol(1e-15, 1e-7));
    EXPECT_FALSE(world->isAsleep(b));
}

/// A body that an engine reports as asleep does not move; a body that moves is awake.
TEST_P(Motion, WhatSleepsIsAtRest) {
    Scenario s = scene();
    const int still = addBody(s, ball(0.2), {});
    const int moving = addBody(s, ball(0.2), {5.0, 0.0, 0.0});
    s.bodies[moving].velocity = {0.0, 1.0, 0.0};
    auto world = build(s, 1.0 / 60.0);
    for (int step = 0; step < 240; ++step) {
        run(*world, 1);
        EXPECT_FALSE(world->isAsleep(moving)) << step;
        if (!world->isAsleep(still)) continue;
        EXPECT_EQ(norm(stateOf(*world, s, still).velocity), 0.0) << step;
    }
}

TEST_P(Motion, KinematicBodiesKeepTheirVelocity) {
    Scenario s = scene(0.5);
    s.gravity = {0, -9.81, 0};
    const int k = addBody(s, block({0.5, 0.5, 0.5}), {});
    s.bodies[0].type = BodyType::Kinematic;
    s.bodies[0].massProperties = {};
    s.bodies[0].velocity = {0.5, 0.25, 0.0};
    const int pushed = addBody(s, ball(0.25), {0.8, 0.0, 0.0}, 100.0, {1, 1, 1});
    if (!engine().capabilities().kinematicBodies) {
        EXPECT_THROW(build(s, 0.01), adapter::Unsupported);
        return;
    }
    auto world = build(s, 0.01);
    run(*world, 100);
    const BodyState state = stateOf(*world, s, k);
    within("kinematic_velocity", norm(state.velocity - s.bodies[0].velocity), tol(1e-12, 1e-6));
    within("kinematic_position", norm(state.position - s.bodies[0].velocity), tol(1e-12, 1e-5));
    if (s.bodies[k].collides && s.bodies[pushed].collides) {
        EXPECT_GT(stateOf(*world, s, pushed).position.x, 0.8) << "the kinematic body pushes";
    }
}

/// About their origin, wherever their shapes are.
TEST_P(Motion, KinematicBodiesTurn) {
    Scenario s = scene();
    const int k = addBody(s, block({0.5, 0.5, 0.5}), {});
    s.bodies[0].type = BodyType::Kinematic;
    s.bodies[0].shapes[0].pose.position = {0.4, 0.0, 0.0};
    s.bodies[0].massProperties = {};
    s.bodies[0].angularVelocity = {0.0, 0.0, 1.5};
    if (!engine().capabilities().kinematicBodies) GTEST_SKIP() << "no kinematic bodies";
    auto world = build(s, 1.0 / 240.0);
    run(*world, 240);
    within("kinematic_angle", angleBetween(stateOf(*world, s, k).orientation, fromAxisAngle({0, 0, 1}, 1.5)),
           tol(2e-5, 2e-3));
    within("kinematic_origin", norm(stateOf(*world, s, k).position), tol(1e-12, 1e-5));
}

}  // namespace
}  // namespace rigor::conformance
