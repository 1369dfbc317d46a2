// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Short stages that threads walk through side by side. Each stage has a share for each thread; a thread does
// its own, waits until all others are done, and goes on. It takes its own share by a word that nobody else
// touches as a rule, and says that it is done by another one that the others wait for: a stage costs each
// thread one line that goes from cache to cache. A share that is not done for long is taken over, if its
// thread has not begun it, and from then on at once, until that thread comes back. What a share consists of
// is up to the work; where a thread has the same one in many stages it finds that in its own cache.
//
// Threads that share a core with somebody else are slower than others. How long each one waits says so, and
// shares are weighted by it (weights()).
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

namespace rigor::engine {

/// Waits a little, after `waits` times before.
void pauseThread(int waits);

class Stages {
  public:
    /// The share `share` of a stage; as many as there are threads.
    using Work = std::function<void(std::size_t stage, std::size_t share)>;

    explicit Stages(std::size_t threads);

    /// Stages 0 .. count - 1 as Tasks::forStages does them, with those who help(); count < 2^24.
    void run(std::size_t count, const Work& work);
    /// By any other thread, at any time; `self` in [1, threads). False: there was nothing to do.
    bool help(std::size_t self);

    /// Between runs: what part of the work each thread should have, such that all are done at the same time;
    /// the sum is 1. Follows what they have waited since the last call, slowly.
    const std::vector<double>& weights();

  private:
    // Stages are counted through all runs, from 1, so that nothing has to be put back. Who has taken a share
    // keeps its stage, and with it the run, from ending: only then what belongs to the run is read. Who comes
    // late finds all shares of the run that it knows of taken and done.
    struct Share {
        alignas(64) std::atomic<std::uint64_t> taken{0};  ///< stages up to this one
        alignas(64) std::atomic<std::uint64_t> done{0};
    };
    /// What a thread knows.
    struct alignas(64) Walker {
        std::uint64_t seen = 0;                ///< the last run
        std::vector<int> patience;             ///< with each share, before it is taken over
        std::atomic<std::uint64_t> waited{0};  ///< pauses, for others who were at work
    };
    void walk(std::size_t self, std::uint64_t run);
    bool take(std::size_t share, std::uint64_t stage);
    void await(Walker& walker, std::size_t share, std::uint64_t stage);

    std::vector<Share> shares_;
    std::vector<Walker> walkers_;
    std::vector<double> weights_;
    /// The run that is under way, or was last: stages of earlier ones, and how many it has.
    alignas(64) std::atomic<std::uint64_t> run_{0};
    // --- of the run
    alignas(64) std::uint64_t before_ = 0;
    const Work* work_ = nullptr;
    std::atomic<bool> failed_{false};
    std::mutex failing_;
    std::exception_ptr error_;
};

}  // namespace rigor::engine
