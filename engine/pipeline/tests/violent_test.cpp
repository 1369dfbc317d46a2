// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Small islands in violent motion (pipeline/step_violent.cpp): their contacts are found for each half of a step.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "engine/narrowphase/distance.hpp"
#include "engine/pipeline/tests/contact_load.hpp"
#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

constexpr double kViolentStep = 1.0 / 60, kStoneHalf = 0.2;
constexpr int kSquall = 12;  ///< number of stones that are thrown together

/// Stones that are thrown at each other over a ground.
template <class S>
struct Squall {
    using R = typename S::Real;
    World<S> world;
    std::uint32_t stone;
    BodyId ground;
    std::vector<BodyId> stones;

    explicit Squall(const WorldDef<S>& def) : world(def), stone(world.addMaterial(R(0.6), R(0))) {
        ground = addGround<S>(world, stone);
    }
    static double massOf(int stone) { return 1 + stone % 3; }
    void throwStones(unsigned seed) {
        std::mt19937 random(seed);
        const auto any = [&](double most) {
            return std::uniform_real_distribution<double>(-most, most)(random);
        };
        for (int i = 0; i < kSquall; ++i) {
            const double column = 0.55 * (i % 4) - 0.8, row = 1 + 0.55 * (i / 4);
            const BodyId id = addCube<S>(world, column, row, kStoneHalf, massOf(i), stone);
            world.setVelocity(id, at<S>(any(2) - 12 * column, any(3) - 10 * (row - 1.5)), spin<S>(any(8)));
            stones.push_back(id);
        }
    }
    double deepest() const {
        const Shape<S> cube = Box<S>{S::Vec::Constant(R(kStoneHalf))};
        double deepest = 0;
        for (std::size_t i = 0; i < stones.size(); ++i)
            for (std::size_t j = i + 1; j < stones.size(); ++j) {
                const ClosestPoints<S> closest =
                    closestPoints<S>(cube, world.pose(stones[i]), cube, world.pose(stones[j]));
                deepest = std::max(deepest, -static_cast<double>(closest.distance));
            }
        return deepest;
    }
    double verticalMomentum() const {
        double sum = 0;
        for (int i = 0; i < kSquall; ++i)
            sum += massOf(i) * static_cast<double>(world.velocity(stones[static_cast<std::size_t>(i)]).y());
        return sum;
    }
    double mass() const {
        double sum = 0;
        for (int i = 0; i < kSquall; ++i) sum += massOf(i);
        return sum;
    }
};

template <class S>
WorldDef<S> ofSquall(bool twice = true) {
    WorldDef<S> def = earth<S>();
    def.secondSearch = twice;
    return def;
}

/// The mean over squalls of the largest overlap of two stones [m].
template <class S>
double meanDeepest(bool twice) {
    constexpr unsigned kSqualls = 40;
    double sum = 0;
    for (unsigned seed = 0; seed < kSqualls; ++seed) {
        Squall<S> squall(ofSquall<S>(twice));
        squall.throwStones(seed);
        double deepest = 0;
        for (int step = 0; step < 20; ++step) {
            squall.world.step(typename S::Real(kViolentStep));
            deepest = std::max(deepest, squall.deepest());
        }
        sum += deepest / kSqualls;
    }
    return sum;
}

template <class S>
class ViolentIslands : public testing::Test {};
using ViolentSpaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(ViolentIslands, ViolentSpaces);

TYPED_TEST(ViolentIslands, StonesThrownTogetherOverlapLess) {
    using S = TypeParam;
    const double once = meanDeepest<S>(false), twice = meanDeepest<S>(true);
    EXPECT_LT(twice, 0.75 * once);
}

/// The contacts with the ground report the impulses of the whole step: they add up to the vertical momentum that the stones
/// got.
TYPED_TEST(ViolentIslands, ImpulsesAddUpOverBothHalves) {
    using S = TypeParam;
    for (unsigned seed = 0; seed < 20; ++seed) {
        Squall<S> squall(ofSquall<S>());
        squall.throwStones(seed);
        for (int step = 0; step < 40; ++step) {
            const double before = squall.verticalMomentum();
            squall.world.step(typename S::Real(kViolentStep));
            const double impulse = normalImpulseOn<S>(squall.world, squall.ground);
            const double given = squall.verticalMomentum() - before + squall.mass() * kGravity * kViolentStep;
            ASSERT_NEAR(impulse, given, 1e-4 * squall.mass()) << "seed " << seed << " step " << step;
        }
    }
}

/// A stone gets continuous collision, and with it the world, amid the squall: no island is violent from then on.
TYPED_TEST(ViolentIslands, MayGetContinuousCollision) {
    using S = TypeParam;
    for (int begin = 2; begin < 12; ++begin) {
        Squall<S> squall(ofSquall<S>());
        squall.throwStones(7);
        for (int step = 0; step < 60; ++step) {
            if (step == begin) squall.world.setContinuous(squall.stones[0], ContinuousMode::On);
            squall.world.step(typename S::Real(kViolentStep));
        }
        for (const BodyId id : squall.stones)
            EXPECT_GT(static_cast<double>(squall.world.pose(id).p.y()), 0.5 * kStoneHalf);
    }
}

/// Stacks that stand beside a squall stay as they are alone, and so does the squall.
TYPED_TEST(ViolentIslands, MoveAsTheyDoAlone) {
    using S = TypeParam;
    const auto addStack = [](Squall<S>& squall) {
        std::vector<BodyId> stack;
        for (int i = 0; i < 4; ++i)
            stack.push_back(addCube<S>(squall.world, 60 + 0.02 * i, 0.2 + 0.4 * i, 0.2, 1, squall.stone));
        return stack;
    };
    Squall<S> both(ofSquall<S>()), alone(ofSquall<S>()), quiet(ofSquall<S>());
    both.throwStones(3);
    alone.throwStones(3);
    const std::vector<BodyId> beside = addStack(both), stack = addStack(quiet);
    for (int step = 0; step < 60; ++step) {
        for (Squall<S>* squall : {&both, &alone, &quiet}) squall->world.step(typename S::Real(kViolentStep));
        for (std::size_t i = 0; i < alone.stones.size(); ++i)
            ASSERT_EQ(both.world.pose(both.stones[i]).p, alone.world.pose(alone.stones[i]).p) << step;
        for (std::size_t i = 0; i < stack.size(); ++i)
            ASSERT_EQ(both.world.pose(beside[i]).p, quiet.world.pose(stack[i]).p) << step;
    }
}

}  // namespace
}  // namespace rigor::engine::test
