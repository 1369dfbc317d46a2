// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A program changes a world that runs: it puts bodies elsewhere, wakes them and lets them sleep.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/core/error.hpp"
#include "engine/embedding/tests/tick.hpp"
#include "engine/pipeline/tests/scene.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class WorldControl : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(WorldControl, Spaces);

/// Two cubes of 1 m, one on the other, at rest.
template <class S>
struct Stack {
    World<S> world;
    BodyId ground, lower, upper;
    explicit Stack(const WorldDef<S>& def) : world(def) {
        using R = typename S::Real;
        const std::uint32_t stone = world.addMaterial(R(0.5), R(0));
        BodyDef<S> fixed;
        fixed.type = BodyType::Static;
        fixed.pose.p = at<S>(0, -1);
        ground = world.addBody(fixed);
        attach<S>(world, ground, Box<S>{S::Vec::Constant(R(1)) + at<S>(20, 0)}, stone);
        lower = addCube<S>(world, 0, 0.5, 0.5, 1, stone);
        upper = addCube<S>(world, 0, 1.5, 0.5, 1, stone);
        step(120);
    }
    void step(int count) {
        for (int i = 0; i < count; ++i) world.step(static_cast<typename S::Real>(kTick));
    }
    double height(BodyId body) const { return static_cast<double>(world.pose(body).p[1]); }
};

template <class S>
WorldDef<S> sleepy(bool sleeps) {
    WorldDef<S> def = earthByEuler<S>();
    if (sleeps) def.sleeping = "islands";
    return def;
}

/// A force or an impulse at a point has the moment (point - centre of mass) x force; a point moves with v + w x r.
TYPED_TEST(WorldControl, ForcesAndImpulsesActAtAPoint) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world{WorldDef<S>{}};
    BodyDef<S> def;
    def.mass = 2;
    def.inertia = isotropic<S>(0.5);
    def.pose.p = at<S>(3, 4);
    def.centerOfMass = at<S>(0.25, 0);
    const BodyId body = world.addBody(def);
    const typename S::Vec center = at<S>(3.25, 4), point = at<S>(3.75, 4), up = at<S>(0, 8);
    world.applyImpulseAt(body, up, point);
    // v = 8 / 2, w = 0.5 * 8 / 0.5 about the axis out of the plane.
    EXPECT_NEAR(double(world.velocityAt(body, center)[1]), 4, 1e-5);
    EXPECT_NEAR(double(world.velocityAt(body, point)[1]), 4 + 8 * 0.5, 1e-5);
    EXPECT_NEAR(double(world.velocityAt(body, at<S>(3.25, 5))[0]), -8, 1e-5);
    World<S> pushed{WorldDef<S>{}};
    const BodyId other = pushed.addBody(def);
    pushed.applyForceAt(other, typename S::Vec(up / R(kTick)), point);
    pushed.step(R(kTick));
    EXPECT_NEAR(double((pushed.velocity(other) - world.velocity(body)).norm()), 0, 1e-5);
    EXPECT_NEAR(double(dotAng(pushed.angularVelocity(other), pushed.angularVelocity(other))), 64, 1e-3);
    EXPECT_THROW(world.applyForceAt(body, at<S>(NAN, 0), point), EngineError);
}

TYPED_TEST(WorldControl, ABodyPutElsewhereFallsAndSoDoesWhatStoodOnIt) {
    using S = TypeParam;
    for (const bool sleeps : {false, true}) {
        Stack<S> stack(sleepy<S>(sleeps));
        ASSERT_EQ(stack.world.isAsleep(stack.lower), sleeps);
        Pose<S> there = stack.world.pose(stack.lower);
        there.p += at<S>(5, 3);
        stack.world.setPose(stack.lower, there);
        EXPECT_EQ(stack.world.pose(stack.lower).p, there.p);
        const double h = stack.height(stack.lower), above = stack.height(stack.upper);
        stack.step(12);
        // n steps of symplectic Euler fall by g h^2 n (n + 1) / 2.
        const double fallen = kGravity * kTick * kTick * 12 * 13 / 2;
        EXPECT_NEAR(stack.height(stack.lower), h - fallen, 2e-4) << "no contact holds it";
        EXPECT_NEAR(stack.height(stack.upper), above - fallen, 2e-4) << "nothing carries it";
        stack.step(120);
        EXPECT_NEAR(stack.height(stack.lower), 0.5, 2e-3);
        EXPECT_NEAR(stack.height(stack.upper), 0.5, 2e-3);
    }
}

TYPED_TEST(WorldControl, WhatStoodOnAStaticBodyFallsWhenThatIsPutElsewhere) {
    using S = TypeParam;
    for (const bool sleeps : {false, true}) {
        Stack<S> stack(sleepy<S>(sleeps));
        Pose<S> there = stack.world.pose(stack.ground);
        there.p -= at<S>(0, 2);
        stack.world.setPose(stack.ground, there);
        stack.step(12);
        EXPECT_NEAR(stack.height(stack.lower), 0.5 - kGravity * kTick * kTick * 12 * 13 / 2, 1e-3);
        stack.step(120);
        EXPECT_NEAR(stack.height(stack.lower), -1.5, 5e-3);
        EXPECT_NEAR(stack.height(stack.upper), -0.5, 5e-3);
    }
}

/// The way between is none: a surface in it is not in the way.
TYPED_TEST(WorldControl, APoseBeyondASurfaceStays) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world{WorldDef<S>{}};
    BodyDef<S> fixed;
    fixed.type = BodyType::Static;
    const BodyId floor = world.addBody(fixed);
    if constexpr (S::dim == 2) {
        const std::vector<typename S::Vec> line{{10, 0}, {-10, 0}};
        attach<S>(world, floor, makeChain<S>(line, false), 0);
    } else {
        const std::vector<typename S::Vec> corners{{-10, 0, -10}, {10, 0, -10}, {-10, 0, 10}, {10, 0, 10}};
        const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 2, 1}, {1, 2, 3}};
        attach<S>(world, floor, makeTriangleMesh<S>(corners, triangles), 0);
    }
    const BodyId ball = addBall<S>(world, 0.3, 1, 0.25, 1, 0);
    world.step(R(kTick));
    Pose<S> below;
    below.p = at<S>(0.3, -1);
    world.setPose(ball, below);
    for (int i = 0; i < 10; ++i) world.step(R(kTick));
    EXPECT_EQ(world.pose(ball).p, below.p);
}

TYPED_TEST(WorldControl, PosesAreThoseOfTheBodyFrame) {
    using S = TypeParam;
    World<S> world{WorldDef<S>{}};
    BodyDef<S> def;
    def.centerOfMass = at<S>(0.3, 0.1);
    const BodyId body = world.addBody(def);
    Pose<S> there;
    there.p = at<S>(1, 2);
    there.q = rotatedBy(there.q, spin<S>(0.7));
    world.setPose(body, there);
    EXPECT_LT((world.pose(body).p - there.p).norm(), typename S::Real(1e-6));
    EXPECT_LT((toMatrix(world.pose(body).q) - toMatrix(there.q)).norm(), typename S::Real(1e-6));
}

TYPED_TEST(WorldControl, SleepsAndWakesAsIslands) {
    using S = TypeParam;
    Stack<S> stack(sleepy<S>(true));
    stack.world.wake(stack.upper);
    EXPECT_FALSE(stack.world.isAsleep(stack.lower));
    stack.step(1);
    stack.world.putToSleep(stack.lower);
    EXPECT_TRUE(stack.world.isAsleep(stack.upper));
    stack.step(5);
    EXPECT_TRUE(stack.world.isAsleep(stack.upper)) << "nothing wakes it";
    stack.world.applyImpulse(stack.upper, at<S>(1, 0), spin<S>(0));
    EXPECT_FALSE(stack.world.isAsleep(stack.lower));

    Stack<S> wakeful(sleepy<S>(false));
    EXPECT_THROW(wakeful.world.putToSleep(wakeful.lower), EngineError);
}

TYPED_TEST(WorldControl, RefusesPosesThatAreNoneAndTellsItsBodies) {
    using S = TypeParam;
    Stack<S> stack(sleepy<S>(false));
    Pose<S> bad;
    bad.p[0] = std::numeric_limits<typename S::Real>::infinity();
    const std::uint64_t before = stack.world.stateHash();
    EXPECT_THROW(stack.world.setPose(stack.lower, bad), EngineError);
    EXPECT_EQ(stack.world.stateHash(), before);
    ASSERT_EQ(stack.world.bodies().size(), 3u);
    EXPECT_EQ(stack.world.bodies()[1], stack.lower);
    stack.world.beginStep(static_cast<typename S::Real>(kTick));
    EXPECT_THROW(stack.world.setPose(stack.lower, Pose<S>{}), EngineError);
}

}  // namespace
}  // namespace rigor::engine::test
