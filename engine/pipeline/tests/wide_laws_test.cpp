// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The laws of contact that the solver `wide` has in its own form, against closed forms: friction at rest and
// sliding, the cone of every contact, which impacts bounce and how far.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "engine/pipeline/tests/scene.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class WideLaws : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(WideLaws, Spaces);

/// Velocity of a box on the ground after a second in which it is pulled with `pull` of its weight, from
/// `speed` on; kinetic friction 0.3, static friction 0.6. Before, the pull grows slowly: soft contacts that
/// are loaded at once give way for a moment.
template <class S>
double pulled(double pull, double speed) {
    using R = typename S::Real;
    WorldDef<S> def = earth<S>();
    def.solver = "wide";
    World<S> world(def);
    const auto stone = world.addMaterial(R(0.3), 0, R(0.6));
    addGround<S>(world, stone);
    const BodyId box = addCube<S>(world, 0, 0.25, 0.25, 1, stone);
    const auto step = [&](double share) {
        world.applyForce(box, at<S>(share * pull * kGravity, 0), zeroAng<S>());
        world.step(R(1.0 / 60));
    };
    for (int i = 0; i < 90; ++i) step(i / 90.0);
    if (speed > 0) world.setVelocity(box, at<S>(speed, 0), zeroAng<S>());
    for (int i = 0; i < 60; ++i) step(1);
    return static_cast<double>(world.velocity(box)[0]);
}

TYPED_TEST(WideLaws, StaticFrictionHoldsWhatRestsAndKineticWhatSlides) {
    for (const double pull : {0.45, 0.59, 0.62, 0.64}) {
        const double sliding = (pull - 0.3) * kGravity;
        if (pull < 0.6)
            EXPECT_NEAR(pulled<TypeParam>(pull, 0), 0, 1e-3) << pull;
        else
            EXPECT_NEAR(pulled<TypeParam>(pull, 0), sliding, 0.1 * sliding) << pull;
        EXPECT_NEAR(pulled<TypeParam>(pull, 1), 1 + sliding, 0.03 * sliding) << pull;
    }
}

/// A sphere that bounces down and rolls, alone or with boxes beside it, whose patches of more points stand in
/// the same block: to the bit the same.
TYPED_TEST(WideLaws, AContactDoesNotKnowWhoStandsBesideIt) {
    using S = TypeParam;
    using R = typename S::Real;
    const auto rolled = [](int boxes) {
        WorldDef<S> def = earth<S>();
        def.solver = "wide";
        World<S> world(def);
        const auto wood = world.addMaterial(R(0.4), R(0.3));
        addGround<S>(world, wood);
        const BodyId ball = addBall<S>(world, 0, 1, 0.5, 1, wood, 2);
        for (int k = 0; k < boxes; ++k) addCube<S>(world, -2.0 - 2 * k, 0.25, 0.25, 1 + k, wood);
        for (int i = 0; i < 120; ++i) world.step(R(1.0 / 120));
        return std::pair{world.pose(ball).p, world.velocity(ball)};
    };
    const auto alone = rolled(0);
    EXPECT_GT(alone.first[0], 1) << "it does not roll";
    for (const int boxes : {1, 3}) {
        const auto beside = rolled(boxes);
        EXPECT_EQ(beside.first, alone.first) << boxes;
        EXPECT_EQ(beside.second, alone.second) << boxes;
    }
}

/// Friction bound: in every step of a heap that falls and slides, the friction impulse between two bodies is
/// at most the coefficient times the normal impulse, and at some contact it reaches this bound.
TYPED_TEST(WideLaws, FrictionStaysInItsCone) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldDef<S> def = earth<S>();
    preferSpeed(def);
    World<S> world(def);
    const double mu = 0.4;
    const auto wood = world.addMaterial(static_cast<R>(mu), R(0.2));
    addGround<S>(world, wood);
    for (int x = 0; x < 5; ++x)
        for (int y = 0; y < 4; ++y)
            addCube<S>(world, 0.52 * x + 0.11 * y, 0.3 + 0.55 * y, 0.25, 1, wood, 2 - y);
    std::vector<ContactView<S>> contacts;
    int seen = 0, full = 0;
    for (int i = 0; i < 60; ++i) {
        world.step(R(1.0 / 60));
        world.readContacts(contacts);
        struct Pair {
            double pressing = 0;
            typename S::Vec rubbing = S::Vec::Zero();
        };
        std::map<std::pair<std::uint32_t, std::uint32_t>, Pair> pairs;
        for (const ContactView<S>& c : contacts) {
            Pair& pair = pairs[{c.bodyA.index, c.bodyB.index}];
            pair.pressing += static_cast<double>(c.normalImpulse);
            pair.rubbing += c.frictionImpulse;
        }
        for (const auto& [key, pair] : pairs) {
            const double rubbing = static_cast<double>(pair.rubbing.norm()), most = mu * pair.pressing;
            EXPECT_LE(rubbing, most * (1 + tol<S>(1e-9, 1e-4)) + 1e-6) << "step " << i;
            ++seen;
            full += rubbing > 0.999 * most && most > 1e-3;
        }
    }
    EXPECT_GT(seen, 500);
    EXPECT_GT(full, 50) << "or nothing slid";
}

/// Approaches on both sides of the threshold: slower ones stop, faster ones bounce by the whole coefficient.
TYPED_TEST(WideLaws, BounceAboveTheThresholdAndNotBelow) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const double share : {0.3, 0.5, 0.95, 1.05, 1.5, 2.9, 4.0}) {
        WorldDef<S> def;  // no gravity
        def.solver = "wide";
        def.restitutionThreshold = R(0.4);
        World<S> world(def);
        const auto rubber = world.addMaterial(0, R(0.5));
        addGround<S>(world, rubber);
        const BodyId ball = addBall<S>(world, 0, 0.5, 0.5, 3, rubber, 0, -0.4 * share);
        for (int i = 0; i < 3; ++i) world.step(R(1.0 / 240));
        EXPECT_NEAR(world.velocity(ball)[1], share > 1 ? 0.2 * share : 0, tol<S>(2e-7, 1e-5)) << share;
    }
}

/// A sphere hits with all of its speed and rebounds by the restitution wherever in its way the step ends, also
/// within the speculative distance.
TYPED_TEST(WideLaws, ReboundDoesNotDependOnTheGapBeforeIt) {
    using S = TypeParam;
    using R = typename S::Real;
    for (int k = 0; k < 12; ++k) {
        WorldDef<S> def;  // no gravity
        preferSpeed(def);
        World<S> world(def);
        const auto rubber = world.addMaterial(0, R(0.75));
        addGround<S>(world, rubber);
        const BodyId ball = addBall<S>(world, 0, 0.25 + 0.0025 * k, 0.25, 2, rubber, 0, -1.5);
        for (int i = 0; i < 10; ++i) world.step(R(1.0 / 240));
        EXPECT_NEAR(world.velocity(ball)[1], 0.75 * 1.5, tol<S>(2e-7, 1e-5)) << k;
    }
}

/// A sphere let go within the distance at which contacts are found ahead falls, and rises to e^2 of its
/// height.
TYPED_TEST(WideLaws, WhatIsDroppedFromCloseAboveBounces) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldDef<S> def = earth<S>();
    preferSpeed(def);
    World<S> world(def);
    const double e = 0.8, height = 0.8 * static_cast<double>(def.speculativeDistance);
    const auto rubber = world.addMaterial(0, static_cast<R>(e));
    addGround<S>(world, rubber);
    const BodyId ball = addBall<S>(world, 0, 0.25 + height, 0.25, 2, rubber);
    const double speed = std::sqrt(2 * kGravity * height), h = 1.0 / 1000;
    double top = 0;
    for (double t = 0; t < (1 + 2 * e) * speed / kGravity; t += h) {
        world.step(static_cast<R>(h));
        if (t > (1 + 0.5 * e) * speed / kGravity)
            top = std::max(top, static_cast<double>(world.pose(ball).p[1]) - 0.25);
    }
    EXPECT_NEAR(top, e * e * height, 0.05 * height);
}

/// A force drives a sphere, which was at rest, through a gap within one step: it bounces with all of the
/// speed that it has been given. (A gap that may end in a bounce is not closed beforehand.)
TYPED_TEST(WideLaws, WhatAForceDrivesThroughAGapBouncesWithAllItsSpeed) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldDef<S> def;  // no gravity
    def.solver = "wide";
    def.substeps = 1;
    def.speculativeDistance = R(5e-3);
    World<S> world(def);
    const double e = 0.75, h = 1.0 / 240, gap = 4e-3, speed = 1.5 * gap / h;
    const auto rubber = world.addMaterial(0, static_cast<R>(e));
    addGround<S>(world, rubber);
    const BodyId ball = addBall<S>(world, 0, 0.25 + gap, 0.25, 2, rubber);
    world.applyForce(ball, at<S>(0, -2 * speed / h), zeroAng<S>());
    world.step(static_cast<R>(h));
    EXPECT_NEAR(world.velocity(ball)[1], -speed, tol<S>(1e-6, 1e-5) * speed) << "and is not held before";
    world.step(static_cast<R>(h));
    EXPECT_NEAR(world.velocity(ball)[1], e * speed, tol<S>(1e-6, 1e-5) * speed);
}

}  // namespace
}  // namespace rigor::engine::test
