// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/wide/patches.hpp"

#include <algorithm>
#include <atomic>

namespace rigor::engine {
namespace {

constexpr std::size_t kBlockGrain = 8;  ///< worth sharing: some microseconds of work
constexpr std::size_t kBodyGrain = 64;  ///< as much work as a block

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
    if (offered_ != lastOffered_) {  // else, as in most steps, everybody stays in place
        plans_.clear(), sources_.clear();
        points_ = 0;
        for (std::uint32_t k = 0; k < offered_.size(); ++k)
            if (offered_[k].points > 0) {
                plans_.push_back(offered_[k]), sources_.push_back(k);
                points_ += offered_[k].points;
            }
        colouring_.colour(plans_, n, kLanes);
        blocks_.resize(colouring_.blocks());
        rests_.resize(colouring_.blocks());
        occupant_.assign(blocks_.size() * kLanes, kNobody);
        for (std::size_t k = 0; k < plans_.size(); ++k) occupant_[colouring_.places()[k]] = sources_[k];
    }
    cut(tasks);
    inertia_.resize(n), motions_.resize(n), velocities_.resize(n), gained_.resize(n);
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

/// Few blocks are not worth sharing: the first thread does them.
template <class S>
void Patches<S>::cut(const Tasks& tasks) {
    threads_ = static_cast<std::size_t>(tasks.threads());
    cuts_.clear();
    for (const Colouring::Range& range : colouring_.ranges()) {
        const bool few = range.last - range.first < 2 * threads_;
        cuts_.push_back(Colouring::cut(range, 0));
        for (std::size_t share = 1; share <= threads_; ++share) {
            Colouring::Cut next = Colouring::cut(range, few ? 1.0 : tasks.before(share));
            for (std::uint32_t kind = 0; kind < Colouring::kKinds; ++kind)
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
    // One run of stages: bodies, all colours once or twice, bodies.
    const std::size_t colours = colouring_.ranges().size(),
                      warm = warmStart && gained == nullptr ? colours : 0;
    const std::size_t last = 1 + warm + colours, n = velocities.size();
    tasks.forStages(last + 1, [&](std::size_t stage, std::size_t share) {
        if (stage == 0 || stage == last) {
            const std::size_t from = tasks.cut(n, kBodyGrain, share),
                              to = tasks.cut(n, kBodyGrain, share + 1);
            if (stage == 0)
                velocities_.begin(from, to, gained);
            else if (from < to)
                raise(change, velocities_.end(from, to, gained_.data(), !warmStart));
        } else if (stage <= warm) {
            ofShare(stage - 1, share, [&](auto first, auto end) { warmStartPatches<F>(range(first, end)); });
        } else {
            ofShare(stage - 1 - warm, share,
                    [&](auto first, auto end) { solvePatches<F>(range(first, end), pass); });
        }
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
    tasks.forRanges(blocks_.size(), kBlockGrain,
                    [&](std::size_t first, std::size_t last) { planPatches<F>(range(first, last), pass); });
}

template class Patches<Space2f>;
template class Patches<Space2d>;
template class Patches<Space3f>;
template class Patches<Space3d>;

}  // namespace rigor::engine
