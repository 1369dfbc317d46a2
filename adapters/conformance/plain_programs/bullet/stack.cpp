// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Stack: ten unit cubes on a floor, Bullet as it ships. Bullet multiplies the coefficients of the two bodies:
// 0.5 on each is the pair's 0.25.
#include "adapters/conformance/plain_programs/bullet/rigid_body_base.hpp"

namespace rigor::plain {
namespace {

TEST(PlainBullet, Stack) {
    RigidBodyBase demo;
    const auto cube = [] { return std::make_unique<btBoxShape>(btVector3(0.5, 0.5, 0.5)); };
    demo.createRigidBody(0, {0, -0.5, 0}, std::make_unique<btBoxShape>(btVector3(20, 0.5, 20)));
    for (int i = 0; i < 10; ++i) demo.createRigidBody(1, {0, 0.49999 + 0.99999 * i, 0}, cube());
    for (const auto& body : demo.bodies) body->setFriction(0.5);
    const Trajectory plain = demo.run(1.0 / 60, 180);

    const Scenario scene = load("scenarios/library/3d/box_stack.json", {"materials.stuff.friction=0.25"});
    EXPECT_GT(travel(plain, 10), 0.001);  // ten iterations leave the stack creeping
    EXPECT_TRUE(same(plain, adapterRun("bullet:preset=default", scene, 1.0 / 60, 180), kSameBits));
}

}  // namespace
}  // namespace rigor::plain
