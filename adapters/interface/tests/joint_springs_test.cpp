// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Effective masses of joint coordinates against closed forms, and springs by frequency as stiffness.
#include "adapters/interface/joint_springs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "adapters/interface/planar.hpp"

namespace rigor::adapter {
namespace {

using scenario::AxisMode;
using scenario::Body;
using scenario::BodyType;
using scenario::Joint;
using scenario::JointType;

Scenario scene(int dimension = 3) {
    Scenario s;
    s.dimension = dimension;
    return s;
}
int addBody(Scenario& s, double mass, const Vec3& moments, const Vec3& position) {
    Body body;
    body.pose.position = position;
    body.massProperties = {mass, {}, Mat3::diagonal(moments.x, moments.y, moments.z)};
    s.bodies.push_back(body);
    return static_cast<int>(s.bodies.size()) - 1;
}
/// A joint at a point of the world; bodies are not turned.
Joint jointAt(const Scenario& s, JointType type, int a, int b, const Vec3& anchor, const Vec3& axis) {
    const auto local = [&](int body) { return body < 0 ? anchor : anchor - s.bodies[body].pose.position; };
    Joint joint;
    joint.type = type;
    joint.bodyA = a;
    joint.bodyB = b;
    joint.anchorA = local(a);
    joint.anchorB = local(b);
    joint.axisA = joint.axisB = axis;
    return joint;
}
constexpr int kWorld = scenario::kNone;

TEST(EffectiveMass, OfADoorIsItsMomentAboutTheHinge) {
    Scenario s = scene();
    const int b = addBody(s, 2.0, {0.3, 0.4, 0.5}, {0.9, 0, 0});
    EXPECT_NEAR(effectiveMass(s, jointAt(s, JointType::Hinge, kWorld, b, {}, {0, 0, 1}), 0), 0.5 + 2.0 * 0.81,
                1e-14);
}

TEST(EffectiveMass, OfTwoBodiesIsTheReducedOne) {
    Scenario s = scene();
    const int a = addBody(s, 2.0, {0.1, 0.1, 0.1}, {});
    const int b = addBody(s, 3.0, {0.2, 0.2, 0.2}, {1, 0, 0});
    Joint rod = jointAt(s, JointType::Distance, a, b, {}, {1, 0, 0});
    rod.anchorB = {};
    EXPECT_NEAR(effectiveMass(s, rod, 0), 2.0 * 3.0 / 5.0, 1e-14);
    const Joint slider = jointAt(s, JointType::Slider, a, b, {1, 0, 0}, {1, 0, 0});
    EXPECT_NEAR(effectiveMass(s, slider, 0), 2.0 * 3.0 / 5.0, 1e-14);
    s.bodies[a].type = BodyType::Kinematic;
    EXPECT_NEAR(effectiveMass(s, slider, 0), 3.0, 1e-14);
}

/// The pin of the wheel is free, so a strut beside the centre moves it with a lever.
TEST(EffectiveMass, OfAWheelHungBesideItsCentreHasALever) {
    for (const int dimension : {2, 3}) {
        Scenario s = scene(dimension);
        const int b = addBody(s, 4.0, {0.2, 0.2, 0.2}, {});
        Joint wheel = jointAt(s, JointType::Wheel, kWorld, b, {0.25, 0, 0}, {0, 1, 0});
        wheel.spinAxisB = {0, 0, 1};
        // The anchor is held across the strut: that row has no lever here.
        const double expected = 1.0 / (1.0 / 4.0 + 0.25 * 0.25 / 0.2);
        EXPECT_NEAR(effectiveMass(s, wheel, 0), expected, 1e-14) << dimension;
        EXPECT_NEAR(effectiveMass(s, wheel, 1), 0.2, 1e-14) << dimension;
        if (dimension == 2) {
            const Scenario lifted = [&] {
                Scenario with = s;
                with.joints = {wheel};
                return planarLift(with);
            }();
            EXPECT_NEAR(effectiveMass(lifted, lifted.joints[0], 0), expected, 1e-14) << "lifted";
        }
    }
}

TEST(EffectiveMass, OfAnUnevenBodyOnABallIsThatOfTheInverse) {
    Scenario s = scene();
    const int b = addBody(s, 2.0, {0.3, 0.4, 0.5}, {});
    s.bodies[0].pose.orientation = scenario::fromAxisAngle(Vec3{0, 0, 1}, 0.5);
    Joint joint = jointAt(s, JointType::ConeTwist, kWorld, b, {}, {1, 0, 0});
    const double c = std::cos(0.5), si = std::sin(0.5);
    EXPECT_NEAR(effectiveMass(s, joint, 0), 1.0 / (c * c / 0.3 + si * si / 0.4), 1e-14)
        << "its swings are free";
    joint.type = JointType::Hinge;
    EXPECT_NEAR(effectiveMass(s, joint, 0), 0.3 * c * c + 0.4 * si * si, 1e-14) << "they are held";
}

TEST(EffectiveMass, OfASixDofDependsOnWhatItLocks) {
    Scenario s = scene();
    const int b = addBody(s, 2.0, {0.3, 0.4, 0.5}, {0.9, 0, 0});
    Joint joint = jointAt(s, JointType::SixDof, kWorld, b, {}, {1, 0, 0});
    joint.normalA = {0, 1, 0};
    joint.axes[5].mode = AxisMode::Free;
    EXPECT_NEAR(effectiveMass(s, joint, 5), 0.5 + 2.0 * 0.81, 1e-14) << "a door";
    joint.axes[1].mode = AxisMode::Free;
    EXPECT_NEAR(effectiveMass(s, joint, 5), 0.5, 1e-14) << "its anchor may give way across the arm";
    EXPECT_NEAR(effectiveMass(s, joint, 1), 1.0 / (1.0 / 2.0 + 0.81 / 0.5), 1e-14);
}

TEST(EffectiveMass, IsZeroWhereNothingCanMove) {
    Scenario s = scene();
    const int b = addBody(s, 2.0, {0.3, 0.4, 0.5}, {});
    s.bodies[0].type = BodyType::Static;
    EXPECT_EQ(effectiveMass(s, jointAt(s, JointType::Hinge, kWorld, b, {}, {0, 0, 1}), 0), 0.0);
}

TEST(WithStiffness, LeavesNoFrequency) {
    Scenario s = scene();
    const int b = addBody(s, 2.0, {0.3, 0.4, 0.5}, {0.9, 0, 0});
    Joint door = jointAt(s, JointType::Hinge, kWorld, b, {}, {0, 0, 1});
    door.axes[0].frequency = 2.0;
    door.axes[0].dampingRatio = 0.1;
    s.joints = {door};
    const scenario::JointAxis axis = withStiffness(s).joints[0].axes[0];
    const double omega = 4.0 * std::numbers::pi, moment = 0.5 + 2.0 * 0.81;
    EXPECT_NEAR(axis.stiffness, moment * omega * omega, 1e-11);
    EXPECT_NEAR(axis.damping, 0.2 * moment * omega, 1e-12);
    EXPECT_EQ(axis.frequency, 0.0);
    EXPECT_EQ(axis.dampingRatio, 0.0);
}

}  // namespace
}  // namespace rigor::adapter
