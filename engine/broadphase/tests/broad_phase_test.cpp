// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every broad phase of the table against a plain double loop, over moving boxes of all kinds.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "engine/broadphase/broad_phase.hpp"

namespace rigor::engine {
namespace {

template <class S>
class BroadPhases : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(BroadPhases, Spaces);

template <class S>
std::vector<ProxyPair> oracle(const std::vector<Aabb<S>>& boxes, const std::vector<std::uint8_t>& movable) {
    std::vector<ProxyPair> pairs;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
            bool apart = !movable[i] && !movable[j];
            for (int k = 0; k < S::dim; ++k)
                apart = apart || boxes[i].min[k] > boxes[j].max[k] || boxes[j].min[k] > boxes[i].max[k];
            if (!apart) pairs.push_back({i, j});
        }
    return pairs;
}

template <class S>
Aabb<S> randomBox(std::mt19937& random, double spread) {
    using R = typename S::Real;
    std::uniform_real_distribution<double> place(-spread, spread), size(0, 1);
    Aabb<S> box;
    for (int k = 0; k < S::dim; ++k) {
        const double c = place(random), e = 0.05 + size(random) * size(random) * 2;
        box.min[k] = static_cast<R>(c - e);
        box.max[k] = static_cast<R>(c + e);
    }
    return box;
}

TYPED_TEST(BroadPhases, EqualTheDoubleLoopWhileBoxesMoveJumpAndBecomeUnbounded) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& entry : broadPhaseTable<S>()) {
        std::mt19937 random(7);
        auto broadPhase = entry.make();
        std::vector<Aabb<S>> boxes;
        std::vector<std::uint8_t> movable;
        std::vector<ProxyPair> pairs;
        for (int i = 0; i < 150; ++i) {
            boxes.push_back(randomBox<S>(random, 8));
            movable.push_back(i % 5 != 0);
        }
        // Two half-spaces: below y = -7, and below x = -7.
        for (const int axis : {1, 0}) {
            Aabb<S> half;
            half.min.setConstant(-std::numeric_limits<R>::max());
            half.max.setConstant(std::numeric_limits<R>::max());
            half.max[axis] = -7;
            boxes.push_back(half);
            movable.push_back(0);
        }
        std::size_t found = 0;
        std::uniform_real_distribution<double> step(-0.3, 0.3);
        for (int round = 0; round < 120; ++round) {
            broadPhase->update(boxes, movable, pairs);
            ASSERT_EQ(pairs, oracle<S>(boxes, movable)) << entry.name << " round " << round;
            found += pairs.size();
            for (std::size_t i = 0; i < 150; ++i) {
                typename S::Vec d;
                for (int k = 0; k < S::dim; ++k) d[k] = static_cast<R>(step(random));
                boxes[i].min += d;
                boxes[i].max += d;
            }
            boxes[round] = randomBox<S>(random, 8);
            if (round == 60) boxes[3] = boxes.back();  // becomes unbounded
            if (round == 70) boxes[3] = randomBox<S>(random, 8);
            if (round == 80) {
                boxes.resize(140);
                movable.resize(140);
            }  // another count: starts afresh
            if (round == 80) round = 1000;
        }
        broadPhase->update(boxes, movable, pairs);
        EXPECT_EQ(pairs, oracle<S>(boxes, movable)) << entry.name;
        EXPECT_GT(found, 1000u) << "or the test looked at nothing";
    }
}

TYPED_TEST(BroadPhases, TouchingCountsAndACopyContinuesAlike) {
    using S = TypeParam;
    for (const auto& entry : broadPhaseTable<S>()) {
        auto broadPhase = entry.make();
        Aabb<S> a, b;
        a.min.setConstant(0);
        a.max.setConstant(1);
        b.min.setConstant(1);
        b.max.setConstant(2);
        std::vector<Aabb<S>> boxes{a, b};
        std::vector<std::uint8_t> movable{1, 1};
        std::vector<ProxyPair> pairs, copied;
        broadPhase->update(boxes, movable, pairs);
        ASSERT_EQ(pairs.size(), 1u) << entry.name;
        auto copy = broadPhase->clone();
        boxes[1].min[0] += typename S::Real(0.001);
        broadPhase->update(boxes, movable, pairs);
        copy->update(boxes, movable, copied);
        EXPECT_TRUE(pairs.empty()) << entry.name;
        EXPECT_EQ(pairs, copied);
    }
}

/// A row of boxes that touch their neighbours and do not move; one of them changes between fixed and movable.
TYPED_TEST(BroadPhases, AProxyThatBecomesMovableFindsItsPairsAndLosesThemAgain) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& entry : broadPhaseTable<S>()) {
        auto broadPhase = entry.make();
        std::vector<Aabb<S>> boxes(20);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            boxes[i].min.setConstant(0);
            boxes[i].max.setConstant(1);
            boxes[i].min[0] = static_cast<R>(i);
            boxes[i].max[0] = static_cast<R>(i + 1);
        }
        std::vector<std::uint8_t> movable(boxes.size(), 0);
        std::vector<ProxyPair> pairs;
        for (int round = 0; round < 6; ++round) {
            broadPhase->update(boxes, movable, pairs);
            EXPECT_EQ(pairs, oracle<S>(boxes, movable)) << entry.name << " round " << round;
            EXPECT_EQ(pairs.size(), movable[7] ? 2u : 0u) << entry.name << " round " << round;
            movable[7] = !movable[7];
        }
    }
}

/// Boxes that have moved far cost no more box tests than boxes that were just added at the same places.
TYPED_TEST(BroadPhases, AfterALongWayTheWorkIsThatOfAFreshStart) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& entry : broadPhaseTable<S>()) {
        std::mt19937 random(11);
        std::vector<Aabb<S>> boxes;
        for (int i = 0; i < 300; ++i) boxes.push_back(randomBox<S>(random, 20));
        const std::vector<std::uint8_t> movable(boxes.size(), 1);
        std::vector<ProxyPair> pairs;
        auto walked = entry.make(), fresh = entry.make();
        std::uniform_real_distribution<double> stride(-1, 1);
        for (int round = 0; round < 200; ++round) {
            walked->update(boxes, movable, pairs);
            for (auto& box : boxes) {
                typename S::Vec d;
                for (int k = 0; k < S::dim; ++k) d[k] = static_cast<R>(stride(random) + (k == 0 ? 2 : 0));
                box.min += d;
                box.max += d;
            }
        }
        const auto cost = [&](BroadPhase<S>& broadPhase) {
            const auto before = broadPhase.tests();
            broadPhase.update(boxes, movable, pairs);
            return static_cast<double>(broadPhase.tests() - before);
        };
        fresh->update(boxes, movable, pairs);
        walked->update(boxes, movable, pairs);
        const double afresh = cost(*fresh), after = cost(*walked);
        EXPECT_LE(after, 2 * afresh + 300) << entry.name << ": " << after << " tests, afresh " << afresh;
    }
}

}  // namespace
}  // namespace rigor::engine
