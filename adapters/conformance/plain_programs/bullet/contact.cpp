// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact: a ball thrown on a static plane, Bullet as it ships. Bullet multiplies the coefficients of the two
// bodies: friction 0.5 and 0.5, restitution 0.5 and 1.
#include "adapters/conformance/plain_programs/bullet/rigid_body_base.hpp"

namespace rigor::plain {
namespace {

TEST(PlainBullet, Contact) {
    RigidBodyBase demo;
    btRigidBody& floor =
        demo.createRigidBody(0, {0, 0, 0}, std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), 0));
    btRigidBody& ball = demo.createRigidBody(2.5, {0, 2, 0}, std::make_unique<btSphereShape>(0.5));
    floor.setFriction(0.5);
    floor.setRestitution(1.0);
    ball.setFriction(0.5);
    ball.setRestitution(0.5);
    ball.setLinearVelocity({3, 0, 1});
    ball.setAngularVelocity({0, 2, 5});
    const Trajectory plain = demo.run(1.0 / 60, 180);

    const Scenario scene = load("adapters/conformance/plain_programs/bullet/contact.json");
    EXPECT_GT(travel(plain, 1), 3.0);
    EXPECT_TRUE(same(plain, adapterRun("bullet:preset=default", scene, 1.0 / 60, 180), kSameBits));
}

}  // namespace
}  // namespace rigor::plain
