// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Distance joints of 2.4: a rope, slack until it is taut, and a spring (manual, "Distance Joint"; 2.4 took the rope
// joint into it).
#include "adapters/conformance/plain_programs/box2d/run.hpp"

namespace rigor::plain {
namespace {

b2Body* makeBob(b2World& world, const b2Vec2& position, float mass, float inertia) {
    b2Body* bob = makeBody(world, b2_dynamicBody, position);
    b2MassData data;
    data.mass = mass;
    data.center.SetZero();
    data.I = inertia;
    bob->SetMassData(&data);
    return bob;
}

TEST(PlainBox2d, Rope) {
    b2World world(b2Vec2(0.0f, -9.81f));
    b2Body* ground = makeBody(world, b2_staticBody, {0.0f, 0.0f});
    b2Body* bob = makeBob(world, {static_cast<float>(0.8660254037844386), 0.25f}, 1.0f, 0.005f);
    b2DistanceJointDef def;
    def.bodyA = ground;
    def.bodyB = bob;
    def.length = def.maxLength = 1.0f;
    def.minLength = 0.0f;
    world.CreateJoint(&def);
    const Trajectory plain = run(world, {bob}, 1.0f / 60.0f, 180);
    EXPECT_GT(travel(plain, 0), 1.0);
    const Scenario scene =
        load("scenarios/library/2d/rope_swing_2d.json",
             {"bodies.bob.inertia=0.005", "bodies.bob.position=[0.8660254037844386,0.25]"});
    EXPECT_TRUE(same(plain, adapterRun("box2d:preset=default", scene, 1.0 / 60, 180)));
}

/// Stiffness and damping by the library's own b2LinearStiffness.
TEST(PlainBox2d, DistanceSpring) {
    b2World world(b2Vec2(0.0f, -9.81f));
    b2Body* ground = makeBody(world, b2_staticBody, {0.0f, 0.0f});
    b2Body* weight = makeBob(world, {0.0f, -1.4f}, 2.0f, 0.01f);
    b2DistanceJointDef def;
    def.bodyA = ground;
    def.bodyB = weight;
    def.length = 1.0f;
    def.minLength = 0.0f;
    def.maxLength = b2_maxFloat;
    b2LinearStiffness(def.stiffness, def.damping, 1.2f, 0.1f, ground, weight);
    world.CreateJoint(&def);
    const Trajectory plain = run(world, {weight}, 1.0f / 60.0f, 180);
    EXPECT_GT(travel(plain, 0), 0.3);
    const Scenario scene =
        load("scenarios/library/2d/distance_spring_2d.json", {"bodies.weight.inertia=0.01"});
    // b2LinearStiffness rounds each product to single precision, the adapter the result.
    EXPECT_TRUE(
        same(plain, adapterRun("box2d:preset=default", scene, 1.0 / 60, 180), {2e-6, 1e-6, 1e-5, 1e-5}));
}

}  // namespace
}  // namespace rigor::plain
