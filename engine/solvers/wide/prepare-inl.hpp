// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Makes the rows of patches from the manifolds of the narrow phase.
//
// The center of a patch is its center of pressure in the last step: the mean of its points weighted by their
// normal impulses. Friction there has the moment that friction at the points would have.
#if defined(RIGOR_PREPARE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGOR_PREPARE_INL_HPP
#undef RIGOR_PREPARE_INL_HPP
#else
#define RIGOR_PREPARE_INL_HPP
#endif

#include "engine/math/lanes-inl.hpp"
#include "engine/solvers/wide/kernels.hpp"
#include "engine/solvers/wide/moments-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {

/// First unit tangent of n in 3D, the same as in contact_rows.cpp.
template <class S>
HWY_INLINE LinVec<S> firstTangent(const LinVec<S>& n) {
    // x cross n or y cross n, whichever is longer.
    const Num<S> zero = hn::Zero(Tag<S>());
    const auto useX = hn::Abs(n[0]) < number<S>(typename S::Real(0.7));
    LinVec<S> t{hn::IfThenElse(useX, zero, n[2]), hn::IfThenElse(useX, zero - n[2], zero),
                hn::IfThenElse(useX, n[1], zero - n[0])};
    const Num<S> length2 = dot(t, t);
    const Num<S> scale = number<S>(1) / hn::Sqrt(hn::IfThenElse(length2 > zero, length2, number<S>(1)));
    for (auto& x : t) x = x * scale;
    return t;
}

/// Reads the inertia and computes the derived numbers of a block from those filled in.
template <class S>
struct Preparation {
    using Real = typename S::Real;
    PatchBlock<S>& block;
    const PatchColdData<S>& cold;
    const PatchFriction<S>& pointFriction;
    At<S> at;
    std::array<Num<S>, PatchSize<S>::inertia> inertiaA, inertiaB;
    Num<S> mass;
    LinVec<S> normal, offset;

    HWY_INLINE Preparation(const PatchRange<S>& range, const PatchInertia<S>* inertia, std::size_t k,
                           std::size_t first)
        : block(range.blocks[k]),
          cold(range.cold[k]),
          pointFriction(range.pointFriction[k]),
          at{first},
          inertiaA(inertiaOf(inertia, block.a + first)),
          inertiaB(inertiaOf(inertia, block.b + first)),
          mass(at(block.invMassA) + at(block.invMassB)),
          normal(at(block.normal)),
          offset(at(block.offset)) {
        at.set(block.invInertiaA, inertiaA);
        at.set(block.invInertiaB, inertiaB);
    }
    static HWY_INLINE std::array<Num<S>, PatchSize<S>::inertia> inertiaOf(const PatchInertia<S>* inertia,
                                                                          const std::uint32_t* index) {
        const auto group = [&](int g) RIGOR_INLINE_LAMBDA {
            return [=](std::size_t lane) RIGOR_INLINE_LAMBDA {
                return static_cast<const Real*>(inertia[index[lane]].number + 4 * g);
            };
        };
        const auto q = gatherQuads(Tag<S>(), group(0));
        if constexpr (S::dim == 2) {
            return {q.x};
        } else {
            const auto r = gatherQuads(Tag<S>(), group(1));
            return {q.x, q.y, q.z, q.w, r.x, r.y};
        }
    }
    /// jA of the row along d whose arm on B is jB.
    HWY_INLINE AngVec<S> sideA(const AngVec<S>& jB, const LinVec<S>& d) const {
        AngVec<S> jA = jB;
        add(jA, number<S>(1), moment(offset, d));
        return jA;
    }

    HWY_INLINE void normals() const {
        const Num<S> zero = hn::Zero(Tag<S>());
        for (int i = 0; i < block.points; ++i) {
            PatchPoint<S>& point = block.point[i];
            const auto there = at(point.invK) > zero;
            const AngVec<S> jB = moment(at(cold.armB[i]), normal), jA = sideA(jB, normal);
            const AngVec<S> iA = times(inertiaA, jA), iB = times(inertiaB, jB);
            at.set(point.jB, jB);
            for (int k = 0; k <= i; ++k) {
                const AngVec<S> other = at(block.point[k].jB);
                at.set(block.K[pairAt(i, k)], mass + dot(sideA(other, normal), iA) + dot(other, iB));
            }
            const Num<S> own = at(block.K[pairAt(i, i)]);
            at.set(point.invK, hn::IfThenElseZero(there, inverseOrZero(own)));
            at.set(point.total, zero);
        }
    }

    /// Center of pressure from the centre of mass of B; the mean of the points where no impulse is known.
    HWY_INLINE LinVec<S> findCenter() const {
        const Num<S> zero = hn::Zero(Tag<S>()), one = number<S>(1);
        Num<S> pressure = zero;
        for (int i = 0; i < block.points; ++i) pressure = pressure + at(block.point[i].impulse);
        const auto loaded = invertible(pressure);
        Num<S> sum = zero;
        LinVec<S> center;
        for (auto& x : center) x = zero;
        for (int i = 0; i < block.points; ++i) {
            const PatchPoint<S>& point = block.point[i];
            const Num<S> there = hn::IfThenElseZero(at(point.invK) > zero, one);
            const Num<S> weight = hn::IfThenElse(loaded, at(point.impulse), there);
            add(center, weight, at(cold.armB[i]));
            sum = sum + weight;
        }
        const Num<S> scale = inverseOrZero(sum);
        for (auto& x : center) x = x * scale;
        return center;
    }

    /// Element of K between two directions of friction at the center.
    HWY_INLINE Num<S> tangentK(const LinVec<S>& center, const LinVec<S>& s, const LinVec<S>& t) const {
        const AngVec<S> sB = moment(center, s), tB = moment(center, t);
        return mass * dot(s, t) + dot(sideA(sB, s), times(inertiaA, sideA(tB, t))) +
               dot(sB, times(inertiaB, tB));
    }

    HWY_INLINE void friction() const {
        const Num<S> zero = hn::Zero(Tag<S>());
        const LinVec<S> center = findCenter();
        at.set(block.center, center);
        LinVec<S> force;
        for (auto& x : force) x = zero;
        for (int i = 0; i < block.points; ++i) add(force, number<S>(1), at(pointFriction.last[i]));
        for (auto& total : block.frictionTotal) at.set(total, zero);
        if constexpr (S::dim == 2) {
            const LinVec<S> t{zero - normal[1], normal[0]};
            at.set(block.frictionImpulse[0], dot(force, t));
            at.set(block.tangentMass, inverseOrZero(tangentK(center, t, t)));
        } else {
            const LinVec<S> t = firstTangent<S>(normal), u = moment(normal, t);
            at.set(block.tangent, t);
            at.set(block.frictionImpulse[0], dot(force, t));
            at.set(block.frictionImpulse[1], dot(force, u));
            const Num<S> tt = tangentK(center, t, t), uu = tangentK(center, u, u),
                         tu = tangentK(center, t, u);
            const Num<S> half = number<S>(Real(0.5)), difference = half * (tt - uu);
            Num<S> largest = half * (tt + uu) + hn::Sqrt(difference * difference + tu * tu);
            largest = hn::Max(largest, torsion(center));
            at.set(block.tangentMass, inverseOrZero(largest));
        }
    }

    /// Sets the initial torsional impulse and the radii; returns K of torsion, scaled like that of a force.
    HWY_INLINE Num<S> torsion(const LinVec<S>& center) const {
        const Num<S> zero = hn::Zero(Tag<S>());
        Num<S> impulse = zero, widest = zero;
        for (int i = 0; i < block.points; ++i) {
            const LinVec<S> arm = minus(at(cold.armB[i]), center);
            const Num<S> radius = hn::IfThenElseZero(at(block.point[i].invK) > zero, hn::Sqrt(dot(arm, arm)));
            at.set(block.radius[i], radius);
            widest = hn::Max(widest, radius);
            impulse = impulse + dot(normal, moment(arm, at(pointFriction.last[i])));
        }
        at.set(block.torsionImpulse, impulse);
        at.set(block.torsionTotal, zero);
        return widest * widest *
               (dot(normal, times(inertiaA, normal)) + dot(normal, times(inertiaB, normal)));
    }
};

template <class S>
void prepareAll(const PatchRange<S>& range, const PatchInertia<S>* inertia) {
    const std::size_t lanes = hn::Lanes(Tag<S>());
    for (std::size_t k = 0; k < range.count; ++k)
        for (std::size_t first = 0; first < kLanes; first += lanes) {
            const Preparation<S> preparation(range, inertia, k, first);
            preparation.normals();
            preparation.friction();
            if (range.blocks[k].moments) prepareMoments<S>(range.blocks[k], range.cold[k], At<S>{first});
        }
}

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
