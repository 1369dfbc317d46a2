// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <gtest/gtest.h>

#include <vector>

#include "engine/core/hash.hpp"
#include "engine/core/ids.hpp"

namespace rigor::engine {
namespace {

TEST(IdTable, SlotsAreReusedButNeverTheHandle) {
    IdTable<BodyTag> table;
    const BodyId a = table.add(10), b = table.add(11);
    EXPECT_TRUE(a) << "index 0 is null";
    EXPECT_FALSE(table.contains(BodyId{}));
    table.remove(a);
    EXPECT_FALSE(table.contains(a));
    const BodyId c = table.add(12);
    EXPECT_EQ(c.index, a.index);
    EXPECT_NE(c.generation, a.generation);
    EXPECT_EQ(table.dense(b), 11u);
    EXPECT_EQ(table.dense(c), 12u);
    table.move(b, 3);
    EXPECT_EQ(table.dense(b), 3u);
    EXPECT_DEATH(table.dense(a), "stale");
    EXPECT_DEATH(table.remove(a), "stale");
}

TEST(IdTable, CopiesGiveOutTheSameHandles) {
    IdTable<BodyTag> table;
    std::vector<BodyId> ids;
    for (std::uint32_t i = 0; i < 20; ++i) ids.push_back(table.add(i));
    for (const std::size_t i : {3u, 17u, 5u}) table.remove(ids[i]);
    IdTable<BodyTag> copy = table;
    for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(table.add(i), copy.add(i));
}

TEST(Hasher, IsFnv1a) {
    Hasher hash;
    EXPECT_EQ(hash.value(), 0xcbf29ce484222325ull);
    hash.bytes("a", 1);
    EXPECT_EQ(hash.value(), 0xaf63dc4c8601ec8cull);  // published test vector
    hash.bytes("b", 1);
    EXPECT_NE(hash.value(), 0xaf63dc4c8601ec8cull);
}

}  // namespace
}  // namespace rigor::engine
