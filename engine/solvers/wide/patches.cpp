// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/wide/patches.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

namespace rigor::engine {
namespace {

constexpr std::size_t kBlockGrain = 8;  ///< worth sharing: some microseconds of work

/// Raises `largest` to at least x.
template <class R>
void raise(std::atomic<R>& largest, R x) {
    R seen = largest.load();
    while (seen < x && !largest.compare_exchange_weak(seen, x)) {
    }
}

}  // namespace

template <class S>
std::size_t Patches<S>::rows() const {
    constexpr std::size_t friction = S::dim == 3 ? S::tangents + 1 : S::tangents;
    return points() + friction * size();
}

template <class S>
void Patches<S>::place(const BodyArrays<S>& bodies, const Tasks& tasks) {
    const std::size_t n = bodies.size();
    if (std::exchange(changed_, false)) {  // else, as in most steps, everybody stays in place
        colouring_.colour(plans_, n, kLanes, tasks);
        before_.clear();
        // What is over is kept for the next time there are more.
        if (blocks_.size() < blocks()) {
            blocks_.resize(blocks());
            rests_.resize(blocks());
        }
    }
    inertia_.resize(n);
    motions_.resize(n);
    velocities_.resize(n);
    gained_.resize(n);
    cut(tasks);
    gainedHolds_ = bounce_ = false;
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
    tasks.forShares(n, kBodyGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) begin(i);
    });
}

/// Stages for shares after the threads' speed; unless all is as it was.
template <class S>
void Patches<S>::cut(const Tasks& tasks) {
    threads_ = static_cast<std::size_t>(tasks.threads());
    bool holds = before_.size() == threads_ + 1;
    before_.resize(threads_ + 1);
    for (std::size_t share = 0; share <= threads_; ++share) {
        const double before = tasks.before(share);
        holds = std::exchange(before_[share], before) == before && holds;
    }
    if (holds) return;
    stages_.clear();
    cuts_.clear();
    if (threads_ > 1) addRangeStages();
    addRegionStage();
}

/// Regions are cut where as many of their blocks come before as belong there, to half a region. A thread
/// alone does all blocks in one go.
template <class S>
void Patches<S>::addRegionStage() {
    const std::span<const Colouring::Region> regions = colouring_.regions();
    firstRegion_.assign(threads_ + 1, 0);
    stages_.push_back({cuts_.size(), false});
    const std::uint32_t first = threads_ > 1 ? regions.front().first : 0, last = regions.back().last;
    cuts_.push_back({first});
    for (std::size_t share = 1; share <= threads_; ++share) {
        const double before = first + before_[share] * (last - first);
        std::size_t& r = firstRegion_[share];
        r = share < threads_ ? firstRegion_[share - 1] : regions.size();
        while (r < regions.size() && 0.5 * (regions[r].first + regions[r].last) < before) ++r;
        cuts_.push_back({r < regions.size() ? regions[r].first : last});
    }
}

/// Few blocks are not worth sharing: the first thread does them, and goes on with the next ones if these are
/// few as well.
template <class S>
void Patches<S>::addRangeStages() {
    bool afterFew = false;
    for (const Colouring::Range& range : colouring_.ranges()) {
        const bool few = range.last - range.first < 2 * threads_;
        if (few && afterFew) {
            for (std::size_t share = 1; share <= threads_; ++share)
                cuts_[stages_.back().cuts + share][0] = range.last;
            continue;
        }
        afterFew = few;
        stages_.push_back({cuts_.size(), !few});
        for (std::size_t share = 0; share <= threads_; ++share) {
            Colouring::Cut next{share == 0 ? range.first : range.last};
            if (!few) next = colouring_.cut(range, before_[share]);
            for (std::uint32_t kind = 0; kind < Colouring::kKinds && share > 0; ++kind)
                next[kind] = std::max(next[kind], cuts_.back()[kind]);
            cuts_.push_back(next);
        }
    }
}

template <class S>
typename S::Real Patches<S>::visit(std::span<Velocity<S>> velocities, const PatchPass& pass, bool warmStart,
                                   const Tasks& tasks) {
    velocities_.refer(velocities);
    const Velocity<F>* const gained = warmStart && gainedHolds_ ? gained_.data() : nullptr;
    std::atomic<PatchReal> change = 0;
    // One run: what bodies begin with; all stages once or twice; how bodies end, by those who have worked on
    // them in the last one.
    const std::size_t n = stages_.size(), warm = warmStart && gained == nullptr ? n : 0;
    tasks.forStages(1 + warm + n, [&](std::size_t stage, std::size_t share) {
        const std::size_t from = bodyOf(share, tasks), to = bodyOf(share + 1, tasks);
        if (stage == 0) return velocities_.begin(from, to, gained);
        const Stage& blocks = stages_[(stage - 1) % n];
        if (stage <= warm)
            return ofShare(blocks, share,
                           [&](auto first, auto last) { warmStartPatches<F>(range(first, last)); });
        ofShare(blocks, share, [&](auto first, auto last) { solvePatches<F>(range(first, last), pass); });
        if (stage == warm + n && from < to)
            raise(change, velocities_.end(from, to, gained_.data(), !warmStart));
    });
    gainedHolds_ = gainedHolds_ || warmStart;
    return static_cast<Real>(change.load());
}

template <class S>
void Patches<S>::advance(std::span<const Velocity<S>> used, Real h, const Tasks& tasks) {
    tasks.forShares(used.size(), kBodyGrain, [&](std::size_t first, std::size_t last) {
        numbers(motions_.data(), first, last) +=
            (h * numbers(used.data(), first, last)).template cast<PatchReal>();
    });
}

template <class S>
void Patches<S>::beginSubstep(std::span<Velocity<S>> velocities, const PatchPass& pass, const Tasks& tasks) {
    if (!bounce_) return;
    gainedHolds_ = false;  // impulses may change
    velocities_.refer(velocities);
    if constexpr (PatchVelocities<S>::kSplit)
        tasks.forShares(velocities.size(), kBodyGrain, [&](std::size_t first, std::size_t last) {
            velocities_.begin(first, last, nullptr);
        });
    tasks.forRanges(blocks(), kBlockGrain,
                    [&](std::size_t first, std::size_t last) { planPatches<F>(range(first, last), pass); });
}

RIGOR_INSTANTIATE_CLASS(Patches)

}  // namespace rigor::engine
