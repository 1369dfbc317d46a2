// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Worlds of a batch have the bits that they have alone; a world that throws is named and takes none of the others
// with it; states go out and in as one array.
#include "engine/embedding/world_batch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/core/tests/counting_new.hpp"
#include "engine/pipeline/tests/scene.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Batch : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Batch, Spaces);

/// A stack that a sphere hits, and a pendulum with a limit; worlds of different numbers have different speeds.
template <class S>
World<S> smallScene(std::size_t number, bool fast = false) {
    using R = typename S::Real;
    WorldDef<S> def = earth<S>();
    if (fast) preferSpeed(def);
    World<S> world(def);
    const auto wood = world.addMaterial(R(0.5), R(0.2));
    addGround<S>(world, wood);
    for (int i = 0; i < 4; ++i) addCube<S>(world, 0.02 * i, 0.25 + 0.5 * i, 0.25, 1, wood);
    addBall<S>(world, -2, 0.8, 0.2, 2, wood, 3 + 0.3 * static_cast<double>(number), 1, -3);
    JointDef<S> joint;
    joint.type = JointType::Hinge;
    joint.bodyB = addBall<S>(world, 4, 3, 0.1, 1, wood);
    joint.anchorA = at<S>(3, 3);
    joint.anchorB = at<S>(-1, 0);
    joint.axes[0].mode = AxisMode::Limited;
    joint.axes[0].lower = R(-0.8);
    joint.axes[0].upper = R(0.8);
    world.addJoint(joint);
    return world;
}

template <class S>
WorldBatch<S> smallBatch(std::size_t count, int threads, bool fast = false) {
    return WorldBatch<S>(count, [fast](std::size_t i) { return smallScene<S>(i, fast); }, {threads});
}

template <class S>
std::uint64_t hashAlone(std::size_t number, int steps, bool fast = false) {
    World<S> world = smallScene<S>(number, fast);
    for (int i = 0; i < steps; ++i) world.step(typename S::Real(1.0 / 60));
    return world.stateHash();
}

TYPED_TEST(Batch, HasTheBitsOfEachWorldAlone) {
    using S = TypeParam;
    constexpr std::size_t kWorlds = 9;
    for (const bool fast : {false, true}) {
        std::vector<std::uint64_t> alone;
        for (std::size_t i = 0; i < kWorlds; ++i) alone.push_back(hashAlone<S>(i, 60, fast));
        ASSERT_NE(alone[0], alone[1]);
        for (const int threads : {1, 2, 3, 8}) {
            WorldBatch<S> batch = smallBatch<S>(kWorlds, threads, fast);
            for (const int steps : {1, 40, 19}) EXPECT_TRUE(batch.step(typename S::Real(1.0 / 60), steps));
            for (std::size_t i = 0; i < kWorlds; ++i)
                EXPECT_EQ(batch.world(i).stateHash(), alone[i]) << threads << " threads, world " << i;
        }
    }
}

TYPED_TEST(Batch, OfCopiesHasTheBitsOfTheOriginal) {
    using S = TypeParam;
    World<S> world = smallScene<S>(2);
    for (int i = 0; i < 20; ++i) world.step(typename S::Real(1.0 / 60));
    WorldBatch<S> batch(world, 5, {2});
    batch.step(typename S::Real(1.0 / 60), 40);
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(batch.world(i).stateHash(), hashAlone<S>(2, 60));
    const std::vector<std::size_t> again{1, 3};
    batch.reset(again);
    EXPECT_EQ(batch.world(1).stateHash(), world.stateHash());
    EXPECT_EQ(batch.world(3).stateHash(), world.stateHash());
    EXPECT_EQ(batch.world(2).stateHash(), hashAlone<S>(2, 60));
    batch.step(typename S::Real(1.0 / 60), 40);
    EXPECT_EQ(batch.world(3).stateHash(), hashAlone<S>(2, 60));
}

TYPED_TEST(Batch, LosesOnlyTheWorldThatThrows) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldBatch<S> batch = smallBatch<S>(6, 3);
    const auto failing = [](std::size_t i, World<S>& world) {
        if (i != 3 || world.time() < 0.1) return;
        world.observeIterations(
            [](int, const ConstraintRows<S>&, R) { throw std::runtime_error("in a step"); });
    };
    EXPECT_FALSE(batch.step(R(1.0 / 60), 30, failing));
    ASSERT_EQ(batch.failures().size(), 1u);
    EXPECT_EQ(batch.failures()[0].world, 3u);
    try {
        std::rethrow_exception(batch.failures()[0].error);
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "in a step");
    }
    const double stopped = batch.world(3).time();
    EXPECT_LT(stopped, 0.2);
    EXPECT_FALSE(batch.step(R(1.0 / 60), 30)) << "the world is still out";
    EXPECT_EQ(batch.world(3).time(), stopped);
    for (const std::size_t i : {0, 1, 2, 4, 5})
        EXPECT_EQ(batch.world(i).stateHash(), hashAlone<S>(i, 60)) << "world " << i;
    batch.reset(3);
    EXPECT_TRUE(batch.failures().empty());
    EXPECT_TRUE(batch.step(R(1.0 / 60), 60));
    EXPECT_EQ(batch.world(3).stateHash(), hashAlone<S>(3, 60));
}

/// Numbers of body `body` of world `world`.
template <class S>
typename S::Real* stateOf(std::vector<typename S::Real>& states, const WorldBatch<S>& batch,
                          std::size_t world, std::size_t body) {
    return states.data() + (world * batch.bodies() + body) * kBodyState<S>;
}

TYPED_TEST(Batch, ReadsAndWritesStatesAsOneArray) {
    using S = TypeParam;
    using R = typename S::Real;
    constexpr std::size_t kBall = 5;  // ground, four cubes, the sphere
    WorldBatch<S> batch = smallBatch<S>(3, 2);
    batch.step(R(1.0 / 60), 10);
    std::vector<R> states(batch.stateSize());
    ASSERT_EQ(states.size(), 3 * 7 * kBodyState<S>);
    batch.readStates(states);
    const World<S>& second = batch.world(1);
    const BodyId ball = second.bodies()[kBall];
    const R* numbers = stateOf(states, batch, 1, kBall);
    const R* velocity = numbers + (S::dim == 2 ? 3 : 7);
    for (int k = 0; k < S::dim; ++k) {
        EXPECT_EQ(numbers[k], second.pose(ball).p[k]);
        EXPECT_EQ(velocity[k], second.velocity(ball)[k]);
    }
    EXPECT_EQ(velocity[kBodyState<S> - (S::dim == 2 ? 4 : 8)], R(spinOf<S>(second.angularVelocity(ball))));
    if constexpr (S::dim == 2)
        EXPECT_EQ(numbers[2], second.pose(ball).q.angle());
    else
        EXPECT_EQ(numbers[3], second.pose(ball).q.w());

    std::vector<std::uint64_t> before;
    for (std::size_t i = 0; i < 3; ++i) before.push_back(batch.world(i).stateHash());
    EXPECT_TRUE(batch.writeStates(states));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(batch.world(i).stateHash(), before[i]) << "nothing changed";

    R* moved = stateOf(states, batch, 1, kBall);
    moved[1] = 7;
    if constexpr (S::dim == 2) {
        moved[2] = R(0.5);
    } else {  // half a turn about z
        moved[3] = moved[4] = moved[5] = 0;
        moved[6] = 1;
    }
    moved[S::dim == 2 ? 3 : 7] = -2;
    EXPECT_TRUE(batch.writeStates(states));
    EXPECT_EQ(batch.world(0).stateHash(), before[0]);
    EXPECT_NE(batch.world(1).stateHash(), before[1]);
    EXPECT_EQ(second.pose(ball).p[1], R(7));
    EXPECT_EQ(second.velocity(ball)[0], R(-2));
    EXPECT_NEAR(second.pose(ball).p[0], moved[0], 0);
    std::vector<R> again(batch.stateSize());
    batch.readStates(again);
    for (std::size_t k = 0; k < states.size(); ++k)
        EXPECT_NEAR(again[k], states[k], 4 * std::numeric_limits<R>::epsilon()) << k;
}

TYPED_TEST(Batch, NamesTheWorldOfAStateThatCannotBe) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldBatch<S> batch = smallBatch<S>(4, 2);
    std::vector<R> states(batch.stateSize());
    batch.readStates(states);
    stateOf(states, batch, 2, 1)[0] = std::numeric_limits<R>::quiet_NaN();
    stateOf(states, batch, 3, 1)[0] = 9;
    EXPECT_FALSE(batch.writeStates(states));
    ASSERT_EQ(batch.failures().size(), 1u);
    EXPECT_EQ(batch.failures()[0].world, 2u);
    EXPECT_EQ(batch.world(3).pose(batch.world(3).bodies()[1]).p[0], R(9));
}

TYPED_TEST(Batch, GoesOnFromSnapshotsToTheSameBits) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldBatch<S> batch = smallBatch<S>(4, 2);
    batch.step(R(1.0 / 60), 25);
    std::vector<std::vector<unsigned char>> snapshots;
    batch.saveSnapshots(snapshots);
    batch.step(R(1.0 / 60), 35);
    EXPECT_TRUE(batch.restoreSnapshots(snapshots));
    EXPECT_TRUE(batch.step(R(1.0 / 60), 35));
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(batch.world(i).stateHash(), hashAlone<S>(i, 60));
}

TYPED_TEST(Batch, AppliesWrenchesAndDrivesJointsWorldByWorld) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldDef<S> def;
    World<S> world(def);
    const BodyId wheel = addBall<S>(world, 0, 0, 0.5, 2, 0), free = addBall<S>(world, 3, 0, 0.5, 2, 0);
    JointDef<S> joint;
    joint.type = JointType::Hinge;
    joint.bodyB = wheel;
    const JointId hinge = world.addJoint(joint);
    WorldBatch<S> batch(world, 3, {2});
    const std::vector<R> speeds{1, -2, 0};
    EXPECT_TRUE(batch.setJointMotors(hinge, 0, speeds, 1000));
    std::vector<R> wrenches(3 * 2 * kBodyWrench<S>, R(0));
    for (std::size_t i = 0; i < 3; ++i) {
        R* of = wrenches.data() + (2 * i + 1) * kBodyWrench<S>;
        of[0] = R(12) * R(i);             // N on 2 kg: 6 i m/s^2
        of[kBodyWrench<S> - 1] = R(0.2);  // N m on 0.2 kg m^2
    }
    EXPECT_TRUE(batch.applyWrenches(wrenches));
    EXPECT_TRUE(batch.step(R(0.125), 2)) << "they act in the first of the two";
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(batch.world(i).jointSpeed(hinge), speeds[i], tol<S>(1e-9, 1e-5)) << i;
        EXPECT_NEAR(batch.world(i).velocity(free)[0], 0.75 * double(i), tol<S>(1e-12, 1e-6)) << i;
        EXPECT_NEAR(spinOf<S>(batch.world(i).angularVelocity(free)), 0.125, tol<S>(1e-12, 1e-6)) << i;
    }
}

TYPED_TEST(Batch, DoesNotAllocateInASteadyStep) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    const auto wood = world.addMaterial(R(0.5), 0);
    addGround<S>(world, wood);
    for (int i = 0; i < 5; ++i) addCube<S>(world, 0, 0.25 + 0.5 * i, 0.25, 1, wood);
    for (const int threads : {1, 2}) {
        WorldBatch<S> batch(world, 20, {threads});
        std::vector<R> states(batch.stateSize());
        batch.step(R(1.0 / 60), 60);
        batch.readStates(states);
        const long before = allocationCount();
        for (int i = 0; i < 10; ++i) {
            batch.step(R(1.0 / 60), 2);
            batch.readStates(states);
        }
        EXPECT_EQ(allocationCount() - before, 0) << threads << " threads";
    }
}

template <class Call>
std::string errorOf(const Call& call) {
    try {
        call();
    } catch (const EngineError& error) {
        return error.id();
    }
    return "none";
}

TEST(BatchArguments, AreChecked) {
    using S = Space3d;
    const World<S> world = smallScene<S>(0);
    EXPECT_EQ(errorOf([&] { WorldBatch<S>(world, 0); }), "batch_size");
    EXPECT_EQ(errorOf([&] { WorldBatch<S>(world, 1, {0}); }), "threads");
    EXPECT_EQ(errorOf([&] { WorldBatch<S>(world, 1, {1025}); }), "threads");
    const auto uneven = [&](std::size_t i) {
        World<S> made = world;
        if (i == 2) made.removeBody(made.bodies()[1]);
        return made;
    };
    EXPECT_EQ(errorOf([&] { WorldBatch<S>(3, uneven); }), "batch_bodies");
    WorldBatch<S> batch(world, 2);
    std::vector<double> states(batch.stateSize() - 1);
    EXPECT_EQ(errorOf([&] { batch.readStates(states); }), "batch_array");
    EXPECT_EQ(errorOf([&] { batch.writeStates(states); }), "batch_array");
    EXPECT_EQ(errorOf([&] { batch.applyWrenches(states); }), "batch_array");
    EXPECT_EQ(errorOf([&] { batch.setJointTargets({}, 0, states); }), "batch_array");
    EXPECT_EQ(errorOf([&] { batch.reset(2); }), "batch_world");
    batch.world(1).removeBody(batch.world(1).bodies()[1]);
    states.resize(batch.stateSize());
    EXPECT_EQ(errorOf([&] { batch.readStates(states); }), "batch_bodies");
}

}  // namespace
}  // namespace rigor::engine::test
