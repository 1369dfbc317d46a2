// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Work shared among threads. Every index of a range is worked on by itself and writes to its own place, so
// that results do not depend on the number of threads or on who did what.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>

namespace rigor::engine {

/// A fixed number of threads to share work among; those that the machine does not have are not missed. Copies
/// have threads of their own.
class Tasks {
  public:
    /// `threads` >= 1; 1 does everything in the calling thread, without allocation.
    explicit Tasks(int threads = 1);
    Tasks(const Tasks& other);
    Tasks& operator=(const Tasks& other);
    Tasks(Tasks&&) noexcept;
    Tasks& operator=(Tasks&&) noexcept;
    ~Tasks();

    /// The calling thread alone, for those who have nobody else.
    static const Tasks& one();

    int threads() const { return threads_; }

    /// Calls work(begin, end) for parts of [0, n) that together are all of it. A range of up to `grain` >= 1
    /// indices is not worth sharing and is one part; else parts have more than a quarter of that. An
    /// exception of `work` reaches the caller.
    template <class Work>
    void forRanges(std::size_t n, std::size_t grain, const Work& work) const {
        if (threads_ == 1 || n <= grain) {
            if (n > 0) work(std::size_t(0), n);
            return;
        }
        shared(n, grain, std::cref(work));
    }
    /// The same index by index: work(i).
    template <class Work>
    void forEach(std::size_t n, std::size_t grain, const Work& work) const {
        forRanges(n, grain, [&work](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) work(i);
        });
    }
    /// The same for work that is even and short: one part for each thread, cut at multiples of `grain`, of
    /// the same n always about the same. No more than `grain` indices are one part.
    template <class Work>
    void forShares(std::size_t n, std::size_t grain, const Work& work) const {
        if (threads_ == 1 || n <= grain) {
            if (n > 0) work(std::size_t(0), n);
            return;
        }
        const auto part = [&](std::size_t, std::size_t share) {
            const std::size_t begin = cut(n, grain, share), end = cut(n, grain, share + 1);
            if (begin < end) work(begin, end);
        };
        sharedStages(1, std::cref(part));
    }
    /// Stages 0 .. count - 1 one after the other, each in as many shares as there are threads: work(stage,
    /// share). The next stage begins when the last one has ended (core/stages.hpp); threads are not sent for
    /// anew in between, so that stages may be short.
    template <class Work>
    void forStages(std::size_t count, const Work& work) const {
        if (threads_ == 1) {
            for (std::size_t stage = 0; stage < count; ++stage) work(stage, std::size_t(0));
            return;
        }
        sharedStages(count, std::cref(work));
    }
    /// What part of the work belongs before the share `share`, 0 .. 1: threads have shares after their speed,
    /// which is reckoned anew with each enter().
    double before(std::size_t share) const;
    /// Where the share `share` of [0, n) begins, at a multiple of `grain`; that of threads() is n.
    std::size_t cut(std::size_t n, std::size_t grain, std::size_t share) const {
        const auto units = static_cast<double>((n + grain - 1) / grain);
        return std::min(n, static_cast<std::size_t>(units * before(share) + 0.5) * grain);
    }
    /// Does `work` among the threads: calls of forRanges from within start at once.
    template <class Work>
    void enter(const Work& work) const {
        if (threads_ == 1) return work();
        entered(std::cref(work));
    }

  private:
    struct Arena;
    void shared(std::size_t n, std::size_t grain,
                const std::function<void(std::size_t, std::size_t)>& work) const;
    void sharedStages(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work) const;
    void entered(const std::function<void()>& work) const;

    int threads_ = 1;
    std::unique_ptr<Arena> arena_;  ///< null for one thread
};

}  // namespace rigor::engine
