// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/core/stages.hpp"

#include <hwy/cache_control.h>

#include <algorithm>
#include <thread>
#include <utility>

namespace rigor::engine {

void pauseThread(int waits) {
    constexpr int kSpins = 1000;  // some ten microseconds, longer than what lies between two ranges of a step
    if (waits < kSpins)
        hwy::Pause();
    else
        std::this_thread::yield();
}

void Stages::run(std::size_t count, std::size_t grain, const Cut& cut, const Work& work) {
    before_ += count_;  // of the last run
    count_ = count, grain_ = std::max<std::size_t>(grain, 1);
    cut_ = &cut, work_ = &work;
    error_ = nullptr;
    failed_.store(false, std::memory_order_relaxed);
    open_.store(true);
    walk(0);
    open_.store(false);
    for (int waits = 0; inside_.load() != 0; ++waits) pauseThread(waits);
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

bool Stages::help(std::size_t self) {
    if (!open_.load(std::memory_order_relaxed)) return false;
    // Either run() sees this one inside and waits for it, or this one sees that it has been closed.
    inside_.fetch_add(1);
    const bool open = open_.load();
    if (open) walk(self);
    inside_.fetch_sub(1);
    return open;
}

void Stages::walk(std::size_t self) {
    for (std::size_t stage = 0; stage < count_; ++stage) {
        const std::size_t n = (*cut_)(stage, 1, 1) - (*cut_)(stage, 0, 1);
        const std::size_t shares = std::clamp<std::size_t>(n / grain_, 1, shares_.size());
        for (std::size_t k = 0; k < shares; ++k) take(stage, (self + k) % shares, shares);
        for (std::size_t k = 0; k < shares; ++k)
            for (int waits = 0; shares_[k].done.load(std::memory_order_acquire) <= before_ + stage; ++waits)
                pauseThread(waits);
    }
}

/// Does a share of a stage if nobody has begun it.
void Stages::take(std::size_t stage, std::size_t share, std::size_t of) {
    Share& mine = shares_[share];
    const std::uint64_t number = before_ + stage + 1;
    std::uint64_t taken = mine.taken.load(std::memory_order_relaxed);
    if (taken >= number || !mine.taken.compare_exchange_strong(taken, number, std::memory_order_relaxed))
        return;
    const std::size_t first = (*cut_)(stage, share, of), last = (*cut_)(stage, share + 1, of);
    try {
        if (first < last && !failed_.load(std::memory_order_relaxed)) (*work_)(stage, first, last);
    } catch (...) {
        const std::lock_guard lock(failing_);
        if (!error_) error_ = std::current_exception();
        failed_ = true;
    }
    mine.done.store(number, std::memory_order_release);
}

}  // namespace rigor::engine
