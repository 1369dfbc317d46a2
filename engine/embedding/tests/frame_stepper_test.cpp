// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/embedding/frame_stepper.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "engine/core/error.hpp"
#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class FrameStepperTest : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(FrameStepperTest, Spaces);

constexpr double kStep = 1.0 / 60;

/// Balls that fall on the ground.
template <class S>
World<S> balls() {
    World<S> world(earth<S>());
    const std::uint32_t stone = world.addMaterial(typename S::Real(0.5), typename S::Real(0.3));
    addGround<S>(world, stone);
    for (int i = 0; i < 5; ++i) addBall<S>(world, 0.3 * i, 1 + i, 0.25, 1, stone);
    return world;
}

TYPED_TEST(FrameStepperTest, TheCourseDoesNotDependOnFrames) {
    using S = TypeParam;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(0, 0.05);
    World<S> framed = balls<S>(), stepped = balls<S>();
    FrameStepper<S> stepper(framed, {kStep, 8});
    double elapsed = 0;
    int steps = 0;
    for (int frame = 0; frame < 200; ++frame) {
        const double time = u(random);
        elapsed += time;
        steps += stepper.advance(time);
        ASSERT_NEAR(steps * kStep + stepper.remainder(), elapsed, 1e-9);
        ASSERT_GE(stepper.fraction(), 0);
        ASSERT_LT(stepper.fraction(), 1);
    }
    EXPECT_EQ(stepper.skipped(), 0);
    for (int i = 0; i < steps; ++i) stepped.step(static_cast<typename S::Real>(kStep));
    EXPECT_EQ(framed.stateHash(), stepped.stateHash());
}

TYPED_TEST(FrameStepperTest, FramesThatAddUpToStepsGiveThem) {
    using S = TypeParam;
    World<S> world = balls<S>();
    FrameStepper<S> stepper(world, {kStep, 8});
    for (int frame = 1; frame <= 400; ++frame)
        EXPECT_EQ(stepper.advance(1.0 / 240), frame % 4 == 0 ? 1 : 0) << frame;
}

/// A body that flies and spins evenly is drawn where it was one step before now, whatever the frames.
TYPED_TEST(FrameStepperTest, PosesAreBetweenTheLastSteps) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldDef<S> def;
    World<S> world(def);
    BodyDef<S> made;
    made.velocity = at<S>(3, -2);
    made.angularVelocity = spin<S>(5);
    made.centerOfMass = at<S>(0.1, 0.2);
    const BodyId body = world.addBody(made);
    FrameStepper<S> stepper(world, {kStep, 8});
    double elapsed = 0;
    for (const double time : {0.05, 0.013, 0.0, 0.021, 0.009, 0.03}) {
        elapsed += time;
        stepper.advance(time);
        const double seen = elapsed - kStep;
        const Pose<S> pose = stepper.pose(body);
        const auto center = toWorld<S>(pose, made.centerOfMass);
        const auto expected = typename S::Vec(made.centerOfMass + R(seen) * made.velocity);
        EXPECT_LT((center - expected).norm(), R(sizeof(R) == 4 ? 1e-5 : 1e-12)) << elapsed;
        const auto turned = rotate(pose.q, at<S>(1, 0));
        EXPECT_LT((turned - at<S>(std::cos(5 * seen), std::sin(5 * seen))).norm(),
                  R(sizeof(R) == 4 ? 1e-5 : 1e-12));
    }
}

TYPED_TEST(FrameStepperTest, BodiesThatAreNewOrPutElsewhereAreNotDrawnOnTheWay) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world = balls<S>();
    FrameStepper<S> stepper(world, {kStep, 8});
    const BodyId old = world.bodies().back();
    stepper.advance(1.4 * kStep);
    world.removeBody(old);
    const BodyId next = addBall<S>(world, 9, 9, 0.25, 1, 1);
    EXPECT_EQ(stepper.pose(next).p, world.pose(next).p) << "the handle's index may be that of the old one";
    Pose<S> there = world.pose(next);
    there.p += at<S>(100, 0);
    stepper.advance(kStep, [&](World<S>& w) { w.setPose(next, there); });
    EXPECT_LT(std::abs(stepper.pose(next).p[0] - there.p[0]), R(1e-4)) << "put there before the step";
    there.p -= at<S>(100, 0);
    world.setPose(next, there);
    EXPECT_EQ(stepper.pose(next).p, there.p) << "put there after the step";
    stepper.restart();
    EXPECT_EQ(stepper.pose(next).p, there.p);
    EXPECT_EQ(stepper.remainder(), 0);
}

TYPED_TEST(FrameStepperTest, AFrameHasAMostOfStepsAndTheRestIsSkipped) {
    using S = TypeParam;
    World<S> world = balls<S>();
    FrameStepper<S> stepper(world, {kStep, 4});
    EXPECT_EQ(stepper.advance(1.0 + 0.25 * kStep), 4);
    EXPECT_NEAR(stepper.skipped(), 56 * kStep, 1e-9);
    EXPECT_NEAR(stepper.fraction(), 0.25, 1e-6);
    EXPECT_NEAR(world.time(), 4 * kStep, 1e-6);
    EXPECT_EQ(stepper.advance(0.8 * kStep), 1) << "the world goes on at its pace";
}

TYPED_TEST(FrameStepperTest, RefusesTimesThatAreNone) {
    using S = TypeParam;
    World<S> world = balls<S>();
    EXPECT_THROW((FrameStepper<S>(world, {0, 8})), EngineError);
    EXPECT_THROW((FrameStepper<S>(world, {kStep, 0})), EngineError);
    FrameStepper<S> stepper(world, {kStep, 8});
    EXPECT_THROW(stepper.advance(-1e-3), EngineError);
    EXPECT_THROW(stepper.advance(std::numeric_limits<double>::quiet_NaN()), EngineError);
    EXPECT_EQ(stepper.remainder(), 0) << "a refused frame changes nothing";
}

/// A body that was put elsewhere is drawn there at once, and not on the way.
TYPED_TEST(FrameStepperTest, DrawsNoWayToWhereABodyWasPut) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world = balls<S>();
    FrameStepper<S> stepper(world, {kStep, 8});
    stepper.advance(2.5 * kStep);
    const BodyId moved = world.bodies()[2], other = world.bodies()[3];
    const Pose<S> others = stepper.pose(other);
    EXPECT_NE(others.p[1], world.pose(other).p[1]) << "between two steps";
    Pose<S> there = world.pose(moved);
    there.p[0] += 100;
    world.setPose(moved, there);
    EXPECT_NEAR(static_cast<double>(stepper.pose(moved).p[0]), static_cast<double>(there.p[0]), 1e-5);
    EXPECT_EQ(stepper.pose(other).p, others.p);
    stepper.advance(0.1 * kStep);  // no step
    EXPECT_NEAR(static_cast<double>(stepper.pose(moved).p[0]), static_cast<double>(there.p[0]), 1e-5);
    stepper.advance(kStep);
    EXPECT_NEAR(static_cast<double>(stepper.pose(moved).p[0]), static_cast<double>(there.p[0]), 1e-5);
    EXPECT_GT(stepper.pose(moved).p[1], world.pose(moved).p[1]) << "between two steps again";
    std::vector<unsigned char> bytes;
    World<S> start = balls<S>();
    start.step(R(kStep));
    start.saveSnapshot(bytes);
    world.restoreSnapshot(bytes);
    EXPECT_EQ(stepper.pose(moved).p, world.pose(moved).p) << "after a snapshot";
}

}  // namespace
}  // namespace rigor::engine::test
