// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Car: two wheel joints with suspension and stops, the rear one with a motor.
#include "adapters/conformance/plain_programs/box2d/run.hpp"

namespace rigor::plain {
namespace {

TEST(PlainBox2d, Car) {
    b2World world(b2Vec2(0.0f, -10.0f));
    b2Body* ground = makeBody(world, b2_staticBody, {0.0f, -10.0f});
    addFixture(*ground, box(50.0f, 10.0f), 0.5f);
    b2Body* chassis = makeBody(world, b2_dynamicBody, {0.0f, 1.0f});
    addFixture(*chassis, box(1.5f, 0.25f), 0.5f);
    std::vector<b2Body*> bodies{ground, chassis};
    for (const float x : {-1.0f, 1.0f}) {
        b2Body* wheel = makeBody(world, b2_dynamicBody, {x, 0.5f});
        addFixture(*wheel, circle(0.5f), 0.5f);
        bodies.push_back(wheel);
    }
    for (std::size_t i : {2u, 3u}) {
        b2WheelJointDef def;
        def.Initialize(chassis, bodies[i], bodies[i]->GetPosition(), b2Vec2(0.0f, 1.0f));
        def.enableLimit = true;
        def.lowerTranslation = -0.25f;
        def.upperTranslation = 0.25f;
        def.stiffness = 200.0f;
        def.damping = 8.0f;
        def.enableMotor = i == 2;
        def.motorSpeed = -10.0f;
        def.maxMotorTorque = 5.0f;
        world.CreateJoint(&def);
    }
    const Trajectory plain = run(world, bodies, 1.0f / 60.0f, 180);
    EXPECT_GT(travel(plain, 1), 3.0);
    const Scenario scene = load(std::string(kScenes) + "car.json");
    EXPECT_TRUE(same(plain, adapterRun("box2d:preset=default", scene, 1.0 / 60, 180)));
}

}  // namespace
}  // namespace rigor::plain
