// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Springs, motors and strength of joints whose coordinates no mobilizer of Simbody's has, by closed forms, and of all
// joints beside the trees, by the same joints in trees.
#include <cmath>
#include <numbers>

#include "adapters/interface/tests/joint_states.hpp"

namespace rigor::test {
namespace {

using scenario::AxisMode;
using scenario::JointAxis;

constexpr double kJointStep = 1.0 / 240.0;

int addFree(Scenario& s, const Vec3& position, double mass, const Vec3& moments) {
    const int body = addBody(s, Sphere{0.1}, position, mass, moments);
    s.bodies[body].collides = false;
    return body;
}

Joint& addJoint(Scenario& s, JointType type, int a, int b, const Vec3& anchorA = {},
                const Vec3& anchorB = {}) {
    Joint joint = jointOf(type, a, b, anchorA, anchorB);
    joint.axisA = joint.axisB = {1, 0, 0};
    joint.normalA = {0, 1, 0};
    return s.joints.emplace_back(joint);
}

void drive(JointAxis& axis, double speed, double maxForce) {
    axis.mode = AxisMode::Free;
    axis.motorSpeed = speed;
    axis.motorMaxForce = maxForce;
}

/// Rate of the twist about an axis x of the world, b in the body: (x + b) . w / (1 + x . b).
double twistRate(const BodyState& state, const Vec3& axis) {
    const Vec3 b = rotate(state.orientation, axis);
    return dot(axis + b, state.angularVelocity) / (1.0 + dot(axis, b));
}

TEST(SimbodyJoints, AMotorOfATwistAcceleratesByItsTorqueAndKeepsItsSpeed) {
    Scenario s = scene();
    const int b = addFree(s, {}, 2.0, {0.5, 0.3, 0.3});
    drive(addJoint(s, JointType::ConeTwist, scenario::kNone, b).axes[0], 2.0, 0.4);
    Simulation world(s, kJointStep, "preset=matched");
    world.steps(240);
    EXPECT_NEAR(world.state(b).angularVelocity.x, 0.4 / 0.5, 1e-9);
    world.steps(480);
    EXPECT_NEAR(world.state(b).angularVelocity.x, 2.0, 1e-9);
    // A torque across the axis swings the body; the twist keeps its speed.
    s.joints[0].axes[0].motorMaxForce = 100.0;
    Simulation strong(s, kJointStep, "preset=matched");
    double swing = 0.0;
    for (int i = 0; i < 240; ++i) {
        strong.world->applyForce(b, {}, {0, 0.3, 0.1});
        strong.steps(1);
        if (i > 10) {
            ASSERT_NEAR(twistRate(strong.state(b), {1, 0, 0}), 2.0, 1e-7) << i;
        }
        swing = std::max(swing, 1.0 - rotate(strong.state(b).orientation, Vec3{1, 0, 0}).x);
    }
    EXPECT_GT(swing, 0.05);
}

/// Two free bodies of 1 and 3 kg: 6 N drive them apart by 8 m/s^2, and they keep their momentum.
TEST(SimbodyJoints, AMotorOfADistanceActsOnBothBodies) {
    for (const double across : {0.0, 1.5}) {
        SCOPED_TRACE(across);
        Scenario s = scene();
        s.gravity = {};
        const int a = addFree(s, {}, 1.0, even(0.1)), b = addFree(s, {2, 0, 0}, 3.0, even(0.1));
        s.bodies[b].velocity = {0, across, 0};
        Joint& joint = addJoint(s, JointType::Distance, a, b);
        joint.length = 2.0;
        drive(joint.axes[0], 2.0, 6.0);
        Simulation world(s, kJointStep, "preset=matched");
        const auto rate = [&] {
            const BodyState A = world.state(a), B = world.state(b);
            const Vec3 span = B.position - A.position;
            return dot(B.velocity - A.velocity, span) / norm(span);
        };
        world.steps(30);
        if (across == 0.0) {
            EXPECT_NEAR(rate(), 1.0, 1e-9);
        }
        for (int i = 0; i < 210; ++i) {
            world.steps(1);
            if (i > 60) {
                ASSERT_NEAR(rate(), 2.0, 1e-7) << i;
            }
        }
        const Vec3 momentum = world.state(a).velocity + 3.0 * world.state(b).velocity;
        EXPECT_LT(norm(momentum - Vec3{0, 3.0 * across, 0}), 1e-8);
    }
}

/// A body thrown about the axis swings over two turns to either side, with the period of its spring.
TEST(SimbodyJoints, ASpringOfATwistCountsTurns) {
    Scenario s = scene();
    const int b = addFree(s, {}, 2.0, {0.5, 0.3, 0.3});
    const double omega = 3.0, farthest = 14.0;
    s.bodies[b].angularVelocity = {farthest * omega, 0, 0};
    JointAxis& twist = addJoint(s, JointType::ConeTwist, scenario::kNone, b).axes[0];
    twist.mode = AxisMode::Free;
    twist.stiffness = 0.5 * omega * omega;
    Simulation world(s, kJointStep, "preset=reference"), other(s, kJointStep, "preset=reference");
    for (int i = 1; i <= 720; ++i) {
        world.steps(1);
        ASSERT_NEAR(world.state(b).angularVelocity.x, farthest * omega * std::cos(omega * i * kJointStep),
                    1e-5)
            << i;
        if (i != 100) continue;
        std::vector<unsigned char> bytes;
        world.world->snapshots()->save(bytes);
        ASSERT_TRUE(other.world->snapshots()->restore(bytes));
    }
    other.steps(620);
    EXPECT_EQ(other.state(b).angularVelocity.x, world.state(b).angularVelocity.x);
}

/// A joint by its coordinates that are open, sprung and driven.
struct Case {
    JointType type;
    std::vector<std::size_t> open, sprung, driven;
};

const std::vector<Case>& cases() {
    static const std::vector<Case> all{
        {JointType::Hinge, {0}, {0}, {}},
        {JointType::Hinge, {0}, {}, {0}},
        {JointType::Slider, {0}, {0}, {}},
        {JointType::Slider, {0}, {}, {0}},
        {JointType::Ball, {0}, {0}, {}},
        {JointType::ConeTwist, {0, 1}, {0, 1}, {}},
        {JointType::ConeTwist, {0, 1}, {1}, {0}},
        {JointType::ConeTwist, {0}, {0}, {}},
        {JointType::ConeTwist, {1}, {1}, {}},
        {JointType::Wheel, {0, 1}, {0}, {1}},
        {JointType::Wheel, {1}, {1}, {}},
        {JointType::SixDof, {0}, {0}, {}},
        {JointType::SixDof, {0, 1, 2, 4}, {0, 1, 2}, {4}},
        {JointType::SixDof, {3}, {3}, {}},
        {JointType::SixDof, {4, 5}, {4, 5}, {}},
        {JointType::SixDof, {3, 5}, {5}, {3}},
        {JointType::SixDof, {1, 3, 4}, {1, 3}, {4}},
        {JointType::SixDof, {0, 1, 2, 3, 4, 5}, {0, 1, 2, 4, 5}, {3}},
    };
    return all;
}

Arm armOf(const Case& of, bool reversed) {
    Arm arm(of.type, reversed);
    for (JointAxis& axis : arm.joint().axes) axis.mode = AxisMode::Locked;
    arm.open(of.open);
    if (of.type != JointType::Wheel) arm.joint().spinAxisB = {0, 0, 1};
    for (const std::size_t k : of.sprung) {
        arm.joint().axes[k].stiffness = 20.0;
        arm.joint().axes[k].damping = 0.3;
        const bool isSwing = of.type == JointType::Ball || (of.type == JointType::ConeTwist && k == 1);
        arm.joint().axes[k].target = isSwing ? 0.0 : 0.1;
    }
    for (const std::size_t k : of.driven) drive(arm.joint().axes[k], 0.7, 40.0);
    return arm;
}

std::string name(const Case& of) {
    std::string text = scenario::jointName(of.type);
    for (const std::size_t k : of.open) text += " " + std::to_string(k);
    return text;
}

double angleBetween(const Quat& a, const Quat& b) {
    const Quat turn = conjugate(a) * b;
    return 2.0 * std::atan2(norm(Vec3{turn.x, turn.y, turn.z}), std::abs(turn.w));
}

/// Largest difference of place and turn between two worlds that move alike, in half a second.
double difference(const Arm& one, const Arm& other) {
    Simulation a(one.s, kJointStep, "preset=reference"), b(other.s, kJointStep, "preset=reference");
    double most = 0.0, moved = 0.0;
    const Vec3 start = a.state(one.moving()).position;
    const Quat upright = a.state(one.moving()).orientation;
    for (int i = 0; i < 120; ++i) {
        for (Simulation* world : {&a, &b}) {
            world->world->applyForce(one.moving(), {0.5, 0.2, 0.4}, {0.1, 0.2, -0.3});
            world->steps(1);
        }
        const BodyState x = a.state(one.moving()), y = b.state(other.moving());
        most = std::max(most, norm(x.position - y.position) + angleBetween(x.orientation, y.orientation));
        moved = std::max(moved, norm(x.position - start) + angleBetween(x.orientation, upright));
    }
    EXPECT_GT(moved, 0.015);
    return most;
}

/// A joint that is strong enough is made of constraints, forces at the two bodies, and no mobilizer.
TEST(SimbodyJoints, AJointThatCouldBreakMovesAsTheOneInATree) {
    for (const Case& of : cases())
        for (const bool reversed : {false, true}) {
            SCOPED_TRACE(name(of) + (reversed ? ", reversed" : ""));
            const Arm tree = armOf(of, reversed);
            Arm strong = tree;
            strong.joint().breakForce = 1e6;
            EXPECT_LT(difference(tree, strong), 2e-6);
        }
}

/// Two equal joints in parallel, of which one closes a loop, act as one of twice the strength.
TEST(SimbodyJoints, SpringsOfALoopActBesideThoseOfTheTree) {
    for (const Case& of : cases()) {
        if (!of.driven.empty()) continue;
        SCOPED_TRACE(name(of));
        Arm twice = armOf(of, false);
        Arm loop = twice;
        loop.s.joints.push_back(loop.joint());
        for (const std::size_t k : of.sprung) {
            twice.joint().axes[k].stiffness *= 2.0;
            twice.joint().axes[k].damping *= 2.0;
        }
        EXPECT_LT(difference(twice, loop), 2e-6);
    }
}

/// 4 kg hang below a joint, by what it locks, by a damped spring or by a motor, at a strength of 2 N above their weight.
TEST(SimbodyJoints, AJointBreaksByWhatItsSpringsAndMotorsBear) {
    constexpr double kWeight = 4.0 * 9.81;
    enum class By { Lock, Spring, Motor };
    const std::tuple<JointType, std::size_t, By> all[] = {
        {JointType::ConeTwist, 0, By::Lock},  {JointType::Wheel, 0, By::Lock},
        {JointType::SixDof, 0, By::Lock},     {JointType::Slider, 0, By::Spring},
        {JointType::Wheel, 0, By::Spring},    {JointType::SixDof, 1, By::Spring},
        {JointType::Distance, 0, By::Spring}, {JointType::Slider, 0, By::Motor},
        {JointType::Wheel, 0, By::Motor},     {JointType::SixDof, 1, By::Motor},
        {JointType::Distance, 0, By::Motor}};
    for (const auto& [type, axis, by] : all) {
        SCOPED_TRACE(scenario::jointName(type) + std::string(" ") + std::to_string(static_cast<int>(by)));
        Scenario s = scene();
        s.gravity = {0, -9.81, 0};
        const int b = addFree(s, {0, -0.5, 0}, 4.0, even(0.1));
        const bool isRod = type == JointType::Distance;
        Joint& joint = addJoint(s, type, scenario::kNone, b, {}, isRod ? Vec3{} : Vec3{0, 0.5, 0});
        joint.length = 0.5;
        joint.spinAxisB = {0, 1, 0};
        if (type == JointType::Slider || type == JointType::Wheel) joint.axisA = joint.axisB = {0, 1, 0};
        JointAxis& use = joint.axes[axis];
        use.mode = by == By::Lock && type != JointType::ConeTwist ? AxisMode::Locked : AxisMode::Free;
        if (by == By::Spring) {
            use.stiffness = 1e4;
            use.damping = 600.0;
            use.target = isRod ? 0.5 - kWeight / 1e4 : kWeight / 1e4;
        }
        if (by == By::Motor) drive(use, 0.0, 1000.0);
        joint.breakForce = kWeight + 2.0;
        Simulation world(s, kJointStep);
        for (int i = 0; i < 240; ++i) {
            world.world->applyForce(b, {0, i < 120 ? -1.5 : -2.1, 0}, {});
            world.steps(1);
            if (i < 120) {
                ASSERT_TRUE(world.world->jointHolds(0)) << i;
            }
            // A lock or a motor holds nothing any more in the step that overloads it.
            if (i == 120 && by != By::Spring) {
                EXPECT_NEAR(world.state(b).velocity.y, -(9.81 + 2.1 / 4.0) * kJointStep, 1e-9);
            }
        }
        EXPECT_FALSE(world.world->jointHolds(0));
        const double speed = world.state(b).velocity.y;
        world.steps(24);
        EXPECT_NEAR(world.state(b).velocity.y - speed, -9.81 * 24 * kJointStep, 1e-9);
    }
}

/// At rest a joint bears the torque from outside, however its springs and locks share it, whose directions are not normal to
/// each other where the body has swung.
TEST(SimbodyJoints, AJointBreaksByTheSumOfItsTorques) {
    for (const bool above : {false, true}) {
        Scenario s = scene();
        const int b = addFree(s, {}, 4.0, even(0.1));
        Joint& joint = addJoint(s, JointType::SixDof, scenario::kNone, b);
        for (const std::size_t k : {4, 5}) {
            joint.axes[k].mode = AxisMode::Free;
            joint.axes[k].stiffness = 1.0;
            joint.axes[k].damping = 1.5;
        }
        joint.breakTorque = 1.0;
        Simulation world(s, kJointStep);
        for (int i = 0; i < 3600; ++i) {
            const double part = std::min(1.0, i / 600.0) * (above ? 1.01 : 0.99);
            world.world->applyForce(b, {}, {0.48 * part, 0.64 * part, 0.6 * part});
            world.steps(1);
        }
        EXPECT_EQ(world.world->jointHolds(0), !above);
        if (above) continue;
        EXPECT_GT(std::acos(rotate(world.state(b).orientation, Vec3{1, 0, 0}).x), 0.6);
        EXPECT_LT(norm(world.state(b).angularVelocity), 1e-3);
    }
}

}  // namespace
}  // namespace rigor::test
