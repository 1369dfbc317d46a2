// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Break: a box swings down on a ball joint and tears it where 96 N along one axis are passed, Bullet as it
// ships: its threshold is an impulse per step.
#include "adapters/conformance/plain_programs/bullet/rigid_body_base.hpp"

namespace rigor::plain {
namespace {

TEST(PlainBullet, Break) {
    RigidBodyBase demo;
    btRigidBody& box = demo.createRigidBody(6, btTransform(btQuaternion::getIdentity(), {1, 0, 0}),
                                            std::make_unique<btEmptyShape>(), {1, 1, 1});
    btPoint2PointConstraint socket(btTypedConstraint::getFixedBody(), box, {0, 0, 0}, {-1, 0, 0});
    socket.setBreakingImpulseThreshold(96 * (1.0 / 60));
    demo.world->addConstraint(&socket);
    Trajectory plain{demo.states()};
    std::vector<bool> plainHolds, adapterHolds;
    for (int i = 0; i < 120; ++i) {
        demo.world->stepSimulation(1.0 / 60, 0);
        plain.push_back(demo.states());
        plainHolds.push_back(socket.isEnabled());
    }

    const Scenario scene = load("adapters/conformance/plain_programs/bullet/break.json");
    const Trajectory adapter = adapterRun("bullet:preset=default", scene, 1.0 / 60, 120, &adapterHolds);
    EXPECT_TRUE(plainHolds.front());
    EXPECT_FALSE(plainHolds.back());
    EXPECT_EQ(plainHolds, adapterHolds);
    EXPECT_TRUE(same(plain, adapter, kSameBits));
}

}  // namespace
}  // namespace rigor::plain
