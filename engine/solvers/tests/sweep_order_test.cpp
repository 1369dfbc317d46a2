// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Parallel sweeps: units that share a body keep their order, those of a level share none.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/solvers/sweep_order.hpp"

namespace rigor::engine::test {
namespace {

using S = Space3d;

std::vector<Block<S>> randomUnits(unsigned seed, std::size_t units, std::uint32_t bodies) {
    std::mt19937 random(seed);
    std::vector<Block<S>> blocks(units);
    for (Block<S>& block : blocks) {
        block.a = static_cast<std::uint32_t>(random() % bodies);
        block.b = static_cast<std::uint32_t>(random() % bodies);
        // Body 0 is a wall, and so are some others.
        block.invMassA = block.a % 7 == 0 ? 0 : 1;
        block.invMassB = block.b % 7 == 0 ? 0 : 1;
    }
    return blocks;
}

/// A product that does not commute: the blocks that have acted on each body, in order.
struct Visited {
    std::vector<std::uint64_t> bodies;
    std::uint64_t add(const Block<S>& block, std::uint64_t unit) {
        std::uint64_t sum = 0;
        for (const auto& [body, moved] :
             {std::pair(block.a, block.invMassA > 0), {block.b, block.invMassB > 0}})
            if (moved) sum += bodies[body] = bodies[body] * 6364136223846793005ull + unit + 1;
        return sum;
    }
};

TEST(SweepOrder, SharedSweepsAreTheSweepForwardsAndBackwards) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const std::uint32_t bodies = 5 + 40 * seed;
        const std::vector<Block<S>> blocks = randomUnits(seed, 60 * seed, bodies);
        for (const bool backwards : {false, true}) {
            std::vector<std::uint64_t> expected;
            double expectedMost = 0;
            for (const int threads : {1, 2, 4}) {
                const Tasks tasks(threads);
                SweepOrder order;
                order.begin(tasks, bodies, 4);
                for (const Block<S>& block : blocks) order.add<S>({&block, 1});
                order.finish();
                ASSERT_EQ(order.units(), blocks.size());
                Visited visited{std::vector<std::uint64_t>(bodies, 0)};
                double most = 0;
                for (int i = 0; i < 3; ++i)
                    most = order.largest<double>(backwards, [&](std::size_t k) {
                        return static_cast<double>(visited.add(blocks[k], k) % 1000003);
                    });
                if (threads == 1) {
                    expected = visited.bodies;
                    expectedMost = most;
                }
                EXPECT_EQ(visited.bodies, expected) << seed << " " << threads;
                EXPECT_EQ(most, expectedMost);
            }
        }
    }
}

TEST(SweepOrder, LevelsAreAsManyAsTheLongestChain) {
    const Tasks tasks(2);
    SweepOrder order;
    std::vector<Block<S>> blocks(100);
    for (const bool chained : {false, true}) {
        order.begin(tasks, 300, 4);
        for (std::uint32_t k = 0; k < 100; ++k) {
            blocks[k].a = chained ? k : 2 * k + 1;
            blocks[k].b = chained ? k + 1 : 2 * k + 2;
            blocks[k].invMassA = blocks[k].invMassB = 1;
            order.add<S>({&blocks[k], 1});
        }
        order.finish();
        EXPECT_EQ(order.levels(), chained ? 100u : 1u);
    }
    // A group moves the bodies of all its blocks; a static body couples none.
    order.begin(tasks, 300, 4);
    order.add<S>({blocks.data(), 50});
    order.add<S>({blocks.data() + 60, 1});
    order.add<S>({blocks.data() + 50, 1});
    order.finish();
    EXPECT_EQ(order.levels(), 2u);
    for (Block<S>& block : blocks) {
        block.b = 0;
        block.invMassB = 0;
    }
    order.begin(tasks, 300, 4);
    for (const Block<S>& block : blocks) order.add<S>({&block, 1});
    order.finish();
    EXPECT_EQ(order.levels(), 1u);
}

}  // namespace
}  // namespace rigor::engine::test
