// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Motion without contacts: a rod on a hinge, and a top that nothing acts on.
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

}  // namespace
}  // namespace rigor::plain
