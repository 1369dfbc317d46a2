// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/wide/patches.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rigor::engine {
namespace {

constexpr std::size_t kBlockGrain = 8;  ///< worth sharing: some microseconds of work

/// Where the groups of a PatchBody hold velocity and motion, and in them the angular part.
template <class S>
constexpr int kMotion = 2 * PatchBody<S>::groups;
template <class S>
constexpr int kAngular = S::dim == 3 ? 4 : 2;

template <class S>
void write(typename S::Real* numbers, const Velocity<S>& u) {
    for (int k = 0; k < S::dim; ++k) numbers[k] = u.v[k];
    if constexpr (S::dim == 3)
        for (int k = 0; k < 3; ++k) numbers[kAngular<S> + k] = u.w[k];
    else
        numbers[kAngular<S>] = u.w;
}

}  // namespace

template <class S>
void Patches<S>::clearLane(std::size_t b, std::size_t lane) {
    // Everything behind the head is lanes of numbers.
    PatchBlock<S>& block = blocks_[b];
    auto* lanes = reinterpret_cast<Real*>(&block) + offsetof(PatchBlock<S>, normal) / sizeof(Real);
    const std::size_t count = (sizeof(block) - offsetof(PatchBlock<S>, normal)) / sizeof(Lanes<Real>);
    for (std::size_t k = 0; k < count; ++k) lanes[k * kLanes + lane] = 0;
    block.a[lane] = block.b[lane] = 0;
}

template <class S>
std::size_t Patches<S>::points() const {
    std::size_t sum = 0;
    for (const PatchPlan& plan : plans_) sum += plan.points;
    return sum;
}
template <class S>
std::size_t Patches<S>::rows() const {
    constexpr std::size_t friction = S::dim == 3 ? S::tangents + 1 : S::tangents;
    return points() + friction * size();
}

template <class S>
void Patches<S>::place(std::size_t bodies) {
    colouring_.colour(plans_, bodies, kLanes);
    blocks_.resize(colouring_.blocks());
    bodies_.resize(bodies);
    inertia_.resize(bodies);
    for (PatchBlock<S>& block : blocks_) block.movesA = block.movesB = block.bounces = 0, block.points = 0;
    occupant_.assign(blocks_.size() * kLanes, kNobody);
    for (std::size_t k = 0; k < plans_.size(); ++k) occupant_[colouring_.places()[k]] = sources_[k];
}

template <class S>
void Patches<S>::prepare(const BodyArrays<S>& bodies, const Tasks& tasks) {
    load(bodies.velocity);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        std::fill(bodies_[i].number + kMotion<S>, bodies_[i].number + 4 * PatchBody<S>::groups, Real(0));
        Real* I = inertia_[i].number;
        const bool moves = bodies.invMass[i] > 0;
        if constexpr (S::dim == 3) {
            int next = 0;
            for (int row = 0; row < 3; ++row)
                for (int column = row; column < 3; ++column)
                    I[next++] = moves ? bodies.invInertia[i](row, column) : Real(0);
        } else {
            I[0] = moves ? bodies.invInertia[i] : Real(0);
        }
    }
    tasks.forRanges(blocks_.size(), kBlockGrain, [&](std::size_t first, std::size_t last) {
        preparePatches<S>({blocks_.data() + first, last - first, bodies_.data()}, inertia_.data());
    });
}

template <class S>
void Patches<S>::load(std::span<const Velocity<S>> velocities) {
    for (std::size_t i = 0; i < velocities.size(); ++i) write<S>(bodies_[i].number, velocities[i]);
}

template <class S>
typename S::Real Patches<S>::unload(std::span<Velocity<S>> velocities) const {
    Real change = 0;
    for (std::size_t i = 0; i < velocities.size(); ++i) {
        const Real* numbers = bodies_[i].number;
        const auto take = [&change](Real& to, Real from) {
            change = std::max(change, std::abs(from - to));
            to = from;
        };
        for (int k = 0; k < S::dim; ++k) take(velocities[i].v[k], numbers[k]);
        if constexpr (S::dim == 3)
            for (int k = 0; k < 3; ++k) take(velocities[i].w[k], numbers[kAngular<S> + k]);
        else
            take(velocities[i].w, numbers[kAngular<S>]);
    }
    return change;
}

/// Colour by colour: work on a range of blocks.
template <class S>
template <class Work>
void Patches<S>::forColours(const Tasks& tasks, const Work& work) {
    const std::span<const Colouring::Range> ranges = colouring_.ranges();
    tasks.forStages(
        ranges.size(), kBlockGrain,
        [&](std::size_t c) -> std::size_t { return ranges[c].last - ranges[c].first; },
        [&](std::size_t c, std::size_t first, std::size_t last) {
            work(PatchRange<S>{blocks_.data() + ranges[c].first + first, last - first, bodies_.data()});
        });
}

template <class S>
typename S::Real Patches<S>::visit(std::span<Velocity<S>> velocities, const PatchPass<Real>& pass,
                                   bool warmStart, const Tasks& tasks) {
    load(velocities);
    if (warmStart) forColours(tasks, [](const PatchRange<S>& range) { warmStartPatches<S>(range); });
    forColours(tasks, [&pass](const PatchRange<S>& range) { solvePatches<S>(range, pass); });
    return unload(velocities);
}

template <class S>
void Patches<S>::advance(std::span<const Velocity<S>> used, Real h) {
    for (std::size_t i = 0; i < used.size(); ++i) {
        Real* motion = bodies_[i].number + kMotion<S>;
        for (int k = 0; k < S::dim; ++k) motion[k] += h * used[i].v[k];
        if constexpr (S::dim == 3)
            for (int k = 0; k < 3; ++k) motion[kAngular<S> + k] += h * used[i].w[k];
        else
            motion[kAngular<S>] += h * used[i].w;
    }
}

template <class S>
void Patches<S>::beginSubstep(std::span<const Velocity<S>> velocities, const PatchPass<Real>& pass,
                              const Tasks& tasks) {
    if (std::none_of(blocks_.begin(), blocks_.end(), [](const auto& block) { return block.bounces != 0; }))
        return;
    load(velocities);
    tasks.forRanges(blocks_.size(), kBlockGrain, [&](std::size_t first, std::size_t last) {
        planPatches<S>({blocks_.data() + first, last - first, bodies_.data()}, pass);
    });
}

template <class S>
void Patches<S>::share(const Tasks& tasks) {
    tasks.forRanges(blocks_.size(), kBlockGrain, [&](std::size_t first, std::size_t last) {
        sharePatches<S>({blocks_.data() + first, last - first, bodies_.data()});
    });
}

template class Patches<Space2f>;
template class Patches<Space2d>;
template class Patches<Space3f>;
template class Patches<Space3d>;

}  // namespace rigor::engine
