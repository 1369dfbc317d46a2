// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Break: a ball falls on a beam welded to the world. The manual has joints broken by the program: after each
// step it reads the reaction force, and destroys the joint above 40 N.
#include "adapters/conformance/plain_programs/box2d/run.hpp"

namespace rigor::plain {
namespace {

TEST(PlainBox2d, Break) {
    b2World world(b2Vec2(0.0f, -10.0f));
    b2Body* ground = makeBody(world, b2_staticBody, {0.0f, 0.0f});
    b2Body* beam = makeBody(world, b2_dynamicBody, {1.0f, 2.0f});
    addBox(*beam, 1.0, 0.125, 0.5f);
    b2Body* ball = makeBody(world, b2_dynamicBody, {1.5f, 5.0f});
    addFixture(*ball, circle(0.5f), 0.5f);
    b2WeldJointDef def;
    def.Initialize(ground, beam, b2Vec2(0.0f, 2.0f));
    b2Joint* weld = world.CreateJoint(&def);
    std::vector<bool> plainHolds, holds;
    const auto breakWeld = [&] {
        if (weld != nullptr && weld->GetReactionForce(60.0f).Length() > 40.0f) {
            world.DestroyJoint(weld);
            weld = nullptr;
        }
        plainHolds.push_back(weld != nullptr);
    };
    const Trajectory plain = run(world, {beam, ball}, 1.0f / 60.0f, 120, breakWeld);
    EXPECT_TRUE(plainHolds.front());
    EXPECT_FALSE(plainHolds.back());
    const Scenario scene = load(std::string(kScenes) + "break.json");
    EXPECT_TRUE(same(plain, adapterRun("box2d:preset=default", scene, 1.0 / 60, 120, &holds)));
    EXPECT_EQ(plainHolds, holds);
}

}  // namespace
}  // namespace rigor::plain
