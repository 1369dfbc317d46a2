// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Large scenes: every broad phase with one thread and with several, against one sweep; and what the wide tree
// alone promises: the same work on every instruction set, little work while little changes, no overlap lost
// where its single-precision boxes are coarse.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <random>

#include "engine/broadphase/broad_phase.hpp"
#include "engine/broadphase/pair_sort.hpp"
#include "engine/broadphase/spatial_order.hpp"
#include "engine/core/tests/counting_new.hpp"

namespace rigor::engine {
namespace {

template <class S>
class LargeScene : public testing::Test {
  public:
    using Vec = typename S::Vec;

    /// `n` boxes of edges 0.2 to 1 m, about two neighbours each, a tenth fixed; a floor, and a few large
    /// ones.
    void fill(int n, double far = 0) {
        const double side = 0.8 * std::pow(n, 1.0 / S::dim);
        for (int i = 0; i < n; ++i) add(vec(far, far + side), vec(0.1, 0.5), i % 10 != 0);
        for (int i = 0; i < 5; ++i) add(vec(far, far + side), vec(2, 5), true);
        Vec half = Vec::Constant(static_cast<typename S::Real>(side));
        half[1] = 1;
        add(vec(far, far), half, false);
    }
    void add(const Vec& center, const Vec& half, bool moves) {
        boxes.push_back({center - half, center + half});
        movable.push_back(moves);
    }
    Vec vec(double a, double b) {
        Vec v;
        for (int k = 0; k < S::dim; ++k)
            v[k] = static_cast<typename S::Real>(std::uniform_real_distribution<double>(a, b)(random));
        return v;
    }
    /// Moves every `every`-th movable box.
    void shift(double distance, std::size_t every) {
        for (std::size_t i = random() % every; i < boxes.size(); i += every) {
            if (!movable[i]) continue;
            const Vec d = vec(-distance, distance);
            boxes[i].min += d;
            boxes[i].max += d;
        }
    }
    /// Pairs found by a sweep along x.
    std::vector<ProxyPair> oracle() const {
        std::vector<std::uint32_t> order(boxes.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
        std::sort(order.begin(), order.end(),
                  [&](std::uint32_t i, std::uint32_t j) { return boxes[i].min[0] < boxes[j].min[0]; });
        std::vector<ProxyPair> pairs;
        for (std::size_t k = 0; k < order.size(); ++k)
            for (std::size_t l = k + 1; l < order.size(); ++l) {
                const std::uint32_t i = order[k], j = order[l];
                if (boxes[j].min[0] > boxes[i].max[0]) break;
                if ((movable[i] || movable[j]) && boxes[i].overlaps(boxes[j]))
                    pairs.push_back({std::min(i, j), std::max(i, j)});
            }
        std::sort(pairs.begin(), pairs.end());
        return pairs;
    }

    std::mt19937 random{9};
    std::vector<Aabb<S>> boxes;
    std::vector<std::uint8_t> movable;
};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(LargeScene, Spaces);

TYPED_TEST(LargeScene, ThePairsAreTheSameForAnyNumberOfThreads) {
    using S = TypeParam;
    this->fill(5000);
    struct Run {
        const char* name;
        std::unique_ptr<BroadPhase<S>> broadPhase;
        Tasks tasks;
    };
    std::vector<Run> runs;
    for (const auto& entry : broadPhaseTable<S>())
        for (const int threads : {1, 2, 3})
            if (std::string_view(entry.name) != "brute_force")
                runs.push_back({entry.name, entry.make(), Tasks(threads)});
    std::vector<ProxyPair> pairs;
    for (int round = 0; round < 8; ++round) {
        const std::vector<ProxyPair> expected = this->oracle();
        if (round < 5) {
            ASSERT_GT(expected.size(), 4000u) << "or the test looked at little";
        }
        std::size_t testsOfOne = 0;
        for (Run& run : runs) {
            const std::size_t before = run.broadPhase->tests();
            run.broadPhase->update(this->boxes, this->movable, pairs, run.tasks);
            ASSERT_TRUE(pairs == expected)
                << run.name << ", " << run.tasks.threads() << " threads, round " << round;
            const std::size_t tests = run.broadPhase->tests() - before;
            if (run.tasks.threads() == 1) testsOfOne = tests;
            EXPECT_EQ(tests, testsOfOne) << run.name << ": the same work";
        }
        this->shift(round == 5 ? 30 : 0.1, round % 3 == 0 ? 50 : 1);
    }
}

TYPED_TEST(LargeScene, NoAllocationInASteadyStateWithOneThread) {
    using S = TypeParam;
    this->fill(5000);
    const auto start = this->boxes;
    this->shift(0.2, 1);
    const auto there = this->boxes;
    auto broadPhase = findAlgorithm(broadPhaseTable<S>(), "broad_phase", "wide_tree").make();
    std::vector<ProxyPair> pairs;
    const auto period = [&] {
        this->boxes = start;
        broadPhase->update(this->boxes, this->movable, pairs);
        this->boxes = there;
        broadPhase->update(this->boxes, this->movable, pairs);
        for (std::size_t i = 0; i < 100; ++i) this->boxes[i] = start[i];
        broadPhase->update(this->boxes, this->movable, pairs);
    };
    period();
    period();
    period();
    const long before = test::allocationCount();
    period();
    EXPECT_EQ(test::allocationCount(), before);
    EXPECT_GT(pairs.size(), 4000u);
}

TYPED_TEST(LargeScene, WhatDoesNotChangeIsNotSearched) {
    using S = TypeParam;
    this->fill(5000);
    auto tree = findAlgorithm(broadPhaseTable<S>(), "broad_phase", "wide_tree").make();
    std::vector<ProxyPair> pairs;
    const auto testsOfUpdate = [&] {
        const std::size_t before = tree->tests();
        tree->update(this->boxes, this->movable, pairs);
        EXPECT_TRUE(pairs == this->oracle());
        return tree->tests() - before;
    };
    const std::size_t all = testsOfUpdate();
    EXPECT_EQ(testsOfUpdate(), 0u);
    for (int round = 0; round < 10; ++round) {
        this->shift(0.1, 500);  // some ten boxes
        EXPECT_LT(testsOfUpdate(), all / 10);
    }
    this->movable[3] = !this->movable[3];
    EXPECT_LT(testsOfUpdate(), all / 10);
    // Boxes that stand still and become movable, or no longer are, gain and lose pairs.
    const std::size_t pairsBefore = pairs.size();
    for (std::size_t i = 0; i < this->movable.size(); i += 20) this->movable[i] = !this->movable[i];
    testsOfUpdate();
    EXPECT_NE(pairs.size(), pairsBefore);
}

/// Boxes that have come far away from where they were when the tree was built: it is built anew, and then
/// does the work of a new one.
TYPED_TEST(LargeScene, AWornTreeIsBuiltAnew) {
    using S = TypeParam;
    this->fill(5000);
    auto tree = findAlgorithm(broadPhaseTable<S>(), "broad_phase", "wide_tree").make();
    std::vector<ProxyPair> pairs;
    const auto testsOf = [&](BroadPhase<S>& broadPhase) {
        const std::size_t before = broadPhase.tests();
        broadPhase.update(this->boxes, this->movable, pairs);
        return broadPhase.tests() - before;
    };
    testsOf(*tree);
    for (const double distance : {20.0, 0.01, 0.01}) {
        this->shift(distance, 1);
        testsOf(*tree);
    }
    this->shift(0.01, 1);
    auto fresh = findAlgorithm(broadPhaseTable<S>(), "broad_phase", "wide_tree").make();
    EXPECT_LT(testsOf(*tree), 2 * testsOf(*fresh));
}

TYPED_TEST(LargeScene, NoOverlapIsLostWhereSinglePrecisionIsCoarse) {
    using S = TypeParam;
    this->fill(1000, 3e6);  // floats are 0.25 m apart there
    this->add(S::Vec::Constant(-3e6f), S::Vec::Ones(), true);
    auto tree = findAlgorithm(broadPhaseTable<S>(), "broad_phase", "wide_tree").make();
    std::vector<ProxyPair> pairs;
    for (int round = 0; round < 5; ++round) {
        tree->update(this->boxes, this->movable, pairs);
        EXPECT_TRUE(pairs == this->oracle());
        this->shift(0.5, 1);
    }
    EXPECT_GT(pairs.size(), 500u);
}

TYPED_TEST(LargeScene, EveryInstructionSetDoesTheSameWork) {
    using S = TypeParam;
    this->fill(3000);
    const std::vector<ProxyPair> expected = this->oracle();
    std::size_t sets = 0, tests = 0;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        auto tree = findAlgorithm(broadPhaseTable<S>(), "broad_phase", "wide_tree").make();
        std::vector<ProxyPair> pairs;
        tree->update(this->boxes, this->movable, pairs);
        EXPECT_TRUE(pairs == expected) << hwy::TargetName(target);
        if (sets++ == 0) tests = tree->tests();
        EXPECT_EQ(tree->tests(), tests) << hwy::TargetName(target);
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_GE(sets, 1u);
    this->RecordProperty("instruction_sets", static_cast<int>(sets));
}

/// Unit cubes on a lattice of 4 x 4 x 4, shuffled: every eight in the order are the corners of a cube.
TEST(SpatialOrder, EightConsecutiveBoxesLieTogether) {
    std::vector<std::uint32_t> place(64);
    for (std::uint32_t i = 0; i < 64; ++i) place[i] = i;
    std::shuffle(place.begin(), place.end(), std::mt19937(4));
    std::vector<Aabb<Space3d>> boxes;
    for (const std::uint32_t p : place) {
        const Space3d::Vec low = 2.0 * Space3d::Vec(p % 4, p / 4 % 4, p / 16);
        boxes.push_back({low, low + Space3d::Vec::Ones()});
    }
    // a box without bounds is last
    boxes.push_back({Space3d::Vec::Constant(-1e30), Space3d::Vec::Constant(1e30)});
    boxes.push_back({Space3d::Vec::Constant(-1), Space3d::Vec::Constant(40)});  // larger than 8 medians
    std::vector<std::uint32_t> order;
    SpatialOrder<Space3d>().sort(boxes, order, Tasks::one());
    ASSERT_EQ(order.size(), 66u);
    EXPECT_EQ(order[64], 65u);
    EXPECT_EQ(order[65], 64u);
    for (std::size_t g = 0; g < 64; g += 8) {
        Aabb<Space3d> bounds = boxes[order[g]];
        for (std::size_t i = g; i < g + 8; ++i) {
            bounds.min = bounds.min.cwiseMin(boxes[order[i]].min);
            bounds.max = bounds.max.cwiseMax(boxes[order[i]].max);
        }
        EXPECT_EQ((bounds.max - bounds.min).maxCoeff(), 3) << "group " << g / 8;
    }
}

TEST(PairSort, EqualsASortByComparisons) {
    std::mt19937 random(3);
    PairSort pairSort;
    for (const std::size_t count : {0u, 3u, 100u, 50000u})
        for (const int threads : {1, 2, 3}) {
            std::vector<std::vector<ProxyPair>> parts(3);
            std::vector<ProxyPair> expected, sorted;
            for (std::size_t i = 0; i < count; ++i) {
                // Low ones often: lists of one and of thousands.
                const std::uint32_t a = random() % 3 ? random() % 1000 : 0, b = a + 1 + random() % 50;
                expected.push_back({a, b});
                parts[random() % 3].push_back({a, b});
            }
            std::sort(expected.begin(), expected.end());
            pairSort.sort(parts, 1000, sorted, Tasks(threads));
            EXPECT_TRUE(sorted == expected) << count << " pairs, " << threads << " threads";
        }
}

}  // namespace
}  // namespace rigor::engine
