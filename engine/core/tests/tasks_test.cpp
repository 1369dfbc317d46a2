// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "engine/core/tasks.hpp"

namespace rigor::engine::test {
namespace {

TEST(Tasks, EveryIndexOnceForAnyNumberOfThreads) {
    for (int threads = 1; threads <= 4; ++threads) {
        const Tasks tasks(threads);
        for (const std::size_t n : {0u, 1u, 7u, 64u, 1000u}) {
            std::vector<int> visits(n, 0);
            tasks.forRanges(n, 8, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) ++visits[i];
            });
            EXPECT_EQ(visits, std::vector<int>(n, 1)) << threads << " threads, " << n << " indices";
        }
    }
}

TEST(Tasks, TwoThreadsReallyWorkAtTheSameTime) {
    const Tasks tasks(2);
    std::atomic<int> inside = 0, most = 0;
    // Each part waits until the other one has come, or a second has passed.
    tasks.forRanges(2, 1, [&](std::size_t, std::size_t) {
        most = std::max(most.load(), ++inside);
        for (int i = 0; i < 1000 && inside < 2 && most < 2; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        most = std::max(most.load(), inside.load());
        --inside;
    });
    EXPECT_EQ(most, 2);
}

TEST(Tasks, StagesFollowEachOtherAndVisitEveryIndexOnce) {
    constexpr std::size_t stages = 40;
    for (int threads = 1; threads <= 4; ++threads) {
        const Tasks tasks(threads);
        std::vector<std::vector<int>> visits(stages);
        for (std::size_t s = 0; s < stages; ++s) visits[s].assign(s * 7 % 30, 0);
        std::atomic<bool> early = false;  // a stage began before the last one had ended
        std::vector<std::atomic<std::size_t>> done(stages);
        tasks.forStages(
            stages, 4, [&](std::size_t s) { return visits[s].size(); },
            [&](std::size_t s, std::size_t begin, std::size_t end) {
                if (s > 0 && done[s - 1] != visits[s - 1].size()) early = true;
                for (std::size_t i = begin; i < end; ++i) ++visits[s][i];
                done[s] += end - begin;
            });
        EXPECT_FALSE(early) << threads;
        for (std::size_t s = 0; s < stages; ++s)
            EXPECT_EQ(visits[s], std::vector<int>(visits[s].size(), 1)) << threads << " threads, stage " << s;
    }
}

TEST(Tasks, ExceptionsReachTheCallerAndCopiesWork) {
    const Tasks tasks(3);
    const Tasks copy = tasks;  // NOLINT: a copy is what is tested
    EXPECT_EQ(copy.threads(), 3);
    for (const Tasks* t : {&tasks, &copy})
        EXPECT_THROW(t->forRanges(100, 1,
                                  [](std::size_t begin, std::size_t end) {
                                      if (begin <= 50 && 50 < end) throw std::runtime_error("50");
                                  }),
                     std::runtime_error);
}

}  // namespace
}  // namespace rigor::engine::test
