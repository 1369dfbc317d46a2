// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A fork-join pool of worker threads with work stealing. Every index of a range is processed independently
// and writes to its own output, so that results depend neither on the number of threads nor on the schedule.
//
//     tasks.forRanges(bodies.size(), 256, [&](std::size_t begin, std::size_t end) { ... });
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>

namespace rigor::engine {

/// A fixed number of threads. The result is the same where the machine has fewer cores. Each copy has threads
/// of its own.
class Tasks {
  public:
    /// `threads` >= 1; 1 does everything in the calling thread, without allocation.
    explicit Tasks(int threads = 1);
    Tasks(const Tasks& other);
    Tasks& operator=(const Tasks& other);
    Tasks(Tasks&&) noexcept;
    Tasks& operator=(Tasks&&) noexcept;
    ~Tasks();

    /// The calling thread alone: the default where no pool is given.
    static const Tasks& one();

    int threads() const { return threads_; }

    /// Dynamic schedule: calls work(begin, end) for chunks that together cover [0, n). A range of up to
    /// `grain` >= 1 indices is one chunk; in a longer one each chunk has more than grain / 4 indices. An
    /// exception thrown by `work` is rethrown in the calling thread.
    template <class Work>
    void forRanges(std::size_t n, std::size_t grain, const Work& work) const {
        if (threads_ == 1 || n <= grain) {
            if (n > 0) work(std::size_t(0), n);
            return;
        }
        runRanges(n, grain, std::cref(work));
    }
    /// forRanges index by index: work(i).
    template <class Work>
    void forEach(std::size_t n, std::size_t grain, const Work& work) const {
        forRanges(n, grain, [&work](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) work(i);
        });
    }
    /// Static schedule, for short work of even cost: one chunk per thread, chunkBegin at multiples of
    /// `grain`, so that for the same n a thread gets about the same indices each time. A range of up to
    /// `grain` indices is one chunk.
    template <class Work>
    void forChunks(std::size_t n, std::size_t grain, const Work& work) const {
        if (threads_ == 1 || n <= grain) {
            if (n > 0) work(std::size_t(0), n);
            return;
        }
        const auto run = [&](std::size_t, std::size_t chunk) {
            const std::size_t begin = chunkBegin(n, grain, chunk), end = chunkBegin(n, grain, chunk + 1);
            if (begin < end) work(begin, end);
        };
        runStages(1, std::cref(run));
    }
    /// Stages 0 .. count - 1 with a barrier after each; every stage has one chunk per thread: work(stage,
    /// chunk). The threads are not woken again between stages, so that stages may be short
    /// (core/stages.hpp).
    template <class Work>
    void forStages(std::size_t count, const Work& work) const {
        if (threads_ == 1) {
            for (std::size_t stage = 0; stage < count; ++stage) work(stage, std::size_t(0));
            return;
        }
        runStages(count, std::cref(work));
    }
    /// Fraction of the work that lies before the chunk `chunk`, 0 .. 1. The sizes of the chunks follow the
    /// measured speed of the threads; they are updated on each call of withWorkers().
    double fractionBefore(std::size_t chunk) const;
    /// First index of the chunk `chunk` of [0, n), a multiple of `grain`; n for chunk == threads().
    std::size_t chunkBegin(std::size_t n, std::size_t grain, std::size_t chunk) const {
        const auto units = static_cast<double>((n + grain - 1) / grain);
        return std::min(n, static_cast<std::size_t>(units * fractionBefore(chunk) + 0.5) * grain);
    }
    /// Calls `work` with the worker threads kept awake: parallel loops inside start without waking them.
    template <class Work>
    void withWorkers(const Work& work) const {
        if (threads_ == 1) return work();
        runWithWorkers(std::cref(work));
    }

  private:
    struct Arena;
    void runRanges(std::size_t n, std::size_t grain,
                   const std::function<void(std::size_t, std::size_t)>& work) const;
    void runStages(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work) const;
    void runWithWorkers(const std::function<void()>& work) const;

    int threads_ = 1;
    std::unique_ptr<Arena> arena_;  ///< null for one thread
};

}  // namespace rigor::engine
