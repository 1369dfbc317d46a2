// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Motion without contacts: a rod on a hinge, a top that nothing acts on, and a wheel on its strut.
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>

#include "adapters/conformance/plain_programs/dart/loop.hpp"

namespace rigor::plain {
namespace {

TEST(PlainDart, Pendulum) {
    Loop loop(1.0 / 240, {0, -9.81, 0});
    const auto skeleton = dart::dynamics::Skeleton::create("rod");
    const auto made = skeleton->createJointAndBodyNodePair<dart::dynamics::RevoluteJoint>();
    made.first->setAxis({0, 0, 1});
    Eigen::Isometry3d anchor = Eigen::Isometry3d::Identity();
    anchor.translation().x() = -0.5;
    made.first->setTransformFromChildBodyNode(anchor);
    made.second->setInertia(boxInertia(1, {1, 0.06, 0.06}));
    loop.world->addSkeleton(skeleton);
    loop.bodies.push_back(made.second);
    const Trajectory plain = loop.run(720);
    EXPECT_GT(travel(plain, 0), 0.9);
    const Scenario scene = load("scenarios/library/3d/physical_pendulum.json");
    EXPECT_TRUE(
        same(plain, adapterRun("dart:preset=default", scene, 1.0 / 240, 720), {1e-11, 1e-11, 1e-10, 1e-10}));
}

TEST(PlainDart, Top) {
    Loop loop(1.0 / 240, {0, 0, 0});
    const auto racket = boxInertia(1, {0.6, 0.3, 0.1});
    auto* body = loop.add(&racket, {0, 0, 0});
    dynamic_cast<dart::dynamics::FreeJoint*>(body->getParentJoint())->setAngularVelocity({0.2, 4, 0});
    const Trajectory plain = loop.run(720);
    const Scenario scene = load("scenarios/library/3d/asymmetric_top.json");
    EXPECT_TRUE(
        same(plain, adapterRun("dart:preset=default", scene, 1.0 / 240, 720), {1e-12, 1e-9, 1e-12, 1e-9}));
}

/// A chassis and one driven wheel. DART has no joint that slides and turns about another axis, so that a body of a
/// thousandth of a milligram is between the strut and the pin. Spring and damper are the joint's own, the motor is a servo.
TEST(PlainDart, Wheel) {
    using namespace dart::dynamics;
    Loop loop(1.0 / 60, {0, -9.81, 0});
    const auto skeleton = Skeleton::create("car");
    const auto chassis = skeleton->createJointAndBodyNodePair<FreeJoint>();
    chassis.second->setInertia(inertia(10, {0.5, 1.5, 1.25}));
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    place.translation() = Eigen::Vector3d(0, 1, 0);
    chassis.first->setTransform(place);
    const auto strut = skeleton->createJointAndBodyNodePair<PrismaticJoint>(chassis.second);
    place.translation() = Eigen::Vector3d(0.8, -0.4, 0);
    strut.first->setTransformFromParentBodyNode(place);
    strut.first->setAxis({0, 1, 0});
    strut.first->setSpringStiffness(0, 400);
    strut.first->setDampingCoefficient(0, 8);
    strut.first->setVelocity(0, 0.5);
    strut.second->setInertia(inertia(1e-9, {1e-9, 1e-9, 1e-9}));
    const auto pin = skeleton->createJointAndBodyNodePair<RevoluteJoint>(strut.second);
    pin.first->setAxis({0, 0, 1});
    pin.first->setActuatorType(Joint::SERVO);
    pin.first->setForceLowerLimit(0, -0.5);
    pin.first->setForceUpperLimit(0, 0.5);
    pin.second->setInertia(inertia(2, {0.05, 0.05, 0.09}));
    loop.world->addSkeleton(skeleton);
    loop.bodies = {chassis.second, pin.second};
    Trajectory plain = loop.run(0);
    for (int i = 0; i < 120; ++i) {
        pin.first->setCommand(0, 6);  // the world clears it after a step
        plain.push_back(loop.run(1).back());
    }
    EXPECT_GT(std::abs(plain.back()[1].angularVelocity.z), 4.0);
    const Scenario scene = load("adapters/conformance/plain_programs/ode/wheel.json");
    EXPECT_TRUE(
        same(plain, adapterRun("dart:preset=default", scene, 1.0 / 60, 120), {1e-7, 1e-7, 1e-7, 1e-7}));
}

}  // namespace
}  // namespace rigor::plain
