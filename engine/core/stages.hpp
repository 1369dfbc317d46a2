// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A sequence of short stages with a barrier after each. Every stage has one chunk of work per thread.
//
//     stage      1          2          3
//     chunk 0  [#####]    [####]     [#####]      worker 0
//     chunk 1  [####]     [#####]    [####]       worker 1
//                     |          |          |     barrier: done[k] >= stage for all k
//
// A worker claims its own chunk by `taken`, a word that other workers rarely touch, and reports it by `done`,
// which the others spin on: a stage moves one cache line per thread between cores. A chunk whose worker has
// not begun it after spinCount pauses (its thread may be descheduled) is run by a waiting worker, and from
// then on without pauses, until its own worker comes back. The content of a chunk is up to the caller; where
// a thread gets the same data in many stages it finds them in its own cache.
//
// A thread whose core is shared with another process is slower. The time that the others wait shows it, and
// the sizes of the chunks are weighted by it (weights()).
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

namespace rigor::engine {

/// One pause of a spin loop that has already paused `waits` times: a CPU pause first, then a yield.
void pauseThread(int waits);

class Stages {
  public:
    /// Runs one chunk of a stage, chunk in [0, threads).
    using Work = std::function<void(std::size_t stage, std::size_t chunk)>;

    explicit Stages(std::size_t threads);

    /// Runs stages 0 .. count - 1 in the calling thread and in those that join(); count < 2^24.
    void run(std::size_t count, const Work& work);
    /// Called by the other threads at any time, `self` in [1, threads). False: there was no new run.
    bool join(std::size_t self);

    /// Fraction of the work for each thread such that all finish at the same time; the sum is 1. Called
    /// between runs. A slow integrator of the times that the threads have waited since the last call.
    const std::vector<double>& weights();

  private:
    // Stages are numbered through all runs, from 1, so that no counter is ever reset. A worker that has taken
    // a chunk keeps its stage, and with it the run, from ending; the members of the run are read only while a
    // chunk is taken. A worker that joins late finds all chunks of that run taken and done.
    struct Chunk {
        alignas(64) std::atomic<std::uint64_t> taken{0};  ///< last stage whose chunk has been taken
        alignas(64) std::atomic<std::uint64_t> done{0};   ///< last stage whose chunk is done
    };
    /// State of one thread.
    struct alignas(64) Worker {
        std::uint64_t lastRun = 0;             ///< the last run that it has joined
        std::vector<int> spinCount;            ///< pauses before each chunk of another worker is taken over
        std::atomic<std::uint64_t> waited{0};  ///< pauses at barriers since weights() was called
    };
    void runStages(std::size_t self, std::uint64_t run);
    bool tryRun(std::size_t chunk, std::uint64_t stage);
    void await(Worker& worker, std::size_t chunk, std::uint64_t stage);

    std::vector<Chunk> chunks_;
    std::vector<Worker> workers_;
    std::vector<double> weights_;
    /// The current or last run: [stages of all runs before | its number of stages].
    alignas(64) std::atomic<std::uint64_t> run_{0};
    // --- the current run
    alignas(64) std::uint64_t before_ = 0;
    const Work* work_ = nullptr;
    std::atomic<bool> failed_{false};
    std::mutex failing_;
    std::exception_ptr error_;
};

}  // namespace rigor::engine
