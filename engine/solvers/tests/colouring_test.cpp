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

/// Contacts of random bodies; every fifth body is static.
std::vector<PatchDescriptor> randomDescriptors(std::size_t count, std::uint32_t bodies, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<PatchDescriptor> descriptors;
    while (descriptors.size() < count) {
        const std::uint32_t a = random() % bodies, b = random() % bodies;
        if (a == b || (a % 5 == 0 && b % 5 == 0)) continue;
        descriptors.push_back({std::min(a, b), std::max(a, b), std::min(a, b) % 5 != 0,
                               std::max(a, b) % 5 != 0, static_cast<std::uint8_t>(1 + random() % 4)});
    }
    return descriptors;
}

Colouring coloured(const std::vector<PatchDescriptor>& descriptors, std::size_t bodies, int threads = 1) {
    Colouring colouring;
    colouring.colour(descriptors, bodies, kWidth, Tasks(threads));
    return colouring;
}

/// Lane of each descriptor, as block * lanes + lane; each must have exactly one.
std::vector<std::uint32_t> placesOf(const Colouring& colouring, std::size_t descriptors) {
    std::vector<std::uint32_t> places(descriptors, kNullIndex);
    EXPECT_EQ(colouring.laneContents().size(), colouring.blocks() * kWidth);
    for (std::uint32_t k = 0; k < colouring.laneContents().size(); ++k) {
        const std::uint32_t descriptor = colouring.laneContents()[k];
        if (descriptor == kNullIndex) continue;
        EXPECT_EQ(places.at(descriptor), kNullIndex) << "descriptor " << descriptor << " has two lanes";
        places.at(descriptor) = k;
    }
    EXPECT_EQ(std::ranges::count(places, kNullIndex), 0);
    return places;
}

/// Thread of a block in a range split evenly among `of` threads; `of`: no thread has it.
std::size_t chunkOf(std::uint32_t block, const Colouring& colouring, const Colouring::Range& range,
                    std::size_t of) {
    for (std::size_t chunk = 0; chunk < of; ++chunk) {
        const Colouring::Split begin = colouring.split(range, double(chunk) / double(of));
        const Colouring::Split end = colouring.split(range, double(chunk + 1) / double(of));
        for (std::uint32_t sizeClass = 0; sizeClass < Colouring::kSizeClasses; ++sizeClass)
            if (begin[sizeClass] <= block && block < end[sizeClass]) return chunk;
    }
    return of;
}

/// Expects that no two contacts in the blocks [first, last) move the same body; returns their number.
std::size_t expectIndependent(const std::vector<PatchDescriptor>& descriptors, const Colouring& colouring,
                              std::uint32_t first, std::uint32_t last) {
    std::size_t found = 0;
    const std::vector<std::uint32_t> places = placesOf(colouring, descriptors.size());
    std::set<std::uint32_t> moved;
    for (std::size_t k = 0; k < descriptors.size(); ++k) {
        const std::uint32_t block = places[k] / kWidth;
        if (block < first || block >= last) continue;
        ++found;
        EXPECT_TRUE(!descriptors[k].movesA || moved.insert(descriptors[k].a).second)
            << "body " << descriptors[k].a;
        EXPECT_TRUE(!descriptors[k].movesB || moved.insert(descriptors[k].b).second)
            << "body " << descriptors[k].b;
    }
    return found;
}

/// Expects that partitions cover all bodies and that their blocks move only their own bodies, static contacts
/// last.
std::size_t expectProperPartitions(const std::vector<PatchDescriptor>& descriptors,
                                   const Colouring& colouring, std::size_t bodies) {
    std::size_t found = 0;
    const std::vector<std::uint32_t> places = placesOf(colouring, descriptors.size());
    std::uint32_t nextBlock = colouring.partitions().front().first, nextBody = 0;
    for (const Colouring::Partition& partition : colouring.partitions()) {
        EXPECT_EQ(partition.first, nextBlock);
        EXPECT_EQ(partition.firstBody, nextBody);
        nextBlock = partition.last;
        nextBody = partition.lastBody;
        for (std::uint32_t block = partition.first; block < partition.last; ++block)
            found += expectIndependent(descriptors, colouring, block, block + 1);
        const auto has = [&](std::uint32_t body) {
            return partition.firstBody <= body && body < partition.lastBody;
        };
        std::uint32_t lastPair = 0, firstStatic = kNullIndex;
        for (std::size_t k = 0; k < descriptors.size(); ++k) {
            const std::uint32_t block = places[k] / kWidth;
            if (block < partition.first || block >= partition.last) continue;
            EXPECT_TRUE((!descriptors[k].movesA || has(descriptors[k].a)) &&
                        (!descriptors[k].movesB || has(descriptors[k].b)))
                << k;
            if (descriptors[k].movesA && descriptors[k].movesB)
                lastPair = std::max(lastPair, block);
            else
                firstStatic = std::min(firstStatic, block);
        }
        EXPECT_LT(lastPair, firstStatic) << "static contacts come last";
    }
    EXPECT_EQ(nextBody, bodies);
    EXPECT_EQ(nextBlock, colouring.blocks());
    return found;
}

/// Every contact has a lane of its own, and blocks that may run in parallel move no body twice.
void expectProper(const std::vector<PatchDescriptor>& descriptors, const Colouring& colouring,
                  std::size_t bodies) {
    std::size_t found = expectProperPartitions(descriptors, colouring, bodies);
    std::uint32_t next = 0;
    for (const Colouring::Range& range : colouring.ranges()) {
        EXPECT_EQ(range.first, next) << "ranges follow each other";
        next = range.last;
        for (std::size_t of = 1; of <= 6; ++of)
            for (std::uint32_t block = range.first; block < range.last; ++block)
                EXPECT_LT(chunkOf(block, colouring, range, of), of) << "block " << block << " among " << of;
        found += expectIndependent(descriptors, colouring, range.first, range.last);
    }
    EXPECT_EQ(next, colouring.partitions().front().first);
    EXPECT_EQ(found, descriptors.size());
}

/// A sheet of bodies on the ground, numbered row by row.
constexpr std::uint32_t kSide = 60;
std::vector<PatchDescriptor> sheetDescriptors(std::uint32_t side = kSide) {
    std::vector<PatchDescriptor> descriptors;
    const auto body = [side](std::uint32_t x, std::uint32_t y) { return 1 + y * side + x; };
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
            descriptors.push_back({0, body(x, y), false, true, 4});
            if (x + 1 < side) descriptors.push_back({body(x, y), body(x + 1, y), true, true, 2});
            if (y + 1 < side) descriptors.push_back({body(x, y), body(x, y + 1), true, true, 2});
        }
    return descriptors;
}

TEST(Colouring, NoTwoOfAColourMoveTheSameBody) {
    for (const std::size_t count : {0u, 1u, 7u, 8u, 9u, 500u, 3000u})
        for (unsigned seed = 0; seed < 4; ++seed) {
            const std::vector<PatchDescriptor> descriptors = randomDescriptors(count, 100 + count / 4, seed);
            expectProper(descriptors, coloured(descriptors, 100 + count / 4), 100 + count / 4);
        }
}

TEST(Colouring, PassesOverContactsWithoutPoints) {
    std::vector<PatchDescriptor> descriptors = randomDescriptors(2000, 500, 3), some;
    for (std::size_t k = 0; k < descriptors.size(); ++k)
        if (k % 3 == 0)
            descriptors[k].points = 0;
        else
            some.push_back(descriptors[k]);
    const Colouring all = coloured(descriptors, 500), without = coloured(some, 500);
    ASSERT_EQ(all.partitions().size(), without.partitions().size()) << "or they cannot be compared";
    ASSERT_EQ(all.blocks(), without.blocks());
    for (std::size_t k = 0; k < all.laneContents().size(); ++k) {
        const std::uint32_t descriptor = without.laneContents()[k];
        ASSERT_EQ(all.laneContents()[k],
                  descriptor == kNullIndex ? descriptor : descriptor / 2 * 3 + 1 + descriptor % 2)
            << k;
    }
}

TEST(Colouring, DoesNotDependOnThreads) {
    for (const auto& descriptors : {randomDescriptors(6000, 2000, 1), sheetDescriptors()})
        for (int repeat = 0; repeat < 20; ++repeat) {
            const Colouring one = coloured(descriptors, 4000), three = coloured(descriptors, 4000, 3);
            ASSERT_TRUE(std::ranges::equal(one.laneContents(), three.laneContents()));
            ASSERT_EQ(one.ranges().size(), three.ranges().size());
            for (std::size_t k = 0; k < one.ranges().size(); ++k)
                ASSERT_EQ(one.ranges()[k].last, three.ranges()[k].last);
            ASSERT_EQ(one.partitions().size(), three.partitions().size());
            for (std::size_t r = 0; r < one.partitions().size(); ++r)
                ASSERT_EQ(one.partitions()[r].firstBody, three.partitions()[r].firstBody);
        }
}

TEST(Colouring, DoesNotDependOnWhatWasColouredBefore) {
    const std::vector<PatchDescriptor> sheet = sheetDescriptors(), mixed = randomDescriptors(700, 300, 5);
    Colouring again = coloured(sheet, kSide * kSide + 1);
    again.colour(mixed, 300, kWidth, Tasks(1));
    EXPECT_TRUE(std::ranges::equal(again.laneContents(), coloured(mixed, 300).laneContents()));
    again.colour(sheet, kSide * kSide + 1, kWidth, Tasks(2));
    EXPECT_TRUE(std::ranges::equal(again.laneContents(), coloured(sheet, kSide * kSide + 1).laneContents()));
    expectProper(sheet, again, kSide * kSide + 1);
}

/// However many partitions there were before.
TEST(Colouring, DoesNotAllocateForWhatItHasHadBefore) {
    const std::vector<PatchDescriptor> sheet = sheetDescriptors(), mixed = randomDescriptors(6000, 2000, 2);
    Colouring colouring;
    const auto both = [&] {
        for (const auto& descriptors : {std::span(sheet), std::span(mixed)})
            colouring.colour(descriptors, kSide * kSide + 1, kWidth, Tasks::one());
    };
    both();
    both();
    const long before = allocationCount();
    both();
    EXPECT_EQ(allocationCount() - before, 0);
}

TEST(Colouring, BodiesOfVeryManyContactsHaveOverflow) {
    // A plate that carries 150 spheres and stands on 100 posts.
    std::vector<PatchDescriptor> descriptors;
    for (std::uint32_t i = 1; i <= 150; ++i) descriptors.push_back({0, i, true, true, 1});
    for (std::uint32_t i = 151; i <= 250; ++i) descriptors.push_back({0, i, true, false, 4});
    const Colouring colouring = coloured(descriptors, 300);
    expectProper(descriptors, colouring, 300);
    EXPECT_EQ(colouring.ranges().size(), 250u) << "nothing can be done side by side";
}

TEST(Colouring, IsDenseAndPutsStaticContactsLast) {
    // A chain of 400 bodies on the ground: two colours of 200 and one of 400.
    std::vector<PatchDescriptor> descriptors;
    for (std::uint32_t i = 1; i < 400; ++i) descriptors.push_back({i, i + 1, true, true, 2});
    for (std::uint32_t i = 1; i <= 400; ++i) descriptors.push_back({0, i, false, true, 2});
    const Colouring colouring = coloured(descriptors, 401);
    expectProper(descriptors, colouring, 401);
    EXPECT_EQ(colouring.ranges().size(), 3u);
    EXPECT_EQ(colouring.blocks(), 25u + 25u + 50u);
    EXPECT_GE(placesOf(colouring, descriptors.size()).back() / kWidth, 50u);
}

/// Partitions would be small, or one would have nearly everything: there is a single one.
TEST(Colouring, FewContactsAndThoseBetweenAllBodiesHaveOnePartition) {
    const std::vector<PatchDescriptor> few = sheetDescriptors(), mixed = randomDescriptors(6000, 2000, 2);
    const std::vector<PatchDescriptor> start(few.begin(), few.begin() + 1000);
    for (const auto& descriptors : {start, mixed}) {
        const Colouring colouring = coloured(descriptors, kSide * kSide + 1);
        expectProper(descriptors, colouring, kSide * kSide + 1);
        EXPECT_EQ(colouring.partitions().size(), 1u);
        EXPECT_EQ(colouring.ranges().back().last, colouring.blocks()) << "all contacts are in ranges";
    }
}

/// 3600 bodies in a sheet of 10 680 contacts: sixteen partitions of equal work, a row of pairs between
/// two.
TEST(Colouring, PartitionsHaveEqualWorkAndFewCutContacts) {
    const std::vector<PatchDescriptor> descriptors = sheetDescriptors();
    const Colouring colouring = coloured(descriptors, kSide * kSide + 1);
    expectProper(descriptors, colouring, kSide * kSide + 1);
    ASSERT_EQ(colouring.partitions().size(), 16u);
    const std::vector<std::uint32_t> places = placesOf(colouring, descriptors.size());
    std::vector<double> inside(16, 0);
    double cut = 0;
    for (std::size_t k = 0; k < descriptors.size(); ++k) {
        if (!descriptors[k].movesA) continue;
        const std::uint32_t block = places[k] / kWidth;
        std::size_t r = 0;
        while (block >= colouring.partitions()[r].last) ++r;
        block >= colouring.partitions()[r].first ? ++inside[r] : ++cut;
    }
    for (const double contacts : inside)
        EXPECT_NEAR(contacts, 2.0 * kSide * kSide / 16 - kSide, 0.1 * contacts);
    EXPECT_LE(cut, 15 * (kSide + 1));
    // Blocks are filled but for the last ones of colours.
    EXPECT_LE(colouring.blocks(), double(descriptors.size()) / kWidth * 1.08);
}

/// The chunks of two (or three, or four) threads in all colours are about equal, and few bodies at the
/// borders are moved by two threads.
TEST(Colouring, ChunksOfAllColoursMoveTheSameBodies) {
    constexpr std::uint32_t kFew = 18;
    const std::vector<PatchDescriptor> descriptors = sheetDescriptors(kFew);
    const Colouring colouring = coloured(descriptors, kFew * kFew + 1);
    ASSERT_EQ(colouring.partitions().size(), 1u);
    const std::vector<std::uint32_t> places = placesOf(colouring, descriptors.size());
    for (std::size_t of = 2; of <= 4; ++of) {
        std::vector<std::size_t> work(of, 0);
        std::vector<std::set<std::uint32_t>> moved(of);
        std::size_t shared = 0;
        for (std::size_t k = 0; k < descriptors.size(); ++k)
            for (const Colouring::Range& range : colouring.ranges())
                if (const std::size_t chunk = chunkOf(places[k] / kWidth, colouring, range, of); chunk < of) {
                    ++work[chunk];
                    ++shared;
                    if (descriptors[k].movesA) moved[chunk].insert(descriptors[k].a);
                    if (descriptors[k].movesB) moved[chunk].insert(descriptors[k].b);
                }
        std::size_t all = 0;
        for (std::size_t chunk = 0; chunk < of; ++chunk) {
            all += moved[chunk].size();
            EXPECT_NEAR(double(work[chunk]), double(shared) / double(of), 0.1 * double(shared));
        }
        // A row of bodies at each border, and blocks that the border goes through. Splits of each colour by
        // itself (one in the middle of the ground's, another of the pairs') would be rows apart.
        EXPECT_LE(all, kFew * kFew + (of - 1) * 4 * kFew) << of << " threads";
    }
}

/// A pyramid's ground contacts are all of bodies of the first intervals: threads split them evenly all the
/// same.
TEST(Colouring, NoChunkOfAColourIsMuchLargerThanAnother) {
    std::vector<PatchDescriptor> descriptors;
    for (std::uint32_t i = 1; i <= 160; ++i) descriptors.push_back({0, i, false, true, 4});
    for (std::uint32_t i = 1; i < 1600; i += 2) descriptors.push_back({i, i + 1, true, true, 2});
    const Colouring colouring = coloured(descriptors, 1601);
    expectProper(descriptors, colouring, 1601);
    ASSERT_GE(colouring.ranges().size(), 1u);
    const Colouring::Range& ground = colouring.ranges().back();
    std::vector<double> blocks(2, 0);
    for (std::uint32_t block = ground.first; block < ground.last; ++block)
        ++blocks[chunkOf(block, colouring, ground, 2)];
    const double all = ground.last - ground.first;
    EXPECT_NEAR(blocks[0], all / 2, all / 16 + 1) << "of " << all;
}

TEST(Colouring, PutsPatchesOfAsManyPointsTogether) {
    // 64 pairs that share no body: one colour, the patches of four points in the first blocks.
    std::vector<PatchDescriptor> descriptors;
    for (std::uint32_t i = 0; i < 64; ++i)
        descriptors.push_back({2 * i, 2 * i + 1, true, true, static_cast<std::uint8_t>(1 + i % 4)});
    const Colouring colouring = coloured(descriptors, 128);
    expectProper(descriptors, colouring, 128);
    const std::vector<std::uint32_t> places = placesOf(colouring, descriptors.size());
    for (std::uint32_t i = 0; i < 64; ++i)
        EXPECT_EQ(places[i] / 16, 4u - descriptors[i].points) << "16 of each size class";
}

}  // namespace
}  // namespace rigor::engine::test
