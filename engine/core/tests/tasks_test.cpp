// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <ctime>
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

TEST(Tasks, PartsAreWorthTheirWhile) {
    for (const int threads : {1, 2, 4}) {
        const Tasks tasks(threads);
        for (const std::size_t n : {16u, 17u, 64u, 1000u, 5000u}) {
            std::atomic<std::size_t> parts = 0, small = 0;
            tasks.forRanges(n, 16, [&](std::size_t begin, std::size_t end) {
                ++parts;
                if (end < n && end - begin <= 4) ++small;
            });
            EXPECT_EQ(small, 0u) << threads << " threads, " << n << ": of a quarter of the grain";
            if (n <= 16 || threads == 1)
                EXPECT_EQ(parts, 1u) << threads << " threads, " << n;
            else
                EXPECT_GT(parts, 1u) << threads << " threads, " << n;
        }
    }
}

TEST(Tasks, TwoThreadsReallyWorkAtTheSameTime) {
    const Tasks tasks(2);
    std::atomic<int> inside = 0, most = 0;
    // Each part waits until the other one has come; on a busy machine that may take seconds.
    tasks.forRanges(2, 1, [&](std::size_t, std::size_t) {
        most = std::max(most.load(), ++inside);
        for (int i = 0; i < 30000 && inside < 2 && most < 2; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        most = std::max(most.load(), inside.load());
        --inside;
    });
    EXPECT_EQ(most, 2);
}

TEST(Tasks, TwoThreadsReallyRunAStage) {
    const Tasks tasks(2);
    std::atomic<int> inside = 0, most = 0;
    tasks.forStages(3, [&](std::size_t, std::size_t) {
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
        tasks.forStages(stages, [&](std::size_t s, std::size_t chunk) {
            if (s > 0 && done[s - 1] != visits[s - 1].size()) early = true;
            const std::size_t end = tasks.chunkBegin(visits[s].size(), 4, chunk + 1);
            for (std::size_t i = tasks.chunkBegin(visits[s].size(), 4, chunk); i < end; ++i) {
                ++visits[s][i];
                ++done[s];
            }
        });
        EXPECT_FALSE(early) << threads;
        for (std::size_t s = 0; s < stages; ++s)
            EXPECT_EQ(visits[s], std::vector<int>(visits[s].size(), 1)) << threads << " threads, stage " << s;
    }
}

/// More threads than there are processors, which fall asleep at work: others take over what they come too
/// late for, and no thread goes on before it is done.
TEST(Tasks, WhoComesLateWaitsForWhatOthersHaveTakenOver) {
    constexpr std::size_t threads = 6, stages = 30;
    const Tasks tasks(threads);
    std::atomic<int> early = 0, twice = 0;
    for (int round = 0; round < 20; ++round) {
        std::array<std::atomic<int>, stages * threads> done{};
        tasks.forStages(stages, [&](std::size_t s, std::size_t chunk) {
            for (std::size_t k = 0; s > 0 && k < threads; ++k)
                if (done[(s - 1) * threads + k] == 0) ++early;
            if ((s * 5 + chunk * 3) % 7 == 0) std::this_thread::sleep_for(std::chrono::microseconds(200));
            if (done[s * threads + chunk]++ != 0) ++twice;
        });
        for (const std::atomic<int>& chunk : done) ASSERT_EQ(chunk, 1);
    }
    EXPECT_EQ(early, 0);
    EXPECT_EQ(twice, 0);
}

TEST(Tasks, ChunksBeginAtMultiplesOfTheGrain) {
    for (int threads = 1; threads <= 4; ++threads) {
        const Tasks tasks(threads);
        for (const std::size_t n : {0u, 1u, 15u, 16u, 17u, 100u, 1000u}) {
            std::vector<int> visits(n, 0);
            std::atomic<int> parts = 0, strange = 0;
            tasks.forChunks(n, 16, [&](std::size_t begin, std::size_t end) {
                ++parts;
                if (begin % 16 != 0 || (end % 16 != 0 && end != n)) ++strange;
                for (std::size_t i = begin; i < end; ++i) ++visits[i];
            });
            EXPECT_EQ(visits, std::vector<int>(n, 1)) << threads << " threads, " << n;
            EXPECT_EQ(strange, 0) << threads << " threads, " << n;
            EXPECT_LE(parts, n <= 16 ? 1 : threads) << threads << " threads, " << n;
            if (n == 1000) {
                EXPECT_EQ(parts, threads);
            }
        }
    }
}

/// The second chunk takes its thread three times as long as it should: it becomes smaller, and large again
/// when the thread is as fast as the other one.
TEST(Tasks, ChunksFollowTheSpeedOfThreads) {
    const Tasks tasks(2);
    EXPECT_EQ(tasks.fractionBefore(0), 0.0);
    EXPECT_EQ(tasks.fractionBefore(1), 0.5);
    EXPECT_EQ(tasks.fractionBefore(2), 1.0);
    const auto spin = [](double microseconds) {
        const auto end =
            std::chrono::steady_clock::now() + std::chrono::duration<double, std::micro>(microseconds);
        while (std::chrono::steady_clock::now() < end) {
        }
    };
    const auto run = [&](double slowness, const auto& until) {
        // Fifty to some hundred rounds; on a busy machine that may take longer.
        for (int round = 0; round < 20000 && !until(tasks.fractionBefore(1)); ++round)
            tasks.forStages(10, [&](std::size_t, std::size_t chunk) {
                const double part = tasks.fractionBefore(chunk + 1) - tasks.fractionBefore(chunk);
                spin(40 * part * (chunk == 1 ? slowness : 1.0));
            });
    };
    const auto begun = std::chrono::steady_clock::now();
    const std::clock_t used = std::clock();
    run(3, [](double before) { return before > 0.6; });
    const bool slower = tasks.fractionBefore(1) > 0.6;
    run(1, [](double before) { return before < 0.55; });
    const bool even = tasks.fractionBefore(1) < 0.55;
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    const double cores = static_cast<double>(std::clock() - used) / CLOCKS_PER_SEC / wall;
    // Threads that take turns on a core do not wait for each other: the speed of neither is known.
    if (!(slower && even) && cores < 1.8) GTEST_SKIP() << "had " << cores << " cores, needs two";
    EXPECT_TRUE(slower);
    EXPECT_TRUE(even);
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

TEST(Tasks, RangesInsideOfRangesAndStagesAreDone) {
    for (int threads = 1; threads <= 4; ++threads) {
        const Tasks tasks(threads);
        std::vector<std::atomic<int>> visits(60);
        tasks.withWorkers([&] {
            tasks.forRanges(6, 1, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i)
                    tasks.forStages(2, [&](std::size_t s, std::size_t chunk) {
                        for (std::size_t k = tasks.chunkBegin(5, 1, chunk);
                             k < tasks.chunkBegin(5, 1, chunk + 1); ++k)
                            ++visits[10 * i + 5 * s + k];
                    });
            });
        });
        for (const std::atomic<int>& visit : visits) EXPECT_EQ(visit, 1) << threads;
    }
}

TEST(Tasks, ExceptionsOfStagesReachTheCallerAndWorkGoesOn) {
    const Tasks tasks(3);
    for (int round = 0; round < 50; ++round) {
        EXPECT_THROW(tasks.forStages(4,
                                     [&](std::size_t s, std::size_t chunk) {
                                         if (s == 2 && chunk == 1) throw std::runtime_error("1 of 2");
                                     }),
                     std::runtime_error);
        EXPECT_THROW(tasks.withWorkers([] { throw std::runtime_error("entered"); }), std::runtime_error);
        std::atomic<int> sum = 0;
        tasks.forEach(1000, 1, [&](std::size_t i) { sum += static_cast<int>(i); });
        EXPECT_EQ(sum, 499500);
    }
}

/// More threads than there are processors, on runs of stages of all sizes: a late thread finds nothing left.
TEST(Tasks, ShortRunsOfStagesFollowEachOther) {
    const Tasks tasks(8);
    tasks.withWorkers([&] {
        for (std::size_t run = 1; run < 1000; ++run) {
            std::vector<std::atomic<int>> visits(run % 7 * 8);
            tasks.forStages(run % 7, [&](std::size_t s, std::size_t chunk) { ++visits[8 * s + chunk]; });
            for (const std::atomic<int>& visit : visits) ASSERT_EQ(visit, 1) << run;
        }
    });
}

/// Many short ranges one after the other: a thread that comes late for one takes part in the next.
TEST(Tasks, ShortRangesFollowEachOther) {
    const Tasks tasks(4);
    tasks.withWorkers([&] {
        std::vector<int> visits;
        for (std::size_t n = 1; n < 3000; ++n) {
            visits.assign(n % 97 + 1, 0);
            tasks.forRanges(visits.size(), 2, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) ++visits[i];
            });
            ASSERT_EQ(visits, std::vector<int>(visits.size(), 1)) << n;
        }
    });
}

}  // namespace
}  // namespace rigor::engine::test
