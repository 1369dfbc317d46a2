// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rolling and torsional friction of patches, and surfaces that move over their bodies. With w = wB - wA, and m the
// angular impulse on B along (t1, t2, n), 2D: about +z,
//     rolling     m_t := P(m_t - w_t / k_t),  P the projection on the disc of radius rho_r sum lambda_i
//     torsional   m_n := clamp(m_n - w_n / k_n, +- rho_t sum lambda_i)
// with k_t the largest eigenvalue of IA^-1 + IB^-1 in the tangent plane and k_n its element along n: at a fixed
// point the moment opposes w, which is the law of moment_rows.hpp.
#if defined(RIGOR_MOMENTS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGOR_MOMENTS_INL_HPP
#undef RIGOR_MOMENTS_INL_HPP
#else
#define RIGOR_MOMENTS_INL_HPP
#endif

#include "engine/math/lanes-inl.hpp"
#include "engine/solvers/wide/kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {

/// The axes that moments have components along: t1, t2, n; in 2D 1.
template <class S>
HWY_INLINE std::array<AngVec<S>, PatchSize<S>::ang> momentAxes([[maybe_unused]] const PatchBlock<S>& block,
                                                               [[maybe_unused]] At<S> at) {
    if constexpr (S::dim == 2) {
        return {AngVec<S>{number<S>(1)}};
    } else {
        const LinVec<S> t = at(block.tangent), n = at(block.normal);
        return {t, moment(n, t), n};
    }
}

/// Makes the numbers of a block that solveMoments reads. The initial impulse is given in world axes.
template <class S>
HWY_INLINE void prepareMoments(const PatchBlock<S>& block, PatchColdData<S>& cold, At<S> at) {
    const auto axes = momentAxes<S>(block, at);
    const auto inertiaA = at(block.invInertiaA), inertiaB = at(block.invInertiaB);
    const auto K = [&](std::size_t i, std::size_t k) RIGOR_INLINE_LAMBDA {
        return dot(axes[i], times(inertiaA, axes[k])) + dot(axes[i], times(inertiaB, axes[k]));
    };
    Num<S> rolling = K(0, 0);
    if constexpr (S::dim == 3) {
        const Num<S> half = number<S>(typename S::Real(0.5)), tt = rolling, uu = K(1, 1), tu = K(0, 1);
        const Num<S> difference = half * (tt - uu);
        rolling = half * (tt + uu) + hn::Sqrt(difference * difference + tu * tu);
        at.set(cold.torsionalMass, inverseOrZero(K(2, 2)));
    }
    at.set(cold.rollingMass, inverseOrZero(rolling));
    const AngVec<S> last = at(cold.moment);
    for (std::size_t k = 0; k < axes.size(); ++k) {
        at.set(cold.moment[k], dot(axes[k], last));
        at.set(cold.momentTotal[k], hn::Zero(Tag<S>()));
    }
}

/// Applies an angular impulse given along the axes.
template <class S, class Group>
HWY_INLINE void applyMoment(Group& p, const AngVec<S>& impulse) {
    const auto axes = momentAxes<S>(p.block, p.at);
    AngVec<S> whole;
    for (std::size_t k = 0; k < whole.size(); ++k) whole[k] = impulse[0] * axes[0][k];
    for (std::size_t i = 1; i < axes.size(); ++i) add(whole, impulse[i], axes[i]);
    p.applyAngularImpulse(whole, whole);
}

/// One pass of a patch of the normal impulse `load`.
template <class S, class Group>
HWY_INLINE void solveMoments(Group& p, Num<S> load, bool last) {
    PatchColdData<S>& cold = p.cold;
    const Num<S> one = number<S>(1);
    const auto axes = momentAxes<S>(p.block, p.at);
    AngVec<S> w = p.velocity().w;
    if (p.block.driven) add(w, one, p.at(cold.surfaceW));
    const AngVec<S> old = p.at(cold.moment);
    AngVec<S> next = old;
    constexpr std::size_t tangents = PatchSize<S>::tangents;
    const Num<S> mass = p.at(cold.rollingMass), bound = p.at(cold.rollingFriction) * load;
    Num<S> size2 = hn::Zero(Tag<S>());
    for (std::size_t k = 0; k < tangents; ++k) {
        next[k] = old[k] - mass * dot(axes[k], w);
        size2 = size2 + next[k] * next[k];
    }
    const auto within = size2 <= bound * bound;
    const Num<S> scale = hn::IfThenElse(within, one, bound / hn::Sqrt(hn::IfThenElse(within, one, size2)));
    for (std::size_t k = 0; k < tangents; ++k) next[k] = scale * next[k];
    if constexpr (S::dim == 3) {
        const Num<S> most = p.at(cold.torsionalFriction) * load;
        const Num<S> free = old[2] - p.at(cold.torsionalMass) * dot(axes[2], w);
        next[2] = hn::Max(hn::Min(free, most), hn::Zero(Tag<S>()) - most);
    }
    p.at.set(cold.moment, next);
    if (last)
        for (std::size_t k = 0; k < next.size(); ++k)
            p.at.set(cold.momentTotal[k], p.at(cold.momentTotal[k]) + next[k]);
    applyMoment<S>(p, minus(next, old));
}

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
