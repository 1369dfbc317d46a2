// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Spring: a bob swings on a distance joint that gives way between two stops.
#include "adapters/conformance/plain_programs/box2d/run.hpp"

namespace rigor::plain {
namespace {

TEST(PlainBox2d, Spring) {
    b2World world(b2Vec2(0.0f, -10.0f));
    b2Body* ground = makeBody(world, b2_staticBody, {0.0f, 0.0f});
    b2Body* bob = makeBody(world, b2_dynamicBody, {1.5f, 4.0f});
    addFixture(*bob, box(0.5f, 0.5f));
    b2DistanceJointDef def;
    def.Initialize(ground, bob, b2Vec2(0.0f, 6.0f), bob->GetPosition());
    def.length = 2.0f;
    def.minLength = 1.0f;
    def.maxLength = 3.5f;
    def.stiffness = 40.0f;
    def.damping = 0.5f;
    world.CreateJoint(&def);
    const Trajectory plain = run(world, {bob}, 1.0f / 60.0f, 180);
    EXPECT_GT(travel(plain, 0), 2.0);
    const Scenario scene = load(std::string(kScenes) + "spring.json");
    EXPECT_TRUE(same(plain, adapterRun("box2d:preset=default", scene, 1.0 / 60, 180)));
}

}  // namespace
}  // namespace rigor::plain
