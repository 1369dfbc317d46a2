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

/// Pauses before the chunk of a worker that may be descheduled is taken over: a microsecond or two, longer
/// than a running worker needs to see that a stage has begun.
constexpr int kSpinCount = 64;

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
    : chunks_(threads), workers_(threads), weights_(threads, 1.0 / static_cast<double>(threads)) {
    for (Worker& worker : workers_) worker.spinCount.assign(threads, kSpinCount);
}

void Stages::run(std::size_t stages, const Work& work) {
    if (stages == 0) return;
    const std::uint64_t last = run_.load(std::memory_order_relaxed);
    before_ = before(last) + count(last);
    work_ = &work;
    failed_.store(false, std::memory_order_relaxed);
    const std::uint64_t next = before_ << kCountBits | stages;
    run_.store(next, std::memory_order_release);
    runStages(0, next);
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

bool Stages::join(std::size_t self) {
    const std::uint64_t run = run_.load(std::memory_order_acquire);
    if (std::exchange(workers_[self].lastRun, run) == run) return false;
    runStages(self, run);
    return true;
}

void Stages::runStages(std::size_t self, std::uint64_t run) {
    Worker& worker = workers_[self];
    for (std::uint64_t stage = before(run) + 1; stage <= before(run) + count(run); ++stage) {
        tryRun(self, stage);
        for (std::size_t k = 1; k < chunks_.size(); ++k) await(worker, (self + k) % chunks_.size(), stage);
        await(worker, self, stage);  // another worker may have taken it
    }
}

void Stages::await(Worker& worker, std::size_t chunk, std::uint64_t stage) {
    int& spinCount = worker.spinCount[chunk];
    bool mayTake = true;
    int waits = 0;
    for (; chunks_[chunk].done.load(std::memory_order_acquire) < stage; ++waits) {
        if (mayTake && waits >= spinCount) {
            mayTake = false;
            spinCount = tryRun(chunk, stage) ? 0 : kSpinCount;
            if (spinCount == 0) return;
        } else {
            pauseThread(waits);
        }
    }
    if (waits == 0) return;
    worker.waited.store(worker.waited.load(std::memory_order_relaxed) + static_cast<std::uint64_t>(waits),
                        std::memory_order_relaxed);
}

/// Runs the chunk of a stage unless another thread has taken it.
bool Stages::tryRun(std::size_t chunk, std::uint64_t stage) {
    Chunk& own = chunks_[chunk];
    std::uint64_t taken = own.taken.load(std::memory_order_relaxed);
    if (taken >= stage || !own.taken.compare_exchange_strong(taken, stage, std::memory_order_relaxed))
        return false;
    try {
        if (!failed_.load(std::memory_order_relaxed)) (*work_)(stage - before_ - 1, chunk);
    } catch (...) {
        const std::lock_guard lock(failing_);
        if (!error_) error_ = std::current_exception();
        failed_.store(true, std::memory_order_relaxed);
    }
    own.done.store(stage, std::memory_order_release);
    return true;
}

const std::vector<double>& Stages::weights() {
    constexpr double kGain = 0.01, kEven = 0.1, kMost = 1.5;
    constexpr std::uint64_t kLeast = 64;  // pauses: less says nothing
    const auto threads = static_cast<double>(workers_.size());
    std::uint64_t all = 0;
    for (const Worker& worker : workers_) all += worker.waited.load(std::memory_order_relaxed);
    if (all < kLeast) return weights_;
    const double mean = static_cast<double>(all) / threads;
    double sum = 0;
    for (std::size_t k = 0; k < workers_.size(); ++k) {
        const auto waited = static_cast<double>(workers_[k].waited.exchange(0, std::memory_order_relaxed));
        const double change = std::abs(waited - mean) <= kEven * mean ? 0 : waited > mean ? kGain : -kGain;
        weights_[k] = std::clamp(weights_[k] + change / threads, (2 - kMost) / threads, kMost / threads);
        sum += weights_[k];
    }
    for (double& weight : weights_) weight /= sum;
    return weights_;
}

}  // namespace rigor::engine
