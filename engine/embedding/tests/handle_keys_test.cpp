// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/embedding/handle_keys.hpp"

#include <gtest/gtest.h>

#include <map>
#include <unordered_map>

namespace rigor::engine::test {
namespace {

TEST(HandleKeys, EachHandleHasItsOwnEntry) {
    std::map<BodyId, std::uint32_t> ordered;
    std::unordered_map<ShapeId, std::uint32_t> hashed;
    for (std::uint32_t index = 1; index <= 100; ++index)
        for (const std::uint32_t generation : {0u, 1u}) {
            ordered[{index, generation}] = 2 * index + generation;
            hashed[{index, generation}] = 2 * index + generation;
        }
    EXPECT_EQ(ordered.size(), 200u);
    EXPECT_EQ(hashed.size(), 200u);
    EXPECT_EQ(ordered.at({7, 1}), 15u);
    EXPECT_EQ(hashed.at({7, 1}), 15u);
    EXPECT_LT((BodyId{7, 1}), (BodyId{8, 0}));
    EXPECT_LT((BodyId{7, 0}), (BodyId{7, 1}));
}

/// A body that takes the place of a removed one is not found by the old handle.
TEST(HandleKeys, AnEntryIsNotFoundForWhatTookItsPlace) {
    IdTable<BodyTag> table;
    std::unordered_map<BodyId, int> kept;
    const BodyId gone = table.add(0);
    kept[gone] = 1;
    table.remove(gone);
    const BodyId newer = table.add(0);
    ASSERT_EQ(newer.index, gone.index);
    EXPECT_FALSE(kept.contains(newer));
    EXPECT_TRUE(kept.contains(gone));
}

}  // namespace
}  // namespace rigor::engine::test
