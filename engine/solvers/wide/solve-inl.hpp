// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Patches solved one by one. A normal row, with separation s from where the bodies have come since the step
// began:
//     s > 0    lambda := max(0, lambda - (J v + s/h) / K)                           may just close the gap
//     s <= 0   lambda := max(0, lambda - alpha (J v + beta min(0, s + slop)) / K - gamma lambda)
// with the damped spring's alpha = massScale, gamma = impulseScale, beta = biasRate [Catto2011]; relaxation
// has alpha = 1, gamma = beta = 0. A point that bounces has the bias e J v_0 in both instead, with v_0 from
// before the forces of the sub-step. Friction then acts on the slip u = (v_t, r w_n) of the patch, where r is
// the mean distance of the pressure from its center, with the impulse f = (lambda_t, lambda_torsion / r):
//     f := P(f - u / rho),   P the projection on the ball of radius mu sum lambda_i
// with rho at least the largest eigenvalue of the rows' K. At a fixed point u opposes f: Coulomb's law,
// maximal dissipation on an ellipsoid in place of the exact limit surface of force and moment
// [GoyalRuina1991] [HoweCutkosky1996]. A spinning patch has no static friction left against a sideways force,
// as the exact limit surface has it.
#if defined(RIGOR_SOLVE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGOR_SOLVE_INL_HPP
#undef RIGOR_SOLVE_INL_HPP
#else
#define RIGOR_SOLVE_INL_HPP
#endif

#include <utility>

#include "engine/core/prefetch.hpp"
#include "engine/solvers/wide/kernels.hpp"
#include "engine/solvers/wide/moments-inl.hpp"
#include "engine/state/bodies-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {

/// Velocity (or displacement) of B relative to A's frame: v of B's centre of mass, w of its rotation.
template <class S>
struct Relative {
    LinVec<S> v;
    AngVec<S> w;
    /// `offset`: from A's centre of mass to B's.
    HWY_INLINE Relative(const Twist<S>& a, const Twist<S>& b, const LinVec<S>& offset)
        : v(minus(minus(b.v, a.v), turning(a.w, offset))), w(minus(b.w, a.w)) {}
};

/// One register of lanes of a block: velocities of both bodies and the numbers of the block that rows read.
/// `based`: velocities are relative to PatchRange::base.
template <class S, bool based>
struct PatchGroup {
    using Real = typename S::Real;
    PatchBlock<S>& block;
    PatchColdData<S>& cold;
    At<S> at;
    const Velocity<S>* motions;
    Side<S> sideA, sideB;
    Twist<S> a, b;
    LinVec<S> normal, offset;
    Relative<S> base;  ///< relative base velocity; if based
    Num<S> massA, massB;
    std::array<Num<S>, PatchSize<S>::inertia> inertiaA, inertiaB;  ///< inverse

    HWY_INLINE PatchGroup(const PatchRange<S>& range, std::size_t k, std::size_t first)
        : block(range.blocks[k]),
          cold(range.cold[k]),
          at{first},
          motions(range.motions),
          sideA{block.a + first, block.movesA >> first},
          sideB{block.b + first, block.movesB >> first},
          a(sideA.load(range.velocities)),
          b(sideB.load(range.velocities)),
          normal(at(block.normal)),
          offset(at(block.offset)),
          base(based ? sideA.load(range.base) : a, based ? sideB.load(range.base) : b, offset),
          massA(at(block.invMassA)),
          massB(at(block.invMassB)),
          inertiaA(at(block.invInertiaA)),
          inertiaB(at(block.invInertiaB)) {}
    HWY_INLINE void store(Velocity<S>* velocities) const {
        sideA.store(a, velocities);
        sideB.store(b, velocities);
    }
    HWY_INLINE AngVec<S> jB(int i) const { return at(block.point[i].jB); }
    HWY_INLINE Relative<S> velocity() const {
        Relative<S> u(a, b, offset);
        if constexpr (based) {
            for (std::size_t k = 0; k < u.v.size(); ++k) u.v[k] = base.v[k] + u.v[k];
            for (std::size_t k = 0; k < u.w.size(); ++k) u.w[k] = base.w[k] + u.w[k];
        }
        return u;
    }
    /// Relative displacement since the step began.
    HWY_INLINE Relative<S> motion() const { return {sideA.load(motions), sideB.load(motions), offset}; }
    /// Angular impulses about the centres of mass: onB on B, -onA on A.
    HWY_INLINE void applyAngularImpulse(const AngVec<S>& onA, const AngVec<S>& onB) {
        a.w = minus(a.w, times(inertiaA, onA));
        add(b.w, number<S>(1), times(inertiaB, onB));
    }
    /// Impulses lambda_i of the normal rows, as sum = sum lambda_i and spin = sum lambda_i jB_i.
    HWY_INLINE void applyNormalImpulse(Num<S> sum, const AngVec<S>& spin) {
        subtract(a.v, sum * massA, normal);
        add(b.v, sum * massB, normal);
        AngVec<S> onA = spin;
        add(onA, sum, moment(offset, normal));
        applyAngularImpulse(onA, spin);
    }
    /// Impulse of friction at the center of the patch, and in 3D the torsional one about the normal.
    HWY_INLINE void applyFrictionImpulse(const LinVec<S>& impulse, [[maybe_unused]] Num<S> torsion) {
        subtract(a.v, massA, impulse);
        add(b.v, massB, impulse);
        AngVec<S> onB = moment(at(block.center), impulse);
        if constexpr (S::dim == 3) add(onB, torsion, normal);
        AngVec<S> onA = onB;
        add(onA, number<S>(1), moment(offset, impulse));
        applyAngularImpulse(onA, onB);
    }
    HWY_INLINE std::array<LinVec<S>, PatchSize<S>::tangents> tangents() const {
        if constexpr (S::dim == 2) {
            return {LinVec<S>{hn::Zero(Tag<S>()) - normal[1], normal[0]}};
        } else {
            const LinVec<S> t = at(block.tangent);
            return {t, moment(normal, t)};
        }
    }
    HWY_INLINE LinVec<S> alongTangents(const std::array<Num<S>, PatchSize<S>::tangents>& x) const {
        const auto t = tangents();
        LinVec<S> sum;
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] = x[0] * t[0][k];
        for (std::size_t k = 1; k < x.size(); ++k) add(sum, x[k], t[k]);
        return sum;
    }
};

/// Component of a relative motion or velocity along the normals: center + jB_i . w at point i.
template <class S>
struct Along {
    Num<S> center;
    AngVec<S> w;
    HWY_INLINE Along(const LinVec<S>& normal, const Relative<S>& u) : center(dot(normal, u.v)), w(u.w) {}
    HWY_INLINE Num<S> operator()(const AngVec<S>& jB) const { return center + dot(jB, w); }
};

/// Prefetches the velocities of the next block: in the last colour another thread may have written them.
template <class S>
HWY_INLINE void fetchBodies(const PatchBlock<S>& block, const Velocity<S>* velocities) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if (block.movesA >> lane & 1) prefetchToWrite(velocities + block.a[lane]);
        if (block.movesB >> lane & 1) prefetchToWrite(velocities + block.b[lane]);
    }
}

/// Calls work(patches) for every register of lanes and stores their velocities.
template <bool based, class S, class Work>
HWY_INLINE void forPatches(const PatchRange<S>& range, const Work& work) {
    const std::size_t lanes = hn::Lanes(Tag<S>());
    for (std::size_t k = 0; k < range.count; ++k) {
        if (range.shared && k + 1 < range.count) fetchBodies(range.blocks[k + 1], range.velocities);
        for (std::size_t first = 0; first < kLanes; first += lanes) {
            PatchGroup<S, based> patches(range, k, first);
            work(patches);
            patches.store(range.velocities);
        }
    }
}

template <class S, bool based>
HWY_INLINE void warmStart(PatchGroup<S, based>& p) {
    PatchBlock<S>& block = p.block;
    Num<S> sum = hn::Zero(Tag<S>());
    AngVec<S> spin;
    for (auto& x : spin) x = sum;
    for (int i = 0; i < block.points; ++i) {
        const Num<S> lambda = p.at(block.point[i].impulse);
        sum = sum + lambda;
        add(spin, lambda, p.jB(i));
    }
    p.applyNormalImpulse(sum, spin);
    Num<S> torsion = hn::Zero(Tag<S>());
    if constexpr (S::dim == 3) torsion = p.at(block.torsionImpulse);
    p.applyFrictionImpulse(p.alongTangents(p.at(block.frictionImpulse)), torsion);
    if (block.moments) applyMoment<S>(p, p.at(p.cold.moment));
}

/// Normal load of a patch: what bounds its friction.
template <class S>
struct NormalLoad {
    Num<S> sum;     ///< sum lambda_i of the normal impulses
    Num<S> moment;  ///< sum lambda_i r_i, r_i the distance from the center
};

/// A normal row in one pass:  lambda := max(0, lambda - factor (J v + bias) - leak lambda).
template <class S>
struct NormalRow {
    AngVec<S> jB;
    Num<S> error;  ///< J v + bias before the pass
    Num<S> factor, leak, lambda;
    Num<S> change;  ///< change of lambda in this pass

    template <class Group>
    HWY_INLINE NormalRow(const Group& p, const PatchPass& pass, const Along<S>& velocity,
                         const Along<S>& motion, int i)
        : jB(p.jB(i)) {
        const PatchPoint<S>& point = p.block.point[i];
        const Num<S> zero = hn::Zero(Tag<S>());
        const Num<S> s = p.at(point.separation) + motion(jB);
        auto rigid = s > zero;
        Num<S> bias = s * number<S>(pass.invH), invK = p.at(point.invK);
        if (pass.soft) {
            const Num<S> push = hn::Max(number<S>(pass.biasRate) * hn::Min(s + number<S>(pass.slop), zero),
                                        number<S>(-pass.maxBiasVelocity));
            bias = hn::IfThenElse(rigid, bias, push);
        } else {
            bias = hn::IfThenElseZero(rigid, bias);
        }
        if (p.block.bounces) {
            const Num<S> rebound = p.at(p.cold.rebound[i]);
            rigid = hn::Or(rigid, rebound < zero);
            bias = hn::IfThenElse(rebound < zero, rebound, bias);
            invK = hn::IfThenElseZero(p.at(p.cold.inactive[i]) == zero, invK);
        }
        factor = invK;
        leak = change = zero;
        if (pass.soft) {
            factor = hn::IfThenElse(rigid, invK, number<S>(pass.massScale) * invK);
            leak = hn::IfThenElse(rigid, zero, number<S>(pass.impulseScale));
        }
        error = velocity(jB) + bias;
        lambda = p.at(point.impulse);
    }
    HWY_INLINE void solve(Num<S> now) {
        const Num<S> next = hn::Max(lambda - (factor * now + leak * lambda), hn::Zero(Tag<S>()));
        change = change + (next - lambda);
        lambda = next;
    }
    /// Makes solve() a no-op in lanes where `active` is false.
    HWY_INLINE void disableUnless(hn::Mask<Tag<S>> active) {
        factor = hn::IfThenElseZero(active, factor);
        leak = hn::IfThenElseZero(active, leak);
    }
};

template <int i>
using Index = std::integral_constant<int, i>;
/// work(Index<0>(), ..., Index<n - 1>()): rows stay in registers only where each has its own code.
template <int n, class Work>
HWY_INLINE decltype(auto) eachPoint(const Work& work) {
    return [&work]<int... i>(std::integer_sequence<int, i...>)->decltype(auto) {
        return work(Index<i>()...);
    }
    (std::make_integer_sequence<int, n>());
}

/// Solves all normal rows by one symmetric Gauss-Seidel sweep (forwards, then backwards): the rotation that
/// the first corner of a box causes is cancelled by the others before its neighbours see it. A forward sweep
/// alone makes tall stacks rock. The only point of a patch is solved once, whatever the other lanes hold: the
/// result of a patch does not depend on the rest of its block. Within the sweep the points act on each other
/// through K; the bodies get the sum of the impulses at the end.
template <int n, class S, bool based>
HWY_INLINE NormalLoad<S> solveNormals(PatchGroup<S, based>& p, const PatchPass& pass) {
    const Num<S> zero = hn::Zero(Tag<S>());
    PatchBlock<S>& block = p.block;
    const Along<S> velocity(p.normal, p.velocity()), motion(p.normal, p.motion());
    std::array<NormalRow<S>, n> row = eachPoint<n>([&](auto... i) RIGOR_INLINE_LAMBDA {
        return std::array<NormalRow<S>, n>{NormalRow<S>(p, pass, velocity, motion, i)...};
    });
    const auto solveRow = [&](auto i, auto changed) RIGOR_INLINE_LAMBDA {
        Num<S> now = row[i].error;
        eachPoint<changed>([&](auto... k) RIGOR_INLINE_LAMBDA {
            ((now = now + p.at(block.K[pairAt(i, k)]) * row[k].change), ...);
        });
        row[i].solve(now);
    };
    eachPoint<n>([&](auto... i) RIGOR_INLINE_LAMBDA { (solveRow(i, i), ...); });
    if constexpr (n > 1) {
        eachPoint<n - 1>([&](auto... i)
                             RIGOR_INLINE_LAMBDA { (solveRow(Index<n - 1 - i>(), Index<n>()), ...); });
        row[0].disableUnless(p.at(block.point[1].invK) > zero);
        solveRow(Index<0>(), Index<n>());
    }

    NormalLoad<S> load{zero, zero};
    Num<S> sum = zero;
    AngVec<S> spin;
    for (auto& x : spin) x = zero;
    const auto finish = [&](auto i) RIGOR_INLINE_LAMBDA {
        PatchPoint<S>& point = block.point[i];
        p.at.set(point.impulse, row[i].lambda);
        if (pass.last) p.at.set(point.total, p.at(point.total) + row[i].lambda);
        sum = sum + row[i].change;
        add(spin, row[i].change, row[i].jB);
        load.sum = load.sum + row[i].lambda;
        if constexpr (S::dim == 3) load.moment = load.moment + row[i].lambda * p.at(block.radius[i]);
    };
    eachPoint<n>([&](auto... i) RIGOR_INLINE_LAMBDA { (finish(i), ...); });
    p.applyNormalImpulse(sum, spin);
    return load;
}

/// Solves sliding and torsional friction together: in (lambda_t, lambda_torsion / r), with r the mean
/// distance of the pressure from the center, the limit surface is a ball.
template <class S, bool based>
HWY_INLINE void solveFriction(PatchGroup<S, based>& p, const NormalLoad<S>& load, bool last) {
    PatchBlock<S>& block = p.block;
    constexpr std::size_t tangents = PatchSize<S>::tangents;
    Relative<S> u = p.velocity();
    if (block.driven) {
        add(u.v, number<S>(1), p.at(p.cold.surfaceV));
        add(u.w, number<S>(1), p.at(p.cold.surfaceW));
    }
    LinVec<S> slip = u.v;
    add(slip, number<S>(1), turning(u.w, p.at(block.center)));
    const auto t = p.tangents();
    const Num<S> invK = p.at(block.tangentMass), one = number<S>(1);
    const std::array<Num<S>, tangents> old = p.at(block.frictionImpulse);
    std::array<Num<S>, tangents> next, change;
    for (std::size_t k = 0; k < tangents; ++k) next[k] = old[k] - dot(t[k], slip) * invK;
    Num<S> size2 = dot(next, next);
    const Num<S> sticking = p.at(block.staticFriction) * load.sum;
    [[maybe_unused]] Num<S> torsion = one, oldTorsion = one, radius = one;
    if constexpr (S::dim == 3) {
        const auto spread = invertible(load.moment);
        radius = load.moment / hn::IfThenElse(spread, load.sum, one);
        oldTorsion = p.at(block.torsionImpulse);
        // The load may have moved to the center since the old impulse was computed: r = 0 then.
        const Num<S> before = oldTorsion / hn::IfThenElse(spread, radius, one);
        const Num<S> bounded = hn::Max(hn::Min(before, sticking), hn::Zero(Tag<S>()) - sticking);
        torsion = hn::IfThenElseZero(spread, bounded - radius * dot(p.normal, u.w) * invK);
        size2 = size2 + torsion * torsion;
    }
    const auto sticks = size2 <= sticking * sticking;
    Num<S> scale = one;
    if (!hn::AllTrue(Tag<S>(), sticks)) {  // lanes that slide have size2 > 0
        const Num<S> size = hn::Sqrt(hn::IfThenElse(sticks, one, size2));
        scale = hn::IfThenElse(sticks, one, p.at(block.friction) * load.sum / size);
    }
    for (std::size_t k = 0; k < tangents; ++k) {
        next[k] = scale * next[k];
        change[k] = next[k] - old[k];
        if (last) p.at.set(block.frictionTotal[k], p.at(block.frictionTotal[k]) + next[k]);
    }
    p.at.set(block.frictionImpulse, next);
    if constexpr (S::dim == 3) {
        torsion = scale * torsion * radius;
        p.at.set(block.torsionImpulse, torsion);
        if (last) p.at.set(block.torsionTotal, p.at(block.torsionTotal) + torsion);
    }
    p.applyFrictionImpulse(p.alongTangents(change), torsion - oldTorsion);
}

/// Begins a sub-step for points with restitution, before forces. A point that hits gets its rebound velocity.
/// A point whose gap may close in this sub-step is inactive: a speculative row would take the approach speed
/// that restitution is to reverse.
template <class S, bool based>
HWY_INLINE void prepareBounce(PatchGroup<S, based>& p, const PatchPass& pass) {
    PatchBlock<S>& block = p.block;
    const Num<S> zero = hn::Zero(Tag<S>()), e = p.at(p.cold.restitution);
    const Num<S> touching = number<S>(pass.touching);
    const Along<S> velocity(p.normal, p.velocity()), motion(p.normal, p.motion());
    for (int i = 0; i < block.points; ++i) {
        PatchPoint<S>& point = block.point[i];
        const AngVec<S> jB = p.jB(i);
        const Num<S> approach = velocity(jB), s = p.at(point.separation) + motion(jB);
        const auto fast = hn::And(e > zero, approach < number<S>(-pass.threshold));
        const auto separated = s > touching;
        const auto mayHit = hn::And(e > zero, s > number<S>(pass.restingGap));
        const auto inactive = hn::And(separated, hn::Or(fast, mayHit));
        p.at.set(p.cold.rebound[i], hn::IfThenElseZero(hn::AndNot(separated, fast), e * approach));
        p.at.set(p.cold.inactive[i], hn::IfThenElseZero(inactive, number<S>(1)));
        p.at.set(point.impulse, hn::IfThenElse(inactive, zero, p.at(point.impulse)));
    }
}

template <class S>
void warmStartAll(const PatchRange<S>& range) {
    forPatches<false>(range, [](auto& p) RIGOR_INLINE_LAMBDA { warmStart(p); });
}
template <bool based, class S>
HWY_INLINE void solveFrom(const PatchRange<S>& range, const PatchPass& pass) {
    const auto normals = [&pass](PatchGroup<S, based>& p) RIGOR_INLINE_LAMBDA {
        if constexpr (S::dim == 3) {
            if (p.block.points == 4) return solveNormals<4>(p, pass);
            if (p.block.points == 3) return solveNormals<3>(p, pass);
        }
        return p.block.points == 2 ? solveNormals<2>(p, pass) : solveNormals<1>(p, pass);
    };
    forPatches<based>(range, [&](auto& p) RIGOR_INLINE_LAMBDA {
        const NormalLoad<S> load = normals(p);
        solveFriction(p, load, pass.last);
        if (p.block.moments) solveMoments<S>(p, load.sum, pass.last);
    });
}
template <class S>
void solveAll(const PatchRange<S>& range, const PatchPass& pass) {
    range.base == nullptr ? solveFrom<false>(range, pass) : solveFrom<true>(range, pass);
}
/// Blocks of all colours may run in parallel: velocities are read only.
template <bool based, class S>
HWY_INLINE void prepareBouncesFrom(const PatchRange<S>& range, const PatchPass& pass) {
    const std::size_t lanes = hn::Lanes(Tag<S>());
    for (std::size_t k = 0; k < range.count; ++k)
        for (std::size_t first = 0; range.blocks[k].bounces && first < kLanes; first += lanes) {
            PatchGroup<S, based> patches(range, k, first);
            prepareBounce(patches, pass);
        }
}
template <class S>
void prepareAllBounces(const PatchRange<S>& range, const PatchPass& pass) {
    range.base == nullptr ? prepareBouncesFrom<false>(range, pass) : prepareBouncesFrom<true>(range, pass);
}

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
