// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contract of contacts for every solver and every position correction: the order of bodies does not matter,
// the reported impulses are those that acted, restored state gives the same future, and a gap that closes is
// closed.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class ContactContract : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(ContactContract, Spaces);

/// A lever that turns lifts a sphere at its end: the same whichever of the two is the first of the pair, in
/// every solver, so also where the separation is carried through sub-steps.
TYPED_TEST(ContactContract, ALeverLiftsABallWhicheverComesFirst) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& solver : solverTable<S>()) {
        typename S::Vec ends[2];
        for (const bool leverFirst : {true, false}) {
            WorldDef<S> def = earth<S>();
            def.solver = solver.name;
            World<S> world(def);
            const std::uint32_t smooth = world.addMaterial(0, 0);
            BodyId ball;
            if (!leverFirst) ball = addBall<S>(world, 2, 0.3, 0.2, 1, smooth);
            BodyDef<S> body;
            body.type = BodyType::Kinematic;
            body.angularVelocity = spin<S>(0.5);
            const BodyId lever = world.addBody(body);
            typename S::Vec half = S::Vec::Constant(3);
            half[1] = R(0.1);
            attach<S>(world, lever, Box<S>{half}, smooth);
            if (leverFirst) ball = addBall<S>(world, 2, 0.3, 0.2, 1, smooth);
            for (int i = 0; i < 20; ++i) world.step(R(1.0 / 60));
            ends[leverFirst] = world.pose(ball).p;
            // The top face at the angle w t: its distance from the sphere's centre.
            const double angle = 0.5 * 20 / 60.0;
            const double distance = static_cast<double>(ends[leverFirst][1]) * std::cos(angle) -
                                    static_cast<double>(ends[leverFirst][0]) * std::sin(angle);
            EXPECT_NEAR(distance, 0.3, 0.01) << solver.name;
        }
        EXPECT_NEAR((ends[0] - ends[1]).norm(), 0, tol<S>(solver.name, 1e-9, 1e-3)) << solver.name;
    }
}

/// The impulses that a step reports are all that acted in it, with or without sub-steps: m dv = m g h + the
/// impulses, of a block that slides and one that lands.
TYPED_TEST(ContactContract, ReportedImpulsesAreThoseOfTheWholeStep) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& solver : solverTable<S>()) {
        WorldDef<S> def = earthByEuler<S>();
        def.solver = solver.name;
        World<S> world(def);
        const std::uint32_t wood = world.addMaterial(R(0.5), 0);
        addGround<S>(world, wood);
        const BodyId block = addCube<S>(world, 0, 0.55, 0.5, 2, wood, 4);
        std::vector<ContactView<S>> contacts;
        double slid = 0;
        for (int i = 0; i < 30; ++i) {
            const typename S::Vec before = world.velocity(block);
            world.step(R(1.0 / 60));
            world.readContacts(contacts);
            typename S::Vec sum = R(2.0 / 60) * def.gravity;
            for (const ContactView<S>& c : contacts) {
                sum += c.normalImpulse * c.normal + c.frictionImpulse;
                slid += static_cast<double>(c.frictionImpulse.norm());
            }
            const typename S::Vec change = R(2) * (world.velocity(block) - before);
            EXPECT_NEAR((change - sum).norm(), 0, tol<S>(solver.name, 1e-9, 2e-4))
                << solver.name << " step " << i;
        }
        EXPECT_GT(slid, 1) << solver.name;
    }
}

/// Contact points are known again by their features, however far they have moved: on a smooth floor a fast
/// box starts its steps from the impulses of the last one like a box at rest.
TYPED_TEST(ContactContract, ImpulsesAreKeptHoweverFastTheirPointsMove) {
    using S = TypeParam;
    using R = typename S::Real;
    const auto iterations = [](double speed, bool warm) {
        WorldDef<S> def = earth<S>();
        def.solver = "pgs";
        def.warmStarting = warm;
        World<S> world(def);
        const std::uint32_t smooth = world.addMaterial(0, 0);
        addGround<S>(world, smooth);
        for (int i = 0; i < 3; ++i) addCube<S>(world, 0.01 * i, 0.5 + i, 0.5, 1 + i, smooth, speed);
        for (int i = 0; i < 30; ++i) world.step(R(1.0 / 60));
        return world.lastStep().iterations;
    };
    const int fast = iterations(20, true), cold = iterations(20, false);
    EXPECT_LT(3 * fast, cold) << fast << " against " << cold;
}

/// A sphere that closes its gap in a step comes to touch, and every position correction leaves it there: the
/// way that its velocity has taken it is no error of position.
TYPED_TEST(ContactContract, WhatClosesAGapTouchesWithEveryCorrection) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& correction : positionCorrectionTable<S>()) {
        WorldDef<S> def;  // no gravity
        def.positionCorrection = correction.name;
        World<S> world(def);
        const std::uint32_t m = world.addMaterial(0, 0);
        addGround<S>(world, m);
        const double gap = 0.5 * static_cast<double>(def.speculativeDistance);
        const BodyId ball = addBall<S>(world, 0, 0.5 + gap, 0.5, 2, m, 0, -2 * 60 * gap);
        for (int i = 0; i < 5; ++i) {
            world.step(R(1.0 / 60));
            EXPECT_NEAR(world.pose(ball).p[1], 0.5, 0.05 * gap) << correction.name << " step " << i;
        }
        EXPECT_NEAR(world.velocity(ball)[1], 0, tol<S>(1e-9, 1e-5)) << correction.name;
    }
}

/// Contacts push: a sphere at rest just above the floor, seen as a contact that is open, is not pulled down
/// to it.
TYPED_TEST(ContactContract, AnOpenContactDoesNotPull) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& correction : positionCorrectionTable<S>())
        for (const double share : {0.1, 0.9}) {
            WorldDef<S> def;  // no gravity
            def.positionCorrection = correction.name;
            World<S> world(def);
            const std::uint32_t m = world.addMaterial(R(0.5), 0);
            addGround<S>(world, m);
            const double y = 0.5 + share * static_cast<double>(def.speculativeDistance);
            const BodyId ball = addBall<S>(world, 0, y, 0.5, 2, m);
            for (int i = 0; i < 10; ++i) world.step(R(1.0 / 60));
            EXPECT_EQ(world.pose(ball).p[1], static_cast<R>(y)) << correction.name << " " << share;
        }
}

/// Kept impulses are forces times the step: a box rests through steps of changing length with one iteration
/// each.
TYPED_TEST(ContactContract, KeptImpulsesFollowTheLengthOfTheStep) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldDef<S> def = earth<S>();
    def.solver = "pgs";
    World<S> world(def);
    const std::uint32_t m = world.addMaterial(R(0.5), 0);
    addGround<S>(world, m);
    const BodyId box = addCube<S>(world, 0, 0.5, 0.5, 2, m);
    for (int i = 0; i < 60; ++i) world.step(R(1.0 / 60));
    int most = 0;
    for (int i = 0; i < 40; ++i) {
        most = std::max(most, world.step(R(i % 2 ? 1.0 / 60 : 1.0 / 240)).iterations);
        EXPECT_NEAR(world.velocity(box).norm(), 0, tol<S>(1e-6, 1e-4)) << i;
    }
    EXPECT_LE(most, 2) << "nothing is left to iterate";
}

}  // namespace
}  // namespace rigor::engine::test
