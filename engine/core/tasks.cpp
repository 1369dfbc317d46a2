// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/core/tasks.hpp"

#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/core/stages.hpp"

namespace rigor::engine {
namespace {

/// Chunks of a work queue that no thread has taken yet, [next, end), packed into one atomic word, so that the
/// thread that takes a chunk knows which range it belongs to: [range 24 | end 20 | next 20]. A failed take
/// moves an end of an empty queue by one; kLate is the room for these.
constexpr std::uint64_t kChunkBits = 20, kLate = 4096;
constexpr std::size_t kMostChunks = (1u << kChunkBits) - 2 * kLate;
constexpr std::uint64_t kTakeNext = 1, kTakeLast = -(std::uint64_t(1) << kChunkBits);  // increments that take
                                                                                       // a chunk
constexpr std::uint64_t pack(std::uint64_t range, std::uint64_t first, std::uint64_t end) {
    return range << (2 * kChunkBits) | (end + kLate) << kChunkBits | (first + kLate);
}
constexpr std::size_t fieldOf(std::uint64_t packed) {
    return (packed & ((1u << kChunkBits) - 1)) - kLate;
}
constexpr std::size_t nextOf(std::uint64_t packed) {
    return fieldOf(packed);
}
constexpr std::size_t endOf(std::uint64_t packed) {
    return fieldOf(packed >> kChunkBits);
}

}  // namespace

/// Work-stealing pool [BlumofeLeiserson1999] for ranges that take microseconds.
///
///     range [0, n)   | chunk 0 | chunk 1 | chunk 2 | chunk 3 | chunk 4 | chunk 5 |
///     queues           owner: thread 0 ->            owner: thread 1 ->
///                                    <- stolen from the end by other threads
///
/// Each world has a task_arena of its own, so that worlds do not take each other's threads. Inside
/// withWorkers() the workers spin in workerLoop(): waking them by parallel_for costs more than most ranges of
/// a step. A thread's queue holds about the same chunks of every range of the same size, so that it finds
/// their data in its own cache. A worker whose queue is empty steals from the end of the other queues.
/// Invariant between ranges: every queue is empty and done_ == chunks_.
struct Tasks::Arena {
    using Work = std::function<void(std::size_t, std::size_t)>;

    explicit Arena(int threads)
        : arena(threads),
          stages(static_cast<std::size_t>(threads)),
          before(static_cast<std::size_t>(threads)),
          queues_(static_cast<std::size_t>(threads)) {
        weigh();
    }

    void weigh() {
        const std::vector<double>& weights = stages.weights();
        std::exclusive_scan(weights.begin(), weights.end(), before.begin(), 0.0);
    }
    void withWorkers(const std::function<void()>& work);
    void distribute(std::size_t n, std::size_t size, const Work& work);
    bool inChunk() const { return working == this; }

    oneapi::tbb::task_arena arena;
    Stages stages;
    std::vector<double> before;  ///< fraction of the work that lies before each thread's chunks
    bool active = false;

    /// Scope in which the calling thread runs a chunk of `arena`.
    struct Inside {
        explicit Inside(const Arena* arena) : before(std::exchange(working, arena)) {}
        ~Inside() { working = before; }
        Inside(const Inside&) = delete;
        Inside& operator=(const Inside&) = delete;
        const Arena* before;
    };

  private:
    struct alignas(64) Queue {
        std::atomic<std::uint64_t> left{0};
    };
    /// First chunk of a queue; the number of chunks for the index after the last queue.
    std::size_t firstChunk(std::size_t queue) const {
        if (queue == queues_.size()) return chunks_;
        return static_cast<std::size_t>(static_cast<double>(chunks_) * before[queue] + 0.5);
    }
    void workerLoop(std::size_t self);
    /// Task of a worker thread; named for cmake/tsan.supp.
    struct WorkerTask {
        Arena* arena;
        std::size_t self;
        void operator()() const { arena->workerLoop(self); }
    };
    bool takeChunks(std::size_t self);
    void run(std::size_t chunk);

    static thread_local const Arena* working;  ///< arena whose chunk this thread is running

    std::vector<Queue> queues_;
    std::atomic<bool> together_{false};
    alignas(64) std::atomic<std::size_t> done_{0};
    // --- the current range; read by threads that have taken a chunk of it
    alignas(64) const Work* work_ = nullptr;
    std::size_t n_ = 0, size_ = 0, chunks_ = 0;  ///< indices; indices per chunk; chunks
    std::uint64_t range_ = 0;
    std::mutex failing_;
    std::exception_ptr error_;
};

thread_local const Tasks::Arena* Tasks::Arena::working = nullptr;

void Tasks::Arena::withWorkers(const std::function<void()>& work) {
    if (inChunk() || active) return work();
    weigh();
    arena.execute([&] {
        oneapi::tbb::task_group others;
        active = together_ = true;
        for (std::size_t i = 1; i < queues_.size(); ++i) others.run(WorkerTask{this, i});
        const auto leave = [&] {
            active = together_ = false;
            others.wait();
        };
        try {
            work();
        } catch (...) {
            leave();
            throw;
        }
        leave();
    });
}

void Tasks::Arena::workerLoop(std::size_t self) {
    for (int waits = 0; together_.load(std::memory_order_acquire); ++waits)
        if (stages.join(self) || takeChunks(self))
            waits = 0;
        else
            pauseThread(waits);
}

void Tasks::Arena::distribute(std::size_t n, std::size_t size, const Work& work) {
    size_ = std::max<std::size_t>({size, 1, n / kMostChunks + 1});
    n_ = n;
    chunks_ = (n_ + size_ - 1) / size_;
    work_ = &work;
    error_ = nullptr;
    done_.store(0, std::memory_order_relaxed);
    ++range_;
    for (std::size_t k = 0; k < queues_.size(); ++k)
        queues_[k].left.store(pack(range_, firstChunk(k), firstChunk(k + 1)), std::memory_order_release);
    takeChunks(0);
    for (int waits = 0; done_.load(std::memory_order_acquire) < chunks_; ++waits) pauseThread(waits);
    if (error_) std::rethrow_exception(error_);
}

bool Tasks::Arena::takeChunks(std::size_t self) {
    bool some = false;
    for (std::size_t k = 0; k < queues_.size(); ++k) {
        const std::size_t queue = (self + k) % queues_.size();
        std::atomic<std::uint64_t>& left = queues_[queue].left;
        std::size_t done = 0;  // published after the loop: the range cannot end before
        for (;;) {
            std::uint64_t now = left.load(std::memory_order_relaxed);
            if (nextOf(now) >= endOf(now)) break;
            // A new range may have begun since the load: the word that fetch_add returns names the chunk and
            // its range, which cannot end before the chunk is done.
            now = left.fetch_add(queue == self ? kTakeNext : kTakeLast, std::memory_order_acq_rel);
            if (nextOf(now) >= endOf(now)) break;
            run(queue == self ? nextOf(now) : endOf(now) - 1);
            ++done;
        }
        if (done == 0) continue;
        done_.fetch_add(done, std::memory_order_release);
        some = true;
    }
    return some;
}

void Tasks::Arena::run(std::size_t chunk) {
    const Inside inside(this);
    try {
        (*work_)(chunk * size_, std::min(n_, (chunk + 1) * size_));
    } catch (...) {
        const std::lock_guard lock(failing_);
        if (!error_) error_ = std::current_exception();
    }
}

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

void Tasks::runRanges(std::size_t n, std::size_t grain,
                      const std::function<void(std::size_t, std::size_t)>& work) const {
    if (arena_->inChunk()) return work(0, n);
    // Four chunks per thread balance uneven costs; more only add overhead.
    constexpr std::size_t kChunksPerThread = 4;
    const std::size_t size = std::max(grain / 2, n / (kChunksPerThread * static_cast<std::size_t>(threads_)));
    const auto distribute = [&] { arena_->distribute(n, size, work); };
    arena_->withWorkers(std::cref(distribute));
}

void Tasks::runStages(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work) const {
    const Stages::Work run = [&](std::size_t stage, std::size_t chunk) {
        const Arena::Inside inside(arena_.get());
        work(stage, chunk);
    };
    const auto all = [&] {
        if (!arena_->inChunk()) return arena_->stages.run(count, run);
        for (std::size_t stage = 0; stage < count; ++stage)
            for (std::size_t chunk = 0; chunk < static_cast<std::size_t>(threads_); ++chunk)
                work(stage, chunk);
    };
    arena_->withWorkers(std::cref(all));
}

double Tasks::fractionBefore(std::size_t chunk) const {
    return chunk == 0 ? 0.0 : chunk >= static_cast<std::size_t>(threads_) ? 1.0 : arena_->before[chunk];
}

void Tasks::runWithWorkers(const std::function<void()>& work) const {
    arena_->withWorkers(work);
}

}  // namespace rigor::engine
