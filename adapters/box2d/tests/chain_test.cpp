// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Chains: Box2D's have one side and lose their radius when they are copied; the format's have two sides, and
// bodies rest on the true line.
#include <algorithm>
#include <cmath>
#include <string>

#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

constexpr double kStep = 1.0 / 240;
constexpr double kG = 9.81;

scenario::Chain floorOf(int links, bool reversed) {
    scenario::Chain chain;
    for (int i = 0; i <= links; ++i) chain.vertices.push_back({-1.0 + 2.0 * i / links, 0, 0});
    if (reversed) std::reverse(chain.vertices.begin(), chain.vertices.end());
    return chain;
}

Scenario onFloor(const scenario::Chain& chain, const Geometry& geometry, const Vec3& position,
                 double friction = 0.0) {
    Scenario s = scene(friction, 0.0, 2);
    addStatic(s, chain);
    addBody(s, geometry, position, 1.0, {0.01, 0.01, 0.01});
    return s;
}

/// Bodies touch the chain from above and from below, for both orders of the vertices.
TEST(Box2dChain, HasTwoSides) {
    for (const bool reversed : {false, true})
        for (const double side : {1.0, -1.0})
            for (const Geometry& geometry : {Geometry{Sphere{0.1}}, Geometry{Box{{0.1, 0.1, 0}}}}) {
                Scenario s = onFloor(floorOf(4, reversed), geometry, {0.2, 0.15 * side, 0});
                s.gravity = {0, -kG * side, 0};
                Simulation run(s, kStep, "preset=matched");
                run.steps(240);
                EXPECT_NEAR(run.state(1).position.y, 0.1 * side, 2e-3) << reversed << side;
            }
}

/// Box2D copies a chain without its radius: then discs would stand 7.5 mm of its lengths above the line.
TEST(Box2dChain, BodiesRestOnItsLineInMatched) {
    for (const double scale : {1.0, 4.0}) {
        Scenario s = onFloor(floorOf(4, false), Sphere{0.1}, {0.2, 0.1, 0});
        Simulation run(s, kStep, "preset=matched,scale=" + std::to_string(scale));
        run.steps(240);
        EXPECT_NEAR(run.state(1).position.y, 0.1, 2e-4 / scale);
    }
}

/// Ghost vertices: a box that slides without friction over many joints keeps its speed and does not turn.
TEST(Box2dChain, InnerVerticesDoNotCatch) {
    Scenario s = onFloor(floorOf(40, false), Box{{0.1, 0.1, 0}}, {-0.8, 0.1, 0});
    s.bodies[1].velocity = {1.5, 0, 0};
    Simulation run(s, kStep, "preset=matched");
    run.steps(240);
    EXPECT_NEAR(run.state(1).velocity.x, 1.5, 1e-4);
    EXPECT_NEAR(angleAboutZ(run.state(1).orientation), 0.0, 1e-4);
}

/// A disc that leaves a free end rolls about the last vertex: it is still touched when its centre is beyond.
TEST(Box2dChain, AFreeEndIsACorner) {
    Scenario s = onFloor(floorOf(4, false), Sphere{0.1}, {0.999, 0.1, 0});
    s.bodies[1].velocity = {0.2, 0, 0};
    Simulation run(s, kStep, "preset=matched");
    bool beyond = false;
    for (int i = 0; i < 40; ++i) {
        run.steps(1);
        for (const ContactPoint& c : run.contacts())
            beyond = beyond || (run.state(1).position.x > 1.01 && c.normal.x > 0.05);
    }
    EXPECT_TRUE(beyond);
}

/// Bodies rest in a closed chain and on it.
TEST(Box2dChain, ALoopHoldsFromWithinAndWithout) {
    scenario::Chain loop{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, true};
    for (const bool within : {true, false}) {
        Scenario s = onFloor(loop, Box{{0.1, 0.1, 0}}, {0.1, within ? -0.85 : 1.15, 0});
        Simulation run(s, kStep, "preset=matched");
        run.steps(240);
        EXPECT_NEAR(run.state(1).position.y, within ? -0.9 : 1.1, 2e-3);
    }
}

TEST(Box2dChain, QueriesSeeTheNearestLink) {
    const Geometry chain = scenario::Chain{{{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}}, false}, disc = Sphere{0.3};
    adapter::CollisionQuery query;
    query.dimension = 2;
    query.a = {&chain, {}};
    query.b = {&disc, {{-0.5, 0.4, 0}, {}}};
    const auto apart = engine().collision()->collide(query);
    EXPECT_FALSE(apart.overlap);
    EXPECT_NEAR(apart.signedDistance.value(), 0.1, 1e-6);
    query.b.pose.position = {-0.5, 0.2, 0};
    const auto above = engine().collision()->collide(query);
    ASSERT_TRUE(above.overlap);
    EXPECT_NEAR(above.contacts[0].depth, 0.1, 1e-6);
    EXPECT_NEAR(norm(above.contacts[0].normal - Vec3{0, 1, 0}), 0.0, 1e-5);
    query.b.pose.position = {-0.5, -0.2, 0};
    const auto below = engine().collision()->collide(query);
    ASSERT_TRUE(below.overlap);
    EXPECT_NEAR(norm(below.contacts[0].normal - Vec3{0, -1, 0}), 0.0, 1e-5);
}

TEST(Box2dChain, VerticesWithinASlopAreRefused) {
    const scenario::Chain fine{{{0, 0, 0}, {0.003, 0, 0}, {1, 0, 0}}, false};
    const auto build = [&](const char* options) {
        Simulation run(onFloor(fine, Sphere{0.1}, {0, 1, 0}), kStep, options);
    };
    EXPECT_THROW(build("preset=default"), adapter::Unsupported);
    EXPECT_NO_THROW(build("preset=matched"));
}

}  // namespace
}  // namespace rigor::test
