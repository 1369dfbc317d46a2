// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// States of a body on a joint, set and read back: for adapters whose joints are coordinates of a tree.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "adapters/interface/state_setting.hpp"
#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {

inline Joint jointOf(JointType type, int a, int b, const Vec3& anchorA, const Vec3& anchorB) {
    Joint joint;
    joint.name = "joint";
    joint.type = type;
    joint.bodyA = a;
    joint.bodyB = b;
    joint.anchorA = anchorA;
    joint.anchorB = anchorB;
    return joint;
}

/// One body on a six_dof or a wheel whose axes are all locked. `reversed`: B is static and A hangs on it, else B hangs on
/// the world.
struct Arm {
    Scenario s = scene();
    int a = scenario::kNone, b = scenario::kNone;

    Arm(JointType type, bool reversed) {
        s.gravity = {0.3, -2.0, 0.5};
        Joint joint;
        joint.name = "joint";
        joint.type = type;
        joint.anchorA = {0.1, 0.2, -0.3};
        joint.anchorB = {-0.4, 0.1, 0.2};
        joint.axisA = joint.axisB = {1, 0, 0};
        joint.normalA = {0, 1, 0};
        joint.spinAxisB = {0.6, 0, 0.8};
        const Vec3 origin = joint.anchorA - joint.anchorB;
        if (reversed) {
            b = addStatic(s, Sphere{0.1}, origin);
            s.bodies[b].collides = false;
        }
        const int body = addBody(s, Sphere{0.1}, reversed ? Vec3{} : origin, 2.0, {0.1, 0.2, 0.25});
        s.bodies[body].collides = false;
        (reversed ? a : b) = body;
        joint.bodyA = a;
        joint.bodyB = b;
        s.joints.push_back(joint);
    }
    Joint& joint() { return s.joints[0]; }
    int moving() const { return a == scenario::kNone ? b : a; }
    /// Axes that move freely from now on.
    Arm& open(const std::vector<std::size_t>& axes) {
        for (const std::size_t k : axes) joint().axes[k].mode = scenario::AxisMode::Free;
        return *this;
    }
};

/// A force and a torque throw the body about for a quarter of a second. Its state is set into a world that is still where
/// both began, and is read back there.
inline void expectStateReadBack(const Arm& arm) {
    constexpr double kStep = 1.0 / 480.0;
    Simulation moved(arm.s, kStep), set(arm.s, kStep);
    for (int i = 0; i < 120; ++i) {
        moved.world->applyForce(arm.moving(), {1, 0.5, 1}, {0.3, 0.2, -0.25});
        moved.steps(1);
    }
    std::vector<BodyState> states(arm.s.bodies.size());
    moved.world->readStates(states);
    auto* setter = dynamic_cast<adapter::StateSetting*>(set.world.get());
    ASSERT_NE(setter, nullptr);
    setter->setStates(states);
    const BodyState &want = states[arm.moving()], have = set.state(arm.moving());
    EXPECT_GT(norm(want.velocity) + norm(want.angularVelocity), 0.1);
    EXPECT_LT(norm(have.position - want.position), 1e-9);
    EXPECT_LT(norm(have.velocity - want.velocity), 1e-9);
    EXPECT_LT(norm(have.angularVelocity - want.angularVelocity), 1e-9);
    const Quat left = conjugate(want.orientation) * have.orientation;
    EXPECT_LT(1.0 - std::abs(left.w), 1e-12);
}

/// The same for a six_dof with each of these sets of free axes, which `prepare` may change further, and for a wheel whose pin is
/// no axis of its strut; with either body moving.
template <class Prepare>
void expectStatesReadBack(const std::vector<std::vector<std::size_t>>& cases, const Prepare& prepare) {
    for (const bool reversed : {false, true}) {
        SCOPED_TRACE(reversed ? "reversed" : "");
        for (const auto& open : cases) {
            SCOPED_TRACE(std::to_string(open.size()) + " open");
            Arm arm = Arm(JointType::SixDof, reversed).open(open);
            prepare(arm, open.size());
            expectStateReadBack(arm);
        }
        expectStateReadBack(Arm(JointType::Wheel, reversed).open({0, 1}));
    }
}
inline void expectStatesReadBack(const std::vector<std::vector<std::size_t>>& cases) {
    expectStatesReadBack(cases, [](Arm&, std::size_t) {});
}

}  // namespace rigor::test
