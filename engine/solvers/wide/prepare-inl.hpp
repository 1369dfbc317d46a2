// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rows of patches from what the narrow phase has found, and friction shared out among their points.
//
// The centre of a patch is that of its pressure, as far as the last step knows it: the mean of its points
// weighted by their impulses. Friction there has the moment that friction at the points would have.
#if defined(RIGOR_PREPARE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGOR_PREPARE_INL_HPP
#undef RIGOR_PREPARE_INL_HPP
#else
#define RIGOR_PREPARE_INL_HPP
#endif

#include "engine/solvers/wide/kernels.hpp"
#include "engine/solvers/wide/vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {

/// A symmetric inertia, or a number in 2D.
template <class S>
struct InertiaLanes {
    std::array<Num<S>, PatchSize<S>::inertia> m;

    HWY_INLINE InertiaLanes(const PatchInertia<S>* inertia, const std::uint32_t* index) {
        using Real = typename S::Real;
        const auto at = [&](int group) {
            return [=](std::size_t lane) {
                return static_cast<const Real*>(inertia[index[lane]].number + 4 * group);
            };
        };
        const auto q = gatherQuads(Tag<S>(), at(0));
        if constexpr (S::dim == 2) {
            m = {q.x};
        } else {
            const auto r = gatherQuads(Tag<S>(), at(1));
            m = {q.x, q.y, q.z, q.w, r.x, r.y};
        }
    }
    HWY_INLINE AngVec<S> operator*(const AngVec<S>& v) const {
        if constexpr (S::dim == 2)
            return {m[0] * v[0]};
        else
            return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[1] * v[0] + m[3] * v[1] + m[4] * v[2],
                    m[2] * v[0] + m[4] * v[1] + m[5] * v[2]};
    }
};

/// Unit tangents that with n form a right-handed frame: those of contact_rows.cpp.
template <class S>
HWY_INLINE std::array<LinVec<S>, PatchSize<S>::tangents> tangents(const LinVec<S>& n) {
    if constexpr (S::dim == 2) {
        return {LinVec<S>{hn::Zero(Tag<S>()) - n[1], n[0]}};
    } else {
        // x cross n or y cross n, whichever is longer.
        const Num<S> zero = hn::Zero(Tag<S>());
        const auto useX = hn::Abs(n[0]) < number<S>(typename S::Real(0.7));
        LinVec<S> t{hn::IfThenElse(useX, zero, n[2]), hn::IfThenElse(useX, zero - n[2], zero),
                    hn::IfThenElse(useX, n[1], zero - n[0])};
        const Num<S> length2 = dot(t, t);
        const Num<S> scale = number<S>(1) / hn::Sqrt(hn::IfThenElse(length2 > zero, length2, number<S>(1)));
        for (auto& x : t) x = x * scale;
        return {t, moment(n, t)};
    }
}

template <class S>
struct Preparation {
    using Real = typename S::Real;
    PatchBlock<S>& block;
    At<S> at;
    InertiaLanes<S> inertiaA, inertiaB;
    Num<S> mass;
    LinVec<S> normal;

    /// Angular parts of a row with the given arms and direction; returns K.
    HWY_INLINE Num<S> makeRow(const LinVec<S>& armA, const LinVec<S>& armB, const LinVec<S>& direction,
                              PatchRow<S>& row) const {
        const AngVec<S> jA = moment(armA, direction), jB = moment(armB, direction);
        const AngVec<S> iA = inertiaA * jA, iB = inertiaB * jB;
        at.set(row.jA, jA), at.set(row.jB, jB), at.set(row.iA, iA), at.set(row.iB, iB);
        return mass + dot(jA, iA) + dot(jB, iB);
    }

    HWY_INLINE void normals() const {
        const Num<S> zero = hn::Zero(Tag<S>());
        for (int i = 0; i < block.points; ++i) {
            PatchPoint<S>& point = block.point[i];
            const auto there = at(point.invK) > zero;
            const Num<S> K = makeRow(at(point.armA), at(point.armB), normal, point.row);
            at.set(point.invK, hn::IfThenElseZero(there, inverseOrZero(K)));
            at.set(point.total, zero);
        }
    }

    /// The mean of the points, weighted by their impulses where there are some.
    HWY_INLINE void findCentre(LinVec<S>& centreA, LinVec<S>& centreB) const {
        const Num<S> zero = hn::Zero(Tag<S>()), one = number<S>(1);
        Num<S> pressure = zero;
        for (int i = 0; i < block.points; ++i) pressure = pressure + at(block.point[i].impulse);
        const auto pressed = invertible(pressure);
        Num<S> sum = zero;
        for (auto& x : centreA) x = zero;
        centreB = centreA;
        for (int i = 0; i < block.points; ++i) {
            const PatchPoint<S>& point = block.point[i];
            const Num<S> there = hn::IfThenElseZero(at(point.invK) > zero, one);
            const Num<S> weight = hn::IfThenElse(pressed, at(point.impulse), there);
            add(centreA, weight, at(point.armA));
            add(centreB, weight, at(point.armB));
            sum = sum + weight;
        }
        const Num<S> scale = inverseOrZero(sum);
        for (auto& x : centreA) x = x * scale;
        for (auto& x : centreB) x = x * scale;
        at.set(block.centre, centreB);
    }

    HWY_INLINE void friction() const {
        const Num<S> zero = hn::Zero(Tag<S>());
        LinVec<S> centreA, centreB;
        findCentre(centreA, centreB);
        const auto t = tangents<S>(normal);
        LinVec<S> force{zero, zero};
        Num<S> twist = zero, widest = zero;
        if constexpr (S::dim == 3) force[2] = zero;
        for (int i = 0; i < block.points; ++i) {
            PatchPoint<S>& point = block.point[i];
            const LinVec<S> rub = at(point.rub), arm = minus(at(point.armB), centreB);
            add(force, number<S>(1), rub);
            const Num<S> radius = hn::IfThenElseZero(at(point.invK) > zero, hn::Sqrt(dot(arm, arm)));
            at.set(point.radius, radius);
            widest = hn::Max(widest, radius);
            if constexpr (S::dim == 3) twist = twist + dot(normal, moment(arm, rub));
        }
        constexpr std::size_t last = PatchSize<S>::tangents - 1;
        std::array<Num<S>, last + 1> K;
        for (std::size_t k = 0; k <= last; ++k) {
            at.set(block.tangent[k], t[k]);
            K[k] = makeRow(centreA, centreB, t[k], block.rub[k]);
            at.set(block.rubImpulse[k], dot(force, t[k]));
            at.set(block.rubTotal[k], zero);
        }
        Num<S> largest = K[0];
        if constexpr (S::dim == 3) {
            const Num<S> K12 = mass * dot(t[0], t[1]) + dot(at(block.rub[0].jA), at(block.rub[1].iA)) +
                               dot(at(block.rub[0].jB), at(block.rub[1].iB));
            const Num<S> half = number<S>(Real(0.5)), difference = half * (K[0] - K[1]);
            largest = half * (K[0] + K[1]) + hn::Sqrt(difference * difference + K12 * K12);
            const AngVec<S> twistA = inertiaA * normal, twistB = inertiaB * normal;
            at.set(block.twistA, twistA), at.set(block.twistB, twistB);
            largest = hn::Max(largest, widest * widest * (dot(normal, twistA) + dot(normal, twistB)));
            at.set(block.twistImpulse, twist), at.set(block.twistTotal, zero);
        }
        at.set(block.rubInvK, inverseOrZero(largest));
    }
};

template <class S>
void prepareAll(const PatchRange<S>& range, const PatchInertia<S>* inertia) {
    const std::size_t lanes = hn::Lanes(Tag<S>());
    for (std::size_t k = 0; k < range.count; ++k)
        for (std::size_t first = 0; first < kLanes; first += lanes) {
            PatchBlock<S>& block = range.blocks[k];
            const At<S> at{first};
            const Preparation<S> preparation{block,
                                             at,
                                             {inertia, block.a + first},
                                             {inertia, block.b + first},
                                             at(block.invMassA) + at(block.invMassB),
                                             at(block.normal)};
            preparation.normals();
            preparation.friction();
        }
}

/// Shares a force and a moment about the normal out among the points, by their normal impulses.
template <class S, class Weight, class Write>
HWY_INLINE void share(const PatchBlock<S>& block, At<S> at, const LinVec<S>& force, Num<S> twist,
                      const Weight& weightOf, const Write& write) {
    const Num<S> zero = hn::Zero(Tag<S>());
    Num<S> sum = zero;
    for (int i = 0; i < block.points; ++i) sum = sum + weightOf(block.point[i]);
    const Num<S> scale = inverseOrZero(sum);
    if constexpr (S::dim == 2) {
        for (int i = 0; i < block.points; ++i) {
            const Num<S> part = weightOf(block.point[i]) * scale;
            write(i, LinVec<S>{part * force[0], part * force[1]});
        }
        (void)twist;
    } else {
        LinVec<S> mean{zero, zero, zero};
        for (int i = 0; i < block.points; ++i)
            add(mean, weightOf(block.point[i]) * scale, at(block.point[i].armB));
        const LinVec<S> normal = at(block.normal);
        const Num<S> rest = twist - dot(normal, moment(minus(mean, at(block.centre)), force));
        Num<S> spread = zero, size = zero;
        for (int i = 0; i < block.points; ++i) {
            const LinVec<S> side = moment(normal, minus(at(block.point[i].armB), mean));
            spread = spread + weightOf(block.point[i]) * scale * dot(side, side);
            size = hn::Max(size, dot(at(block.point[i].armB), at(block.point[i].armB)));
        }
        // Points that rounding alone has parted carry no moment.
        const auto apart = spread > number<S>(typename S::Real(1e-6)) * size;
        const Num<S> turn = hn::IfThenElseZero(apart, rest * inverseOrZero(spread));
        for (int i = 0; i < block.points; ++i) {
            const Num<S> part = weightOf(block.point[i]) * scale;
            LinVec<S> own = moment(normal, minus(at(block.point[i].armB), mean));
            for (std::size_t k = 0; k < 3; ++k) own[k] = part * (force[k] + turn * own[k]);
            write(i, own);
        }
    }
}

template <class S>
void shareAll(const PatchRange<S>& range) {
    const std::size_t lanes = hn::Lanes(Tag<S>());
    for (std::size_t k = 0; k < range.count; ++k)
        for (std::size_t first = 0; first < kLanes; first += lanes) {
            PatchBlock<S>& block = range.blocks[k];
            const At<S> at{first};
            const auto force = [&](const auto& impulses) {
                LinVec<S> sum;
                for (auto& x : sum) x = hn::Zero(Tag<S>());
                for (int t = 0; t < PatchSize<S>::tangents; ++t)
                    add(sum, at(impulses[t]), at(block.tangent[t]));
                return sum;
            };
            Num<S> twist = hn::Zero(Tag<S>()), twistTotal = twist;
            if constexpr (S::dim == 3) twist = at(block.twistImpulse), twistTotal = at(block.twistTotal);
            share<S>(
                block, at, force(block.rubImpulse), twist, [&](const auto& p) { return at(p.impulse); },
                [&](int i, const LinVec<S>& f) { at.set(block.point[i].rub, f); });
            share<S>(
                block, at, force(block.rubTotal), twistTotal, [&](const auto& p) { return at(p.total); },
                [&](int i, const LinVec<S>& f) { at.set(block.point[i].rubTotal, f); });
        }
}

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
