// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/core/large_vector.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

namespace rigor::engine {
namespace {

struct alignas(64) Line {
    double value = 0;
};

TEST(LargeVector, IsAlignedToLargePagesWhereItIsLarge) {
    constexpr std::size_t kPage = std::size_t(2) << 20;
    for (const std::size_t bytes :
         {std::size_t(64), std::size_t(4096), kPage / 2, kPage - 64, kPage, kPage + 64, 3 * kPage - 64}) {
        const LargeVector<Line> items(bytes / sizeof(Line));
        const auto address = reinterpret_cast<std::uintptr_t>(items.data());
        EXPECT_EQ(address % (bytes < kPage / 2 ? alignof(Line) : kPage), 0u) << bytes;
    }
}

TEST(LargeVector, KeepsItsItemsWhileItGrows) {
    LargeVector<std::uint32_t> items;
    constexpr std::uint32_t kItems = 1u << 20;
    for (std::uint32_t k = 0; k < kItems; ++k) items.push_back(k);
    for (std::uint32_t k = 0; k < kItems; ++k) ASSERT_EQ(items[k], k);
}

TEST(LargeVector, GrowsByFactorsWhateverIsReserved) {
    LargeVector<int> items;
    std::size_t moves = 0;
    for (std::size_t n = 1; n <= 100000; ++n) {
        const std::size_t before = items.capacity();
        reserveToGrow(items, n);
        moves += items.capacity() != before;
        ASSERT_GE(items.capacity(), n);
    }
    EXPECT_LE(moves, 18u);
}

TEST(LargeScratch, HasRoomForWhatWasRequired) {
    LargeScratch<Line> scratch;
    for (const std::size_t n : {std::size_t(3), std::size_t(100000), std::size_t(10)}) {
        scratch.require(n);
        for (std::size_t k = 0; k < n; ++k) scratch.put(k, {double(k)});
        for (std::size_t k = 0; k < n; ++k) ASSERT_EQ(scratch[k].value, double(k));
    }
    const LargeScratch<Line> copy = scratch;
    LargeScratch<Line> moved = std::move(scratch);
    EXPECT_EQ(moved[9].value, 9);
    moved = copy;
    moved.require(1);
    moved.put(0, {5});
    EXPECT_EQ(moved[0].value, 5);
}

}  // namespace
}  // namespace rigor::engine
