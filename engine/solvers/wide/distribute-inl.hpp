// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Distributes the friction of each patch over its points: for the warm start of the next step and for the
// contact impulses that a world reports. With weights w_i (the points' normal impulses, sum 1), their mean m
// and s_i = n x (r_i - m), point i gets
//     f_i = w_i (f + k s_i),   k = (moment about the normal that f at m lacks) / sum w_i s_i . s_i
#if defined(RIGOR_DISTRIBUTE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGOR_DISTRIBUTE_INL_HPP
#undef RIGOR_DISTRIBUTE_INL_HPP
#else
#define RIGOR_DISTRIBUTE_INL_HPP
#endif

#include "engine/math/lanes-inl.hpp"
#include "engine/solvers/wide/kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {

/// Distributes a force and a moment about the normal over the points, weighted by their normal impulses.
template <class S, class Weight, class Write>
HWY_INLINE void distribute(const PatchBlock<S>& block, const PatchColdData<S>& cold, At<S> at,
                           const LinVec<S>& force, Num<S> torsion, const Weight& weightOf,
                           const Write& write) {
    const Num<S> zero = hn::Zero(Tag<S>());
    Num<S> sum = zero;
    for (int i = 0; i < block.points; ++i) sum = sum + weightOf(block.point[i]);
    const Num<S> scale = inverseOrZero(sum);
    if constexpr (S::dim == 2) {
        for (int i = 0; i < block.points; ++i) {
            const Num<S> part = weightOf(block.point[i]) * scale;
            write(i, LinVec<S>{part * force[0], part * force[1]});
        }
        (void)torsion;
    } else {
        LinVec<S> mean{zero, zero, zero};
        for (int i = 0; i < block.points; ++i) add(mean, weightOf(block.point[i]) * scale, at(cold.armB[i]));
        const LinVec<S> normal = at(block.normal);
        const Num<S> left = torsion - dot(normal, moment(minus(mean, at(block.center)), force));
        Num<S> spread = zero, size = zero;
        for (int i = 0; i < block.points; ++i) {
            const LinVec<S> side = moment(normal, minus(at(cold.armB[i]), mean));
            spread = spread + weightOf(block.point[i]) * scale * dot(side, side);
            size = hn::Max(size, dot(at(cold.armB[i]), at(cold.armB[i])));
        }
        // Points whose distance is only rounding carry no moment.
        const auto distinct = spread > number<S>(typename S::Real(1e-6)) * size;
        const Num<S> turn = hn::IfThenElseZero(distinct, left * inverseOrZero(spread));
        for (int i = 0; i < block.points; ++i) {
            const Num<S> part = weightOf(block.point[i]) * scale;
            LinVec<S> own = moment(normal, minus(at(cold.armB[i]), mean));
            for (std::size_t k = 0; k < 3; ++k) own[k] = part * (force[k] + turn * own[k]);
            write(i, own);
        }
    }
}

template <class S>
HWY_INLINE void distributeLanes(const PatchBlock<S>& block, const PatchColdData<S>& cold,
                                PatchFriction<S>& friction, At<S> at) {
    const LinVec<S> normal = at(block.normal);
    const auto force = [&](const auto& impulses) RIGOR_INLINE_LAMBDA -> LinVec<S> {
        const Num<S> first = at(impulses[0]);
        if constexpr (S::dim == 2) {
            return {hn::Zero(Tag<S>()) - first * normal[1], first * normal[0]};
        } else {
            const LinVec<S> t = at(block.tangent);
            LinVec<S> sum{first * t[0], first * t[1], first * t[2]};
            add(sum, at(impulses[1]), moment(normal, t));
            return sum;
        }
    };
    Num<S> torsion = hn::Zero(Tag<S>()), torsionTotal = torsion;
    if constexpr (S::dim == 3) {
        torsion = at(block.torsionImpulse);
        torsionTotal = at(block.torsionTotal);
    }
    distribute<S>(
        block, cold, at, force(block.frictionImpulse), torsion,
        [&](const auto& p) RIGOR_INLINE_LAMBDA { return at(p.impulse); },
        [&](int i, const LinVec<S>& f) RIGOR_INLINE_LAMBDA { at.set(friction.last[i], f); });
    distribute<S>(
        block, cold, at, force(block.frictionTotal), torsionTotal,
        [&](const auto& p) RIGOR_INLINE_LAMBDA { return at(p.total); },
        [&](int i, const LinVec<S>& f) RIGOR_INLINE_LAMBDA { at.set(friction.total[i], f); });
}

template <class S>
void distributeAll(const PatchRange<S>& range) {
    const std::size_t lanes = hn::Lanes(Tag<S>());
    for (std::size_t k = 0; k < range.count; ++k)
        for (std::size_t first = 0; first < kLanes; first += lanes)
            distributeLanes(range.blocks[k], range.cold[k], range.pointFriction[k], At<S>{first});
}

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
