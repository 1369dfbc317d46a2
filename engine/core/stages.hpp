// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Short stages that threads walk through side by side. Each stage is cut in as many shares as there are
// threads; a thread does its own and then those that nobody has begun, and goes on when all are done. A share
// costs two words that others read: that it is taken, that it is done. The share of a thread is the same for
// stages of the same size, so that it finds what it worked on last time in its own cache.
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
    /// Of a stage: where the share `share` <= `of` of `of` begins; the last one ends at (stage, of, of).
    using Cut = std::function<std::size_t(std::size_t stage, std::size_t share, std::size_t of)>;
    using Work = std::function<void(std::size_t, std::size_t, std::size_t)>;

    explicit Stages(std::size_t threads) : shares_(threads) {}

    /// Stages 0 .. count - 1 as Tasks::forStages does them, with those who help(). `cut` and `work` are
    /// called by all of them.
    void run(std::size_t count, std::size_t grain, const Cut& cut, const Work& work);
    /// By any other thread, at any time; `self` in [1, threads). False: there was nothing to do.
    bool help(std::size_t self);

  private:
    /// Stages are counted through all runs, so that nothing has to be put back.
    struct alignas(64) Share {
        std::atomic<std::uint64_t> taken{0}, done{0};  ///< stages up to this one
    };
    void walk(std::size_t self);
    void take(std::size_t stage, std::size_t share, std::size_t of);

    std::vector<Share> shares_;
    alignas(64) std::atomic<bool> open_{false};
    alignas(64) std::atomic<int> inside_{0};  ///< those who help
    // --- of a run; read by those inside
    alignas(64) std::size_t count_ = 0, grain_ = 1;
    std::uint64_t before_ = 0;  ///< stages of earlier runs
    const Cut* cut_ = nullptr;
    const Work* work_ = nullptr;
    std::mutex failing_;
    std::exception_ptr error_;
    std::atomic<bool> failed_{false};
};

}  // namespace rigor::engine
