// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Fat AABBs: filtered by the boxes themselves their pairs are those of a double loop, over every broad phase;
// the broad phase runs only when a box has left its fat one; the result says whether the pairs changed.
#include "engine/broadphase/fat_aabbs.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "engine/core/tests/counting_new.hpp"

namespace rigor::engine {
namespace {

template <class S>
class FatAabbsOf : public testing::Test {
  public:
    using R = typename S::Real;

    /// 120 boxes, a third of them fixed, a wide floor and a half-space.
    void fill() {
        for (int i = 0; i < 120; ++i) add(box(vec(-6, 6)), i % 3 != 0);
        typename S::Vec lo = S::Vec::Constant(-50), hi = S::Vec::Constant(50);
        hi[1] = -5;
        add({lo, hi}, false);
        hi.setConstant(std::numeric_limits<R>::max());
        lo = -hi;
        hi[0] = -5;
        add({lo, hi}, false);
    }
    void add(const Aabb<S>& b, bool moves) {
        boxes.push_back(b);
        movable.push_back(moves);
    }
    typename S::Vec vec(double a, double b) {
        typename S::Vec v;
        for (int k = 0; k < S::dim; ++k)
            v[k] = static_cast<R>(std::uniform_real_distribution<double>(a, b)(random));
        return v;
    }
    Aabb<S> box(const typename S::Vec& center) {
        const typename S::Vec half = vec(0.2, 1);
        return {center - half, center + half};
    }
    void shift(double distance) {
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            if (!movable[i]) continue;
            const typename S::Vec d = vec(-distance, distance);
            boxes[i].min += d;
            boxes[i].max += d;
        }
    }
    std::vector<ProxyPair> oracle(const std::vector<Aabb<S>>& of) const {
        std::vector<ProxyPair> pairs;
        for (std::uint32_t i = 0; i < of.size(); ++i)
            for (std::uint32_t j = i + 1; j < of.size(); ++j)
                if ((movable[i] || movable[j]) && of[i].overlaps(of[j])) pairs.push_back({i, j});
        return pairs;
    }
    std::vector<ProxyPair> filtered(const std::vector<ProxyPair>& pairs) const {
        std::vector<ProxyPair> exact;
        for (const ProxyPair& p : pairs)
            if (boxes[p.a].overlaps(boxes[p.b])) exact.push_back(p);
        return exact;
    }

    std::mt19937 random{5};
    std::vector<Aabb<S>> boxes;
    std::vector<std::uint8_t> movable;
};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(FatAabbsOf, Spaces);

TYPED_TEST(FatAabbsOf, HoldThePairsOfTheBoxesAndSayWhenTheyChange) {
    using S = TypeParam;
    this->fill();
    for (const auto& entry : broadPhaseTable<S>())
        for (const double margin : {0.0, 0.05, 0.7}) {
            auto broadPhase = entry.make();
            FatAabbs<S> fat;
            std::vector<ProxyPair> before;
            std::size_t found = 0, changes = 0;
            for (int round = 0; round < 60; ++round) {
                const bool changed = fat.update(*broadPhase, this->boxes, this->movable,
                                                static_cast<typename S::Real>(margin));
                ASSERT_EQ(fat.pairs(), this->oracle(fat.boxes())) << entry.name << " " << round;
                ASSERT_EQ(this->filtered(fat.pairs()), this->oracle(this->boxes))
                    << entry.name << " margin " << margin << " round " << round;
                if (round > 0) {
                    ASSERT_EQ(changed, fat.pairs() != before) << entry.name << " " << round;
                }
                before = fat.pairs();
                found += before.size();
                changes += changed;
                this->shift(round % 20 == 19 ? 3 : 0.02);
                if (round == 30) this->movable[4] = !this->movable[4];
                if (round == 40) this->add(this->box(this->vec(-3, 3)), true);
                if (round == 45) {
                    fat.reset();
                    broadPhase->reset();
                    before.clear();
                }
            }
            EXPECT_GT(found, 1000u);
            if (margin > 0.5) {
                EXPECT_LT(changes, 50u) << "or the margin does nothing";
            }
        }
}

TYPED_TEST(FatAabbsOf, TheBroadPhaseRunsOnlyWhenABoxLeavesItsFatOne) {
    using S = TypeParam;
    this->fill();
    auto broadPhase = findAlgorithm(broadPhaseTable<S>(), "broad_phase", "brute_force").make();
    FatAabbs<S> fat;
    const typename S::Real margin{0.1f};
    EXPECT_TRUE(fat.update(*broadPhase, this->boxes, this->movable, margin));
    EXPECT_EQ(fat.replaced(), this->boxes.size());
    const std::size_t tests = broadPhase->tests();
    const auto start = this->boxes;
    const long allocations = test::allocationCount();
    for (int round = 0; round < 20; ++round) {
        this->boxes = start;
        this->shift(0.03);  // edges of at least 0.4 m: margins of at least 0.04 m
        EXPECT_FALSE(fat.update(*broadPhase, this->boxes, this->movable, margin));
        EXPECT_EQ(fat.replaced(), 0u);
    }
    EXPECT_EQ(broadPhase->tests(), tests);
    EXPECT_EQ(test::allocationCount(), allocations);
    this->boxes[1].min[0] -= 10;
    this->boxes[1].max[0] -= 10;
    fat.update(*broadPhase, this->boxes, this->movable, margin);
    EXPECT_EQ(fat.replaced(), 1u);
    EXPECT_GT(broadPhase->tests(), tests);
}

}  // namespace
}  // namespace rigor::engine
