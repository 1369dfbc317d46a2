// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Heavy chain: eight light links of a chain on ball joints that carry a weight of a hundred of them (heavy_end_chain). No
// contacts, no constraints: joints are coordinates, and solvers have nothing to do. Hanging at rest, the chain's fastest
// vibration has w = 229.94 rad/s (M th'' + K th = 0, linearised), so that an Euler step that is explicit in the positions
// is stable below 2 / w = 1/115.0 s.
#include <dart/dynamics/BallJoint.hpp>

#include "adapters/conformance/plain_programs/dart/loop.hpp"

namespace rigor::plain {
namespace {

constexpr double kDegree = 0.017453292519943295;

/// The chain of the file, turned about z by `turn` [rad] from hanging straight.
Loop heavyChain(double step, double endMass, double turn) {
    using namespace dart::dynamics;
    Loop loop(step, {0, -9.81, 0});
    const auto skeleton = Skeleton::create("chain");
    BodyNode* parent = nullptr;
    for (int i = 0; i < 9; ++i) {
        BallJoint::Properties joint;
        joint.mName = "joint" + std::to_string(i);
        BodyNode::Properties body;
        body.mName = "link" + std::to_string(i);
        // A link hangs by its upper end on the lower end of the one before.
        joint.mT_ChildBodyToJoint.translation() = Eigen::Vector3d(0, 0.1, 0);
        if (parent != nullptr) joint.mT_ParentBodyToJoint.translation() = Eigen::Vector3d(0, -0.1, 0);
        if (parent == nullptr)
            joint.mT_ParentBodyToJoint.linear() =
                Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
        const double mass = i == 8 ? endMass : 0.1;
        const double across = i == 8 ? 0.4 * mass * 0.01 : mass * (0.01 + 0.0004) / 3;
        const double along = i == 8 ? across : mass * 0.0008 / 3;
        body.mInertia = inertia(mass, {across, along, across});
        parent = skeleton->createJointAndBodyNodePair<BallJoint>(parent, joint, body).second;
        loop.bodies.push_back(parent);
    }
    loop.world->addSkeleton(skeleton);
    return loop;
}

/// Whether all rates stay below 1e6 rad/s for `seconds`.
bool lasts(const Loop& loop, double step, double seconds) {
    // A thousandth of a radian per second, against each other, so that vibrations begin.
    const auto skeleton = loop.bodies.front()->getSkeleton();
    skeleton->setVelocity(2, 1e-3);
    skeleton->setVelocity(11, -1e-3);
    for (int i = 0; i < seconds / step; ++i) {
        loop.world->step();
        if (!(skeleton->getVelocities().norm() < 1e6)) return false;
    }
    return true;
}

TEST(PlainDart, HeavyChain) {
    const double turn = 36.86989764584402 * kDegree;
    const Trajectory plain = heavyChain(1.0 / 240, 10, turn).run(120);
    EXPECT_GT(travel(plain, 8), 0.1);
    const Scenario scene = load("scenarios/library/3d/heavy_end_chain.json");
    // Links of the file have the axes of the world at the start, so that orientations differ by the turn.
    EXPECT_TRUE(
        same(plain, adapterRun("dart:preset=default", scene, 1.0 / 240, 120), {1e-12, 1.0, 1e-11, 1e-11}));

    EXPECT_FALSE(lasts(heavyChain(1.0 / 60, 10, turn), 1.0 / 60, 2));
    EXPECT_TRUE(lasts(heavyChain(1.0 / 240, 10, turn), 1.0 / 240, 2));
    EXPECT_TRUE(lasts(heavyChain(1.0 / 60, 1, turn), 1.0 / 60, 2));
}

TEST(PlainDart, HangingChainAtTheLimitOfItsStep) {
    EXPECT_FALSE(lasts(heavyChain(1.0 / 110, 10, 0), 1.0 / 110, 10));
    EXPECT_TRUE(lasts(heavyChain(1.0 / 116, 10, 0), 1.0 / 116, 10));
}

}  // namespace
}  // namespace rigor::plain
