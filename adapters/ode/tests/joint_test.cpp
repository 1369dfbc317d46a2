// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints that the adapter puts together from several of ODE's, and the traps on the way.
#include <cmath>

#include "adapters/interface/tests/joint_states.hpp"
#include "adapters/ode/tests/free_body.hpp"

namespace rigor::test {
namespace {

using scenario::AxisMode;
using scenario::fromAxisAngle;
using scenario::Pose;

constexpr double kPi = 3.14159265358979323846;
constexpr double kStep = 1.0 / 480.0;

Vec3 at(const BodyState& state, const Vec3& local) {
    return Pose{state.position, state.orientation} * local;
}
/// A damped spring of 2 Hz and damping ratio 0.1, let go `by` from its target.
double swungBack(double by, double time) {
    const double w = 2.0 * kPi * 2.0, zeta = 0.1, wd = w * std::sqrt(1.0 - zeta * zeta);
    return by * std::exp(-zeta * w * time) * (std::cos(wd * time) + zeta * w / wd * std::sin(wd * time));
}

/// Two free bodies on a spring by frequency: the reduced mass swings, and nothing else moves them.
TEST(OdeJoints, ASpringByFrequencySwingsTheReducedMassOfTwoBodies) {
    Scenario s = scene();
    s.gravity = {};
    const int a = addFree(s, {0, 0, 0}, 1.0, {0.1, 0.1, 0.1}),
              b = addFree(s, {1.5, 0, 0}, 3.0, {0.1, 0.1, 0.1});
    Joint joint = jointOf(JointType::Distance, a, b, {}, {});
    joint.length = 1.5;
    joint.axes[0].mode = AxisMode::Free;
    joint.axes[0].frequency = 2.0;
    joint.axes[0].dampingRatio = 0.1;
    joint.axes[0].target = 1.2;
    s.joints.push_back(joint);
    Simulation simulation(s, kStep);
    for (int i = 1; i <= 480; ++i) {
        simulation.steps(1);
        const Vec3 A = simulation.state(a).position, B = simulation.state(b).position;
        ASSERT_NEAR(norm(B - A) - 1.2, swungBack(0.3, i * kStep), 2e-2);
        ASSERT_NEAR(norm(A + 3.0 * B - Vec3{4.5, 0, 0}), 0.0, 1e-12);
    }
}

/// Two wheels of an axle turned against each other by a hinge's spring: I1 I2 / (I1 + I2) swings.
TEST(OdeJoints, AHingeSpringByFrequencySwingsTheReducedMomentOfTwoBodies) {
    Scenario s = scene();
    s.gravity = {};
    const int a = addFree(s, {}, 1.0, {0.4, 0.3, 0.2}), b = addFree(s, {}, 2.0, {0.5, 0.6, 0.6});
    Joint joint = jointOf(JointType::Hinge, a, b, {}, {});
    joint.axisA = joint.axisB = {0, 0, 1};
    joint.axes[0].mode = AxisMode::Free;
    joint.axes[0].frequency = 2.0;
    joint.axes[0].dampingRatio = 0.1;
    joint.axes[0].target = 0.3;
    s.joints.push_back(joint);
    Simulation simulation(s, kStep);
    const auto turn = [&](int body) {
        const Quat q = simulation.state(body).orientation;
        return 2.0 * std::atan2(q.z, q.w);
    };
    for (int i = 1; i <= 480; ++i) {
        simulation.steps(1);
        ASSERT_NEAR(turn(b) - turn(a) - 0.3, swungBack(-0.3, i * kStep), 2e-2);
    }
}

/// Trap: hinges measure angles from -pi to pi; a user-mode AMotor takes them over turns.
TEST(OdeJoints, AHingeStopsBeyondAWholeTurn) {
    Scenario s = scene();
    s.gravity = {};
    const int b = addFree(s, {}, 1.0, {0.5, 0.5, 0.5});
    Joint joint = jointOf(JointType::Hinge, scenario::kNone, b, {}, {});
    joint.axisA = joint.axisB = {0, 0, 1};
    joint.axes[0].mode = AxisMode::Limited;
    joint.axes[0].lower = -1.0;
    joint.axes[0].upper = 8.0;
    joint.axes[0].motorSpeed = 4.0;
    joint.axes[0].motorMaxForce = 2.0;
    s.joints.push_back(joint);
    Simulation simulation(s, kStep);
    double turned = 0.0;
    Quat before;
    for (int i = 0; i < 1920; ++i) {
        simulation.steps(1);
        const Quat q = simulation.state(b).orientation, d = conjugate(before) * q;
        turned += 2.0 * std::atan2(d.w < 0 ? -d.z : d.z, std::abs(d.w));
        before = q;
        // 4 rad/s^2 for 1 s, just fast enough.
        if (i == 479) {
            EXPECT_NEAR(turned, 2.0, 0.05);
        }
    }
    EXPECT_NEAR(turned, 8.0, 1e-2);
}

/// Trap: a spring takes the one set of stops that a hinge or slider has; limits and motor need another joint.
TEST(OdeJoints, SpringsStandBesideLimitsAndMotors) {
    for (const JointType type : {JointType::Hinge, JointType::Slider}) {
        Scenario s = scene();
        s.gravity = {};
        const int b = addFree(s, {}, 2.0, {2.0, 2.0, 2.0});
        Joint joint = jointOf(type, scenario::kNone, b, {}, {});
        joint.axisA = joint.axisB = {0, 0, 1};
        joint.axes[0].mode = AxisMode::Limited;
        joint.axes[0].lower = -1.0;
        joint.axes[0].upper = 0.25;
        joint.axes[0].stiffness = 300.0;
        joint.axes[0].damping = 10.0;
        joint.axes[0].target = 0.4;
        s.joints.push_back(joint);
        Simulation simulation(s, kStep);
        double furthest = 0.0;
        const auto value = [&] {
            const BodyState state = simulation.state(b);
            return type == JointType::Slider ? state.position.z
                                             : 2.0 * std::atan2(state.orientation.z, state.orientation.w);
        };
        for (int i = 0; i < 960; ++i) {
            simulation.steps(1);
            furthest = std::max(furthest, value());
        }
        EXPECT_LE(furthest, 0.27);
        EXPECT_NEAR(value(), 0.25, 1e-3);
    }
}

/// A ball joint whose swing is limited, and a cone-twist joint: a rod that falls rests on the edge of its
/// cone, in whatever direction it falls.
TEST(OdeJoints, ACompoundOfBallAndUserModeMotorIsACone) {
    for (const double azimuth : {0.0, 0.7, 2.5}) {
        Scenario s = scene();
        s.gravity = {0, -9.81 * std::cos(azimuth), -9.81 * std::sin(azimuth)};
        const int b = addFree(s, {0.5, 0, 0}, 2.0, {0.01, 0.2, 0.2});
        Joint joint = jointOf(JointType::ConeTwist, scenario::kNone, b, {}, {-0.5, 0, 0});
        joint.axisA = joint.axisB = {1, 0, 0};
        joint.axes[0].mode = AxisMode::Limited;
        joint.axes[0].lower = -0.2;
        joint.axes[0].upper = 0.3;
        joint.axes[1].mode = AxisMode::Limited;
        joint.axes[1].upper = 0.6;
        s.joints.push_back(joint);
        Simulation simulation(s, kStep);
        for (int i = 0; i < 960; ++i) {
            simulation.world->applyForce(b, {},
                                         0.05 * rotate(simulation.state(b).orientation, Vec3{1, 0, 0}));
            simulation.steps(1);
            EXPECT_LE(norm(at(simulation.state(b), {-0.5, 0, 0})), 5e-3);
        }
        const Quat q = simulation.state(b).orientation;
        EXPECT_NEAR(std::acos(rotate(q, Vec3{1, 0, 0}).x), 0.6, 2e-3) << azimuth;
        // The torque about its own axis turned it to the stop of the twist.
        EXPECT_NEAR(2.0 * std::atan2(q.x, q.w), 0.3, 5e-3) << azimuth;
    }
}

/// Two swing coordinates with limits of their own: the swing vector stays in its rectangle.
TEST(OdeJoints, SixDofTurnsStopAtTheirLimits) {
    Scenario s = scene();
    s.gravity = {};
    const int b = addFree(s, {}, 2.0, {0.2, 0.2, 0.2});
    Joint joint = jointOf(JointType::SixDof, scenario::kNone, b, {}, {});
    joint.axisA = joint.axisB = {1, 0, 0};
    joint.normalA = {0, 1, 0};
    joint.axes[4].mode = joint.axes[5].mode = AxisMode::Limited;
    joint.axes[4].lower = -0.5;
    joint.axes[4].upper = 0.3;
    joint.axes[5].lower = -0.2;
    joint.axes[5].upper = 0.7;
    s.joints.push_back(joint);
    Simulation simulation(s, kStep);
    for (int i = 0; i < 1440; ++i) {
        simulation.world->applyForce(b, {}, {0.3, 0.4, 0.4});
        simulation.steps(1);
    }
    const BodyState state = simulation.state(b);
    // The rotation vector is the swing vector, since there is no twist.
    const Vec3 v{state.orientation.x, state.orientation.y, state.orientation.z};
    const Vec3 turned = 2.0 * std::atan2(norm(v), state.orientation.w) / norm(v) * v;
    EXPECT_NEAR(turned.x, 0.0, 2e-3);
    EXPECT_NEAR(turned.y, 0.3, 5e-3);
    EXPECT_NEAR(turned.z, 0.7, 5e-3);
    EXPECT_LE(norm(state.position), 1e-6);
}

/// Trap: LMotor has no stops and acts at the centres of mass. Held and sprung travels by its speed are the
/// same rows; what it can not do is refused.
TEST(OdeJoints, ContactRowsHoldSpringAndDrive) {
    Scenario s = scene();
    const int b = addFree(s, {}, 2.0, {0.2, 0.2, 0.2});
    Joint joint = jointOf(JointType::SixDof, scenario::kNone, b, {}, {});
    joint.axisA = joint.axisB = {1, 0, 0};
    joint.normalA = {0, 1, 0};
    joint.axes[0].mode = joint.axes[2].mode = AxisMode::Free;
    joint.axes[0].motorSpeed = 1.0;
    joint.axes[0].motorMaxForce = 4.0;
    joint.axes[2].frequency = 2.0;
    joint.axes[2].dampingRatio = 0.1;
    joint.axes[2].target = -0.3;
    s.joints.push_back(joint);
    Simulation simulation(s, kStep);
    for (int i = 1; i <= 240; ++i) {
        simulation.steps(1);
        const BodyState state = simulation.state(b);
        ASSERT_NEAR(state.position.z + 0.3, swungBack(0.3, i * kStep), 2e-2);
        ASSERT_NEAR(state.position.y, 0.0, 1e-6);
        ASSERT_NEAR(state.velocity.x, std::min(1.0, 2.0 * i * kStep), 1e-6);
    }
}

/// The same rows between two free bodies, away from their centres of mass: momentum and angular momentum stay.
TEST(OdeJoints, ContactRowsPushBothBodiesAtOnePoint) {
    for (const bool turned : {false, true}) {
        Scenario s = scene();
        s.gravity = {};
        const int a = addFree(s, {}, 1.0, even(0.1)), b = addFree(s, {1.0, 0.2, 0}, 3.0, even(0.4));
        s.bodies[0].angularVelocity = {0, 0, 1.0};
        Joint joint = turned ? jointOf(JointType::SixDof, b, a, {-0.4, 0.3, 0}, {0.6, 0.5, 0})
                             : jointOf(JointType::SixDof, a, b, {0.6, 0.5, 0}, {-0.4, 0.3, 0});
        joint.axisA = joint.axisB = {1, 0, 0};
        joint.normalA = {0, 1, 0};
        joint.axes[0].mode = AxisMode::Limited;
        joint.axes[0].lower = -0.05;
        joint.axes[0].upper = 0.1;
        joint.axes[0].motorSpeed = -0.5;
        joint.axes[0].motorMaxForce = 2.0;
        joint.axes[1].mode = joint.axes[5].mode = AxisMode::Free;
        joint.axes[1].stiffness = 50.0;
        joint.axes[1].damping = 1.0;
        joint.axes[1].target = 0.1;
        s.joints.push_back(joint);
        Simulation simulation(s, kStep);
        double last = 0.0, highest = 0.0;
        for (int i = 1; i <= 480; ++i) {
            simulation.steps(1);
            const BodyState A = simulation.state(a), B = simulation.state(b);
            ASSERT_NEAR(norm(A.velocity + 3.0 * B.velocity), 0.0, 1e-10) << i;
            const Vec3 spin = 0.1 * A.angularVelocity + 0.4 * B.angularVelocity;
            ASSERT_NEAR((spin + cross(A.position, A.velocity) + 3.0 * cross(B.position, B.velocity)).z, 0.1,
                        2e-3);
            const BodyState &first = turned ? B : A, &second = turned ? A : B;
            const Vec3 offset =
                rotateInverse(first.orientation, at(second, joint.anchorB) - at(first, joint.anchorA));
            last = offset.x;
            highest = std::max(highest, offset.y);
            ASSERT_NEAR(offset.z, 0.0, 1e-6);
            ASSERT_GT(offset.x, -0.06);
        }
        EXPECT_NEAR(last, -0.05, 2e-3) << "driven to its lower stop";
        EXPECT_GT(highest, 0.05) << "pulled by its spring";
    }
}

/// A rope is wound in by a motor of a force that lifts its load, and stops at its shortest.
TEST(OdeJoints, AMotorAlongADistanceWindsItIn) {
    Scenario s = scene();
    const int b = addFree(s, {0, -1, 0}, 2.0, even(0.1));
    Joint joint = jointOf(JointType::Distance, scenario::kNone, b, {}, {});
    joint.length = 1.0;
    joint.axes[0].mode = AxisMode::Limited;
    joint.axes[0].lower = 0.6;
    joint.axes[0].upper = 1.0;
    joint.axes[0].motorSpeed = -0.5;
    joint.axes[0].motorMaxForce = 2.0 * 9.81 + 1.0;
    s.joints.push_back(joint);
    Simulation simulation(s, kStep);
    for (int i = 1; i <= 960; ++i) {
        simulation.steps(1);
        const BodyState state = simulation.state(b);
        if (i <= 360) {
            ASSERT_NEAR(state.velocity.y, std::min(0.5, 0.5 * i * kStep), 1e-5);
        }
        ASSERT_LT(state.position.y, -0.599);
    }
    EXPECT_NEAR(simulation.state(b).position.y, -0.6, 1e-3);
}

/// A suspension has stops and a motor, with a pin normal to the strut (Hinge2) or leaning (rows at the anchor).
TEST(OdeJoints, ASuspensionIsDrivenToItsStop) {
    for (const Vec3& pin : {Vec3{0, 0, 1}, Vec3{0, 0.6, 0.8}}) {
        SCOPED_TRACE(pin.y);
        Scenario s = scene();
        const int b = addFree(s, {0, 1, 0}, 2.0, even(0.1));
        Joint joint = jointOf(JointType::Wheel, scenario::kNone, b, {0, 1, 0}, {});
        joint.axisA = joint.axisB = {0, 1, 0};
        joint.spinAxisB = pin;
        joint.axes[0].mode = AxisMode::Limited;
        joint.axes[1].mode = AxisMode::Free;
        joint.axes[0].lower = -0.1;
        joint.axes[0].upper = 0.3;
        joint.axes[0].motorSpeed = 0.5;
        joint.axes[0].motorMaxForce = 2.0 * 9.81 + 4.0;
        s.joints.push_back(joint);
        Simulation simulation(s, kStep);
        simulation.steps(60);
        EXPECT_NEAR(simulation.state(b).velocity.y, 2.0 * 60 * kStep, 1e-6);
        simulation.steps(660);
        EXPECT_NEAR(simulation.state(b).position.y, 1.3, 1e-3);
    }
}

/// Trap: Hinge2's suspension pulls to the place of the anchors; its target is set by moving B for a moment. A
/// car of one wheel: the spring's force must not turn the wheel, however far it is from the chassis.
TEST(OdeJoints, AWheelOfAMovingChassisIsNotTurnedByItsSpring) {
    Scenario s = scene();
    s.gravity = {};
    const int chassis = addFree(s, {0, 0, 0}, 10.0, {2, 2, 2});
    const int wheel = addFree(s, {1.0, -0.5, 0.3}, 2.0, {0.04, 0.04, 0.05});
    Joint joint = jointOf(JointType::Wheel, chassis, wheel, {1.0, -0.5, 0.3}, {});
    joint.axisA = joint.axisB = {0, 1, 0};
    joint.spinAxisB = {0, 0, 1};
    joint.axes[0].mode = joint.axes[1].mode = AxisMode::Free;
    joint.axes[0].stiffness = 500.0;
    joint.axes[0].damping = 20.0;
    joint.axes[0].target = -0.1;
    s.joints.push_back(joint);
    Simulation simulation(s, kStep);
    double turned = 0.0;
    for (int i = 0; i < 480; ++i) {
        simulation.steps(1);
        turned = std::max(turned, std::abs(simulation.state(wheel).angularVelocity.z));
    }
    const BodyState A = simulation.state(chassis), B = simulation.state(wheel);
    const Vec3 travel = rotateInverse(A.orientation, B.position - A.position) - Vec3{1.0, -0.5, 0.3};
    EXPECT_NEAR(travel.y, -0.1, 2e-3);
    EXPECT_NEAR(std::hypot(travel.x, travel.z), 0.0, 1e-3);
    EXPECT_LE(turned, 1e-3);
}

/// A joint of several ODE joints breaks by the sum of their forces, in the step that first overloads it; what
/// it kept apart may touch from then on.
TEST(OdeJoints, BreaksByForceAndByTorqueAboutItsAnchor) {
    for (const bool torque : {false, true}) {
        Scenario s = scene();
        const int b = addFree(s, {0.5, 0, 0}, 4.0, {0.2, 0.2, 0.2});
        Joint joint = jointOf(JointType::Fixed, scenario::kNone, b, {}, {-0.5, 0, 0});
        (torque ? joint.breakTorque : joint.breakForce) = torque ? 0.5 * 4.0 * 9.81 + 1.0 : 4.0 * 9.81 + 2.0;
        s.joints.push_back(joint);
        Simulation simulation(s, kStep);
        for (int i = 0; i < 480; ++i) {
            // 1.9 N more hold either, 2.1 N more at the body (1.05 N m about the anchor) neither.
            simulation.world->applyForce(b, {0, i < 240 ? -1.9 : -2.1, 0}, {});
            simulation.steps(1);
            EXPECT_EQ(simulation.world->jointHolds(0), i < 240) << i;
        }
        const double t = 240 * kStep;
        EXPECT_NEAR(simulation.state(b).position.y, -0.5 * (9.81 + 2.1 / 4.0) * t * t, 2e-2);
    }
}

/// Trap: ODE normalises what orientation it is given; a snapshot has to come back to the bit.
TEST(OdeSnapshots, AManyTimesNormalisedOrientationComesBack) {
    Scenario s = scene(0.5);
    addStatic(s, Box{{5, 0.5, 5}}, {0, -0.5, 0});
    for (int i = 0; i < 5; ++i) {
        addBody(s, Box{{0.2, 0.3, 0.25}}, {0.1 * i, 1.0 + 0.7 * i, 0}, 1.0, {0.05, 0.03, 0.04});
        s.bodies.back().angularVelocity = {1.0 + i, -2.0, 0.5 * i};
    }
    for (const char* options : {"preset=matched", "stepper=quickstep", "gyroscopic=external"}) {
        Simulation simulation(s, 1.0 / 60.0, options);
        simulation.steps(37);
        std::vector<unsigned char> bytes;
        simulation.world->snapshots()->save(bytes);
        simulation.steps(60);
        std::vector<BodyState> first(s.bodies.size()), again(s.bodies.size());
        simulation.world->readStates(first);
        ASSERT_TRUE(simulation.world->snapshots()->restore(bytes));
        simulation.steps(60);
        simulation.world->readStates(again);
        for (std::size_t i = 0; i < first.size(); ++i) {
            EXPECT_EQ(first[i].position, again[i].position) << options;
            EXPECT_EQ(first[i].orientation, again[i].orientation) << options;
            EXPECT_EQ(first[i].angularVelocity, again[i].angularVelocity) << options;
        }
    }
}

}  // namespace
}  // namespace rigor::test
