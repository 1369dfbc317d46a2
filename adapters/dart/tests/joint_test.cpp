// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Wheels and six_dof as chains of DART's joints: whichever body hangs on which, what is held stays held, coordinates are
// the scenario's, and states that are set come back.
#include <cmath>

#include "adapters/interface/tests/joint_states.hpp"

namespace rigor::test {
namespace {

using scenario::AxisMode;
using scenario::Pose;

constexpr double kJointStep = 1.0 / 480.0;

/// Motion of B against A by the definition of a six_dof: its anchor in A's frame, its twist, and the swing vector.
struct Coordinates {
    Vec3 travel;
    double twist;
    Vec3 swing;  ///< in A's frame; x is zero
};
Coordinates coordinatesOf(const Joint& joint, const BodyState& A, const BodyState& B) {
    const Pose a{A.position, A.orientation}, b{B.position, B.orientation};
    const Pose relative = inverse(a) * b;
    Quat q = relative.orientation;
    if (q.w < 0.0) q = {-q.w, -q.x, -q.y, -q.z};
    const Quat twist = normalized(Quat{q.w, q.x, 0.0, 0.0}), swing = q * conjugate(twist);
    const double half = std::acos(std::min(1.0, swing.w)), sine = std::sin(half);
    const double scale = sine > 1e-12 ? 2.0 * half / sine : 2.0;
    return {relative * joint.anchorB - joint.anchorA, 2.0 * std::atan2(twist.x, twist.w),
            scale * Vec3{swing.x, swing.y, swing.z}};
}

BodyState stateOf(Simulation& simulation, int body) {
    return body == scenario::kNone ? BodyState{} : simulation.state(body);
}

/// A travel, the twist and one swing are open. The body is thrown about by gravity and a torque; what is held stays held
/// by the definition of the coordinates, to rounding.
TEST(DartJoints, WhatASixDofHoldsStaysHeld) {
    for (const bool reversed : {false, true})
        for (const std::size_t swing : {4, 5}) {
            SCOPED_TRACE(std::string(reversed ? "reversed, swing " : "swing ") + std::to_string(swing));
            Arm arm(JointType::SixDof, reversed);
            for (const std::size_t k : {std::size_t{1}, std::size_t{3}, swing})
                arm.joint().axes[k].mode = AxisMode::Free;
            Simulation simulation(arm.s, kJointStep);
            double held = 0.0, twisted = 0.0, swung = 0.0, travelled = 0.0;
            for (int i = 0; i < 360; ++i) {
                simulation.world->applyForce(arm.moving(), {}, {0.8, 0.6, -0.7});
                simulation.steps(1);
                const Coordinates c =
                    coordinatesOf(arm.joint(), stateOf(simulation, arm.a), stateOf(simulation, arm.b));
                held = std::max({held, std::abs(c.travel.x), std::abs(c.travel.z),
                                 std::abs(swing == 4 ? c.swing.z : c.swing.y)});
                travelled = std::max(travelled, std::abs(c.travel.y));
                twisted = std::max(twisted, std::abs(c.twist));
                swung = std::max(swung, std::abs(swing == 4 ? c.swing.y : c.swing.z));
            }
            EXPECT_LT(held, 1e-9);
            EXPECT_GT(travelled, 0.05);
            EXPECT_GT(twisted, 0.05);
            EXPECT_GT(swung, 0.05);
            EXPECT_EQ(simulation.ledgerLine("six_dof_angles"), nullptr);
        }
}

/// Each coordinate by itself is driven at 0.5, whichever body hangs on which.
TEST(DartJoints, EveryCoordinateOfASixDofIsTheScenariosOwn) {
    for (const bool reversed : {false, true})
        for (std::size_t k = 0; k < 6; ++k) {
            SCOPED_TRACE((reversed ? "reversed, " : "") + std::to_string(k));
            Arm arm(JointType::SixDof, reversed);
            arm.s.gravity = {};
            auto& axis = arm.joint().axes[k];
            axis.mode = AxisMode::Limited;
            axis.lower = -0.1;
            axis.upper = 0.2;
            axis.motorSpeed = 0.5;
            axis.motorMaxForce = 100.0;
            Simulation simulation(arm.s, kJointStep);
            const auto coordinate = [&] {
                const Coordinates c =
                    coordinatesOf(arm.joint(), stateOf(simulation, arm.a), stateOf(simulation, arm.b));
                const double all[] = {c.travel.x, c.travel.y, c.travel.z, c.twist, c.swing.y, c.swing.z};
                return all[k];
            };
            simulation.steps(96);
            EXPECT_NEAR(coordinate(), 0.5 * 96 * kJointStep, 2e-3);
            simulation.steps(384);
            EXPECT_NEAR(coordinate(), 0.2, 2e-3);
        }
}

/// The pin leans against the strut. B's anchor runs along A's axis and B turns about its pin alone, which A keeps.
TEST(DartJoints, AWheelTurnsAboutItsPinAndTravelsAlongItsStrut) {
    for (const bool reversed : {false, true}) {
        SCOPED_TRACE(reversed);
        Arm arm(JointType::Wheel, reversed);
        const Vec3 pin{0.6, 0.0, 0.8};
        arm.joint().axisA = arm.joint().axisB = {0, 0.6, 0.8};
        arm.joint().spinAxisB = pin;
        for (const std::size_t k : {0, 1}) arm.joint().axes[k].mode = AxisMode::Free;
        arm.joint().axes[0].stiffness = 40.0;
        arm.joint().axes[1].motorSpeed = 3.0;
        arm.joint().axes[1].motorMaxForce = 100.0;
        Simulation simulation(arm.s, kJointStep);
        double aside = 0.0, leant = 0.0, travelled = 0.0;
        for (int i = 0; i < 240; ++i) {
            simulation.steps(1);
            const BodyState A = stateOf(simulation, arm.a), B = stateOf(simulation, arm.b);
            const Pose a{A.position, A.orientation}, b{B.position, B.orientation};
            const Vec3 way = inverse(a) * (b * arm.joint().anchorB) - arm.joint().anchorA;
            const double along = dot(way, arm.joint().axisA);
            aside = std::max(aside, norm(way - along * arm.joint().axisA));
            leant = std::max(leant, norm(rotateInverse(a.orientation, rotate(b.orientation, pin)) - pin));
            travelled = std::max(travelled, std::abs(along));
            if (i < 24) continue;
            EXPECT_NEAR(dot(B.angularVelocity - A.angularVelocity, rotate(b.orientation, pin)), 3.0, 1e-6);
        }
        EXPECT_LT(aside, 1e-9);
        EXPECT_LT(leant, 1e-9);
        EXPECT_GT(travelled, 0.02);
    }
}

/// Two swings that are not both free are successive turns, which the ledger says; a body whose turns are all free has a
/// ball joint, as exact as the format's.
TEST(DartJoints, TwoSwingsAreSuccessiveTurnsUnlessAllTurnsAreFree) {
    for (const bool all : {false, true}) {
        Arm arm(JointType::SixDof, false);
        for (const std::size_t k : {4, 5}) arm.joint().axes[k].mode = AxisMode::Free;
        if (all) arm.joint().axes[3].mode = AxisMode::Free;
        Simulation simulation(arm.s, kJointStep);
        const auto* line = simulation.ledgerLine("six_dof_angles");
        ASSERT_EQ(line == nullptr, all);
        if (line != nullptr) {
            EXPECT_EQ(line->realisation, adapter::Realisation::Approximate);
        }
        double drift = 0.0, swung = 0.0;
        for (int i = 0; i < 240; ++i) {
            simulation.steps(1);
            const Coordinates c =
                coordinatesOf(arm.joint(), stateOf(simulation, arm.a), stateOf(simulation, arm.b));
            drift = std::max(drift, norm(c.travel));
            swung = std::max(swung, norm(c.swing));
        }
        EXPECT_LT(drift, 1e-9);
        EXPECT_GT(swung, 0.2);
    }
}

/// Two free rods in a line, each bent by one of the opposite turns, on a ball with a damped spring of the swing.
Scenario twoRods() {
    Scenario s = scene();
    s.gravity = {};
    for (const double side : {-1.0, 1.0}) {
        const int rod = addBody(s, Sphere{0.1}, {0.5 * side, 0, 0}, 1.0, even(0.1));
        s.bodies[rod].collides = false;
        s.bodies[rod].angularVelocity = {0, 0, -0.1 * side};
        s.bodies[rod].velocity = {0, -0.05, 0};
    }
    Joint joint;
    joint.name = "joint";
    joint.type = JointType::Ball;
    joint.bodyA = 0;
    joint.bodyB = 1;
    joint.anchorA = {0.5, 0, 0};
    joint.anchorB = {-0.5, 0, 0};
    joint.axisA = joint.axisB = {1, 0, 0};
    joint.axes[0].mode = AxisMode::Free;
    joint.axes[0].stiffness = 4.0;
    joint.axes[0].damping = 0.1;
    s.joints.push_back(joint);
    return s;
}

/// Each rod keeps its centre's height, so that 0.1 kg m^2 turn by theta = swing / 2:
/// 0.1 theta'' = -2 (4 theta + 0.1 theta').
TEST(DartJoints, ASpringOfASwingActsOnBothBodies) {
    const double rate = std::sqrt(80.0 - 1.0);
    Simulation simulation(twoRods(), kJointStep);
    ASSERT_NE(simulation.ledgerLine("swing_springs"), nullptr);
    for (int i = 1; i <= 480; ++i) {
        simulation.steps(1);
        const double t = i * kJointStep;
        const double turn = 0.1 * std::exp(-t) * (std::cos(rate * t) - std::sin(rate * t) / rate);
        ASSERT_NEAR(simulation.state(0).angularVelocity.z, turn, 1.5e-3) << i;
        ASSERT_NEAR(simulation.state(1).angularVelocity.z, -simulation.state(0).angularVelocity.z, 1e-9);
    }
}

/// The largest torque of the spring is 0.09 N m, at a swing of 0.022. A joint that has broken has no spring.
TEST(DartJoints, ASwingsSpringLoadsTheJoint) {
    for (const double strength : {0.1, 0.08}) {
        SCOPED_TRACE(strength);
        Scenario s = twoRods();
        s.joints[0].axes[0].damping = 0.0;
        s.joints[0].breakTorque = strength;
        Simulation simulation(s, kJointStep);
        simulation.steps(240);
        EXPECT_EQ(simulation.world->jointHolds(0), strength > 0.09);
        const double turn = simulation.state(1).angularVelocity.z;
        simulation.steps(60);
        if (strength < 0.09) {
            EXPECT_NEAR(simulation.state(1).angularVelocity.z, turn, 1e-12);
        }
    }
}

/// Travels, one, two or three successive turns, and all turns free.
TEST(DartJoints, StatesThatTheJointAllowsAreSetAndReadBack) {
    // A spring on the twist keeps all turns from being one ball.
    const auto spring = [](Arm& arm, std::size_t open) {
        if (open == 4) arm.joint().axes[3].stiffness = 1.0;
    };
    expectStatesReadBack({{0, 1, 2}, {0, 3}, {1, 4, 3}, {2, 5, 3}, {4, 5}, {0, 3, 4, 5}, {0, 1, 2, 3, 4, 5}},
                         spring);
}

}  // namespace
}  // namespace rigor::test
