// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact: a disc is thrown at a floor, bounces, slips and rolls.
#include "adapters/conformance/plain_programs/box2d/run.hpp"

namespace rigor::plain {
namespace {

TEST(PlainBox2d, Contact) {
    b2World world(b2Vec2(0.0f, -9.75f));
    b2Body* ground = makeBody(world, b2_staticBody, {0.0f, -0.5f});
    addFixture(*ground, box(50.0f, 0.5f), 0.25f, 0.5f);
    b2Body* disc = makeBody(world, b2_dynamicBody, {-4.0f, 3.0f});
    addFixture(*disc, circle(0.5f), 0.25f, 0.5f);
    disc->SetLinearVelocity(b2Vec2(2.5f, 0.0f));
    disc->SetAngularVelocity(4.0f);
    const Trajectory plain = run(world, {ground, disc}, 1.0f / 60.0f, 240);
    EXPECT_GT(travel(plain, 1), 3.0);
    const Scenario scene = load(std::string(kScenes) + "contact.json");
    EXPECT_TRUE(same(plain, adapterRun("box2d:preset=default", scene, 1.0 / 60, 240)));
}

}  // namespace
}  // namespace rigor::plain
