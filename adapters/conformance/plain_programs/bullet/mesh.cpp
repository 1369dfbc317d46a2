// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Mesh: a ball rolls down a sheet of four triangles and over the fold, Bullet as it ships.
#include "adapters/conformance/plain_programs/bullet/rigid_body_base.hpp"

namespace rigor::plain {
namespace {

TEST(PlainBullet, Mesh) {
    btTriangleMesh triangles;
    const btVector3 v[] = {{-8, 4, -4}, {0, 0, -4}, {16, 0, -4}, {-8, 4, 4}, {0, 0, 4}, {16, 0, 4}};
    triangles.addTriangle(v[0], v[3], v[1]);
    triangles.addTriangle(v[1], v[3], v[4]);
    triangles.addTriangle(v[1], v[4], v[2]);
    triangles.addTriangle(v[2], v[4], v[5]);
    RigidBodyBase demo;
    btRigidBody& sheet =
        demo.createRigidBody(0, {0, 0, 0}, std::make_unique<btBvhTriangleMeshShape>(&triangles, true));
    btRigidBody& ball = demo.createRigidBody(2.5, {-4, 2.75, 0.5}, std::make_unique<btSphereShape>(0.5));
    sheet.setFriction(0.5);
    ball.setFriction(0.5);
    const Trajectory plain = demo.run(1.0 / 60, 180);

    const Scenario scene = load("adapters/conformance/plain_programs/bullet/mesh.json");
    EXPECT_GT(travel(plain, 1), 5.0);
    EXPECT_TRUE(same(plain, adapterRun("bullet:preset=default", scene, 1.0 / 60, 180), kSameBits));
}

}  // namespace
}  // namespace rigor::plain
