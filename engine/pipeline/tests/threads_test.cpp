// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The same bits for every number of threads, whatever the choices; and no allocation in a steady step.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "engine/core/tests/counting_new.hpp"
#include "engine/narrowphase/narrowphases.hpp"
#include "engine/pipeline/algorithms.hpp"
#include "engine/pipeline/tests/scene.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Threads : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Threads, Spaces);

/// A crowd that collapses: columns of boxes and spheres that rest on each other, a chain of joints across
/// them, and spheres thrown in; enough of everything for every loop of a step to be shared.
template <class S>
World<S> crowd(const WorldDef<S>& def, int columns, int height) {
    using R = typename S::Real;
    World<S> world(def);
    const auto wood = world.addMaterial(R(0.5), R(0.1)), rubber = world.addMaterial(R(0.8), R(0.6), R(1));
    addGround<S>(world, wood);
    for (int x = 0; x < columns; ++x)
        for (int y = 0; y < height; ++y)
            if ((x + y) % 3 == 0)
                addBall<S>(world, 0.51 * x + 0.02 * y, 0.26 + 0.52 * y, 0.25, 1, rubber, 0.1 * (x % 3), 0, 1);
            else
                addCube<S>(world, 0.51 * x + 0.02 * y, 0.25 + 0.52 * y, 0.25, 1 + y % 2, wood, 0.2);
    BodyId last;
    for (int i = 0; i < 8; ++i) {
        const BodyId link = addBall<S>(world, 0.3 + 0.3 * i, 0.52 * height + 0.4, 0.1, 0.3, wood);
        if (i > 0) {
            JointDef<S> joint;
            joint.bodyA = last;
            joint.bodyB = link;
            joint.anchorA = at<S>(0.15, 0);
            joint.anchorB = at<S>(-0.15, 0);
            world.addJoint(joint);
        }
        last = link;
    }
    addBall<S>(world, -1.5, 0.8, 0.2, 5, rubber, 8, 1, -3);
    return world;
}

template <class S>
void expectSameBits(WorldDef<S> def, int steps, const std::string& what) {
    using R = typename S::Real;
    std::vector<std::uint64_t> expected;
    for (const int threads : {1, 2, 3, 5}) {
        def.threads = threads;
        World<S> world = crowd<S>(def, 12, 4);
        for (int i = 0; i < steps; ++i) {
            world.step(R(1.0 / 60));
            const auto place = static_cast<std::size_t>(i);
            if (threads == 1)
                expected.push_back(world.stateHash());
            else
                ASSERT_EQ(world.stateHash(), expected[place])
                    << what << ": " << threads << " threads, step " << i;
        }
        EXPECT_FALSE(world.lastStep().nonFinite) << what;
        EXPECT_GT(world.lastStep().rows, 80u) << what << ": too few to be shared";
    }
}

TYPED_TEST(Threads, DoNotChangeABitOfTheDefaults) {
    expectSameBits<TypeParam>(earth<TypeParam>(), 60, "default");
}

/// Enough pairs for their parts to be merged and ordered side by side (contacts/candidates.cpp), while pairs
/// and contacts come and go: in the middle, every third contact is torn apart within a step.
TYPED_TEST(Threads, DoNotChangeABitOfManyPairs) {
    using S = TypeParam;
    WorldDef<S> def = earth<S>();
    preferSpeed(def);
    std::vector<std::uint64_t> expected;
    for (const int threads : {1, 2, 3}) {
        def.threads = threads;
        World<S> world = crowd<S>(def, 180, 4);
        std::vector<ContactView<S>> contacts;
        for (std::size_t i = 0; i < 40; ++i) {
            if (i == 20) {
                world.readContacts(contacts);
                for (std::size_t k = 0; k < contacts.size(); k += 3)
                    world.setVelocity(contacts[k].bodyB, at<S>(0, 60), zeroAng<S>());
            }
            world.step(static_cast<typename S::Real>(1.0 / 60));
            EXPECT_GT(world.lastStep().pairs, i <= 20 ? 600u : 0u) << "more than one part";
            if (threads == 1)
                expected.push_back(world.stateHash());
            else
                ASSERT_EQ(world.stateHash(), expected[i]) << threads << " threads, step " << i;
        }
    }
}

TYPED_TEST(Threads, DoNotChangeABitOfAnySolverOrNarrowPhase) {
    using S = TypeParam;
    WorldDef<S> plain = earth<S>();
    // Direct solvers solve all rows together, and more iterations do not help them.
    plain.velocityIterations = plain.firstStepIterations = 5;
    for (const auto& solver : solverTable<S>()) {
        WorldDef<S> def = plain;
        def.solver = solver.name;
        expectSameBits<S>(def, 6, solver.name);
    }
    for (const auto& narrowPhase : narrowPhases()) {
        WorldDef<S> def = plain;
        def.narrowPhase = narrowPhase.name;
        expectSameBits<S>(def, 6, narrowPhase.name);
    }
}

/// Every other choice there is, one at a time.
TEST(ThreadsChoices, DoNotChangeABitOfAnyAlgorithm) {
    using S = Space3d;
    for (const AlgorithmFamily& family : algorithmFamilies())
        for (const AlgorithmInfo& algorithm : family.algorithms) {
            if (family.name == "solver" || family.name == "narrow_phase") continue;
            WorldDef<S> def = earth<S>();
            def.velocityIterations = def.firstStepIterations = 8;
            if (std::string* field = choiceOf(def, family.name)) {
                *field = algorithm.name;
                expectSameBits<S>(def, 10, family.name + "=" + algorithm.name);
            }
        }
}

/// Piles that fall asleep one after the other, and are woken by a sphere that rolls along and by what is done
/// to them from outside.
TYPED_TEST(Threads, DoNotChangeABitOfWhatFallsAsleepAndWakes) {
    using S = TypeParam;
    using R = typename S::Real;
    constexpr int kPiles = 24;
    for (const bool fast : {false, true}) {
        std::vector<std::uint64_t> expected;
        std::size_t least = 1000, most = 0;
        for (const int threads : {1, 2, 3, 4}) {
            WorldDef<S> def = earth<S>();
            if (fast) preferSpeed(def);
            def.threads = threads;
            def.sleeping = "islands";
            World<S> world(def);
            const auto wood = world.addMaterial(R(0.5), 0);
            addGround<S>(world, wood);
            std::vector<BodyId> tops;
            for (int x = 0; x < kPiles; ++x)
                for (int y = 0; y < 3; ++y) {
                    const BodyId cube =
                        addCube<S>(world, 1.5 * x, 0.25 + 0.502 * y + 0.01 * (x % 5) * y, 0.25, 1 + y, wood);
                    if (y == 2) tops.push_back(cube);
                }
            const BodyId ball = addBall<S>(world, -9, 0.3, 0.3, 20, wood, 6);
            for (std::size_t i = 0; i < 130; ++i) {
                if (i == 90) world.applyForce(tops[15], at<S>(200, 0), zeroAng<S>());
                if (i == 105) world.removeBody(tops[20]);
                if (i == 110) world.setVelocity(ball, at<S>(9, 2), zeroAng<S>());
                world.step(R(1.0 / 60));
                if (threads == 1)
                    expected.push_back(world.stateHash());
                else
                    ASSERT_EQ(world.stateHash(), expected[i]) << threads << " threads, step " << i;
                most = std::max(most, world.lastStep().sleeping);
                if (most > 60) least = std::min(least, world.lastStep().sleeping);
            }
        }
        EXPECT_GT(most, 60u) << "they did not fall asleep";
        EXPECT_LT(least + 5, most) << "or nothing woke";
    }
}

TYPED_TEST(Threads, DoNotAllocateInASteadyStep) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const char* solver : {"block", "jacobi", "tgs_soft", "wide"}) {
        WorldDef<S> def = earth<S>();
        def.threads = 2;
        def.solver = solver;
        World<S> world(def);
        const auto wood = world.addMaterial(R(0.5), 0);
        addGround<S>(world, wood);
        for (int x = 0; x < 40; ++x)
            for (int y = 0; y < 3; ++y) addCube<S>(world, x, 0.25 + 0.5 * y, 0.25, 1, wood);
        for (int i = 0; i < 40; ++i) world.step(R(1.0 / 60));
        const long before = allocationCount();
        for (int i = 0; i < 20; ++i) world.step(R(1.0 / 60));
        EXPECT_EQ(allocationCount() - before, 0) << solver;
    }
}

TEST(ThreadsRange, IsChecked) {
    for (const int threads : {0, -1, 1025}) {
        WorldDef<Space3d> def;
        def.threads = threads;
        try {
            World<Space3d> world(def);
            ADD_FAILURE() << threads << " threads accepted";
        } catch (const EngineError& error) {
            EXPECT_STREQ(error.id().c_str(), "threads");
        }
    }
}

}  // namespace
}  // namespace rigor::engine::test
