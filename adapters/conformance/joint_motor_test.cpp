// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Limits and motors of joints: what stops where, and what is driven at which speed with which force.
#include <cmath>

#include "adapters/conformance/joint_kit.hpp"

namespace rigor::conformance {
namespace {

/// A travel away from the centre of mass of a body that turns: the anchor runs along the axis at the motor's
/// speed, off it the anchor is held, and at the limit it stops.
TEST_P(Joints, ASixDofTravelActsAtItsAnchor) {
    if (!hasJoint("six_dof.limit") || !hasJoint("six_dof.motor")) GTEST_SKIP() << "no six_dof limits";
    Scenario s = scene();
    const Vec3 anchor{-0.3, 0.1, 0};
    const int b = addBody(s, block({0.2, 0.1, 0.1}), -anchor, 2.0, {0.1, 0.1, 0.1});
    s.bodies[0].angularVelocity = {0, 0, 3.0};
    s.bodies[0].velocity = Vec3{1.0, 0, 0} + cross(Vec3{0, 0, 3.0}, -anchor);
    Joint joint = jointOf(JointType::SixDof, scenario::kNone, b, {}, anchor);
    joint.axisA = joint.axisB = {1, 0, 0};
    joint.normalA = {0, 1, 0};
    joint.axes[0].mode = scenario::AxisMode::Limited;
    joint.axes[0].lower = -0.2;
    joint.axes[0].upper = 0.4;
    joint.axes[0].motorSpeed = 1.0;
    joint.axes[0].motorMaxForce = 1000.0;
    turnOf(joint).mode = scenario::AxisMode::Free;
    s.joints.push_back(joint);
    std::string lacking;
    const auto world = buildIfOffered(s, lacking);
    if (!world) GTEST_SKIP() << lacking;
    double travel = 0.0, aside = 0.0, limit = 0.0, turned = 0.0;
    for (int i = 1; i <= 384; ++i) {
        world->step();
        const BodyState state = stateOf(*world, s, b);
        const Vec3 p = at(state, anchor);
        if (i * kStep < 0.38) travel = std::max(travel, std::abs(p.x - i * kStep));
        if (i * kStep > 0.45) limit = std::max(limit, std::abs(p.x - 0.4));
        aside = std::max(aside, norm(Vec3{0, p.y, p.z}));
        turned = std::max(turned, angleBetween(state.orientation, Quat{}));
    }
    within("six_dof_motor", travel, 1e-2);
    within("six_dof_limit", limit, 1e-2);
    within("six_dof_held", aside, 5e-3);
    EXPECT_GT(turned, 1.0);
}

/// A torque of 1 N m turns a body of 0.5 kg m^2 against its stop; then it rests there.
TEST_P(Joints, AHingeStopsAtItsLimits) {
    if (!hasJoint("hinge.limit")) GTEST_SKIP() << "no hinge limits";
    for (const double side : {1.0, -1.0}) {
        Scenario s = scene();
        const int b = addBody(s, block({0.2, 0.1, 0.1}), {1, 1, 0}, 2.0, {0.5, 0.5, 0.5});
        Joint joint = jointOf(JointType::Hinge, scenario::kNone, b, {1, 1, 0}, {});
        joint.axisA = joint.axisB = Vec3{0, 0, 1};
        joint.axes[0].mode = scenario::AxisMode::Limited;
        joint.axes[0].lower = -0.4;
        joint.axes[0].upper = 0.7;
        s.joints.push_back(joint);
        auto world = build(s, kStep);
        double furthest = 0.0;
        const auto angle = [&] {
            const Quat q = stateOf(*world, s, b).orientation;
            return 2.0 * std::atan2(q.z, q.w);
        };
        for (int i = 0; i < 960; ++i) {
            world->applyForce(b, {}, {0, 0, side});
            world->step();
            furthest = std::max(furthest, side * angle());
        }
        const double stop = side > 0 ? 0.7 : 0.4;
        within("hinge_limit_beyond", furthest - stop, 1e-2);
        within("hinge_limit_rest", std::abs(side * angle() - stop), 2e-2);
        within("hinge_limit_speed", norm(stateOf(*world, s, b).angularVelocity), 2e-2);
    }
}

/// A motor without load accelerates by its torque over the inertia up to its speed, in its sense; overloaded
/// it yields.
TEST_P(Joints, AHingeMotorTurnsAtItsSpeedWithItsTorque) {
    if (!hasJoint("hinge.motor")) GTEST_SKIP() << "no hinge motors";
    for (const double load : {0.0, -1.5}) {
        Scenario s = scene();
        const int b = addBody(s, block({0.2, 0.1, 0.1}), {1, 1, 0}, 2.0, {0.5, 0.5, 0.5});
        Joint joint = jointOf(JointType::Hinge, scenario::kNone, b, {1, 1, 0}, {});
        joint.axisA = joint.axisB = Vec3{0, 0, 1};
        joint.axes[0].motorSpeed = 2.0;
        joint.axes[0].motorMaxForce = 1.0;
        s.joints.push_back(joint);
        auto world = build(s, kStep);
        for (int i = 0; i < 240; ++i) {
            world->applyForce(b, {}, {0, 0, load});
            world->step();
        }
        // Speeds after 0.5 s: 1 N m / 0.5 kg m^2 gives 1 rad/s; with the load -0.5 N m / 0.5 kg m^2.
        within("hinge_motor_start",
               std::abs(stateOf(*world, s, b).angularVelocity.z - (load == 0.0 ? 1.0 : -0.5)), 2e-2);
        if (load != 0.0) continue;
        for (int i = 0; i < 480; ++i) world->step();
        within("hinge_motor_speed", std::abs(stateOf(*world, s, b).angularVelocity.z - 2.0), 1e-2);
    }
}

/// Two rods in a line, the inner one driven, the outer one free on its pin. What is driven has eleven times more inertia
/// while the pin is held than it has in truth: a motor that takes the one for the other does not keep its speed.
TEST_P(Joints, AHingeMotorKeepsItsSpeedUnderALinkThatFolds) {
    if (!hasJoint("hinge.motor")) GTEST_SKIP() << "no hinge motors";
    Scenario s = scene();
    const int inner = addBody(s, block({0.2, 0.1, 0.1}), {0.2, 0, 0}, 0.5, {0.01, 0.01, 0.01});
    const int outer = addBody(s, block({0.4, 0.05, 0.05}), {0.9, 0, 0}, 0.5, {0.02, 0.02, 0.02});
    for (scenario::Body& body : s.bodies) body.collides = false;
    Joint drive = jointOf(JointType::Hinge, scenario::kNone, inner, {}, {-0.2, 0, 0});
    drive.axisA = drive.axisB = Vec3{0, 0, 1};
    drive.axes[0].motorSpeed = 2.0;
    drive.axes[0].motorMaxForce = 1000.0;
    Joint pin = jointOf(JointType::Hinge, inner, outer, {0.2, 0, 0}, {-0.5, 0, 0});
    pin.axisA = pin.axisB = Vec3{0, 0, 1};
    s.joints = {drive, pin};
    auto world = build(s, kStep);
    double farthest = 0.0;
    for (int i = 0; i < 480; ++i) {
        world->step();
        if (i >= 48)
            farthest = std::max(farthest, std::abs(stateOf(*world, s, inner).angularVelocity.z - 2.0));
    }
    within("hinge_motor_folding", farthest, 5e-2);
}

TEST_P(Joints, ASliderStopsAtItsLimitsAndIsDrivenByItsMotor) {
    if (!hasJoint("slider.limit") || !hasJoint("slider.motor")) GTEST_SKIP() << "no slider limits and motors";
    Scenario s = scene();
    const int b = addBody(s, block({0.2, 0.1, 0.1}), {}, 2.0, {0.05, 0.05, 0.05});
    Joint joint = jointOf(JointType::Slider, scenario::kNone, b, {}, {});
    joint.axisA = joint.axisB = is2d() ? Vec3{0.6, 0.8, 0} : Vec3{2, 3, 6} / 7.0;
    joint.axes[0].mode = scenario::AxisMode::Limited;
    joint.axes[0].lower = -0.2;
    joint.axes[0].upper = 0.5;
    joint.axes[0].motorSpeed = 1.0;
    joint.axes[0].motorMaxForce = 4.0;
    s.joints.push_back(joint);
    auto world = build(s, kStep);
    for (int i = 0; i < 120; ++i) world->step();
    // 4 N / 2 kg for 0.25 s.
    within("slider_motor_start", std::abs(dot(stateOf(*world, s, b).velocity, joint.axisA) - 0.5), 1e-2);
    for (int i = 0; i < 120; ++i) world->step();
    within("slider_motor_speed", std::abs(dot(stateOf(*world, s, b).velocity, joint.axisA) - 1.0), 1e-2);
    for (int i = 0; i < 480; ++i) world->step();
    within("slider_limit", std::abs(dot(stateOf(*world, s, b).position, joint.axisA) - 0.5), 1e-2);
}

TEST_P(Joints, ARopeIsSlackThenTaut) {
    if (!hasJoint("distance.limit")) GTEST_SKIP() << "no ropes";
    Scenario s = scene();
    s.gravity = {0, -9.81, 0};
    const int b = addBody(s, ball(0.1), {0, -0.5, 0}, 2.0, {0.008, 0.008, 0.008});
    Joint joint = jointOf(JointType::Distance, scenario::kNone, b, {}, {});
    joint.length = 0.5;
    joint.axes[0].mode = scenario::AxisMode::Limited;
    joint.axes[0].lower = 0.0;
    joint.axes[0].upper = 1.2;
    s.joints.push_back(joint);
    auto world = build(s, kStep);
    run(*world, 96);  // 0.2 s of free fall; symplectic Euler adds g t dt / 2
    within("rope_slack", std::abs(stateOf(*world, s, b).position.y + 0.5 + 0.5 * 9.81 * 0.04), 4e-3);
    run(*world, 864);
    within("rope_taut", std::abs(stateOf(*world, s, b).position.y + 1.2), 1e-2);
    within("rope_rest", norm(stateOf(*world, s, b).velocity), 2e-2);
}

}  // namespace
}  // namespace rigor::conformance
