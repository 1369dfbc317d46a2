// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Stack: a pyramid of ten unit squares, let down on the floor.
#include "adapters/conformance/plain_programs/box2d/run.hpp"

namespace rigor::plain {
namespace {

TEST(PlainBox2d, Stack) {
    b2World world(b2Vec2(0.0f, -10.0f));
    std::vector<b2Body*> bodies{makeBody(world, b2_staticBody, {0.0f, -10.0f})};
    addFixture(*bodies[0], box(50.0f, 10.0f), 0.5f);
    for (int row = 0; row < 4; ++row)
        for (int i = 0; i < 4 - row; ++i) {
            const float x = 1.125f * i + 0.5625f * row;
            bodies.push_back(makeBody(world, b2_dynamicBody, {x, 0.5625f + 1.125f * row}));
            addBox(*bodies.back(), 0.5, 0.5, 0.5f);
        }
    const Trajectory plain = run(world, bodies, 1.0f / 60.0f, 180);
    EXPECT_GT(travel(plain, 10), 0.1);
    const Scenario scene = load(std::string(kScenes) + "stack.json");
    EXPECT_TRUE(same(plain, adapterRun("box2d:preset=default", scene, 1.0 / 60, 180)));
}

}  // namespace
}  // namespace rigor::plain
