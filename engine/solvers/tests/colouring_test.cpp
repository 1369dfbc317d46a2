// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <span>

#include "engine/core/tests/counting_new.hpp"
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

Colouring coloured(const std::vector<PatchPlan>& plans, std::size_t bodies, int threads = 1) {
    Colouring colouring;
    colouring.colour(plans, bodies, kWidth, Tasks(threads));
    return colouring;
}

/// Where each plan comes: block * lanes + lane; twice or nowhere is an error.
std::vector<std::uint32_t> placesOf(const Colouring& colouring, std::size_t plans) {
    std::vector<std::uint32_t> places(plans, kNullIndex);
    EXPECT_EQ(colouring.occupants().size(), colouring.blocks() * kWidth);
    for (std::uint32_t k = 0; k < colouring.occupants().size(); ++k) {
        const std::uint32_t plan = colouring.occupants()[k];
        if (plan == kNullIndex) continue;
        EXPECT_EQ(places.at(plan), kNullIndex) << "plan " << plan << " stands twice";
        places.at(plan) = k;
    }
    EXPECT_EQ(std::ranges::count(places, kNullIndex), 0);
    return places;
}

/// Of a range that `of` threads share evenly, whose share a block is; `of`: nobody's.
std::size_t shareOf(std::uint32_t block, const Colouring& colouring, const Colouring::Range& range,
                    std::size_t of) {
    for (std::size_t share = 0; share < of; ++share) {
        const Colouring::Cut begin = colouring.cut(range, double(share) / double(of));
        const Colouring::Cut end = colouring.cut(range, double(share + 1) / double(of));
        for (std::uint32_t kind = 0; kind < Colouring::kKinds; ++kind)
            if (begin[kind] <= block && block < end[kind]) return share;
    }
    return of;
}

/// No two plans in the blocks [first, last) move the same body; returns how many there are.
std::size_t expectIndependent(const std::vector<PatchPlan>& plans, const Colouring& colouring,
                              std::uint32_t first, std::uint32_t last) {
    std::size_t found = 0;
    const std::vector<std::uint32_t> places = placesOf(colouring, plans.size());
    std::set<std::uint32_t> moved;
    for (std::size_t k = 0; k < plans.size(); ++k) {
        const std::uint32_t block = places[k] / kWidth;
        if (block < first || block >= last) continue;
        ++found;
        EXPECT_TRUE(!plans[k].movesA || moved.insert(plans[k].a).second) << "body " << plans[k].a;
        EXPECT_TRUE(!plans[k].movesB || moved.insert(plans[k].b).second) << "body " << plans[k].b;
    }
    return found;
}

/// Regions have all bodies, and blocks that move bodies of their own alone, at last those with walls.
std::size_t expectProperRegions(const std::vector<PatchPlan>& plans, const Colouring& colouring,
                                std::size_t bodies) {
    std::size_t found = 0;
    const std::vector<std::uint32_t> places = placesOf(colouring, plans.size());
    std::uint32_t nextBlock = colouring.regions().front().first, nextBody = 0;
    for (const Colouring::Region& region : colouring.regions()) {
        EXPECT_EQ(region.first, nextBlock);
        EXPECT_EQ(region.firstBody, nextBody);
        nextBlock = region.last, nextBody = region.lastBody;
        for (std::uint32_t block = region.first; block < region.last; ++block)
            found += expectIndependent(plans, colouring, block, block + 1);
        const auto has = [&](std::uint32_t body) {
            return region.firstBody <= body && body < region.lastBody;
        };
        std::uint32_t lastPair = 0, firstWall = kNullIndex;
        for (std::size_t k = 0; k < plans.size(); ++k) {
            const std::uint32_t block = places[k] / kWidth;
            if (block < region.first || block >= region.last) continue;
            EXPECT_TRUE((!plans[k].movesA || has(plans[k].a)) && (!plans[k].movesB || has(plans[k].b))) << k;
            if (plans[k].movesA && plans[k].movesB)
                lastPair = std::max(lastPair, block);
            else
                firstWall = std::min(firstWall, block);
        }
        EXPECT_LT(lastPair, firstWall) << "walls have the last word";
    }
    EXPECT_EQ(nextBody, bodies);
    EXPECT_EQ(nextBlock, colouring.blocks());
    return found;
}

/// Every plan has a lane of its own, and what may be done side by side moves no body twice.
void expectProper(const std::vector<PatchPlan>& plans, const Colouring& colouring, std::size_t bodies) {
    std::size_t found = expectProperRegions(plans, colouring, bodies);
    std::uint32_t next = 0;
    for (const Colouring::Range& range : colouring.ranges()) {
        EXPECT_EQ(range.first, next) << "ranges follow each other";
        next = range.last;
        for (std::size_t of = 1; of <= 6; ++of)
            for (std::uint32_t block = range.first; block < range.last; ++block)
                EXPECT_LT(shareOf(block, colouring, range, of), of) << "block " << block << " among " << of;
        found += expectIndependent(plans, colouring, range.first, range.last);
    }
    EXPECT_EQ(next, colouring.regions().front().first);
    EXPECT_EQ(found, plans.size());
}

/// A sheet of bodies on the ground, numbered row by row.
constexpr std::uint32_t kSide = 60;
std::vector<PatchPlan> sheetPlans(std::uint32_t side = kSide) {
    std::vector<PatchPlan> plans;
    const auto body = [side](std::uint32_t x, std::uint32_t y) { return 1 + y * side + x; };
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
            plans.push_back({0, body(x, y), false, true, 4});
            if (x + 1 < side) plans.push_back({body(x, y), body(x + 1, y), true, true, 2});
            if (y + 1 < side) plans.push_back({body(x, y), body(x, y + 1), true, true, 2});
        }
    return plans;
}

TEST(Colouring, NoTwoOfAColourMoveTheSameBody) {
    for (const std::size_t count : {0u, 1u, 7u, 8u, 9u, 500u, 3000u})
        for (unsigned seed = 0; seed < 4; ++seed) {
            const std::vector<PatchPlan> plans = randomPlans(count, 100 + count / 4, seed);
            expectProper(plans, coloured(plans, 100 + count / 4), 100 + count / 4);
        }
}

TEST(Colouring, PassesOverContactsWithoutPoints) {
    std::vector<PatchPlan> plans = randomPlans(2000, 500, 3), some;
    for (std::size_t k = 0; k < plans.size(); ++k)
        if (k % 3 == 0)
            plans[k].points = 0;
        else
            some.push_back(plans[k]);
    const Colouring all = coloured(plans, 500), without = coloured(some, 500);
    ASSERT_EQ(all.regions().size(), without.regions().size()) << "or they cannot be compared";
    ASSERT_EQ(all.blocks(), without.blocks());
    for (std::size_t k = 0; k < all.occupants().size(); ++k) {
        const std::uint32_t plan = without.occupants()[k];
        ASSERT_EQ(all.occupants()[k], plan == kNullIndex ? plan : plan / 2 * 3 + 1 + plan % 2) << k;
    }
}

TEST(Colouring, DoesNotDependOnThreads) {
    for (const auto& plans : {randomPlans(6000, 2000, 1), sheetPlans()})
        for (int repeat = 0; repeat < 20; ++repeat) {
            const Colouring one = coloured(plans, 4000), three = coloured(plans, 4000, 3);
            ASSERT_TRUE(std::ranges::equal(one.occupants(), three.occupants()));
            ASSERT_EQ(one.ranges().size(), three.ranges().size());
            for (std::size_t k = 0; k < one.ranges().size(); ++k)
                ASSERT_EQ(one.ranges()[k].last, three.ranges()[k].last);
            ASSERT_EQ(one.regions().size(), three.regions().size());
            for (std::size_t r = 0; r < one.regions().size(); ++r)
                ASSERT_EQ(one.regions()[r].firstBody, three.regions()[r].firstBody);
        }
}

TEST(Colouring, DoesNotDependOnWhatWasColouredBefore) {
    const std::vector<PatchPlan> sheet = sheetPlans(), mixed = randomPlans(700, 300, 5);
    Colouring again = coloured(sheet, kSide * kSide + 1);
    again.colour(mixed, 300, kWidth, Tasks(1));
    EXPECT_TRUE(std::ranges::equal(again.occupants(), coloured(mixed, 300).occupants()));
    again.colour(sheet, kSide * kSide + 1, kWidth, Tasks(2));
    EXPECT_TRUE(std::ranges::equal(again.occupants(), coloured(sheet, kSide * kSide + 1).occupants()));
    expectProper(sheet, again, kSide * kSide + 1);
}

/// However many regions there were before.
TEST(Colouring, DoesNotAllocateForWhatItHasHadBefore) {
    const std::vector<PatchPlan> sheet = sheetPlans(), mixed = randomPlans(6000, 2000, 2);
    Colouring colouring;
    const auto both = [&] {
        for (const auto& plans : {std::span(sheet), std::span(mixed)})
            colouring.colour(plans, kSide * kSide + 1, kWidth, Tasks::one());
    };
    both(), both();
    const long before = allocationCount();
    both();
    EXPECT_EQ(allocationCount() - before, 0);
}

TEST(Colouring, BodiesOfVeryManyContactsLeaveSomeOver) {
    // A plate that carries 150 balls and stands on 100 posts.
    std::vector<PatchPlan> plans;
    for (std::uint32_t i = 1; i <= 150; ++i) plans.push_back({0, i, true, true, 1});
    for (std::uint32_t i = 151; i <= 250; ++i) plans.push_back({0, i, true, false, 4});
    const Colouring colouring = coloured(plans, 300);
    expectProper(plans, colouring, 300);
    EXPECT_EQ(colouring.ranges().size(), 250u) << "nothing can be done side by side";
}

TEST(Colouring, IsDenseAndPutsWallsLast) {
    // A chain of 400 bodies on the ground: two colours of 200 and one of 400.
    std::vector<PatchPlan> plans;
    for (std::uint32_t i = 1; i < 400; ++i) plans.push_back({i, i + 1, true, true, 2});
    for (std::uint32_t i = 1; i <= 400; ++i) plans.push_back({0, i, false, true, 2});
    const Colouring colouring = coloured(plans, 401);
    expectProper(plans, colouring, 401);
    EXPECT_EQ(colouring.ranges().size(), 3u);
    EXPECT_EQ(colouring.blocks(), 25u + 25u + 50u);
    EXPECT_GE(placesOf(colouring, plans.size()).back() / kWidth, 50u);
}

/// Threads would have little of their own, or one would have everything: regions are left out.
TEST(Colouring, FewContactsAndThoseBetweenAllBodiesHaveNoRegions) {
    const std::vector<PatchPlan> few = sheetPlans(), mixed = randomPlans(6000, 2000, 2);
    const std::vector<PatchPlan> start(few.begin(), few.begin() + 1000);
    for (const auto& plans : {start, mixed}) {
        const Colouring colouring = coloured(plans, kSide * kSide + 1);
        expectProper(plans, colouring, kSide * kSide + 1);
        EXPECT_EQ(colouring.regions().size(), 1u);
        EXPECT_EQ(colouring.ranges().back().last, colouring.blocks()) << "all contacts are shared";
    }
}

/// 3600 bodies in a sheet of 10 680 contacts: sixteen regions of as much work, a row of bonds between two.
TEST(Colouring, RegionsHaveAsMuchWorkAndFewContactsAcross) {
    const std::vector<PatchPlan> plans = sheetPlans();
    const Colouring colouring = coloured(plans, kSide * kSide + 1);
    expectProper(plans, colouring, kSide * kSide + 1);
    ASSERT_EQ(colouring.regions().size(), 16u);
    const std::vector<std::uint32_t> places = placesOf(colouring, plans.size());
    std::vector<double> inside(16, 0);
    double across = 0;
    for (std::size_t k = 0; k < plans.size(); ++k) {
        if (!plans[k].movesA) continue;
        const std::uint32_t block = places[k] / kWidth;
        std::size_t r = 0;
        while (block >= colouring.regions()[r].last) ++r;
        block >= colouring.regions()[r].first ? ++inside[r] : ++across;
    }
    for (const double contacts : inside)
        EXPECT_NEAR(contacts, 2.0 * kSide * kSide / 16 - kSide, 0.1 * contacts);
    EXPECT_LE(across, 15 * (kSide + 1));
    // Blocks are filled but for the last ones of colours.
    EXPECT_LE(colouring.blocks(), double(plans.size()) / kWidth * 1.08);
}

/// What two (or three, or four) threads move in all colours is about a half of it each, and few bodies at the
/// seam are moved by two.
TEST(Colouring, SharesOfAllColoursMoveTheSameBodies) {
    constexpr std::uint32_t kFew = 18;
    const std::vector<PatchPlan> plans = sheetPlans(kFew);
    const Colouring colouring = coloured(plans, kFew * kFew + 1);
    ASSERT_EQ(colouring.regions().size(), 1u);
    const std::vector<std::uint32_t> places = placesOf(colouring, plans.size());
    for (std::size_t of = 2; of <= 4; ++of) {
        std::vector<std::size_t> work(of, 0);
        std::vector<std::set<std::uint32_t>> moved(of);
        std::size_t shared = 0;
        for (std::size_t k = 0; k < plans.size(); ++k)
            for (const Colouring::Range& range : colouring.ranges())
                if (const std::size_t share = shareOf(places[k] / kWidth, colouring, range, of); share < of) {
                    ++work[share], ++shared;
                    if (plans[k].movesA) moved[share].insert(plans[k].a);
                    if (plans[k].movesB) moved[share].insert(plans[k].b);
                }
        std::size_t all = 0;
        for (std::size_t share = 0; share < of; ++share) {
            all += moved[share].size();
            EXPECT_NEAR(double(work[share]), double(shared) / double(of), 0.1 * double(shared));
        }
        // A row of bodies at each seam, and blocks that the seam goes through. Cuts of each colour by itself
        // (one in the middle of the ground's, another of the bonds') would lie rows apart.
        EXPECT_LE(all, kFew * kFew + (of - 1) * 4 * kFew) << of << " threads";
    }
}

/// A pyramid's ground contacts are all of bodies of the first slices: threads share them all the same.
TEST(Colouring, NoShareOfAColourIsMuchLargerThanAnother) {
    std::vector<PatchPlan> plans;
    for (std::uint32_t i = 1; i <= 160; ++i) plans.push_back({0, i, false, true, 4});
    for (std::uint32_t i = 1; i < 1600; i += 2) plans.push_back({i, i + 1, true, true, 2});
    const Colouring colouring = coloured(plans, 1601);
    expectProper(plans, colouring, 1601);
    ASSERT_GE(colouring.ranges().size(), 1u);
    const Colouring::Range& ground = colouring.ranges().back();
    std::vector<double> blocks(2, 0);
    for (std::uint32_t block = ground.first; block < ground.last; ++block)
        ++blocks[shareOf(block, colouring, ground, 2)];
    const double all = ground.last - ground.first;
    EXPECT_NEAR(blocks[0], all / 2, all / 16 + 1) << "of " << all;
}

TEST(Colouring, PutsPatchesOfAsManyPointsTogether) {
    // 64 pairs that share no body: one colour, the patches of four points in the first blocks.
    std::vector<PatchPlan> plans;
    for (std::uint32_t i = 0; i < 64; ++i)
        plans.push_back({2 * i, 2 * i + 1, true, true, static_cast<std::uint8_t>(1 + i % 4)});
    const Colouring colouring = coloured(plans, 128);
    expectProper(plans, colouring, 128);
    const std::vector<std::uint32_t> places = placesOf(colouring, plans.size());
    for (std::uint32_t i = 0; i < 64; ++i)
        EXPECT_EQ(places[i] / 16, 4u - plans[i].points) << "16 of each kind";
}

}  // namespace
}  // namespace rigor::engine::test
