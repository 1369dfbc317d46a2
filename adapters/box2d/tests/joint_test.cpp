// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Springs put together from several of Box2D's joints, dampers without a spring, joints that break.
#include <algorithm>
#include <cmath>

#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

constexpr double kJointStep = 1.0 / 480;

Scenario plane() {
    return scene(0.0, 0.0, 2);
}

Joint onWorld(JointType type, int body, const Vec3& anchor, const Vec3& inBody = {}) {
    Joint joint;
    joint.name = "joint";
    joint.type = type;
    joint.bodyA = scenario::kNone;
    joint.bodyB = body;
    joint.anchorA = anchor;
    joint.anchorB = inBody;
    joint.axisA = joint.axisB = type == JointType::Hinge ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    return joint;
}

double angleOf(const BodyState& state) {
    return angleAboutZ(state.orientation);
}

/// Box2D leaves out the damper of a spring whose stiffness is zero: with friction alone v = v0 exp(-c t / m).
TEST(Box2dSprings, ADamperWithoutStiffnessDamps) {
    for (const char* options : {"preset=default", "preset=matched"})
        for (const JointType type :
             {JointType::Slider, JointType::Hinge, JointType::Distance, JointType::Wheel}) {
            SCOPED_TRACE(jointName(type));
            Scenario s = plane();
            s.gravity = {};
            const int b = addBody(s, Sphere{0.1}, {2, 0, 0}, 2.0, {0.5, 0.5, 0.5});
            s.bodies[0].collides = false;
            const bool turns = type == JointType::Hinge;
            s.bodies[0].velocity = turns ? Vec3{} : Vec3{0.3, 0, 0};
            s.bodies[0].angularVelocity = turns ? Vec3{0, 0, 0.3} : Vec3{};
            const bool rod = type == JointType::Distance;
            Joint joint = onWorld(type, b, rod ? Vec3{1, 0, 0} : Vec3{2, 0, 0});
            joint.length = 1.0;
            joint.axes[0].mode = scenario::AxisMode::Free;
            joint.axes[0].damping = turns ? 0.5 : 2.0;  // a time of 1 s for both
            joint.axes[0].target = rod ? 1.0 : 0.0;
            s.joints.push_back(joint);
            Simulation run(s, kJointStep, options);
            run.steps(480);
            const auto state = run.state(0);
            EXPECT_NEAR(turns ? state.angularVelocity.z : state.velocity.x, 0.3 * std::exp(-1.0), 2e-4);
        }
}

/// A spring beside stops and a motor: the motor stretches it to torque / stiffness, the stop holds before.
TEST(Box2dSprings, ASpringStandsBesideStopAndMotor) {
    for (const bool stopped : {false, true}) {
        Scenario s = plane();
        s.gravity = {};
        const int b = addBody(s, Box{{0.2, 0.1, 0}}, {1, 0, 0}, 2.0, {0.5, 0.5, 0.5});
        s.bodies[0].collides = false;
        Joint joint = onWorld(JointType::Hinge, b, {1, 0, 0});
        joint.axes[0].mode = stopped ? scenario::AxisMode::Limited : scenario::AxisMode::Free;
        joint.axes[0].lower = -0.2;
        joint.axes[0].upper = 0.2;
        joint.axes[0].stiffness = 5.0;
        joint.axes[0].damping = 4.0;
        joint.axes[0].motorSpeed = 100.0;
        joint.axes[0].motorMaxForce = 2.0;
        s.joints.push_back(joint);
        Simulation run(s, kJointStep, "preset=matched");
        run.steps(4800);
        EXPECT_NEAR(angleOf(run.state(0)), stopped ? 0.2 : 0.4, 5e-3);
    }
}

/// Two free bodies of 1 and 3 kg on a slider's spring of 2 Hz: the reduced mass 0.75 kg swings.
TEST(Box2dSprings, AFrequencyIsThatOfBothBodies) {
    Scenario s = plane();
    s.gravity = {};
    const int a = addBody(s, Sphere{0.1}, {0, 0, 0}, 1.0, {0.1, 0.1, 0.1});
    const int b = addBody(s, Sphere{0.1}, {0.3, 0, 0}, 3.0, {0.1, 0.1, 0.1});
    for (auto& body : s.bodies) body.collides = false;
    Joint joint = onWorld(JointType::Slider, b, {0.3, 0, 0});
    joint.bodyA = a;
    joint.axes[0].mode = scenario::AxisMode::Free;
    joint.axes[0].frequency = 2.0;
    joint.axes[0].dampingRatio = 0.0;
    joint.axes[0].target = 0.1;
    s.joints.push_back(joint);
    Simulation run(s, kJointStep, "preset=matched");
    run.steps(120);  // half a period: from 0.1 short of the target to 0.1 beyond
    EXPECT_NEAR(run.state(1).position.x - run.state(0).position.x, 0.5, 5e-3);
    EXPECT_NEAR(3.0 * run.state(1).velocity.x + run.state(0).velocity.x, 0.0, 1e-5);
}

/// A weld carries 2 kg: 19.62 N hold below the strength and not above it, whatever the scale of the world.
TEST(Box2dBreaks, WhereTheReactionIsAboveTheStrength) {
    for (const char* options : {"preset=default", "preset=matched", "preset=matched,scale=10"})
        for (const double strength : {19.5, 19.7}) {
            Scenario s = plane();
            const int b = addBody(s, Box{{0.1, 0.1, 0}}, {1, 2, 0}, 2.0, {0.1, 0.1, 0.1});
            s.bodies[0].collides = false;
            Joint joint = onWorld(JointType::Fixed, b, {1, 2, 0});
            joint.breakForce = strength;
            s.joints.push_back(joint);
            Simulation run(s, kJointStep, options);
            run.steps(60);
            const bool holds = strength > 19.62;
            EXPECT_EQ(run.world->jointHolds(0), holds) << options;
            EXPECT_EQ(run.state(0).position.y > 1.99, holds) << options;
        }
}

/// A beam of 2 kg whose middle is 0.5 m beside its weld: 9.81 N m about the anchor.
TEST(Box2dBreaks, WhereTheTorqueIsAboveTheStrength) {
    for (const double strength : {9.7, 9.9}) {
        Scenario s = plane();
        const int b = addBody(s, Box{{0.5, 0.05, 0}}, {0.5, 0, 0}, 2.0, {0.2, 0.2, 0.2});
        s.bodies[0].collides = false;
        Joint joint = onWorld(JointType::Fixed, b, {}, {-0.5, 0, 0});
        joint.breakTorque = strength;
        s.joints.push_back(joint);
        Simulation run(s, kJointStep, "preset=matched");
        run.steps(240);
        EXPECT_EQ(run.world->jointHolds(0), strength > 9.81);
    }
}

/// Bodies that a joint kept from colliding collide after it broke, although they have not moved.
TEST(Box2dBreaks, BodiesThatAJointKeptApartTouchAfterwards) {
    for (const bool breaks : {false, true}) {
        Scenario s = plane();
        addStatic(s, Box{{2, 0.5, 0}}, {0, -0.5, 0});
        const int b = addBody(s, Box{{0.1, 0.1, 0}}, {0, 0.1, 0}, 2.0, {0.1, 0.1, 0.1});
        Joint joint = onWorld(JointType::Fixed, b, {0, 0.1, 0});
        joint.bodyA = 0;
        joint.anchorA = {0, 0.6, 0};
        joint.breakForce = breaks ? 1.0 : 1e300;
        s.joints.push_back(joint);
        Simulation run(s, kJointStep, "preset=matched");
        double lowest = 1.0;
        for (int i = 0; i < 240; ++i) {
            run.steps(1);
            lowest = std::min(lowest, run.state(1).position.y);
        }
        EXPECT_EQ(run.world->jointHolds(0), !breaks);
        EXPECT_EQ(run.contacts().empty(), !breaks);
        EXPECT_GT(lowest, 0.099);
    }
}

/// A damper without a spring needs no target: Box2D, which refuses a length of zero, keeps its own.
TEST(Box2dSprings, ADamperAlongADistanceNeedsNoLength) {
    Scenario s = plane();
    s.gravity = {};
    const int b = addBody(s, Sphere{0.1}, {2, 0, 0}, 2.0, even(0.5));
    s.bodies[0].velocity = {0.3, 0, 0};
    Joint joint = onWorld(JointType::Distance, b, {1, 0, 0});
    joint.length = 1.0;
    joint.axes[0].mode = scenario::AxisMode::Free;
    joint.axes[0].damping = 2.0;
    s.joints.push_back(joint);
    Simulation run(s, kJointStep);
    run.steps(480);
    EXPECT_NEAR(run.state(b).velocity.x, 0.3 * std::exp(-1.0), 2e-4);
}

/// A six_dof is the joint that leaves the same: a push and a turn move what is free alone.
TEST(Box2dSixDof, MovesWhatIsFreeAlone) {
    for (int free = 0; free < 8; ++free) {
        Scenario s = plane();
        s.gravity = {};
        const int b = addBody(s, Sphere{0.1}, {2, 1, 0}, 2.0, even(0.5));
        s.bodies[0].collides = false;
        Joint joint = onWorld(JointType::SixDof, b, {2, 1, 0});
        joint.axisA = joint.axisB = {0.6, 0.8, 0};
        for (int k = 0; k < 3; ++k)
            joint.axes[k].mode = (free >> k & 1) != 0 ? scenario::AxisMode::Free : scenario::AxisMode::Locked;
        s.joints.push_back(joint);
        Simulation run(s, kJointStep);
        const Vec3 x{0.6, 0.8, 0}, y{-0.8, 0.6, 0};
        for (int i = 0; i < 240; ++i) {
            run.world->applyForce(b, 2.0 * x + 1.0 * y, {0, 0, 0.5});
            run.steps(1);
        }
        const BodyState state = run.state(b);
        const Vec3 moved = state.position - Vec3{2, 1, 0};
        // v = F t / m for half a second; half of it times t is the way.
        EXPECT_NEAR(dot(moved, x), free & 1 ? 0.125 : 0.0, 2e-3) << free;
        EXPECT_NEAR(dot(moved, y), free & 2 ? 0.0625 : 0.0, 2e-3) << free;
        EXPECT_NEAR(angleOf(state), free & 4 ? 0.125 : 0.0, 2e-3) << free;
    }
}

/// A motion that no joint of the library leaves free is refused: a spring along one of two travels.
TEST(Box2dSixDof, TwoTravelsAreFreeOrRefused) {
    Scenario s = plane();
    const int b = addBody(s, Sphere{0.1}, {}, 2.0, even(0.5));
    Joint joint = onWorld(JointType::SixDof, b, {});
    for (auto& axis : joint.axes) axis.mode = scenario::AxisMode::Free;
    joint.axes[1].stiffness = 10.0;
    s.joints.push_back(joint);
    EXPECT_THROW(Simulation(s, kJointStep), adapter::Unsupported);
    s.joints[0].axes[1].stiffness = 0.0;
    EXPECT_NO_THROW(Simulation(s, kJointStep));
}

}  // namespace
}  // namespace rigor::test
