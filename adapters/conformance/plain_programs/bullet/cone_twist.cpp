// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cone-twist: a rod falls to the edge of its cone, btConeTwistConstraint as in Bullet's ConstraintDemo.
#include "adapters/conformance/plain_programs/bullet/rigid_body_base.hpp"

namespace rigor::plain {
namespace {

TEST(PlainBullet, ConeTwist) {
    RigidBodyBase demo;
    btRigidBody& rod = demo.createRigidBody(2, btTransform(btQuaternion::getIdentity(), {0.5, 0, 0}),
                                            std::make_unique<btEmptyShape>(), {0.0012, 0.1673, 0.1673});
    const btTransform inWorld(btQuaternion::getIdentity(), {0, 0, 0}),
        inRod(btQuaternion::getIdentity(), {-0.5, 0, 0});
    btConeTwistConstraint socket(btTypedConstraint::getFixedBody(), rod, inWorld, inRod);
    const btScalar cone = 0.6981317007977318;
    socket.setLimit(cone, cone, BT_LARGE_FLOAT, 1.0, 0.3, 1.0);
    demo.world->addConstraint(&socket);
    const Trajectory plain = demo.run(1.0 / 60, 120);
    const Scenario scene =
        load("scenarios/library/3d/cone_twist_stop.json", {"bodies.rod.inertia=[0.0012,0.1673,0.1673]"});
    EXPECT_GT(travel(plain, 0), 0.3);
    EXPECT_TRUE(same(plain, adapterRun("bullet:preset=default", scene, 1.0 / 60, 120), kSameBits));
}

}  // namespace
}  // namespace rigor::plain
