// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joint: eight planks, pinned to each other and to the world, swing down.
#include "adapters/conformance/plain_programs/box2d/run.hpp"

namespace rigor::plain {
namespace {

TEST(PlainBox2d, Joint) {
    b2World world(b2Vec2(0.0f, -10.0f));
    b2Body* previous = makeBody(world, b2_staticBody, {0.0f, 0.0f});
    std::vector<b2Body*> planks;
    for (int i = 0; i < 8; ++i) {
        const auto x = static_cast<float>(i);
        planks.push_back(makeBody(world, b2_dynamicBody, {x + 0.5f, 5.0f}));
        addBox(*planks.back(), 0.5, 0.125, 0.5f);
        b2RevoluteJointDef def;
        def.Initialize(previous, planks.back(), b2Vec2(x, 5.0f));
        world.CreateJoint(&def);
        previous = planks.back();
    }
    const Trajectory plain = run(world, planks, 1.0f / 60.0f, 180);
    EXPECT_GT(travel(plain, 7), 5.0);
    const Scenario scene = load(std::string(kScenes) + "joint.json");
    EXPECT_TRUE(same(plain, adapterRun("box2d:preset=default", scene, 1.0 / 60, 180)));
}

}  // namespace
}  // namespace rigor::plain
