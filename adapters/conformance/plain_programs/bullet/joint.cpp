// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joint: two hinges and a ball joint in a row, Bullet as it ships.
#include "adapters/conformance/plain_programs/bullet/rigid_body_base.hpp"

namespace rigor::plain {
namespace {

TEST(PlainBullet, Joint) {
    RigidBodyBase demo;
    const auto nothing = [] { return std::make_unique<btEmptyShape>(); };
    const auto at = [](btScalar x) { return btTransform(btQuaternion::getIdentity(), {x, 0, 0}); };
    btRigidBody& anchor = demo.createRigidBody(0, at(0), nothing());
    btRigidBody& upper = demo.createRigidBody(6, at(1), nothing(), {1, 1, 1});
    btRigidBody& middle = demo.createRigidBody(6, at(3), nothing(), {1, 1, 1});
    btRigidBody& lower = demo.createRigidBody(3, at(5), nothing(), {0.5, 1.5, 1});
    lower.setAngularVelocity({1, 0.5, 0});
    const btVector3 z(0, 0, 1);
    btHingeConstraint first(anchor, upper, {0, 0, 0}, {-1, 0, 0}, z, z, true);
    btHingeConstraint second(upper, middle, {1, 0, 0}, {-1, 0, 0}, z, z, true);
    btPoint2PointConstraint third(middle, lower, {1, 0, 0}, {-1, 0, 0});
    demo.world->addConstraint(&first);
    demo.world->addConstraint(&second);
    demo.world->addConstraint(&third);
    const Trajectory plain = demo.run(1.0 / 60, 180);

    const Scenario scene = load("adapters/conformance/plain_programs/bullet/joint.json");
    EXPECT_GT(travel(plain, 3), 3.0);
    EXPECT_TRUE(same(plain, adapterRun("bullet:preset=default", scene, 1.0 / 60, 180), kSameBits));
    // The comparison detects a difference of one iteration.
    EXPECT_FALSE(
        same(plain, adapterRun("bullet:preset=default,iterations=11", scene, 1.0 / 60, 180), kSameBits));
}

}  // namespace
}  // namespace rigor::plain
