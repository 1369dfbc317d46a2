// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/core/stages.hpp"

#include <hwy/cache_control.h>

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

namespace rigor::engine {
namespace {

/// Pauses before the share of a thread that seems to be away is taken over: a microsecond or two, longer than
/// a thread takes to see that a stage has begun.
constexpr int kPatience = 64;

constexpr std::uint64_t kCountBits = 24;
constexpr std::uint64_t before(std::uint64_t run) {
    return run >> kCountBits;
}
constexpr std::uint64_t count(std::uint64_t run) {
    return run & ((std::uint64_t(1) << kCountBits) - 1);
}

}  // namespace

void pauseThread(int waits) {
    constexpr int kSpins = 1000;  // some ten microseconds, longer than what lies between two ranges of a step
    if (waits < kSpins)
        hwy::Pause();
    else
        std::this_thread::yield();
}

Stages::Stages(std::size_t threads)
    : shares_(threads), walkers_(threads), weights_(threads, 1.0 / static_cast<double>(threads)) {
    for (Walker& walker : walkers_) walker.patience.assign(threads, kPatience);
}

void Stages::run(std::size_t stages, const Work& work) {
    if (stages == 0) return;
    const std::uint64_t last = run_.load(std::memory_order_relaxed);
    before_ = before(last) + count(last);
    work_ = &work;
    failed_.store(false, std::memory_order_relaxed);
    const std::uint64_t next = before_ << kCountBits | stages;
    run_.store(next, std::memory_order_release);
    walk(0, next);
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

bool Stages::help(std::size_t self) {
    const std::uint64_t run = run_.load(std::memory_order_acquire);
    if (std::exchange(walkers_[self].seen, run) == run) return false;
    walk(self, run);
    return true;
}

void Stages::walk(std::size_t self, std::uint64_t run) {
    Walker& walker = walkers_[self];
    for (std::uint64_t stage = before(run) + 1; stage <= before(run) + count(run); ++stage) {
        take(self, stage);
        for (std::size_t k = 1; k < shares_.size(); ++k) await(walker, (self + k) % shares_.size(), stage);
        await(walker, self, stage);  // somebody else may have taken it
    }
}

void Stages::await(Walker& walker, std::size_t share, std::uint64_t stage) {
    int& patience = walker.patience[share];
    bool mayTake = true;
    int waits = 0;
    for (; shares_[share].done.load(std::memory_order_acquire) < stage; ++waits) {
        if (mayTake && waits >= patience) {
            mayTake = false;
            patience = take(share, stage) ? 0 : kPatience;
            if (patience == 0) return;
        } else {
            pauseThread(waits);
        }
    }
    if (waits == 0) return;
    walker.waited.store(walker.waited.load(std::memory_order_relaxed) + static_cast<std::uint64_t>(waits),
                        std::memory_order_relaxed);
}

/// Does a share of a stage unless somebody has begun it.
bool Stages::take(std::size_t share, std::uint64_t stage) {
    Share& mine = shares_[share];
    std::uint64_t taken = mine.taken.load(std::memory_order_relaxed);
    if (taken >= stage || !mine.taken.compare_exchange_strong(taken, stage, std::memory_order_relaxed))
        return false;
    try {
        if (!failed_.load(std::memory_order_relaxed)) (*work_)(stage - before_ - 1, share);
    } catch (...) {
        const std::lock_guard lock(failing_);
        if (!error_) error_ = std::current_exception();
        failed_.store(true, std::memory_order_relaxed);
    }
    mine.done.store(stage, std::memory_order_release);
    return true;
}

const std::vector<double>& Stages::weights() {
    constexpr double kGain = 0.01, kEven = 0.1, kMost = 1.5;
    constexpr std::uint64_t kLeast = 64;  // pauses: less says nothing
    const auto threads = static_cast<double>(walkers_.size());
    std::uint64_t all = 0;
    for (const Walker& walker : walkers_) all += walker.waited.load(std::memory_order_relaxed);
    if (all < kLeast) return weights_;
    const double mean = static_cast<double>(all) / threads;
    double sum = 0;
    for (std::size_t k = 0; k < walkers_.size(); ++k) {
        const auto waited = static_cast<double>(walkers_[k].waited.exchange(0, std::memory_order_relaxed));
        const double change = std::abs(waited - mean) <= kEven * mean ? 0 : waited > mean ? kGain : -kGain;
        weights_[k] = std::clamp(weights_[k] + change / threads, (2 - kMost) / threads, kMost / threads);
        sum += weights_[k];
    }
    for (double& weight : weights_) weight /= sum;
    return weights_;
}

}  // namespace rigor::engine
