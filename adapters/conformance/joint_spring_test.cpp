// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Springs of joints: bodies on them swing at the requested frequency and damping.
#include <cmath>

#include "adapters/conformance/joint_kit.hpp"

namespace rigor::conformance {
namespace {

/// Position of a body on a damped spring of 2 Hz and damping ratio 0.1, let go 0.3 m from its target.
double swungBack(double time) {
    const double w = 2.0 * kPi * 2.0, zeta = 0.1, wd = w * std::sqrt(1.0 - zeta * zeta);
    return 0.3 * std::exp(-zeta * w * time) * (std::cos(wd * time) + zeta * w / wd * std::sin(wd * time));
}

TEST_P(Joints, ADistanceSpringSwingsAtItsFrequency) {
    if (!hasJoint("distance.spring")) GTEST_SKIP() << "no distance springs";
    Scenario s = scene();
    const int b = addBody(s, ball(0.1), {1.5, 0, 0}, 2.0, {0.008, 0.008, 0.008});
    Joint joint = jointOf(JointType::Distance, scenario::kNone, b, {}, {});
    joint.length = 1.5;
    joint.axes[0].mode = scenario::AxisMode::Free;
    joint.axes[0].frequency = 2.0;
    joint.axes[0].dampingRatio = 0.1;
    joint.axes[0].target = 1.2;
    s.joints.push_back(joint);
    auto world = build(s, kStep);
    double worst = 0.0;
    for (int i = 1; i <= 480; ++i) {
        world->step();
        worst = std::max(worst, std::abs(stateOf(*world, s, b).position.x - 1.2 - swungBack(i * kStep)));
    }
    within("distance_spring", worst, 2e-2);
}

/// A frequency means the stiffness that it has at the initial poses: a wheel that hangs 0.25 m beside its
/// centre turns, and with it the lever that its spring moves.
TEST_P(Joints, ASpringByFrequencyKeepsTheStiffnessOfTheStart) {
    if (!hasJoint("wheel.spring")) GTEST_SKIP() << "no wheels with springs";
    const auto runOf = [&](bool byFrequency) {
        Scenario s = scene();
        const int b = addBody(s, ball(0.2), {0.25, 0, 0}, 4.0, {0.064, 0.064, 0.064});
        s.gravity = {0, -9.81, 0};
        Joint joint = jointOf(JointType::Wheel, scenario::kNone, b, {}, {-0.25, 0, 0});
        joint.axisA = joint.axisB = {0, 1, 0};
        joint.spinAxisB = {0, 0, 1};
        joint.axes[0].mode = joint.axes[1].mode = scenario::AxisMode::Free;
        const double omega = 2.0 * kPi * 1.5, mass = 1.0 / (1.0 / 4.0 + 0.25 * 0.25 / 0.064);
        if (byFrequency) {
            joint.axes[0].frequency = 1.5;
            joint.axes[0].dampingRatio = 0.1;
        } else {
            joint.axes[0].stiffness = mass * omega * omega;
            joint.axes[0].damping = 0.2 * mass * omega;
        }
        s.joints.push_back(joint);
        auto world = build(s, kStep);
        for (int i = 0; i < 480; ++i) world->step();
        return stateOf(*world, s, b).position;
    };
    within("spring_by_frequency", norm(runOf(true) - runOf(false)), 1e-4);
}

/// A door of moment 0.5 + 2 0.9^2 about its hinge: what swings at the requested frequency.
TEST_P(Joints, AHingeSpringSwingsWhatTurnsAboutTheHinge) {
    if (!hasJoint("hinge.spring")) GTEST_SKIP() << "no hinge springs";
    Scenario s = scene();
    const int b = addBody(s, block({0.9, 0.1, 0.1}), {0.9, 0, 0}, 2.0, {0.5, 0.5, 0.5});
    Joint joint = jointOf(JointType::Hinge, scenario::kNone, b, {}, {-0.9, 0, 0});
    joint.axisA = joint.axisB = {0, 0, 1};
    joint.axes[0].mode = scenario::AxisMode::Free;
    joint.axes[0].frequency = 2.0;
    joint.axes[0].dampingRatio = 0.1;
    joint.axes[0].target = -0.3;
    s.joints.push_back(joint);
    auto world = build(s, kStep);
    double worst = 0.0;
    for (int i = 1; i <= 480; ++i) {
        world->step();
        const Quat q = stateOf(*world, s, b).orientation;
        worst = std::max(worst, std::abs(2.0 * std::atan2(q.z, q.w) + 0.3 - swungBack(i * kStep)));
    }
    within("hinge_spring", worst, 2e-2);
}

TEST_P(Joints, ASliderSpringSwingsByStiffnessAndDamping) {
    if (!hasJoint("slider.spring")) GTEST_SKIP() << "no slider springs";
    Scenario s = scene();
    const Vec3 axis = is2d() ? Vec3{0.6, 0.8, 0} : Vec3{2, 3, 6} / 7.0;
    const int b = addBody(s, block({0.2, 0.1, 0.1}), {}, 2.0, {0.05, 0.05, 0.05});
    Joint joint = jointOf(JointType::Slider, scenario::kNone, b, {}, {});
    joint.axisA = joint.axisB = axis;
    const double w = 2.0 * kPi * 2.0;
    joint.axes[0].mode = scenario::AxisMode::Free;
    joint.axes[0].stiffness = 2.0 * w * w;
    joint.axes[0].damping = 2.0 * 2.0 * 0.1 * w;
    joint.axes[0].target = -0.3;
    s.joints.push_back(joint);
    auto world = build(s, kStep);
    double worst = 0.0;
    for (int i = 1; i <= 480; ++i) {
        world->step();
        worst =
            std::max(worst, std::abs(dot(stateOf(*world, s, b).position, axis) + 0.3 - swungBack(i * kStep)));
    }
    within("slider_spring", worst, 2e-2);
}

/// A pin in 3D need not be normal to its strut.
TEST_P(Joints, AWheelHasASpringAlongItsAxisAndAMotorAboutItsPin) {
    if (!hasJoint("wheel.spring") || !hasJoint("wheel.motor")) GTEST_SKIP() << "no driven wheels";
    for (const Vec3& pin : {Vec3{0, 0, 1}, Vec3{0, 0.6, 0.8}}) {
        if (is2d() && pin.y != 0.0) continue;
        SCOPED_TRACE("pin along y " + std::to_string(pin.y));
        Scenario s = scene();
        const int b = addBody(s, ball(0.2), {1, 1, 0}, 2.0, {0.04, 0.04, 0.04});
        Joint joint = jointOf(JointType::Wheel, scenario::kNone, b, {1, 1, 0}, {});
        joint.axisA = joint.axisB = {0, 1, 0};
        joint.spinAxisB = pin;
        joint.axes[0].mode = joint.axes[1].mode = scenario::AxisMode::Free;
        joint.axes[0].frequency = 2.0;
        joint.axes[0].dampingRatio = 0.1;
        joint.axes[0].target = -0.3;
        joint.axes[1].motorSpeed = 5.0;
        joint.axes[1].motorMaxForce = 0.2;
        s.joints.push_back(joint);
        std::string lacking;
        const auto world = buildIfOffered(s, lacking);
        if (!world) continue;  // the pin is not normal to the strut
        const auto spin = [&] { return dot(stateOf(*world, s, b).angularVelocity, pin); };
        double travel = 0.0, aside = 0.0, turned = 0.0;
        for (int i = 1; i <= 480; ++i) {
            world->step();
            const BodyState state = stateOf(*world, s, b);
            const Vec3 p = state.position;
            travel = std::max(travel, std::abs(p.y - 1.0 + 0.3 - swungBack(i * kStep)));
            aside = std::max(aside, norm(Vec3{p.x - 1.0, 0, p.z}));
            turned = std::max(turned, norm(rotate(state.orientation, pin) - pin));
            // 0.2 N m / 0.04 kg m^2 for half a second.
            if (i == 240) within("wheel_motor_start", std::abs(spin() - 2.5), 5e-2);
        }
        within("wheel_spring", travel, 2e-2);
        within("wheel_aside", aside, 2e-3);
        within("wheel_pin", turned, 2e-3);
        for (int i = 0; i < 240; ++i) world->step();
        within("wheel_motor_speed", std::abs(spin() - 5.0), 2e-2);
    }
}

/// A rod of moment 0.3 + 2 0.5^2 about its end that is thrown across its axis: the spring of the swing alone
/// acts, and the rod swings through zero like a pendulum of one plane, in whatever direction.
TEST_P(Joints, ASpringOfASwingBringsTheRodBack) {
    for (const JointType type : {JointType::Ball, JointType::ConeTwist}) {
        if (is2d() || !hasJoint(std::string(jointName(type)) + ".spring")) continue;
        for (const Vec3& across : {Vec3{0, 0, 1}, Vec3{0, 0.6, -0.8}}) {
            SCOPED_TRACE(jointName(type) + std::string(", about y ") + std::to_string(across.y));
            Scenario s = scene();
            const int b = addBody(s, block({0.5, 0.1, 0.1}), {0.5, 0, 0}, 2.0, {0.1, 0.3, 0.3});
            auto& body = s.bodies[b];
            body.angularVelocity = across;
            body.velocity = cross(across, Vec3{0.5, 0, 0});
            Joint joint = jointOf(type, scenario::kNone, b, {}, {-0.5, 0, 0});
            joint.axisA = joint.axisB = {1, 0, 0};
            const double omega = 2.0 * kPi;
            auto& swing = joint.axes[type == JointType::Ball ? 0 : 1];
            swing.mode = scenario::AxisMode::Free;
            swing.stiffness = 0.8 * omega * omega;
            s.joints.push_back(joint);
            auto world = build(s, kStep);
            double worst = 0.0;
            for (int i = 1; i <= 480; ++i) {
                world->step();
                const Quat turn = scenario::fromAxisAngle(across, std::sin(omega * i * kStep) / omega);
                worst = std::max(worst, norm(stateOf(*world, s, b).position - rotate(turn, Vec3{0.5, 0, 0})));
            }
            within("swing_spring", worst, 5e-3);
        }
    }
}

}  // namespace
}  // namespace rigor::conformance
