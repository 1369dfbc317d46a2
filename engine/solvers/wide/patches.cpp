// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/wide/patches.hpp"

#include <algorithm>
#include <atomic>

namespace rigor::engine {
namespace {

constexpr std::size_t kBlockGrain = 8, kBodyGrain = 512;  ///< worth sharing: some microseconds of work
constexpr std::size_t kChunk = 64;                        ///< of bodies: as much work as a block

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
    inertia_.resize(n), motions_.resize(n), velocities_.resize(n), gained_.resize(n);
    gainedHolds_ = bounce_ = false;
    tasks.forEach(n, kBodyGrain, [&](std::size_t i) {
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
    });
}

template <class S>
typename S::Real Patches<S>::visit(std::span<Velocity<S>> velocities, const PatchPass& pass, bool warmStart,
                                   const Tasks& tasks) {
    velocities_.refer(velocities);
    const Velocity<F>* const gained = warmStart && gainedHolds_ ? gained_.data() : nullptr;
    std::atomic<PatchReal> change = 0;
    // One run of stages: bodies, all colours once or twice, bodies.
    const std::span<const Colouring::Range> ranges = colouring_.ranges();
    const std::size_t colours = ranges.size(), warm = warmStart && gained == nullptr ? colours : 0;
    const std::size_t last = 1 + warm + colours, n = velocities.size();
    const std::size_t chunks = (n + kChunk - 1) / kChunk;
    const auto cut = [&](std::size_t stage, std::size_t share, std::size_t of) -> std::size_t {
        if (stage == 0 || stage == last) return chunks * share / of;
        return ranges[(stage - 1) % colours].begin(share, of);
    };
    tasks.forCutStages(last + 1, kGrain, cut, [&](std::size_t stage, std::size_t from, std::size_t to) {
        if (stage == 0)
            velocities_.begin(from * kChunk, std::min(to * kChunk, n), gained);
        else if (stage == last)
            raise(change,
                  velocities_.end(from * kChunk, std::min(to * kChunk, n), gained_.data(), !warmStart));
        else if (stage <= warm)
            warmStartPatches<F>(range(from, to));
        else
            solvePatches<F>(range(from, to), pass);
    });
    gainedHolds_ = gainedHolds_ || warmStart;
    return static_cast<Real>(change.load());
}

template <class S>
void Patches<S>::advance(std::span<const Velocity<S>> used, Real h, const Tasks& tasks) {
    tasks.forRanges(used.size(), kBodyGrain, [&](std::size_t first, std::size_t last) {
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
        tasks.forRanges(velocities.size(), kBodyGrain, [&](std::size_t first, std::size_t last) {
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
