// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies that bounce off others that rest (pipeline/step_landings.cpp): at their own times within a step, without overlap
// before, and without loss of momentum, wherever in the step they meet.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class BounceAhead : public testing::Test {};
using BounceSpaces = testing::Types<Space2d, Space3d>;
TYPED_TEST_SUITE(BounceAhead, BounceSpaces);

constexpr double kSpeed = 5, kRadius = 0.2, kHalf = 0.25, kBall = 2, kCube = 3;
constexpr double kGap = 0.31;  ///< between the ball and the cube at the start

/// A ball flies at a cube that rests on ice: alone, or with others side by side.
template <class S>
struct RestingPair {
    World<S> world;
    BodyId ball, cube;

    explicit RestingPair(double restitution) : world(settings()) {
        const auto ice = world.addMaterial(0, 0);
        const auto stuff = world.addMaterial(0, static_cast<typename S::Real>(restitution));
        addGround<S>(world, ice);
        cube = addCube<S>(world, 0, kHalf, kHalf, kCube, stuff);
        ball = addBall<S>(world, -kHalf - kRadius - kGap, kHalf, kRadius, kBall, stuff);
        for (int i = 0; i < 10; ++i) world.step(typename S::Real(1e-3));  // the cube comes to rest
        // It meets the cube at the height of its middle.
        world.setVelocity(ball, at<S>(kSpeed, 0.5 * 9.81 * kGap / kSpeed), spin<S>(0));
    }
    static WorldDef<S> settings() {
        WorldDef<S> def = earth<S>();
        def.integrator = "moreau_midpoint";
        return def;
    }
    double gap() const { return double(world.pose(cube).p[0] - world.pose(ball).p[0]) - kHalf - kRadius; }
    double momentum() const {
        return kBall * double(world.velocity(ball)[0]) + kCube * double(world.velocity(cube)[0]);
    }
};

TYPED_TEST(BounceAhead, MomentumIsKept) {
    for (const double restitution : {0.0, 0.5})
        for (int rate = 50; rate < 90; ++rate) {
            RestingPair<TypeParam> pair(restitution);
            for (int i = 0; i * (1.0 / rate) < 0.12; ++i) {
                pair.world.step(1.0 / rate);
                ASSERT_NEAR(pair.momentum(), kBall * kSpeed, 1e-11) << rate << ' ' << restitution;
            }
        }
}

TYPED_TEST(BounceAhead, ShapesDoNotOverlapBefore) {
    for (int rate = 50; rate < 90; ++rate) {
        RestingPair<TypeParam> pair(0.5);
        double least = 1;
        for (int i = 0; i * (1.0 / rate) < 0.12; ++i) {
            pair.world.step(1.0 / rate);
            least = std::min(least, pair.gap());
        }
        EXPECT_GE(least, -1e-3) << rate;  // a step is 55 to 100 mm
    }
}

/// The speed at which they part is half of that at which they meet, and they are where the impact at its time takes them.
TYPED_TEST(BounceAhead, TheyPartAsTheLawHasIt) {
    const double common = kBall * kSpeed / (kBall + kCube);
    const double ball = common - 0.5 * kSpeed * kCube / (kBall + kCube);
    for (int rate = 50; rate < 90; ++rate) {
        RestingPair<TypeParam> pair(0.5);
        const double before = pair.gap();
        int steps = 0;
        for (; steps * (1.0 / rate) < 0.1; ++steps) pair.world.step(1.0 / rate);
        EXPECT_NEAR(double(pair.world.velocity(pair.ball)[0]), ball, 1e-6) << rate;
        const double after = steps * (1.0 / rate) - before / kSpeed;
        EXPECT_NEAR(pair.gap(), 0.5 * kSpeed * after, 2e-3) << rate;
    }
}

/// A ball flies at a cube off its middle, without gravity. Forces of nothing keep both from being bodies in flight, which have
/// impacts of their own (ccd/flight_impacts.hpp).
template <class S>
struct FreePair {
    static constexpr double kMomentum = kBall * kSpeed + kCube * 0.3;
    World<S> world;
    BodyId ball, cube;

    FreePair() : world(settings()) {
        const auto stuff = world.addMaterial(0.4, 0.5);
        cube = addCube<S>(world, 0, 0, kHalf, kCube, stuff);
        world.setVelocity(cube, at<S>(0.3, -0.4), spin<S>(0));
        ball = addBall<S>(world, -kHalf - kRadius - kGap, 0.11, kRadius, kBall, stuff, kSpeed, 0, 3);
        for (const BodyId body : {cube, ball}) {
            ConstantForce<S> nothing;
            nothing.body = body;
            world.addForce(nothing);
        }
    }
    static WorldDef<S> settings() {
        WorldDef<S> def;
        def.integrator = "moreau_midpoint";
        return def;
    }
    double spinAboutOrigin() const {
        const auto of = [&](BodyId body, double mass, double inertia) {
            const auto x = world.pose(body).p;
            const auto v = world.velocity(body);
            return mass * double(x[0] * v[1] - x[1] * v[0]) +
                   inertia * spinOf<S>(world.angularVelocity(body));
        };
        return of(ball, kBall, 0.4 * kBall * kRadius * kRadius) +
               of(cube, kCube, 2.0 / 3 * kCube * kHalf * kHalf);
    }
    double momentum() const {
        return kBall * double(world.velocity(ball)[0]) + kCube * double(world.velocity(cube)[0]);
    }
};

TYPED_TEST(BounceAhead, TwoBodiesKeepTheirAngularMomentum) {
    for (int rate = 50; rate < 90; ++rate) {
        FreePair<TypeParam> pair;
        const double before = pair.spinAboutOrigin();
        for (int i = 0; i * (1.0 / rate) < 0.2; ++i) {
            pair.world.step(1.0 / rate);
            ASSERT_NEAR(pair.spinAboutOrigin(), before, 1e-12) << rate << " step " << i;
            ASSERT_NEAR(pair.momentum(), FreePair<TypeParam>::kMomentum, 1e-12) << rate << " step " << i;
        }
        EXPECT_LT(double(pair.world.velocity(pair.ball)[0]), 0.5 * kSpeed) << rate;
    }
}

/// A program pushes the ball while it is about to bounce: both go on from the velocities that are shown.
TYPED_TEST(BounceAhead, MomentumIsKeptWhereAProgramPushes) {
    for (int rate = 50; rate < 90; ++rate)
        for (int push = 0; push < 8; ++push) {
            FreePair<TypeParam> pair;
            for (int i = 0; i * (1.0 / rate) < 0.2; ++i) {
                if (i == push) pair.world.applyImpulse(pair.ball, at<TypeParam>(0.25, 0), spin<TypeParam>(0));
                pair.world.step(1.0 / rate);
                const double expected = FreePair<TypeParam>::kMomentum + (i >= push ? 0.25 : 0);
                ASSERT_NEAR(pair.momentum(), expected, 1e-12) << rate << " step " << i << " push " << push;
            }
        }
}

/// Balls that touch pass a bounce on when it takes place, so that they stay together until then.
TYPED_TEST(BounceAhead, ARowPassesTheBounceOn) {
    for (int rate = 50; rate < 90; ++rate) {
        WorldDef<TypeParam> def;
        def.integrator = "moreau_midpoint";
        World<TypeParam> world(def);
        const auto stuff = world.addMaterial(0, 0.5);
        std::array<BodyId, 3> balls;
        for (int i = 0; i < 2; ++i)
            balls[i] = addBall<TypeParam>(world, 2 * kRadius * i, 0, kRadius, kBall, stuff);
        balls[2] = addBall<TypeParam>(world, -2 * kRadius - kGap, 0, kRadius, kBall, stuff, kSpeed);
        for (int i = 0; i * (1.0 / rate) < 0.12; ++i) {
            world.step(1.0 / rate);
            for (const auto& [left, right] : {std::pair{2, 0}, {0, 1}})
                ASSERT_GE(double(world.pose(balls[right]).p[0] - world.pose(balls[left]).p[0]),
                          2 * kRadius - 1e-9)
                    << rate << " step " << i;
        }
        const double momentum =
            double(world.velocity(balls[0])[0] + world.velocity(balls[1])[0] + world.velocity(balls[2])[0]);
        EXPECT_NEAR(momentum, kSpeed, 1e-11) << rate;
        EXPECT_GT(double(world.velocity(balls[1])[0]), 0.2 * kSpeed) << rate;
    }
}

}  // namespace
}  // namespace rigor::engine::test
