// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Motors and limits: a disc driven by the motor of its axle, and a block that runs up a rail to its stop and
// slides back (manual, "Revolute Joint", "Prismatic Joint").
#include "adapters/conformance/plain_programs/box2d/run.hpp"

namespace rigor::plain {
namespace {

void setMass(b2Body& body, double mass, double inertia) {
    b2MassData data;
    data.mass = static_cast<float>(mass);
    data.center.SetZero();
    data.I = static_cast<float>(inertia);
    body.SetMassData(&data);
}

TEST(PlainBox2d, HingeMotor) {
    b2World world(b2Vec2(0.0f, -9.81f));
    b2Body* ground = makeBody(world, b2_staticBody, {0.0f, 0.0f});
    b2Body* disc = makeBody(world, b2_dynamicBody, {0.0f, 0.0f});
    setMass(*disc, 5.0, 0.4);
    b2RevoluteJointDef def;
    def.Initialize(ground, disc, b2Vec2(0.0f, 0.0f));
    def.enableMotor = true;
    def.motorSpeed = 3.0f;
    def.maxMotorTorque = 0.8f;
    world.CreateJoint(&def);
    const Trajectory plain = run(world, {disc}, 1.0f / 60.0f, 150);
    EXPECT_NEAR(plain.back()[0].angularVelocity.z, 3.0, 1e-3);
    const Scenario scene = load("scenarios/library/2d/hinge_motor_2d.json", {"bodies.disc.inertia=0.4"});
    EXPECT_TRUE(same(plain, adapterRun("box2d:preset=default", scene, 1.0 / 60, 150)));
}

TEST(PlainBox2d, SliderLimit) {
    b2World world(b2Vec2(-4.905f, static_cast<float>(-8.495709211125343)));
    b2Body* ground = makeBody(world, b2_staticBody, {0.0f, 0.0f});
    b2Body* block = makeBody(world, b2_dynamicBody, {0.0f, 1.0f});
    setMass(*block, 2.0, 0.02);
    block->SetLinearVelocity(
        b2Vec2(static_cast<float>(0.7499999999999999), static_cast<float>(1.299038105676658)));
    b2PrismaticJointDef def;
    def.Initialize(ground, block, b2Vec2(0.0f, 1.0f), b2Vec2(0.5f, static_cast<float>(0.8660254037844386)));
    def.enableLimit = true;
    def.lowerTranslation = -0.8f;
    def.upperTranslation = 0.5f;
    world.CreateJoint(&def);
    const Trajectory plain = run(world, {block}, 1.0f / 60.0f, 120);
    EXPECT_GT(travel(plain, 0), 0.7);
    const Scenario scene = load("scenarios/library/2d/slider_limit_2d.json", {"bodies.block.inertia=0.02"});
    EXPECT_TRUE(same(plain, adapterRun("box2d:preset=default", scene, 1.0 / 60, 120)));
}

}  // namespace
}  // namespace rigor::plain
