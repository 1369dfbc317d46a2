// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Broad phases against brute force: moving, touching, degenerate and coinciding boxes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "adapters/conformance/kit.hpp"
#include "adapters/interface/timed.hpp"

namespace rigor::conformance {
namespace {

using adapter::Aabb;
using adapter::Pair;

class BroadPhases : public testing::TestWithParam<int> {
  protected:
    Aabb boxAt(const Vec3& min, const Vec3& size) const {
        Aabb box{min, min + size};
        if (GetParam() == 2) box.min.z = box.max.z = 0.0;
        return box;
    }
    /// Compares every algorithm with brute force on a sequence of box sets of the same count.
    void compare(const std::vector<std::vector<Aabb>>& frames) const {
        for (const auto& algorithm : engine().broadPhase()->algorithms()) {
            SCOPED_TRACE(algorithm);
            auto broadPhase = engine().broadPhase()->create(algorithm, GetParam());
            std::vector<Pair> pairs;
            for (std::size_t i = 0; i < frames.size(); ++i) {
                broadPhase->update(frames[i], pairs);
                ASSERT_EQ(pairs, adapter::bruteForcePairs(frames[i])) << "frame " << i;
            }
        }
    }
};
INSTANTIATE_TEST_SUITE_P(Kit, BroadPhases,
                         testing::ValuesIn(engine().broadPhase() ? queryDimensions() : std::vector<int>{}),
                         dimensionName);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(BroadPhases);

TEST_P(BroadPhases, MovingBoxesMeetTheSamePartnersAsByBruteForce) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-6.0, 6.0), extent(0.05, 1.2), move(-0.5, 0.5);
    std::vector<Aabb> boxes;
    for (int i = 0; i < 150; ++i)
        boxes.push_back(boxAt({place(random), place(random), place(random)},
                              {extent(random), extent(random), extent(random)}));
    boxes.push_back(boxAt({-50, -50, -50}, {100, 100, 100}));  // one that holds all
    std::vector<std::vector<Aabb>> frames;
    std::size_t met = 0;
    for (int frame = 0; frame < 25; ++frame) {
        frames.push_back(boxes);
        met += adapter::bruteForcePairs(boxes).size();
        for (Aabb& box : boxes) {
            // Now and then a leap: nothing may rest on coherence.
            const double scale = frame % 8 == 7 ? 20.0 : 1.0;
            const Vec3 shift = scale * Vec3{move(random), move(random), move(random)};
            box = boxAt(box.min + shift, box.max - box.min);
        }
    }
    EXPECT_GT(met, 25u * 150u) << "the large box alone gives 150 pairs per frame";
    compare(frames);
}

/// The broad phase runs as when it is timed: no pairs are read in between, and the engine may hold more than
/// those that overlap.
TEST_P(BroadPhases, WhatIsHeldAfterManyRunsHasAllPairs) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-5.0, 5.0), move(-0.05, 0.05);
    const auto* timed = dynamic_cast<const adapter::TimedBroadPhaseEngine*>(engine().broadPhase());
    if (timed == nullptr) GTEST_SKIP() << "not in parts: it cannot be timed by itself";
    for (const auto& algorithm : timed->algorithms()) {
        SCOPED_TRACE(algorithm);
        auto broadPhase = timed->createTimed(algorithm, GetParam(), nullptr);
        std::vector<Aabb> boxes;
        std::vector<Vec3> velocities;
        for (int i = 0; i < 200; ++i) {
            boxes.push_back(boxAt({place(random), place(random), place(random)}, {1, 1, 1}));
            velocities.push_back({move(random), move(random), move(random)});
        }
        std::vector<Pair> held;
        for (int frame = 0; frame < 60; ++frame) {
            for (std::size_t i = 0; i < boxes.size(); ++i)
                boxes[i] = boxAt(boxes[i].min + velocities[i], boxes[i].max - boxes[i].min);
            broadPhase->take(boxes);
            broadPhase->run();
            if (frame % 20 != 19) continue;
            broadPhase->held(held);
            std::sort(held.begin(), held.end());
            held.erase(std::unique(held.begin(), held.end()), held.end());
            const auto exact = adapter::bruteForcePairs(boxes);
            EXPECT_TRUE(std::includes(held.begin(), held.end(), exact.begin(), exact.end())) << frame;
            EXPECT_LT(held.size(), 3 * exact.size() + 100) << "not everything with everything";
        }
    }
}

TEST_P(BroadPhases, TouchingIsOverlap) {
    // A lattice of unit boxes shares faces, edges and corners exactly.
    std::vector<Aabb> boxes;
    for (int x = 0; x < 4; ++x)
        for (int y = 0; y < 4; ++y)
            for (int z = 0; z < (GetParam() == 2 ? 1 : 3); ++z)
                boxes.push_back(boxAt({1.0 * x - 2, 1.0 * y - 2, 1.0 * z - 1}, {1, 1, 1}));
    auto apart = boxes;
    for (std::size_t i = 0; i < apart.size(); i += 2)
        apart[i].max.x = std::nextafter(apart[i].max.x, -std::numeric_limits<double>::infinity());
    compare({boxes, apart, boxes});
}

TEST_P(BroadPhases, PointsAndCoincidingBoxesCount) {
    std::vector<Aabb> boxes{boxAt({0, 0, 0}, {1, 1, 1}),       boxAt({0, 0, 0}, {1, 1, 1}),
                            boxAt({0.5, 0.5, 0.5}, {0, 0, 0}), boxAt({1, 1, 1}, {0, 0, 0}),
                            boxAt({0.5, 0.5, 0.5}, {0, 0, 0}), boxAt({3, 0, 0}, {0, 2, 2}),
                            boxAt({2.5, 1, 1}, {1, 0, 0})};
    compare({boxes, boxes});
}

TEST_P(BroadPhases, NothingMeetsNothing) {
    compare({{}});
    compare({{boxAt({0, 0, 0}, {1, 1, 1})}});
}

TEST_P(BroadPhases, UnknownNamesAreRefused) {
    // One of the interface's two refusals is required; a std::runtime_error of the library's own would not
    // do.
    try {
        engine().broadPhase()->create("no such algorithm", GetParam());
        ADD_FAILURE() << "created something";
    } catch (const adapter::Unsupported&) {
    } catch (const adapter::BadInput&) {
    }
    EXPECT_FALSE(engine().broadPhase()->algorithms().empty());
}

}  // namespace
}  // namespace rigor::conformance
