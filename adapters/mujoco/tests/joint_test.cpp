// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints as trees: whichever body hangs on which, coordinates are the scenario's; what closes a loop is held by an
// equality constraint or refused by name.
#include <cmath>

#include "adapters/interface/tests/joint_states.hpp"

namespace rigor::test {
namespace {

using scenario::AxisMode;
using scenario::Pose;

constexpr double kStep = 1.0 / 480.0;

int addFree(Scenario& s, const Vec3& position, double mass = 1.0) {
    const int b = addBody(s, Sphere{0.1}, position, mass, even(0.1));
    s.bodies[b].collides = false;
    return b;
}
Vec3 at(const BodyState& state, const Vec3& local) {
    return Pose{state.position, state.orientation} * local;
}

/// A is the body that moves, and MuJoCo hangs it on B: the motor's speed is that of B against A.
TEST(MujocoJoints, CoordinatesOfAJointWhoseAHangsOnItsBKeepTheirSign) {
    for (const JointType type : {JointType::Hinge, JointType::Slider, JointType::Wheel}) {
        SCOPED_TRACE(jointName(type));
        Scenario s = scene();
        s.gravity = {};
        const int a = addFree(s, {0, 0, 0});
        const int b = addStatic(s, Sphere{0.1}, {1, 0, 0});
        s.bodies[b].collides = false;
        Joint joint = jointOf(type, a, b, {}, {-1, 0, 0});
        joint.axisA = joint.axisB = {0, 0.6, 0.8};
        joint.spinAxisB = {1, 0, 0};
        const bool wheel = type == JointType::Wheel;
        auto& axis = joint.axes[wheel ? 1 : 0];
        if (wheel) joint.axes[0].mode = AxisMode::Free;
        axis.mode = AxisMode::Free;
        axis.motorSpeed = 2.0;
        axis.motorMaxForce = 100.0;
        s.joints.push_back(joint);
        Simulation simulation(s, kStep);
        simulation.steps(10);
        const BodyState state = simulation.state(a);
        const Vec3 found = type == JointType::Slider ? state.velocity : state.angularVelocity;
        const Vec3 along = wheel ? Vec3{1, 0, 0} : joint.axisA;
        EXPECT_NEAR(norm(found + 2.0 * along), 0.0, 1e-6);
    }
}

/// A four-bar linkage: three joints are of the tree, the fourth closes it.
TEST(MujocoJoints, AFourBarLinkageStaysClosed) {
    Scenario s = scene();
    const int left = addFree(s, {0, -0.5, 0}), right = addFree(s, {1, -0.5, 0}),
              coupler = addFree(s, {0.5, -1, 0});
    const Vec3 z{0, 0, 1};
    const auto hinge = [&](int a, int b, const Vec3& anchorA, const Vec3& anchorB) {
        Joint joint = jointOf(JointType::Hinge, a, b, anchorA, anchorB);
        joint.axisA = joint.axisB = z;
        s.joints.push_back(joint);
    };
    hinge(scenario::kNone, left, {0, 0, 0}, {0, 0.5, 0});
    hinge(scenario::kNone, right, {1, 0, 0}, {0, 0.5, 0});
    hinge(left, coupler, {0, -0.5, 0}, {-0.5, 0, 0});
    hinge(coupler, right, {0.5, 0, 0}, {0, -0.5, 0});
    for (const int b : {left, right}) {
        s.bodies[b].angularVelocity = {0, 0, 3};
        s.bodies[b].velocity = {1.5, 0, 0};
    }
    s.bodies[coupler].velocity = {3, 0, 0};
    Simulation simulation(s, kStep);
    double gap = 0.0, turned = 0.0;
    for (int i = 0; i < 480; ++i) {
        simulation.steps(1);
        for (const Joint& joint : s.joints) {
            const Vec3 a = joint.bodyA == scenario::kNone ? joint.anchorA
                                                          : at(simulation.state(joint.bodyA), joint.anchorA);
            gap = std::max(gap, norm(a - at(simulation.state(joint.bodyB), joint.anchorB)));
        }
        turned = std::max(turned, std::abs(simulation.state(coupler).position.x - 0.5));
    }
    EXPECT_LT(gap, 2e-3);
    EXPECT_GT(turned, 0.3);
    EXPECT_NE(simulation.ledgerLine("loops"), nullptr);
}

TEST(MujocoJoints, ALoopThatNoEqualityHoldsIsRefusedByName) {
    Scenario s = scene();
    const int a = addFree(s, {0, 0, 0}), b = addFree(s, {1, 0, 0});
    for (const auto& [from, to] : {std::pair{scenario::kNone, a}, {a, b}, {b, a}}) {
        Joint slider = jointOf(JointType::Slider, from, to, {}, {});
        slider.axisA = slider.axisB = {1, 0, 0};
        s.joints.push_back(slider);
    }
    try {
        Simulation simulation(s, kStep);
        ADD_FAILURE() << "built";
    } catch (const adapter::Unsupported& refused) {
        EXPECT_NE(std::string(refused.what()).find("slider"), std::string::npos) << refused.what();
        EXPECT_NE(std::string(refused.what()).find("loop"), std::string::npos) << refused.what();
    }
}

/// A hinge that closes a loop is one of the tree where a slider would have to close it otherwise.
TEST(MujocoJoints, WhatCanNotCloseALoopIsOfTheTree) {
    Scenario s = scene();
    const int crank = addFree(s, {0.25, 0, 0}), rod = addFree(s, {1, 0, 0}), piston = addFree(s, {1.5, 0, 0});
    const auto add = [&](JointType type, int a, int b, const Vec3& anchorA, const Vec3& anchorB,
                         const Vec3& axis) {
        Joint joint = jointOf(type, a, b, anchorA, anchorB);
        joint.axisA = joint.axisB = axis;
        s.joints.push_back(joint);
    };
    const Vec3 x{1, 0, 0}, z{0, 0, 1};
    add(JointType::Hinge, scenario::kNone, crank, {}, {-0.25, 0, 0}, z);
    add(JointType::Hinge, crank, rod, {0.25, 0, 0}, {-0.5, 0, 0}, z);
    add(JointType::Hinge, rod, piston, {0.5, 0, 0}, {}, z);
    add(JointType::Slider, scenario::kNone, piston, {1.5, 0, 0}, {}, x);
    Simulation simulation(s, kStep);
    simulation.steps(240);
    const BodyState state = simulation.state(piston);
    EXPECT_LT(std::abs(state.position.y), 1e-12) << "the slider is exact";
    EXPECT_GT(std::abs(state.position.x - 1.5), 0.01);
    EXPECT_LT(norm(at(simulation.state(rod), {0.5, 0, 0}) - state.position), 2e-3);
}

/// Momentum of two free bodies on a hinge drifts with Euler's step in reduced coordinates, and with its first order.
TEST(MujocoJoints, MomentumOfAFreeTreeConvergesWithTheStep) {
    double drift[2] = {};
    for (const int fine : {0, 1}) {
        Scenario s = scene();
        s.gravity = {};
        const int a = addFree(s, {-0.5, 0, 0}, 1.0), b = addFree(s, {0.7, 0, 0}, 3.0);
        Joint joint = jointOf(JointType::Hinge, a, b, {0.5, 0, 0}, {-0.7, 0, 0});
        joint.axisA = joint.axisB = {0, 0, 1};
        s.joints.push_back(joint);
        for (const int i : {a, b}) {
            s.bodies[i].angularVelocity = {0, 0, 2};
            s.bodies[i].velocity = cross(Vec3{0, 0, 2}, s.bodies[i].pose.position - Vec3{0.4, 0, 0});
        }
        const int steps = fine == 1 ? 960 : 240;
        Simulation simulation(s, 0.5 / steps);
        simulation.steps(steps);
        drift[fine] = norm(simulation.state(a).velocity + 3.0 * simulation.state(b).velocity);
    }
    EXPECT_GT(drift[0], 1e-4);
    EXPECT_NEAR(drift[0] / drift[1], 4.0, 0.4);
}

/// The state of every body of a tree can be set: it is the coordinates of its joints that change.
TEST(MujocoJoints, StatesOfATreeCanBeSet) {
    Scenario s = scene();
    const int a = addFree(s, {0.5, 0, 0}), b = addFree(s, {1.5, 0, 0});
    for (const auto& [parent, child, anchor] :
         {std::tuple{scenario::kNone, a, Vec3{}}, {a, b, Vec3{0.5, 0, 0}}}) {
        Joint joint = jointOf(JointType::Ball, parent, child, anchor, {-0.5, 0, 0});
        s.joints.push_back(joint);
    }
    Simulation first(s, kStep), second(s, kStep);
    first.steps(100);
    auto* setter = dynamic_cast<adapter::StateSetting*>(second.world.get());
    ASSERT_NE(setter, nullptr);
    std::vector<BodyState> states(s.bodies.size());
    first.world->readStates(states);
    setter->setStates(states);
    first.steps(50);
    second.steps(50);
    for (const int body : {a, b}) {
        EXPECT_LT(norm(first.state(body).position - second.state(body).position), 1e-9);
        EXPECT_LT(norm(first.state(body).angularVelocity - second.state(body).angularVelocity), 1e-8);
    }
}

/// Travels with one turn and with all of them free, and a wheel whose pin is no axis of its strut.
TEST(MujocoJoints, StatesThatTheJointAllowsAreSetAndReadBack) {
    expectStatesReadBack({{0, 1, 2}, {0, 4}, {0, 1, 2, 5}, {0, 1, 2, 3, 4, 5}});
}

}  // namespace
}  // namespace rigor::test
