// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Chain, the mesh of 2D: a disc and a square in a trough. Box2D's chain is solid to the left of its
// direction, so the manual's way is from right to left, with ghost vertices that go on in the same direction.
#include "adapters/conformance/plain_programs/box2d/run.hpp"

namespace rigor::plain {
namespace {

TEST(PlainBox2d, Chain) {
    b2World world(b2Vec2(0.0f, -10.0f));
    b2Body* trough = makeBody(world, b2_staticBody, {0.0f, 0.0f});
    const b2Vec2 points[] = {{4.0f, 4.0f},   {3.0f, 2.25f}, {2.0f, 1.0f},   {1.0f, 0.25f}, {0.0f, 0.0f},
                             {-1.0f, 0.25f}, {-2.0f, 1.0f}, {-3.0f, 2.25f}, {-4.0f, 4.0f}};
    b2ChainShape chain;
    chain.CreateChain(points, 9, b2Vec2(5.0f, 6.0f), b2Vec2(-5.0f, 6.0f));
    addFixture(*trough, chain, 0.5f);
    b2Body* disc = makeBody(world, b2_dynamicBody, {2.0f, 1.75f});
    addFixture(*disc, circle(0.5f), 0.5f);
    b2Body* block = makeBody(world, b2_dynamicBody, {-1.5f, 3.0f});
    addBox(*block, 0.25, 0.25, 0.5f);
    const Trajectory plain = run(world, {trough, disc, block}, 1.0f / 60.0f, 180);
    EXPECT_GT(travel(plain, 1), 1.0);
    EXPECT_GT(travel(plain, 2), 1.0);
    const Scenario scene = load(std::string(kScenes) + "chain.json");
    EXPECT_TRUE(same(plain, adapterRun("box2d:preset=default", scene, 1.0 / 60, 180)));
}

}  // namespace
}  // namespace rigor::plain
