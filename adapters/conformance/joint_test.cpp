// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints: anchors stay together, what is free moves as mechanics says, what is held does not.
#include <cmath>

#include "adapters/conformance/joint_kit.hpp"

namespace rigor::conformance {

INSTANTIATE_TEST_SUITE_P(Kit, Joints, testing::ValuesIn(dynamicsArenas()), arenaName);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Joints);

void Joints::swing(JointType type) {
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

namespace {

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
