// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Height field: a capsule falls over and slides down a field of triangles, btHeightfieldTerrainShape as its demo has it.
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>

#include "adapters/conformance/plain_programs/bullet/rigid_body_base.hpp"

namespace rigor::plain {
namespace {

TEST(PlainBullet, HeightField) {
    const Scenario scene = load("adapters/conformance/plain_programs/bullet/height_field.json");
    // Rows along z of heights along x, from the file instead of written out.
    const auto& field = std::get<scenario::HeightField>(scene.bodies[0].shapes[0].geometry);
    std::vector<btScalar> heights(field.heights.begin(), field.heights.end());
    // Bullet's origin of a terrain is the middle of its heights.
    btHeightfieldTerrainShape terrain(9, 5, heights.data(), btScalar(0), btScalar(2), 1, false);
    auto lifted = std::make_unique<btCompoundShape>();
    lifted->addChildShape(btTransform(btQuaternion::getIdentity(), {0, 1, 0}), &terrain);
    RigidBodyBase demo;
    btRigidBody& ground = demo.createRigidBody(0, {0, 0, 0}, std::move(lifted));
    btRigidBody& capsule =
        demo.createRigidBody(2, btTransform(btQuaternion::getIdentity(), {-2.5, 2.5, 0.25}),
                             std::make_unique<btCapsuleShape>(0.25, 0.5), {0.1, 0.06, 0.1});
    ground.setFriction(0.5);
    capsule.setFriction(0.5);
    const Trajectory plain = demo.run(1.0 / 60, 120);
    EXPECT_GT(travel(plain, 1), 1.0);
    EXPECT_TRUE(same(plain, adapterRun("bullet:preset=default", scene, 1.0 / 60, 120), kSameBits));
}

}  // namespace
}  // namespace rigor::plain
