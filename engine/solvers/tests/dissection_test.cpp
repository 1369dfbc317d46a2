// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Dissection of joints: every joint once, what is cut off last, and as few products in nets as their theory
// promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "engine/solvers/joints/dissection.hpp"
#include "engine/solvers/joints/elimination.hpp"

namespace rigor::engine {
namespace {

using Nodes = std::vector<std::uint32_t>;
using Joints = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// side x side bodies, each joined to its neighbours, the first row to the world.
Joints netOf(std::uint32_t side) {
    Joints joints;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        joints.push_back({i < side ? kNullIndex : i - side, i});
        if (i % side > 0) joints.push_back({i - 1, i});
    }
    return joints;
}

std::vector<Nodes> neighboursOf(const Joints& joints) {
    std::vector<Nodes> near(joints.size());
    for (std::uint32_t i = 0; i < joints.size(); ++i)
        for (std::uint32_t j = 0; j < joints.size(); ++j) {
            const auto shares = [&](std::uint32_t body) {
                return body != kNullIndex && (body == joints[j].first || body == joints[j].second);
            };
            if (i != j && (shares(joints[i].first) || shares(joints[i].second))) near[i].push_back(j);
        }
    return near;
}

void expectPermutation(Nodes order, std::size_t n) {
    std::sort(order.begin(), order.end());
    Nodes all(n);
    std::iota(all.begin(), all.end(), 0u);
    EXPECT_EQ(order, all);
}

TEST(Dissections, EveryJointIsOrderedOnce) {
    std::mt19937 random(4);
    for (int round = 0; round < 50; ++round) {
        const std::uint32_t bodies = 1 + random() % 60;
        Joints joints;
        for (std::uint32_t k = random() % 150; k > 0; --k) {
            const auto end = [&] {
                return random() % 10 == 0 ? kNullIndex : std::uint32_t(random() % bodies);
            };
            joints.push_back({end(), end()});  // includes the same body twice and no body
        }
        expectPermutation(dissectJoints(joints, bodies), joints.size());
    }
    EXPECT_TRUE(dissectJoints({}, 0).empty());
}

/// The halves of a net hang together by the last joints alone, one row or column of them.
TEST(Dissections, TheLastJointsAreAllThatHoldsTwoHalvesTogether) {
    constexpr std::uint32_t side = 16;
    Joints joints = netOf(side);
    std::shuffle(joints.begin(), joints.end(), std::mt19937(9));
    const Nodes order = dissectJoints(joints, side * side);
    expectPermutation(order, joints.size());
    Nodes set(side * side);  // connected bodies
    std::iota(set.begin(), set.end(), 0u);
    const auto root = [&](std::uint32_t i) {
        while (set[i] != i) i = set[i];
        return i;
    };
    for (std::size_t k = 0; k + side < order.size(); ++k)
        if (const auto [a, b] = joints[order[k]]; a != kNullIndex) set[root(a)] = root(b);
    std::vector<std::size_t> sizes(side * side, 0);
    for (std::uint32_t i = 0; i < side * side; ++i) ++sizes[root(i)];
    std::sort(sizes.rbegin(), sizes.rend());
    EXPECT_EQ(sizes[0], side * side / 2);
    EXPECT_EQ(sizes[1], side * side / 2);
}

/// A net of n joints has O(n log n) entries and O(n^1.5) products [George1973].
TEST(Dissections, NetsHaveFewProducts) {
    for (const std::uint32_t side : {10u, 20u, 30u}) {
        const Joints joints = netOf(side);
        Elimination found, degree;
        const auto near = neighboursOf(joints);
        ASSERT_TRUE(findElimination(near, dissectJoints(joints, side * side), 1u << 20, found));
        ASSERT_TRUE(findElimination(near, 1u << 20, degree));
        const double n = double(joints.size());
        EXPECT_LT(double(found.row.size()), 1.3 * n * std::log2(n)) << side;
        EXPECT_LT(double(found.products()), 4 * std::pow(n, 1.5)) << side;
        EXPECT_LT(found.products(), degree.products()) << side;
    }
}

}  // namespace
}  // namespace rigor::engine
