// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Islands against a flood fill, and the times at which bodies sleep and wake.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

TEST(Islands, AreTheConnectedComponents) {
    std::mt19937 random(5);
    Islands islands;
    for (int round = 0; round < 50; ++round) {
        const std::uint32_t n = 1 + random() % 60;
        std::vector<std::uint8_t> member(n);
        std::vector<BodyId> ids(n);
        std::vector<std::vector<std::uint32_t>> next(n);
        for (auto& m : member) m = random() % 4 != 0;
        islands.begin(n);
        for (std::uint32_t e = 0; e < n; ++e) {
            const std::uint32_t a = random() % n, b = random() % n;
            if (!member[a] || !member[b]) continue;
            islands.join(a, b);
            next[a].push_back(b);
            next[b].push_back(a);
        }
        islands.finish(member, ids);
        std::vector<std::uint32_t> expected(n, kNullIndex);
        std::uint32_t count = 0;
        std::size_t seen = 0;
        for (std::uint32_t i = 0; i < n; ++i) {
            if (!member[i] || expected[i] != kNullIndex) continue;
            std::vector<std::uint32_t> todo{i};
            while (!todo.empty()) {
                const std::uint32_t j = todo.back();
                todo.pop_back();
                if (expected[j] != kNullIndex) continue;
                expected[j] = count;
                todo.insert(todo.end(), next[j].begin(), next[j].end());
            }
            ++count;
        }
        ASSERT_EQ(islands.count(), count);
        for (std::uint32_t i = 0; i < n; ++i) EXPECT_EQ(islands.islandOf(i), expected[i]);
        for (std::uint32_t k = 0; k < count; ++k) {
            std::uint32_t last = 0;
            for (const std::uint32_t i : islands.members(k)) {
                EXPECT_EQ(expected[i], k);
                EXPECT_TRUE(i > last || seen == 0 || i == islands.members(k)[0]);
                last = i;
                ++seen;
            }
            EXPECT_EQ(islands.bodies(k).size(), islands.members(k).size());
        }
        EXPECT_EQ(islands.islandOf(n), kNullIndex);
        seen = 0;
    }
}

template <class S>
class Sleeping : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Sleeping, Spaces);

constexpr double kStep = 1.0 / 60;

/// A stack of cubes on the ground and a sphere apart from it.
template <class S>
struct Scene {
    explicit Scene(const char* sleeping = "islands") : world(defOf(sleeping)) {
        material = world.addMaterial(typename S::Real(0.5), 0);
        ground = addGround<S>(world, material);
        for (int i = 0; i < 3; ++i) stack.push_back(addCube<S>(world, 0, 0.5 + i, 0.5, 1, material));
        ball = addBall<S>(world, 5, 0.25, 0.25, 1, material);
    }
    static WorldDef<S> defOf(const char* sleeping) {
        WorldDef<S> def = earth<S>();
        def.sleeping = sleeping;
        return def;
    }
    void run(int steps) {
        for (int i = 0; i < steps; ++i) world.step(typename S::Real(kStep));
    }
    int asleep() const {
        int count = world.isAsleep(ball);
        for (const BodyId id : stack) count += world.isAsleep(id);
        return count;
    }
    World<S> world;
    std::uint32_t material;
    BodyId ground, ball;
    std::vector<BodyId> stack;
};

template <class S>
bool samePose(const Pose<S>& a, const Pose<S>& b) {
    if (a.p != b.p) return false;
    if constexpr (S::dim == 2)
        return a.q.c == b.q.c && a.q.s == b.q.s;
    else
        return a.q.coeffs() == b.q.coeffs();
}

TYPED_TEST(Sleeping, AStackFallsAsleepAndKeepsItsPoseAndContactsExactly) {
    using S = TypeParam;
    Scene<S> scene;
    scene.run(20);
    EXPECT_EQ(scene.asleep(), 0) << "not before the time to sleep";
    EXPECT_EQ(scene.world.islands().count(), 2u);
    EXPECT_EQ(scene.world.islands().bodies(0).size(), 3u);
    scene.run(40);
    ASSERT_EQ(scene.asleep(), 4);
    EXPECT_EQ(scene.world.lastStep().sleeping, 4u);
    std::vector<Pose<S>> poses;
    for (const BodyId id : scene.stack) poses.push_back(scene.world.pose(id));
    std::vector<ContactView<S>> before, after;
    scene.world.readContacts(before);
    scene.run(200);
    scene.world.readContacts(after);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        EXPECT_TRUE(samePose<S>(poses[i], scene.world.pose(scene.stack[i])));
        EXPECT_EQ(scene.world.velocity(scene.stack[i]).norm(), 0);
    }
    ASSERT_EQ(after.size(), before.size());
    ASSERT_GT(after.size(), 4u);
    double weight = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        EXPECT_EQ(after[i].normalImpulse, before[i].normalImpulse);
        if (after[i].bodyA == scene.ground) weight += static_cast<double>(after[i].normalImpulse);
    }
    EXPECT_NEAR(weight, 4 * kGravity * kStep, 1e-2) << "what the ground carries";
    EXPECT_EQ(scene.world.lastStep().rows, 0u);
}

TYPED_TEST(Sleeping, WokenStackStandsAsIfItHadNeverSlept) {
    using S = TypeParam;
    Scene<S> scene;
    scene.run(100);
    ASSERT_EQ(scene.asleep(), 4);
    const double top = static_cast<double>(scene.world.pose(scene.stack[2]).p.y());
    scene.world.applyForce(scene.stack[0], at<S>(1e-3, 0), zeroAng<S>());
    EXPECT_EQ(scene.asleep(), 1) << "the ball sleeps on";
    scene.run(20);
    EXPECT_NEAR(static_cast<double>(scene.world.pose(scene.stack[2]).p.y()), top, 1e-4);
    for (const BodyId id : scene.stack) EXPECT_LT(static_cast<double>(scene.world.velocity(id).norm()), 0.01);
    EXPECT_EQ(scene.asleep(), 1);
    scene.run(100);
    EXPECT_EQ(scene.asleep(), 4) << "and goes to sleep again";
}

TYPED_TEST(Sleeping, AHitWakesTheStackAndKeepsMomentum) {
    using S = TypeParam;
    for (const char* ccd : {"none", "speculative", "conservative_advancement"}) {
        WorldDef<S> def = euler<S>();  // no gravity, no ground: momentum is conserved
        def.sleeping = "islands";
        def.continuousCollision = ccd;
        World<S> world(def);
        const auto material = world.addMaterial(0, 0);
        std::vector<BodyId> row;
        for (int i = 0; i < 3; ++i) row.push_back(addCube<S>(world, i, 0, 0.5, 1, material));
        for (int i = 0; i < 60; ++i) world.step(typename S::Real(kStep));
        for (const BodyId id : row) ASSERT_TRUE(world.isAsleep(id));
        const BodyId ball = addBall<S>(world, -3, 0, 0.25, 1, material, 40);
        for (int i = 0; i < 30; ++i) world.step(typename S::Real(kStep));
        double momentum = static_cast<double>(world.velocity(ball).x());
        for (const BodyId id : row) {
            EXPECT_FALSE(world.isAsleep(id)) << ccd;
            EXPECT_GT(static_cast<double>(world.velocity(id).x()), 5) << ccd;
            momentum += static_cast<double>(world.velocity(id).x());
        }
        EXPECT_NEAR(momentum, 40, 1e-3) << ccd;
    }
}

TYPED_TEST(Sleeping, WakeByVelocityJointShapeAndRemovalOfANeighbour) {
    using S = TypeParam;
    const auto sleeping = [] {
        Scene<S> scene;
        scene.run(100);
        EXPECT_EQ(scene.asleep(), 4);
        return scene;
    };
    {
        Scene<S> scene = sleeping();
        scene.world.setVelocity(scene.stack[1], at<S>(0.5, 0), zeroAng<S>());
        EXPECT_EQ(scene.asleep(), 1);
        scene.run(3);
        EXPECT_GT(static_cast<double>(scene.world.pose(scene.stack[1]).p.x()), 0.001);
    }
    {
        Scene<S> scene = sleeping();
        JointDef<S> joint;
        joint.bodyA = scene.ball;
        scene.world.addJoint(joint);
        EXPECT_EQ(scene.asleep(), 3);
    }
    {
        Scene<S> scene = sleeping();
        attach<S>(scene.world, scene.ball, Sphere<S>{typename S::Real(0.3)}, scene.material);
        EXPECT_EQ(scene.asleep(), 3);
    }
    {
        Scene<S> scene = sleeping();
        scene.world.removeBody(scene.stack[0]);
        EXPECT_TRUE(scene.world.isAsleep(scene.ball));
        scene.run(30);
        EXPECT_LT(static_cast<double>(scene.world.pose(scene.stack[2]).p.y()), 1.7) << "the rest has fallen";
        EXPECT_TRUE(scene.world.isAsleep(scene.ball));
    }
    {
        Scene<S> scene = sleeping();
        scene.world.removeBody(scene.ground);
        EXPECT_EQ(scene.asleep(), 0);
        scene.run(10);
        EXPECT_LT(static_cast<double>(scene.world.pose(scene.ball).p.y()), 0.2);
    }
}

TYPED_TEST(Sleeping, JointsMakeIslandsAndSleepToo) {
    using S = TypeParam;
    WorldDef<S> def = earth<S>();
    def.sleeping = "islands";
    World<S> world(def);
    std::vector<BodyId> chain;
    for (int i = 0; i < 4; ++i) {
        BodyDef<S> body;
        body.pose.p = at<S>(0, -0.5 - i);
        body.mass = 1;
        body.inertia = isotropic<S>(0.1);
        chain.push_back(world.addBody(body));
        JointDef<S> joint;
        if (i > 0) joint.bodyA = chain[static_cast<std::size_t>(i) - 1];
        joint.anchorA = at<S>(0, i > 0 ? -0.5 : 0);
        joint.bodyB = chain.back();
        joint.anchorB = at<S>(0, 0.5);
        world.addJoint(joint);
    }
    for (int i = 0; i < 60; ++i) world.step(typename S::Real(kStep));
    EXPECT_EQ(world.islands().count(), 1u);
    for (const BodyId id : chain) ASSERT_TRUE(world.isAsleep(id));
    for (int i = 0; i < 10; ++i) ASSERT_FALSE(world.step(typename S::Real(kStep)).nonFinite);
    world.setVelocity(chain[3], at<S>(0.3, 0), zeroAng<S>());
    for (const BodyId id : chain) EXPECT_FALSE(world.isAsleep(id));
    for (int i = 0; i < 20; ++i) world.step(typename S::Real(kStep));
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const auto end = toWorld<S>(world.pose(chain[i]), at<S>(0, -0.5));
        const auto begin = toWorld<S>(world.pose(chain[i + 1]), at<S>(0, 0.5));
        EXPECT_LT(static_cast<double>((end - begin).norm()), tol<S>(1e-6, 1e-4))
            << "impulses are taken up again";
    }
}

TYPED_TEST(Sleeping, AKinematicBodyThatMovesKeepsAndMakesAwake) {
    using S = TypeParam;
    Scene<S> scene;
    scene.run(100);
    ASSERT_EQ(scene.asleep(), 4);
    BodyDef<S> pusher;
    pusher.type = BodyType::Kinematic;
    pusher.pose.p = at<S>(-1.6, 0.5);
    pusher.velocity = at<S>(0.2, 0);
    attach<S>(scene.world, scene.world.addBody(pusher), Box<S>{S::Vec::Constant(typename S::Real(0.5))},
              scene.material);
    scene.run(240);
    EXPECT_TRUE(scene.world.isAsleep(scene.ball));
    EXPECT_FALSE(scene.world.isAsleep(scene.stack[0]));
    EXPECT_GT(static_cast<double>(scene.world.pose(scene.stack[0]).p.x()), 0.15);
}

/// A weight on a spring is slow twice in each swing, a tenth of a second at a time: it never rests long
/// enough, however often. One whose swing is slow throughout sleeps on time.
TYPED_TEST(Sleeping, OnlyRestWithoutInterruptionCounts) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const double amplitude : {0.01, 0.001}) {
        WorldDef<S> def;
        def.sleeping = "islands";
        def.sleepLinearVelocity = R(0.05);
        def.timeToSleep = R(0.5);
        World<S> world(def);
        BodyDef<S> body;
        body.mass = 1;
        body.inertia = isotropic<S>(1);
        body.pose.p = at<S>(1 + amplitude, 0);
        const BodyId id = world.addBody(body);
        LinearSpring<S> spring;
        spring.bodyB = id;
        spring.stiffness = 100;
        spring.restLength = 1;
        world.addForce(spring);
        double slept = 0;
        for (int i = 0; i < 300 && slept == 0; ++i) {
            world.step(static_cast<R>(kStep));
            if (world.isAsleep(id)) slept = world.time();
        }
        if (amplitude == 0.01) {
            EXPECT_EQ(slept, 0);
        } else {
            EXPECT_NEAR(slept, 0.5, 2 * kStep);
        }
    }
}

/// The linear and the angular velocity each keepa body awake, by a threshold of their own.
TYPED_TEST(Sleeping, WhatOnlySpinsOrOnlyDriftsIsAwake) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const double speed : {0.0, 0.02, 0.04})
        for (const double turn : {0.0, 0.2, 0.4}) {
            WorldDef<S> def;
            def.sleeping = "islands";
            def.sleepLinearVelocity = R(0.03);
            def.sleepAngularVelocity = R(0.3);
            World<S> world(def);
            BodyDef<S> body;
            body.mass = 1;
            body.inertia = isotropic<S>(1);
            body.velocity = at<S>(speed, 0);
            body.angularVelocity = spin<S>(-turn);
            const BodyId id = world.addBody(body);
            for (int i = 0; i < 120; ++i) world.step(static_cast<R>(kStep));
            EXPECT_EQ(world.isAsleep(id), speed < 0.03 && turn < 0.3) << speed << " " << turn;
        }
}

TYPED_TEST(Sleeping, OffChangesNoBitsAndCopiesAndHashesKnowTheTimers) {
    using S = TypeParam;
    Scene<S> off("off"), on("islands");
    off.run(25);
    on.run(25);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_TRUE(samePose<S>(off.world.pose(off.stack[i]), on.world.pose(on.stack[i])))
            << "before anybody sleeps there is no difference";
    EXPECT_NE(off.world.stateHash(), on.world.stateHash()) << "but the timers run";
    Scene<S> copy = on;
    for (int i = 0; i < 60; ++i) {
        on.run(1);
        copy.run(1);
        ASSERT_EQ(on.world.stateHash(), copy.world.stateHash());
    }
    EXPECT_EQ(copy.asleep(), 4);
    off.run(200);
    EXPECT_EQ(off.asleep(), 0);
}

}  // namespace
}  // namespace rigor::engine::test
