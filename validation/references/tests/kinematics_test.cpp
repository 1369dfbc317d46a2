// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contract of every reference: positions and orientations move by its velocities and angular velocities, with
// masses, radii and moments that are not 1, before, between and after the events.
#include <gtest/gtest.h>

#include <cmath>

#include "validation/references/tests/newton_euler.hpp"

namespace rigor::validation::testing {
namespace {

void expectMoves(const Scenario& s, std::initializer_list<double> times, double tolerance = 1e-8) {
    const auto reference = makeReference(s);
    for (const int body : reference->bodies())
        for (const double t : times) expectConsistent(s, *reference, body, t, tolerance);
}

Scenario ballOnFloor(Vec3 gravity, double mu, Vec3 velocity, Vec3 spin, const char* name) {
    Scenario s = emptyScene(3, gravity, 2);
    addBall(s, "ball", 0.3, 2, 0.5, {0, 0.3, 0}, velocity, spin);
    addFloor(s);
    s.materials[0].friction = mu;
    setReference(s, name);
    return s;
}

TEST(Kinematics, OfABallThatSlipsAndRolls) {
    // Slips until 0.6 s; the axis of its spin stays, or wanders.
    expectMoves(ballOnFloor({0, -10, 0}, 0.1, {1.8, 0, 0}, {}, "slip_to_roll"), {0.1, 0.4, 0.9, 1.7});
    expectMoves(ballOnFloor({0, -10, 0}, 0.1, {1.8, 0, 0}, {3, 2, 1}, "slip_to_roll"), {0.1, 0.3, 1.2, 1.7});
    for (const double mu : {0.05, 0.6})
        expectMoves(ballOnFloor({3, -9, 0}, mu, {}, {}, "rolling_incline"), {0.2, 1.1, 1.8});
}

TEST(Kinematics, OfABallOnATurntable) {
    Scenario s = emptyScene(3, {0, 0, -9.81}, 1);
    const int table = addBody(s, "table", BodyType::Kinematic, Box{{2, 2, 0.1}}, {0, 0, -0.1});
    s.bodies[table].angularVelocity = {0, 0, 3.5};
    const Vec3 v{0, 0.2, 0}, surface{0, 3.5 * 0.5, 0};
    addBall(s, "ball", 0.2, 3, 0.5, {0.5, 0, 0.2}, v, (1 / 0.2) * cross(Vec3{0, 0, 1}, v - surface));
    s.materials[0].friction = 0.5;
    setReference(s, "turntable");
    expectMoves(s, {0.2, 0.6});
    // A table that stands still: straight on.
    s.bodies[0].angularVelocity = {};
    s.bodies[1].angularVelocity = (1 / 0.2) * cross(Vec3{0, 0, 1}, v);
    expectMoves(s, {0.2, 0.6});
    EXPECT_NEAR(norm(*makeReference(s)->exact(1, 1).position - Vec3{0.5, 0.2, 0.2}), 0, 1e-13);
}

/// Wherever the spin starts: about the first axis, about the third, and near the separatrix between them.
TEST(Kinematics, OfATopFromEveryStart) {
    for (const Vec3 I : {Vec3{1, 2, 2.5}, Vec3{0.4, 1.9, 2.0}, Vec3{3, 2, 2.9}})
        for (int i = 0; i < 24; ++i) {
            Scenario s = emptyScene(3, {}, 2);
            addBox(s, "top", {0.1, 0.1, 0.1}, 1, {});
            s.bodies[0].massProperties.inertia = Mat3::diagonal(I.x, I.y, I.z);
            s.bodies[0].pose.orientation = fromAxisAngle({0.6, 0, 0.8}, 0.7);
            const double a = 0.27 * i, b = 0.41 * i;
            s.bodies[0].angularVelocity =
                3.0 * Vec3{std::cos(a) * std::sin(b), std::sin(a) * std::sin(b), std::cos(b)};
            setReference(s, "torque_free_top");
            const auto reference = makeReference(s);
            const Vec3 start = spinMomentum(s, *reference, 0, 0);
            for (const double t : {0.5, 1.7}) {
                SCOPED_TRACE(std::to_string(i) + " at " + std::to_string(t));
                expectConsistent(s, *reference, 0, t, 1e-8);
                EXPECT_LT(norm(spinMomentum(s, *reference, 0, t) - start), 1e-11);
                EXPECT_NEAR(energyOf(s, *reference, t), energyOf(s, *reference, 0), 1e-11);
            }
        }
}

TEST(Kinematics, OfImpacts) {
    Scenario plane = emptyScene(3, {0.4, -9.81, 1}, 0.6);
    addBall(plane, "ball", 0.2, 1.7, 0.55, {0, 1, 0}, {3, -2, 1}, {4, 5, -6});
    addFloor(plane);
    plane.materials[0] = {"stuff", 0.3, 0.6, 1000};
    setReference(plane, "sphere_plane_impact");
    expectMoves(plane, {0.1, 0.35, 0.5});
    Scenario bounce = emptyScene(3, {1.5, -9.81, 0.5}, 2);
    addBall(bounce, "ball", 0.2, 3, 0.4, {0, 1, 0}, {1, 0, 2}, {1, -2, 3});
    addFloor(bounce);
    bounce.materials[0].restitution = 0.8;
    setReference(bounce, "bouncing_ball");
    expectMoves(bounce, {0.2, 0.7, 1.3, 1.9});
    Scenario two = emptyScene(3, {}, 1);
    addBall(two, "a", 0.1, 1, 0.4, {-0.5, 0, 0}, {2, 0, 0}, {1, 2, 3});
    addBall(two, "b", 0.2, 2, 0.5, {0.16, 0.12, 0}, {}, {0, 0, 10});
    two.materials[0] = {"stuff", 0.1, 0.5, 1000};
    setReference(two, "two_sphere_impact");
    expectMoves(two, {0.05, 0.6});
}

TEST(Kinematics, OfFlightsAndSprings) {
    Scenario drag = emptyScene(3, {0, -10, 0}, 2);
    addBox(drag, "box", {0.1, 0.1, 0.1}, 2, {}, {1, 2, 3});
    drag.bodies[0].angularVelocity = {2, -1, 3};
    drag.bodies[0].linearVelocityKept = 0.7;
    drag.bodies[0].angularVelocityKept = 0.4;
    drag.forces.push_back(DragForce{0, 1.5});
    setReference(drag, "linear_drag");
    expectMoves(drag, {0.3, 1.5});
    Scenario spring = emptyScene(3, {0, -10, 0}, 2);
    addBall(spring, "bob", 0.1, 2, 0.4, {0, -1.2, 0}, {0, 1, 0});
    spring.forces.push_back(SpringForce{kNone, 0, {}, {}, 60, 2, 1});
    setReference(spring, "spring_oscillator");
    expectMoves(spring, {0.3, 1.5});
    Scenario flight = emptyScene(3, {0, -10, 0}, 2);
    addBox(flight, "box", {0.1, 0.3, 0.2}, 2, {}, {1, 2, 3});
    flight.bodies[0].angularVelocity = {2, -1, 3};
    flight.bodies[0].massProperties.centerOfMass = {0.1, 0.2, -0.1};
    flight.forces.push_back(ConstantForce{0, {6, 0, 1}, {}, 0.5, 1.5});
    setReference(flight, "free_flight");
    expectMoves(flight, {0.2, 1.1, 1.8});
}

/// A conical pendulum goes round at sqrt(g/(l cos a)) under a constant tilt.
TEST(Kinematics, OfAConicalPendulum) {
    const double tilt = 0.6, length = 0.5, rate = std::sqrt(10 / (length * std::cos(tilt)));
    Scenario s = emptyScene(3, {0, -10, 0}, 1.5);
    const Vec3 arm{length * std::sin(tilt), -length * std::cos(tilt), 0};
    addBall(s, "bob", 1e-3, 2, 0.4, arm, cross({0, rate, 0}, arm), {0, rate, 0});
    Joint ball;
    ball.name = "pivot";
    ball.type = JointType::Ball;
    ball.bodyB = 0;
    ball.anchorB = -arm;
    s.joints = {ball};
    setReference(s, "spherical_pendulum");
    expectMoves(s, {0.2, 1.1});
    const auto quantities = makeReference(s)->quantities(0.01, adapter::Scheme::Unknown);
    ASSERT_NE(findQuantity(quantities, "azimuth_turned"), nullptr);
    EXPECT_NEAR(std::abs(findQuantity(quantities, "azimuth_turned")->exact), rate * 1.5, 1e-4);
    EXPECT_NEAR(findQuantity(quantities, "tilt_max")->exact, M_PI - tilt, 1e-5) << "from the upward vertical";
    EXPECT_NEAR(findQuantity(quantities, "tilt_min")->exact, M_PI - tilt, 1e-5);
}

}  // namespace
}  // namespace rigor::validation::testing
