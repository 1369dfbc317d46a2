// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/joint_loops.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "engine/math/space.hpp"

namespace rigor::engine {
namespace {

/// Joints that close a loop among joints between pairs of bodies 0 to 9, of which 0 and 1 are moved by no impulse.
std::vector<std::size_t> closing(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs,
                                 BlockKind kind = BlockKind::Joint) {
    std::vector<Block<Space3d>> blocks;
    for (const auto& [a, b] : pairs) {
        Block<Space3d> block;
        block.kind = kind;
        block.a = a;
        block.b = b;
        block.invMassA = a < 2 ? 0 : 1;
        block.invMassB = b < 2 ? 0 : 1;
        blocks.push_back(block);
    }
    std::vector<std::size_t> closes;
    JointLoops().find<Space3d>(blocks, 10, [&](std::size_t k) { closes.push_back(k); });
    return closes;
}

TEST(JointLoops, TreesHaveNone) {
    EXPECT_TRUE(closing({}).empty());
    EXPECT_TRUE(closing({{0, 2}, {2, 3}, {3, 4}, {2, 5}, {0, 6}, {7, 8}}).empty());
}

TEST(JointLoops, TheLastJointOfALoopClosesIt) {
    EXPECT_EQ(closing({{2, 3}, {3, 4}, {4, 2}}), std::vector<std::size_t>{2});
    EXPECT_EQ(closing({{4, 2}, {5, 6}, {2, 3}, {3, 4}, {2, 3}}), (std::vector<std::size_t>{3, 4}));
}

TEST(JointLoops, BodiesThatNoImpulseMovesAreOneGround) {
    EXPECT_EQ(closing({{0, 2}, {2, 3}, {3, 1}}), std::vector<std::size_t>{2});
}

TEST(JointLoops, ContactsCloseNone) {
    EXPECT_TRUE(closing({{2, 3}, {3, 4}, {4, 2}}, BlockKind::Contact).empty());
}

}  // namespace
}  // namespace rigor::engine
