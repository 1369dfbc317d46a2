// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Spring: a lid on a btGeneric6DofSpring2Constraint whose turn about x is sprung, Bullet as it ships.
// Bullet's angle is that of the lid's frame seen the other way round: the target changes its sign.
#include "adapters/conformance/plain_programs/bullet/rigid_body_base.hpp"

namespace rigor::plain {
namespace {

TEST(PlainBullet, Spring) {
    RigidBodyBase demo;
    btRigidBody& lid = demo.createRigidBody(6, btTransform(btQuaternion::getIdentity(), {0, 0, 0.5}),
                                            std::make_unique<btEmptyShape>(), {1, 1, 1});
    const btTransform inWorld = btTransform::getIdentity();
    const btTransform inLid(btQuaternion::getIdentity(), {0, 0, -0.5});
    btGeneric6DofSpring2Constraint hinge(btTypedConstraint::getFixedBody(), lid, inWorld, inLid);
    hinge.setLinearLowerLimit({0, 0, 0});
    hinge.setLinearUpperLimit({0, 0, 0});
    hinge.setAngularLowerLimit({1, 0, 0});
    hinge.setAngularUpperLimit({-1, 0, 0});
    hinge.enableSpring(3, true);
    hinge.setStiffness(3, 60);
    hinge.setDamping(3, 2);
    hinge.setEquilibriumPoint(3, -0.5);
    demo.world->addConstraint(&hinge);
    const Trajectory plain = demo.run(1.0 / 60, 180);

    const Scenario scene = load("adapters/conformance/plain_programs/bullet/spring.json");
    EXPECT_GT(travel(plain, 0), 0.2);
    EXPECT_TRUE(same(plain, adapterRun("bullet:preset=default", scene, 1.0 / 60, 180), kSameBits));
}

}  // namespace
}  // namespace rigor::plain
