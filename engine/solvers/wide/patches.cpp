// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/wide/patches.hpp"

#include <algorithm>
#include <atomic>

#include "engine/state/numbers.hpp"

namespace rigor::engine {
namespace {

constexpr std::size_t kBlockGrain = 8, kBodyGrain = 512;  ///< worth sharing: some microseconds of work

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
    inertia_.resize(n), motions_.resize(n), before_.resize(n), gained_.resize(n);
    gainedHolds_ = bounce_ = false;
    tasks.forEach(n, kBodyGrain, [&](std::size_t i) {
        motions_[i] = {};
        Real* I = inertia_[i].number;
        const bool moves = bodies.invMass[i] > 0;
        if constexpr (S::dim == 3) {
            for (int row = 0; row < 3; ++row)
                for (int column = row; column < 3; ++column)
                    *I++ = moves ? bodies.invInertia[i](row, column) : Real(0);
        } else {
            *I = moves ? bodies.invInertia[i] : Real(0);
        }
    });
}

template <class S>
typename S::Real Patches<S>::visit(std::span<Velocity<S>> velocities, const PatchPass<Real>& pass,
                                   bool warmStart, const Tasks& tasks) {
    Velocity<S>* const v = velocities.data();
    const bool addGained = warmStart && gainedHolds_;
    tasks.forRanges(velocities.size(), kBodyGrain, [&](std::size_t first, std::size_t last) {
        numbers(before_.data(), first, last) = numbers(v, first, last);
        if (addGained) numbers(v, first, last) += numbers(gained_.data(), first, last);
    });
    if (warmStart && !addGained)
        forStages(tasks,
                  [&](std::size_t first, std::size_t last) { warmStartPatches<S>(range(first, last, v)); });
    forStages(tasks,
              [&](std::size_t first, std::size_t last) { solvePatches<S>(range(first, last, v), pass); });
    std::atomic<Real> change = 0;
    tasks.forRanges(velocities.size(), kBodyGrain, [&](std::size_t first, std::size_t last) {
        auto gained = numbers(gained_.data(), first, last);
        const auto made = numbers(v, first, last) - numbers(before_.data(), first, last);
        raise(change, made.abs().maxCoeff());
        if (warmStart)
            gained = made;
        else
            gained += made;
    });
    gainedHolds_ = gainedHolds_ || warmStart;
    return change;
}

template <class S>
void Patches<S>::advance(std::span<const Velocity<S>> used, Real h, const Tasks& tasks) {
    tasks.forRanges(used.size(), kBodyGrain, [&](std::size_t first, std::size_t last) {
        numbers(motions_.data(), first, last) += h * numbers(used.data(), first, last);
    });
}

template <class S>
void Patches<S>::beginSubstep(std::span<Velocity<S>> velocities, const PatchPass<Real>& pass,
                              const Tasks& tasks) {
    if (!bounce_) return;
    gainedHolds_ = false;  // impulses may change
    tasks.forRanges(blocks_.size(), kBlockGrain, [&](std::size_t first, std::size_t last) {
        planPatches<S>(range(first, last, velocities.data()), pass);
    });
}

template class Patches<Space2f>;
template class Patches<Space2d>;
template class Patches<Space3f>;
template class Patches<Space3d>;

}  // namespace rigor::engine
