// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints: anchors stay together, what is free moves as mechanics says, what is held does not.
#include <cmath>

#include "adapters/conformance/kit.hpp"

namespace rigor::conformance {
namespace {

class Joints : public DynamicsTest {
  protected:
    static constexpr double kStep = 1.0 / 480.0;

    static Joint jointOf(JointType type, int a, int b, const Vec3& anchorA, const Vec3& anchorB) {
        Joint joint;
        joint.name = "joint";
        joint.type = type;
        joint.bodyA = a;
        joint.bodyB = b;
        joint.anchorA = anchorA;
        joint.anchorB = anchorB;
        return joint;
    }
    static Vec3 at(const BodyState& state, const Vec3& local) {
        return Pose{state.position, state.orientation} * local;
    }
    /// Null, and what is lacking, where the library has the kind of joint but not this one of it.
    std::unique_ptr<adapter::World> buildIfOffered(const Scenario& s, std::string& lacking) {
        try {
            return build(s, kStep);
        } catch (const adapter::Unsupported& refused) {
            EXPECT_EQ(refused.refusal(), adapter::Refusal::NotInLibrary) << refused.what();
            lacking = refused.what();
            return nullptr;
        }
    }
    /// The angle about z of a six_dof whose axis is x and whose normal is y.
    scenario::JointAxis& turnOf(Joint& joint) const { return joint.axes[is2d() ? 2 : 5]; }
    /// Angle of a physical pendulum, theta'' = -k sin(theta), released at rest at `theta`, after `time`.
    static double pendulumAngle(double theta, double k, double time) {
        const int steps = 20000;
        const double h = time / steps;
        double rate = 0.0;
        for (int i = 0; i < steps; ++i) {  // Störmer-Verlet, error 1e-8
            rate -= 0.5 * h * k * std::sin(theta);
            theta += h * rate;
            rate -= 0.5 * h * k * std::sin(theta);
        }
        return theta;
    }
    /// A body hung beside its pivot and let go; its angle after 0.4 s must be that of the pendulum.
    void swing(JointType type) {
        Scenario s = scene();
        s.gravity = {0, -9.81, 0};
        const Vec3 pivot = flat({1.0, 2.0, 0.5});
        const double arm = 0.8, mass = 2.0, inertia = 0.1;
        const int b =
            addBody(s, block({0.2, 0.1, 0.1}), pivot + Vec3{arm, 0, 0}, mass, {inertia, inertia, inertia});
        s.joints.push_back(jointOf(type, scenario::kNone, b, pivot, {-arm, 0, 0}));
        if (type == JointType::SixDof) {
            Joint& joint = s.joints.back();
            joint.axisA = joint.axisB = {1, 0, 0};
            joint.normalA = {0, 1, 0};
            turnOf(joint).mode = scenario::AxisMode::Free;
        }
        auto world = build(s, kStep);
        double drift = 0.0;
        for (int i = 0; i < 192; ++i) {
            world->step();
            drift = std::max(drift, norm(at(stateOf(*world, s, b), {-arm, 0, 0}) - pivot));
        }
        const BodyState state = stateOf(*world, s, b);
        const double angle = std::atan2(state.position.x - pivot.x, pivot.y - state.position.y);
        const double k = mass * 9.81 * arm / (inertia + mass * arm * arm);
        within("anchor_drift", drift, 2e-3);
        within("pendulum_angle", std::abs(angle - pendulumAngle(kPi / 2, k, 0.4)), 2e-2);
    }
};
INSTANTIATE_TEST_SUITE_P(Kit, Joints, testing::ValuesIn(dynamicsArenas()), arenaName);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Joints);

TEST_P(Joints, ABodyOnABallJointIsAPendulum) {
    if (!hasJoint("ball")) GTEST_SKIP() << "no ball joint";
    if (is2d() && engine().capabilities().dimensions == std::vector<int>{2}) GTEST_SKIP() << "2D only";
    swing(JointType::Ball);
}

TEST_P(Joints, ABodyOnAHingeIsAPendulum) {
    if (!hasJoint("hinge")) GTEST_SKIP() << "no hinge";
    swing(JointType::Hinge);
}

TEST_P(Joints, ABodyOnASixDofWithAFreeAngleIsAPendulum) {
    if (!hasJoint("six_dof")) GTEST_SKIP() << "no six_dof";
    swing(JointType::SixDof);
}

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

TEST_P(Joints, AHingeTurnsAboutItsAxisAndNoOther) {
    if (!hasJoint("hinge")) GTEST_SKIP() << "no hinge";
    Scenario s = scene();
    const Vec3 axis = is2d() ? Vec3{0, 0, 1} : Vec3{1, 2, 2} / 3.0;
    const Quat start = is2d() ? fromAxisAngle({0, 0, 1}, 0.3) : fromAxisAngle({0, 1, 0}, 0.6);
    const int b = addBody(s, block({0.2, 0.1, 0.1}), {1, 1, 0}, 2.0, {0.5, 0.5, 0.5});
    s.bodies[0].pose.orientation = start;
    Joint joint = jointOf(JointType::Hinge, scenario::kNone, b, {1, 1, 0}, {});
    joint.axisA = axis;
    joint.axisB = rotateInverse(start, axis);
    s.joints.push_back(joint);
    auto world = build(s, kStep);
    const Vec3 across = is2d() ? Vec3{} : Vec3{2, -2, 1} / 3.0;
    for (int i = 0; i < 240; ++i) {
        world->applyForce(b, {}, 0.5 * axis + 0.5 * across);
        world->step();
    }
    // theta = tau t^2 / (2 I) with t = 0.5 s; symplectic Euler adds tau t dt / (2 I).
    const double angle = 0.5 / 0.5 * 0.5 * 0.5 / 2.0;
    const BodyState state = stateOf(*world, s, b);
    within("hinge_axis", norm(rotate(state.orientation, joint.axisB) - axis), 2e-3);
    within("hinge_angle", angleBetween(state.orientation, fromAxisAngle(axis, angle) * start), 3e-3);
    within("hinge_anchor", norm(state.position - Vec3{1, 1, 0}), 1e-3);
}

TEST_P(Joints, ASliderMovesAlongItsAxisWithoutTurning) {
    if (!hasJoint("slider")) GTEST_SKIP() << "no slider";
    Scenario s = scene();
    s.gravity = {0, -9.81, 0};
    const Vec3 axis = is2d() ? Vec3{0.6, -0.8, 0} : Vec3{2, -6, 3} / 7.0;
    const int b = addBody(s, block({0.2, 0.1, 0.1}), {}, 2.0, {0.05, 0.05, 0.05});
    Joint joint = jointOf(JointType::Slider, scenario::kNone, b, {}, {});
    joint.axisA = joint.axisB = axis;
    s.joints.push_back(joint);
    auto world = build(s, kStep);
    for (int i = 0; i < 240; ++i) {
        world->applyForce(b, {}, {0, 0, 0.2});
        world->step();
    }
    const BodyState state = stateOf(*world, s, b);
    const double along = dot(state.position, axis), t = 0.5;
    within("slider_travel", std::abs(along / (0.5 * dot(s.gravity, axis) * t * t) - 1.0), 1e-2);
    within("slider_aside", norm(state.position - along * axis), 2e-3);
    within("slider_turn", angleBetween(state.orientation, Quat{}), 2e-3);
}

TEST_P(Joints, AFixedJointHolds) {
    if (!hasJoint("fixed")) GTEST_SKIP() << "no fixed joint";
    Scenario s = scene();
    s.gravity = {0, -9.81, 0};
    const int b = addBody(s, block({0.2, 0.1, 0.1}), {1, 0, 0}, 2.0, {0.05, 0.05, 0.05});
    s.joints.push_back(jointOf(JointType::Fixed, scenario::kNone, b, {}, {-1, 0, 0}));
    auto world = build(s, kStep);
    run(*world, 480);
    const BodyState state = stateOf(*world, s, b);
    within("fixed_sag", norm(state.position - Vec3{1, 0, 0}), 5e-3);
    within("fixed_turn", angleBetween(state.orientation, Quat{}), 5e-3);
}

TEST_P(Joints, ARodKeepsItsLength) {
    if (!hasJoint("distance")) GTEST_SKIP() << "no distance joint";
    Scenario s = scene();
    s.gravity = {0, -9.81, 0};
    const double length = 1.5;
    const int b = addBody(s, ball(0.1), {length, 0, 0}, 2.0, {0.008, 0.008, 0.008});
    Joint joint = jointOf(JointType::Distance, scenario::kNone, b, {}, {});
    joint.length = length;
    s.joints.push_back(joint);
    std::string lacking;
    const auto world = buildIfOffered(s, lacking);
    if (!world) GTEST_SKIP() << lacking;
    double drift = 0.0;
    for (int i = 0; i < 240; ++i) {
        world->step();
        drift = std::max(drift, std::abs(norm(stateOf(*world, s, b).position) - length));
    }
    const Vec3 p = stateOf(*world, s, b).position;
    within("rod_length", drift, 5e-3);
    within("rod_angle", std::abs(std::atan2(p.x, -p.y) - pendulumAngle(kPi / 2, 9.81 / length, 0.5)), 2e-2);
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

TEST_P(Joints, TwoFreeBodiesOnAJointKeepTheirMomentum) {
    for (const auto& [type, name] :
         {std::pair{JointType::Ball, "ball"}, {JointType::Hinge, "hinge"}, {JointType::Fixed, "fixed"}}) {
        if (!hasJoint(name) || (is2d() && type == JointType::Ball)) continue;
        SCOPED_TRACE(name);
        Scenario s = scene();
        const int a = addBody(s, block({0.2, 0.1, 0.1}), {-0.5, 0, 0}, 1.0, {0.1, 0.1, 0.1});
        const int b = addBody(s, block({0.2, 0.1, 0.1}), {0.7, 0, 0}, 3.0, {0.3, 0.3, 0.3});
        // Velocities that agree at the anchor: the pair turns about its common centre and drifts.
        const double spin = 2.0;
        const Vec3 drift{0.3, 0.2, 0.0}, center{0.4, 0, 0};
        for (const int i : {a, b}) {
            Body& body = s.bodies[i];
            body.angularVelocity = {0, 0, spin};
            body.velocity = drift + cross(Vec3{0, 0, spin}, body.pose.position - center);
        }
        s.joints.push_back(jointOf(type, a, b, {0.5, 0, 0}, {-0.7, 0, 0}));
        auto world = build(s, kStep);
        double gap = 0.0;
        for (int i = 0; i < 240; ++i) {
            world->step();
            gap = std::max(
                gap, norm(at(stateOf(*world, s, a), {0.5, 0, 0}) - at(stateOf(*world, s, b), {-0.7, 0, 0})));
        }
        const BodyState stateA = stateOf(*world, s, a), stateB = stateOf(*world, s, b);
        within("joint_momentum", norm(stateA.velocity + 3.0 * stateB.velocity - 4.0 * drift),
               tol(1e-9, 1e-4));
        within("joint_gap", gap, 2e-3);
        EXPECT_NEAR(stateB.angularVelocity.z, spin, 0.05);
    }
}

}  // namespace
}  // namespace rigor::conformance
