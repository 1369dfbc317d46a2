// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "engine/solvers/wide/colouring.hpp"

namespace rigor::engine::test {
namespace {

constexpr std::uint32_t kWidth = 8;

/// Contacts of random bodies; every fifth body is a wall.
std::vector<PatchPlan> randomPlans(std::size_t count, std::uint32_t bodies, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<PatchPlan> plans;
    while (plans.size() < count) {
        const std::uint32_t a = random() % bodies, b = random() % bodies;
        if (a == b || (a % 5 == 0 && b % 5 == 0)) continue;
        plans.push_back({std::min(a, b), std::max(a, b), std::min(a, b) % 5 != 0, std::max(a, b) % 5 != 0,
                         static_cast<std::uint8_t>(1 + random() % 4)});
    }
    return plans;
}

/// Of a range that `of` threads share evenly, whose share a block is; `of`: nobody's.
std::size_t shareOf(std::uint32_t block, const Colouring::Range& range, std::size_t of) {
    for (std::size_t share = 0; share < of; ++share) {
        const Colouring::Cut begin = Colouring::cut(range, double(share) / double(of));
        const Colouring::Cut end = Colouring::cut(range, double(share + 1) / double(of));
        for (std::uint32_t kind = 0; kind < Colouring::kKinds; ++kind)
            if (begin[kind] <= block && block < end[kind]) return share;
    }
    return of;
}

/// Every plan has a lane of its own, and no two of a range move the same body.
void expectProper(const std::vector<PatchPlan>& plans, const Colouring& colouring) {
    ASSERT_EQ(colouring.places().size(), plans.size());
    const std::set<std::uint32_t> lanes(colouring.places().begin(), colouring.places().end());
    EXPECT_EQ(lanes.size(), plans.size()) << "lanes taken twice";
    std::uint32_t next = 0;
    std::size_t found = 0;
    for (const Colouring::Range& range : colouring.ranges()) {
        EXPECT_EQ(range.first, next) << "ranges follow each other";
        next = range.last;
        for (std::size_t of = 1; of <= 6; ++of)
            for (std::uint32_t block = range.first; block < range.last; ++block)
                EXPECT_LT(shareOf(block, range, of), of) << "block " << block << " among " << of;
        std::set<std::uint32_t> moved;
        for (std::size_t k = 0; k < plans.size(); ++k) {
            const std::uint32_t block = colouring.places()[k] / kWidth;
            if (block < range.first || block >= range.last) continue;
            ++found;
            EXPECT_TRUE(!plans[k].movesA || moved.insert(plans[k].a).second) << "body " << plans[k].a;
            EXPECT_TRUE(!plans[k].movesB || moved.insert(plans[k].b).second) << "body " << plans[k].b;
        }
    }
    EXPECT_EQ(next, colouring.blocks());
    EXPECT_EQ(found, plans.size());
}

TEST(Colouring, NoTwoOfAColourMoveTheSameBody) {
    for (const std::size_t count : {0u, 1u, 7u, 8u, 9u, 500u})
        for (unsigned seed = 0; seed < 4; ++seed) {
            const std::vector<PatchPlan> plans = randomPlans(count, 100, seed);
            Colouring colouring;
            colouring.colour(plans, 100, kWidth);
            expectProper(plans, colouring);
        }
}

TEST(Colouring, BodiesOfVeryManyContactsLeaveSomeOver) {
    // A plate that carries 150 balls and stands on 100 posts.
    std::vector<PatchPlan> plans;
    for (std::uint32_t i = 1; i <= 150; ++i) plans.push_back({0, i, true, true, 1});
    for (std::uint32_t i = 151; i <= 250; ++i) plans.push_back({0, i, true, false, 4});
    Colouring colouring;
    colouring.colour(plans, 300, kWidth);
    expectProper(plans, colouring);
    EXPECT_EQ(colouring.ranges().size(), 250u) << "nothing can be done side by side";
}

TEST(Colouring, IsDenseAndPutsWallsLast) {
    // A chain of 400 bodies on the ground: two colours of 200 and one of 400.
    std::vector<PatchPlan> plans;
    for (std::uint32_t i = 1; i < 400; ++i) plans.push_back({i, i + 1, true, true, 2});
    for (std::uint32_t i = 1; i <= 400; ++i) plans.push_back({0, i, false, true, 2});
    Colouring colouring;
    colouring.colour(plans, 401, kWidth);
    expectProper(plans, colouring);
    EXPECT_EQ(colouring.ranges().size(), 3u);
    EXPECT_EQ(colouring.blocks(), 25u + 25u + 50u);
    EXPECT_GE(colouring.places().back() / kWidth, 50u);
}

/// A sheet of 60 x 60 bodies on the ground, numbered row by row: what two (or three, or four) threads move in
/// all colours is about a half of it each, and few bodies at the seam are moved by two.
TEST(Colouring, SharesOfAllColoursMoveTheSameBodies) {
    constexpr std::uint32_t kSide = 60;
    std::vector<PatchPlan> plans;
    const auto body = [](std::uint32_t x, std::uint32_t y) { return 1 + y * kSide + x; };
    for (std::uint32_t y = 0; y < kSide; ++y)
        for (std::uint32_t x = 0; x < kSide; ++x) {
            plans.push_back({0, body(x, y), false, true, 4});
            if (x + 1 < kSide) plans.push_back({body(x, y), body(x + 1, y), true, true, 2});
            if (y + 1 < kSide) plans.push_back({body(x, y), body(x, y + 1), true, true, 2});
        }
    Colouring colouring;
    colouring.colour(plans, kSide * kSide + 1, kWidth);
    expectProper(plans, colouring);
    for (std::size_t of = 2; of <= 4; ++of) {
        std::vector<std::size_t> work(of, 0);
        std::vector<std::set<std::uint32_t>> moved(of);
        for (std::size_t k = 0; k < plans.size(); ++k)
            for (const Colouring::Range& range : colouring.ranges())
                if (const std::size_t share = shareOf(colouring.places()[k] / kWidth, range, of);
                    share < of) {
                    ++work[share];
                    if (plans[k].movesA) moved[share].insert(plans[k].a);
                    if (plans[k].movesB) moved[share].insert(plans[k].b);
                }
        std::size_t all = 0;
        for (std::size_t share = 0; share < of; ++share) {
            all += moved[share].size();
            EXPECT_NEAR(double(work[share]), double(plans.size()) / double(of), 0.05 * double(plans.size()));
        }
        // A row of bodies at each seam, and blocks that the seam goes through. Cuts of each colour by itself
        // (one in the middle of the ground's, another of the bonds') would lie rows apart.
        EXPECT_LE(all, kSide * kSide + (of - 1) * 4 * kSide) << of << " threads";
    }
}

/// A pyramid's ground contacts are all of bodies of the first slices: threads share them all the same.
TEST(Colouring, NoShareOfAColourIsMuchLargerThanAnother) {
    std::vector<PatchPlan> plans;
    for (std::uint32_t i = 1; i <= 320; ++i) plans.push_back({0, i, false, true, 4});
    for (std::uint32_t i = 1; i < 4000; i += 2) plans.push_back({i, i + 1, true, true, 2});
    Colouring colouring;
    colouring.colour(plans, 4001, kWidth);
    expectProper(plans, colouring);
    ASSERT_EQ(colouring.ranges().size(), 2u);
    for (const Colouring::Range& range : colouring.ranges()) {
        std::vector<double> blocks(2, 0);
        for (std::uint32_t block = range.first; block < range.last; ++block)
            ++blocks[shareOf(block, range, 2)];
        const double all = range.last - range.first;
        EXPECT_NEAR(blocks[0], all / 2, all / 16 + 1) << "of " << all;
    }
}

TEST(Colouring, PutsPatchesOfAsManyPointsTogether) {
    // 64 pairs that share no body: one colour, the patches of four points in the first blocks.
    std::vector<PatchPlan> plans;
    for (std::uint32_t i = 0; i < 64; ++i)
        plans.push_back({2 * i, 2 * i + 1, true, true, static_cast<std::uint8_t>(1 + i % 4)});
    Colouring colouring;
    colouring.colour(plans, 128, kWidth);
    expectProper(plans, colouring);
    for (std::uint32_t i = 0; i < 64; ++i)
        EXPECT_EQ(colouring.places()[i] / 16, 4u - plans[i].points) << "16 of each kind";
}

}  // namespace
}  // namespace rigor::engine::test
