// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/wide/patches.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

namespace rigor::engine {
namespace {

constexpr std::size_t kBlockGrain = 8;  ///< blocks worth a task: some microseconds of work

/// Raises `largest` to at least x.
template <class R>
void raise(std::atomic<R>& largest, R x) {
    R current = largest.load();
    while (current < x && !largest.compare_exchange_weak(current, x)) {
    }
}

}  // namespace

template <class S>
std::size_t Patches<S>::rows() const {
    constexpr std::size_t friction = S::dim == 3 ? S::tangents + 1 : S::tangents;
    return points() + friction * size();
}

template <class S>
void Patches<S>::assignLanes(const BodyArrays<S>& bodies, const Tasks& tasks) {
    const std::size_t n = bodies.size();
    if (std::exchange(changed_, false)) {  // false in most steps , in which the assignment stays valid
        colouring_.colour(descriptors_, n, kLanes, tasks);
        fractions_.clear();
        // The arrays never shrink, so that a steady state does not allocate.
        if (blocks_.size() < blocks()) {
            blocks_.resize(blocks());
            cold_.resize(blocks());
        }
    }
    inertia_.resize(n);
    motions_.resize(n);
    velocities_.resize(n);
    impulseDelta_.resize(n);
    split(tasks);
    impulseDeltaValid_ = bounce_ = false;
    const auto begin = [&](std::size_t i) {
        motions_[i] = {};
        PatchReal* I = inertia_[i].number;
        const bool moves = bodies.invMass[i] > 0;
        if constexpr (S::dim == 3) {
            for (int row = 0; row < 3; ++row)
                for (int column = row; column < 3; ++column)
                    *I++ = moves ? static_cast<PatchReal>(bodies.invInertia[i](row, column)) : PatchReal(0);
        } else {
            *I = moves ? static_cast<PatchReal>(bodies.invInertia[i]) : PatchReal(0);
        }
    };
    tasks.forChunks(n, kBodyGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) begin(i);
    });
}

/// Makes the stages, with chunks weighted by the threads' speed, unless these have not changed.
template <class S>
void Patches<S>::split(const Tasks& tasks) {
    threads_ = static_cast<std::size_t>(tasks.threads());
    bool valid = fractions_.size() == threads_ + 1;
    fractions_.resize(threads_ + 1);
    for (std::size_t chunk = 0; chunk <= threads_; ++chunk) {
        const double fraction = tasks.fractionBefore(chunk);
        valid = std::exchange(fractions_[chunk], fraction) == fraction && valid;
    }
    if (valid) return;
    stages_.clear();
    splits_.clear();
    if (threads_ > 1) addRangeStages();
    addPartitionStage();
}

/// Each thread gets whole partitions, in number of blocks within half a partition of its fraction. A single
/// thread runs all blocks in one chunk.
template <class S>
void Patches<S>::addPartitionStage() {
    const std::span<const Colouring::Partition> partitions = colouring_.partitions();
    firstPartition_.assign(threads_ + 1, 0);
    stages_.push_back({splits_.size(), false});
    const std::uint32_t first = threads_ > 1 ? partitions.front().first : 0, last = partitions.back().last;
    splits_.push_back({first});
    for (std::size_t chunk = 1; chunk <= threads_; ++chunk) {
        const double before = first + fractions_[chunk] * (last - first);
        std::size_t& r = firstPartition_[chunk];
        r = chunk < threads_ ? firstPartition_[chunk - 1] : partitions.size();
        while (r < partitions.size() && 0.5 * (partitions[r].first + partitions[r].last) < before) ++r;
        splits_.push_back({r < partitions.size() ? partitions[r].first : last});
    }
}

/// Fewer than two blocks per thread are not split: the first thread runs them, and without a barrier between
/// consecutive ranges of this kind.
template <class S>
void Patches<S>::addRangeStages() {
    bool afterFew = false;
    for (const Colouring::Range& range : colouring_.ranges()) {
        const bool few = range.last - range.first < 2 * threads_;
        if (few && afterFew) {
            for (std::size_t chunk = 1; chunk <= threads_; ++chunk)
                splits_[stages_.back().splits + chunk][0] = range.last;
            continue;
        }
        afterFew = few;
        stages_.push_back({splits_.size(), !few});
        for (std::size_t chunk = 0; chunk <= threads_; ++chunk) {
            Colouring::Split next{chunk == 0 ? range.first : range.last};
            if (!few) next = colouring_.split(range, fractions_[chunk]);
            for (std::uint32_t c = 0; c < Colouring::kSizeClasses && chunk > 0; ++c)
                next[c] = std::max(next[c], splits_.back()[c]);
            splits_.push_back(next);
        }
    }
}

template <class S>
typename S::Real Patches<S>::solvePass(std::span<Velocity<S>> velocities, const PatchPass& pass,
                                       bool warmStart, const Tasks& tasks) {
    velocities_.refer(velocities);
    const Velocity<F>* const delta = warmStart && impulseDeltaValid_ ? impulseDelta_.data() : nullptr;
    std::atomic<PatchReal> change = 0;
    // One sequence of stages: load the velocities; warm start, if needed; solve; store the velocities, each
    // by the thread whose partition it belongs to.
    const std::size_t n = stages_.size(), warm = warmStart && delta == nullptr ? n : 0;
    tasks.forStages(1 + warm + n, [&](std::size_t stage, std::size_t chunk) {
        const std::size_t from = firstBody(chunk, tasks), to = firstBody(chunk + 1, tasks);
        if (stage == 0) return velocities_.begin(from, to, delta);
        const Stage& blocks = stages_[(stage - 1) % n];
        if (stage <= warm)
            return forChunk(blocks, chunk,
                            [&](auto first, auto last) { warmStartPatches<F>(range(first, last)); });
        forChunk(blocks, chunk, [&](auto first, auto last) { solvePatches<F>(range(first, last), pass); });
        if (stage == warm + n && from < to)
            raise(change, velocities_.end(from, to, impulseDelta_.data(), !warmStart));
    });
    impulseDeltaValid_ = impulseDeltaValid_ || warmStart;
    return static_cast<Real>(change.load());
}

template <class S>
void Patches<S>::advance(std::span<const Velocity<S>> used, Real h, const Tasks& tasks) {
    tasks.forChunks(used.size(), kBodyGrain, [&](std::size_t first, std::size_t last) {
        numbers(motions_.data(), first, last) +=
            (h * numbers(used.data(), first, last)).template cast<PatchReal>();
    });
}

template <class S>
void Patches<S>::beginSubstep(std::span<Velocity<S>> velocities, const PatchPass& pass, const Tasks& tasks) {
    if (!bounce_) return;
    impulseDeltaValid_ = false;  // prepareBounces may reset impulses
    velocities_.refer(velocities);
    if constexpr (PatchVelocities<S>::kSplit)
        tasks.forChunks(velocities.size(), kBodyGrain, [&](std::size_t first, std::size_t last) {
            velocities_.begin(first, last, nullptr);
        });
    tasks.forRanges(blocks(), kBlockGrain, [&](std::size_t first, std::size_t last) {
        prepareBounces<F>(range(first, last), pass);
    });
}

RIGOR_INSTANTIATE_CLASS(Patches)

}  // namespace rigor::engine
