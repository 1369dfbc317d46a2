// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Runs that part in a known way: when, which body, at which contact, how fast.
#include "validation/chaos/divergence.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "validation/references/tests/scene.hpp"

namespace rigor::validation::testing {
namespace {

constexpr double kDt = 0.01;
constexpr int kFrames = 400;

/// Three balls of radius 0.25 m; run b differs from run a by what is put in.
struct Pair {
    Scenario scenario = emptyScene(3, {0, -10, 0}, kDt* kFrames);
    Trajectory a, b;

    Pair() {
        addFloor(scenario);
        for (const char* name : {"one", "two", "three"}) addBall(scenario, name, 0.25, 1, 0.4, {});
        a.dt = kDt;
        a.bodyCount = scenario.bodies.size();
        for (int k = 0; k <= kFrames; ++k) {
            a.times.push_back(k * kDt);
            a.states.resize(a.states.size() + a.bodyCount);
            a.contacts.emplace_back();
        }
        b = a;
    }
    BodyState& atB(int frame, int body) { return b.states[frame * b.bodyCount + body]; }
    static void touch(Trajectory& t, int frame, int one, int other) {
        ContactPoint c;
        c.bodyA = one;
        c.bodyB = other;
        c.depth = 0.001;
        t.contacts[frame].push_back(c);
    }
};

TEST(Divergence, OfAnExponentialSplitIsRecovered) {
    Pair pair;
    const double d0 = 1e-9, rate = 5.0;
    for (int k = 0; k <= kFrames; ++k) {
        pair.atB(k, 2).position = {0.6 * d0 * std::exp(rate * k * kDt), 0,
                                   0.8 * d0 * std::exp(rate * k * kDt)};
        pair.atB(k, 1).position = {0, 0.5 * d0 * std::exp(rate * k * kDt), 0};
    }
    // Body 1 stands on the floor in both until frame 250, in run a alone from then on, a frame late before.
    for (int k = 1; k <= kFrames; ++k) Pair::touch(pair.a, k, 0, 1);
    for (int k = 2; k < 250; ++k) Pair::touch(pair.b, k, 0, 1);
    const Divergence d = divergenceOf(pair.scenario, pair.a, pair.b, {0.01, 1, 1});
    EXPECT_EQ(d.length, 0.5);
    // d0 exp(r t) = 0.005 m, at the next frame
    const double exact = std::log(0.005 / d0) / rate;
    ASSERT_TRUE(d.divergenceTime);
    EXPECT_GE(*d.divergenceTime, exact);
    EXPECT_LT(*d.divergenceTime, exact + kDt);
    EXPECT_EQ(d.body, 2);
    ASSERT_TRUE(d.growth);
    EXPECT_NEAR(d.growth->rate, rate, 1e-9);
    EXPECT_NEAR(d.growth->low, rate, 1e-6);
    EXPECT_NEAR(d.growth->until, *d.divergenceTime, 1e-12);
    ASSERT_TRUE(d.split);
    EXPECT_NEAR(d.split->time, 2.51 - kDt + kDt, 1e-12) << "frame 250 still has 249 beside it";
    EXPECT_EQ(d.split->bodyA, 0);
    EXPECT_EQ(d.split->bodyB, 1);
    EXPECT_TRUE(d.split->inFirst);
    EXPECT_NEAR(d.largest, d0 * std::exp(rate * kFrames * kDt), 1e-12);
}

TEST(Divergence, NoiseWidensTheIntervalAroundTheRate) {
    Pair pair;
    for (int k = 0; k <= kFrames; ++k)
        pair.atB(k, 1).position = {1e-9 * std::exp(3.0 * k * kDt + 0.8 * std::sin(1.0 + 97.0 * k)), 0, 0};
    const auto growth = divergenceOf(pair.scenario, pair.a, pair.b, {0.01, 1, 1}).growth;
    ASSERT_TRUE(growth);
    EXPECT_LT(growth->low, 3.0);
    EXPECT_GT(growth->high, 3.0);
    EXPECT_GT(growth->high - growth->low, 0.01);
}

TEST(Divergence, OfEqualRunsIsNone) {
    Pair pair;
    for (int k = 1; k <= kFrames; ++k) {
        Pair::touch(pair.a, k, 0, 1);
        Pair::touch(pair.b, k, 0, 1);
    }
    const Divergence d = divergenceOf(pair.scenario, pair.a, pair.b, {0.01, 1, 1});
    EXPECT_FALSE(d.divergenceTime);
    EXPECT_FALSE(d.growth);
    EXPECT_FALSE(d.split);
    EXPECT_EQ(d.largest, 0.0);
}

TEST(Divergence, AConstantDistanceDoesNotGrow) {
    Pair pair;
    for (int k = 0; k <= kFrames; ++k) pair.atB(k, 1).position = {0.001, 0, 0};
    EXPECT_FALSE(divergenceOf(pair.scenario, pair.a, pair.b, {0.01, 1, 1}).growth);
    pair.atB(7, 3).position = {0, 0.006, 0};
    const Divergence d = divergenceOf(pair.scenario, pair.a, pair.b, {0.01, 1, 1});
    EXPECT_DOUBLE_EQ(d.divergenceTime.value(), 0.07);
    EXPECT_EQ(d.body, 3);
}

TEST(Divergence, ContactsThatCarryNothingAreNone) {
    Pair pair;
    for (int k = 1; k <= kFrames; ++k) Pair::touch(pair.a, k, 1, 2);
    for (auto& frame : pair.a.contacts)
        for (auto& c : frame) {
            c.hasImpulse = true;
            c.normalImpulse = 0.0;
        }
    EXPECT_FALSE(divergenceOf(pair.scenario, pair.a, pair.b, {0.01, 1, 1}).split);
    pair.a.contacts[100][0].normalImpulse = 1.0;
    const auto split = divergenceOf(pair.scenario, pair.a, pair.b, {0.01, 1, 1}).split;
    ASSERT_TRUE(split);
    EXPECT_DOUBLE_EQ(split->time, 1.0);
    EXPECT_EQ(split->bodyB, 2);
    // Stored every fourth frame: seen where it is.
    EXPECT_DOUBLE_EQ(divergenceOf(pair.scenario, pair.a, pair.b, {0.01, 4, 1}).split->time, 1.0);
    EXPECT_FALSE(divergenceOf(pair.scenario, pair.a, pair.b, {0.01, 3, 1}).split);
}

TEST(Divergence, OtherRunsAreRefused) {
    Pair pair;
    Trajectory shorter = pair.b;
    shorter.times.back() += 0.5;
    EXPECT_THROW(divergenceOf(pair.scenario, pair.a, shorter, {}), std::invalid_argument);
    pair.b.bodyCount = 2;
    EXPECT_THROW(divergenceOf(pair.scenario, pair.a, pair.b, {}), std::invalid_argument);
}

TEST(SceneLength, IsOfTheBodies) {
    Scenario s = emptyScene(3, {}, 1);
    addBox(s, "a", {0.3, 0.4, 0.0 + 1.2}, 1, {});  // 1.3 m from the centre
    EXPECT_DOUBLE_EQ(sceneLength(s), 2.6);
    s.bodies[0].shapes.clear();
    addJoint(s, JointType::Ball, kNone, 0, {0, 3, 4});
    EXPECT_DOUBLE_EQ(sceneLength(s), 5.0);
}

}  // namespace
}  // namespace rigor::validation::testing
