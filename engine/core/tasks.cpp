// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/core/tasks.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace rigor::engine {

/// An arena of its own keeps a world from borrowing threads that another one was given.
struct Tasks::Arena {
    explicit Arena(int threads) : arena(threads) {}
    oneapi::tbb::task_arena arena;
    /// A stage: parts taken, and parts done.
    struct alignas(64) Count {
        std::atomic<std::size_t> taken{0}, done{0};
    };
    std::vector<Count> stages;
};

Tasks::Tasks(int threads)
    : threads_(threads), arena_(threads > 1 ? std::make_unique<Arena>(threads) : nullptr) {}
Tasks::Tasks(const Tasks& other) : Tasks(other.threads_) {}
Tasks& Tasks::operator=(const Tasks& other) {
    if (this != &other) *this = Tasks(other);
    return *this;
}
Tasks::Tasks(Tasks&&) noexcept = default;
Tasks& Tasks::operator=(Tasks&&) noexcept = default;
Tasks::~Tasks() = default;

const Tasks& Tasks::one() {
    static const Tasks tasks(1);
    return tasks;
}

void Tasks::shared(std::size_t n, std::size_t grain,
                   const std::function<void(std::size_t, std::size_t)>& work) const {
    using Range = oneapi::tbb::blocked_range<std::size_t>;
    // A few parts for each thread even out what they cost; more only cost themselves.
    constexpr std::size_t kPartsPerThread = 4;
    const std::size_t part = std::max(grain / 2, n / (kPartsPerThread * static_cast<std::size_t>(threads_)));
    arena_->arena.execute([&] {
        oneapi::tbb::parallel_for(
            Range(0, n, std::max<std::size_t>(part, 1)),
            [&](const Range& range) { work(range.begin(), range.end()); }, oneapi::tbb::simple_partitioner());
    });
}

void Tasks::sharedStages(std::size_t count, std::size_t grain,
                         const std::function<std::size_t(std::size_t)>& size,
                         const std::function<void(std::size_t, std::size_t, std::size_t)>& work) const {
    std::vector<Arena::Count>& stages = arena_->stages;
    if (stages.size() < count) stages = std::vector<Arena::Count>(2 * count);
    for (std::size_t s = 0; s < count; ++s) stages[s].taken = 0, stages[s].done = 0;
    // Whoever comes takes part from the stage that is under way; nobody waits for a thread that has not come.
    const auto takePart = [&] {
        for (std::size_t s = 0; s < count; ++s) {
            const std::size_t n = size(s), parts = (n + grain - 1) / grain;
            for (std::size_t part; (part = stages[s].taken.fetch_add(1)) < parts; stages[s].done.fetch_add(1))
                work(s, part * grain, std::min(n, (part + 1) * grain));
            constexpr int kSpins = 2000;  // some microseconds, the length of a part
            for (int spin = 0; stages[s].done.load() < parts; ++spin)
                if (spin > kSpins) std::this_thread::yield();
        }
    };
    arena_->arena.execute([&] {
        oneapi::tbb::task_group others;
        for (int i = 1; i < threads_; ++i) others.run(takePart);
        takePart();
        others.wait();
    });
}

void Tasks::entered(const std::function<void()>& work) const {
    arena_->arena.execute([&] { work(); });
}

}  // namespace rigor::engine
