// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Patches solved one by one. A normal row, with separation s from where the bodies have come since the step
// began:
//     s > 0    lambda := max(0, lambda - (J v + s/h) / K)                           may just close the gap
//     s <= 0   lambda := max(0, lambda - alpha (J v + beta min(0, s + slop)) / K - gamma lambda)
// with the damped spring's alpha = massScale, gamma = impulseScale, beta = biasRate [Catto2011]; relaxation
// has alpha = 1, gamma = beta = 0. A point that hits has the bias e J v_0 in both instead, with v_0 from
// before the forces of the sub-step. Friction then acts on the slip u = (v_t, r w_n) of the patch, where r is
// the mean distance of the pressure from its centre, with the impulse f = (lambda_t, lambda_twist / r):
//     f := P(f - u / rho),   P the projection on the ball of radius mu sum lambda_i
// with rho at least the largest eigenvalue of the rows' K. At a fixed point u opposes f: Coulomb's law,
// maximal dissipation on an ellipsoid in place of the exact limit surface of force and moment
// [GoyalRuina1991] [HoweCutkosky1996]. A patch that turns gives way sideways to the least force, as it
// should.
#if defined(RIGOR_SOLVE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGOR_SOLVE_INL_HPP
#undef RIGOR_SOLVE_INL_HPP
#else
#define RIGOR_SOLVE_INL_HPP
#endif

#include <utility>

#include "engine/core/prefetch.hpp"
#include "engine/solvers/wide/kernels.hpp"
#include "engine/state/bodies-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {

/// What B has against A's frame: the velocity of its centre of mass there, or the way it has come, and what
/// it turns.
template <class S>
struct Relative {
    LinVec<S> v;
    AngVec<S> w;
    /// `offset`: from A's centre of mass to B's.
    HWY_INLINE Relative(const Twist<S>& a, const Twist<S>& b, const LinVec<S>& offset)
        : v(minus(minus(b.v, a.v), turning(a.w, offset))), w(minus(b.w, a.w)) {}
};

/// Lanes of a block while they are worked on: the velocities of both sides, and what rows read of the block.
/// `based`: velocities are counted from PatchRange::base.
template <class S, bool based>
struct PatchGroup {
    using Real = typename S::Real;
    PatchBlock<S>& block;
    PatchRest<S>& rest;
    At<S> at;
    const Velocity<S>* motions;
    Side<S> sideA, sideB;
    Twist<S> a, b;
    LinVec<S> normal, offset;
    Relative<S> base;  ///< of what velocities are counted from; if based
    Num<S> massA, massB;
    std::array<Num<S>, PatchSize<S>::inertia> inertiaA, inertiaB;  ///< inverse

    HWY_INLINE PatchGroup(const PatchRange<S>& range, std::size_t k, std::size_t first)
        : block(range.blocks[k]),
          rest(range.rests[k]),
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
    /// Since the step began.
    HWY_INLINE Relative<S> motion() const { return {sideA.load(motions), sideB.load(motions), offset}; }
    /// Angular impulses, about the centres of mass, on B and against that on A.
    HWY_INLINE void turn(const AngVec<S>& onA, const AngVec<S>& onB) {
        a.w = minus(a.w, times(inertiaA, onA));
        add(b.w, number<S>(1), times(inertiaB, onB));
    }
    /// Of normal rows with the impulses lambda: `sum` of them, and `spin` = sum lambda_i jB_i.
    HWY_INLINE void press(Num<S> sum, const AngVec<S>& spin) {
        subtract(a.v, sum * massA, normal);
        add(b.v, sum * massB, normal);
        AngVec<S> onA = spin;
        add(onA, sum, moment(offset, normal));
        turn(onA, spin);
    }
    /// A force's impulse at the centre of the patch, and in 3D one about the normal.
    HWY_INLINE void rub(const LinVec<S>& impulse, [[maybe_unused]] Num<S> twist) {
        subtract(a.v, massA, impulse);
        add(b.v, massB, impulse);
        AngVec<S> onB = moment(at(block.centre), impulse);
        if constexpr (S::dim == 3) add(onB, twist, normal);
        AngVec<S> onA = onB;
        add(onA, number<S>(1), moment(offset, impulse));
        turn(onA, onB);
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

/// What motion or velocity is along the normals: centre + jB_i . w at point i.
template <class S>
struct Along {
    Num<S> centre;
    AngVec<S> w;
    HWY_INLINE Along(const LinVec<S>& normal, const Relative<S>& u) : centre(dot(normal, u.v)), w(u.w) {}
    HWY_INLINE Num<S> operator()(const AngVec<S>& jB) const { return centre + dot(jB, w); }
};

/// What another thread has moved in the last colour is on its way while a block is worked on.
template <class S>
HWY_INLINE void fetchBodies(const PatchBlock<S>& block, const Velocity<S>* velocities) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if (block.movesA >> lane & 1) prefetchToWrite(velocities + block.a[lane]);
        if (block.movesB >> lane & 1) prefetchToWrite(velocities + block.b[lane]);
    }
}

/// Calls visit(patches) for every register's worth of lanes, and stores their velocities.
template <bool based, class S, class Visit>
HWY_INLINE void forPatches(const PatchRange<S>& range, const Visit& visit) {
    const std::size_t lanes = hn::Lanes(Tag<S>());
    for (std::size_t k = 0; k < range.count; ++k) {
        if (range.shared && k + 1 < range.count) fetchBodies(range.blocks[k + 1], range.velocities);
        for (std::size_t first = 0; first < kLanes; first += lanes) {
            PatchGroup<S, based> patches(range, k, first);
            visit(patches);
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
    p.press(sum, spin);
    Num<S> twist = hn::Zero(Tag<S>());
    if constexpr (S::dim == 3) twist = p.at(block.twistImpulse);
    p.rub(p.alongTangents(p.at(block.rubImpulse)), twist);
}

/// What friction may lean on.
template <class S>
struct Pressed {
    Num<S> sum;     ///< of normal impulses
    Num<S> moment;  ///< of them times their distances from the centre
};

/// A normal row of this visit:  lambda := max(0, lambda - factor (J v + bias) - leak lambda).
template <class S>
struct NormalRow {
    AngVec<S> jB;
    Num<S> error;  ///< J v + bias before the visit
    Num<S> factor, leak, lambda;
    Num<S> change;  ///< of lambda in this visit

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
                                        number<S>(-pass.fastestPush));
            bias = hn::IfThenElse(rigid, bias, push);
        } else {
            bias = hn::IfThenElseZero(rigid, bias);
        }
        if (p.block.bounces) {
            const Num<S> rebound = p.at(p.rest.rebound[i]);
            rigid = hn::Or(rigid, rebound < zero);
            bias = hn::IfThenElse(rebound < zero, rebound, bias);
            invK = hn::IfThenElseZero(p.at(p.rest.open[i]) == zero, invK);
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
    /// Further visits change nothing where `more` does not hold.
    HWY_INLINE void keepUnless(hn::Mask<Tag<S>> more) {
        factor = hn::IfThenElseZero(more, factor);
        leak = hn::IfThenElseZero(more, leak);
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

/// All normal rows. The points of a patch are swept forwards and back: a body that the first corner turns is
/// turned back by the others before its neighbours see it. One sweep alone makes tall stacks rock. A point
/// that is alone has one visit, whoever stands beside it: what is made of a patch does not depend on what its
/// block holds besides. The bodies get the sum of what the sweeps make; on the way the points act on each
/// other through K.
template <int n, class S, bool based>
HWY_INLINE Pressed<S> solveNormals(PatchGroup<S, based>& p, const PatchPass& pass) {
    const Num<S> zero = hn::Zero(Tag<S>());
    PatchBlock<S>& block = p.block;
    const Along<S> velocity(p.normal, p.velocity()), motion(p.normal, p.motion());
    std::array<NormalRow<S>, n> row = eachPoint<n>([&](auto... i) RIGOR_INLINE_LAMBDA {
        return std::array<NormalRow<S>, n>{NormalRow<S>(p, pass, velocity, motion, i)...};
    });
    const auto visit = [&](auto i, auto changed) RIGOR_INLINE_LAMBDA {
        Num<S> now = row[i].error;
        eachPoint<changed>([&](auto... k) RIGOR_INLINE_LAMBDA {
            ((now = now + p.at(block.K[pairAt(i, k)]) * row[k].change), ...);
        });
        row[i].solve(now);
    };
    eachPoint<n>([&](auto... i) RIGOR_INLINE_LAMBDA { (visit(i, i), ...); });
    if constexpr (n > 1) {
        eachPoint<n - 1>([&](auto... i)
                             RIGOR_INLINE_LAMBDA { (visit(Index<n - 1 - i>(), Index<n>()), ...); });
        row[0].keepUnless(p.at(block.point[1].invK) > zero);
        visit(Index<0>(), Index<n>());
    }

    Pressed<S> pressed{zero, zero};
    Num<S> sum = zero;
    AngVec<S> spin;
    for (auto& x : spin) x = zero;
    const auto finish = [&](auto i) RIGOR_INLINE_LAMBDA {
        PatchPoint<S>& point = block.point[i];
        p.at.set(point.impulse, row[i].lambda);
        if (pass.last) p.at.set(point.total, p.at(point.total) + row[i].lambda);
        sum = sum + row[i].change;
        add(spin, row[i].change, row[i].jB);
        pressed.sum = pressed.sum + row[i].lambda;
        if constexpr (S::dim == 3) pressed.moment = pressed.moment + row[i].lambda * p.at(block.radius[i]);
    };
    eachPoint<n>([&](auto... i) RIGOR_INLINE_LAMBDA { (finish(i), ...); });
    p.press(sum, spin);
    return pressed;
}

/// Tangents and twist at once: in (lambda_t, lambda_twist / r) with r the mean distance of the pressure from
/// the centre, the limit surface is a ball.
template <class S, bool based>
HWY_INLINE void solveFriction(PatchGroup<S, based>& p, const Pressed<S>& pressed, bool last) {
    PatchBlock<S>& block = p.block;
    constexpr std::size_t tangents = PatchSize<S>::tangents;
    const Relative<S> u = p.velocity();
    LinVec<S> slip = u.v;
    add(slip, number<S>(1), turning(u.w, p.at(block.centre)));
    const auto t = p.tangents();
    const Num<S> invK = p.at(block.rubInvK), one = number<S>(1);
    const std::array<Num<S>, tangents> old = p.at(block.rubImpulse);
    std::array<Num<S>, tangents> next, change;
    for (std::size_t k = 0; k < tangents; ++k) next[k] = old[k] - dot(t[k], slip) * invK;
    Num<S> size2 = dot(next, next);
    const Num<S> sticking = p.at(block.staticFriction) * pressed.sum;
    [[maybe_unused]] Num<S> twist = one, oldTwist = one, radius = one;
    if constexpr (S::dim == 3) {
        const auto spread = invertible(pressed.moment);
        radius = pressed.moment / hn::IfThenElse(spread, pressed.sum, one);
        oldTwist = p.at(block.twistImpulse);
        // The pressure may have come together at the centre since the old one was found.
        const Num<S> before = oldTwist / hn::IfThenElse(spread, radius, one);
        const Num<S> bounded = hn::Max(hn::Min(before, sticking), hn::Zero(Tag<S>()) - sticking);
        twist = hn::IfThenElseZero(spread, bounded - radius * dot(p.normal, u.w) * invK);
        size2 = size2 + twist * twist;
    }
    const auto sticks = size2 <= sticking * sticking;
    Num<S> scale = one;
    if (!hn::AllTrue(Tag<S>(), sticks)) {  // where it slides size2 > 0
        const Num<S> size = hn::Sqrt(hn::IfThenElse(sticks, one, size2));
        scale = hn::IfThenElse(sticks, one, p.at(block.friction) * pressed.sum / size);
    }
    for (std::size_t k = 0; k < tangents; ++k) {
        next[k] = scale * next[k];
        change[k] = next[k] - old[k];
        if (last) p.at.set(block.rubTotal[k], p.at(block.rubTotal[k]) + next[k]);
    }
    p.at.set(block.rubImpulse, next);
    if constexpr (S::dim == 3) {
        twist = scale * twist * radius;
        p.at.set(block.twistImpulse, twist);
        if (last) p.at.set(block.twistTotal, p.at(block.twistTotal) + twist);
    }
    p.rub(p.alongTangents(change), twist - oldTwist);
}

/// What a sub-step makes of points that can bounce, before forces: those that hit get their rebound; a gap
/// that may end in one is let through, because closing it would take the speed that is to be reversed.
template <class S, bool based>
HWY_INLINE void plan(PatchGroup<S, based>& p, const PatchPass& pass) {
    PatchBlock<S>& block = p.block;
    const Num<S> zero = hn::Zero(Tag<S>()), e = p.at(p.rest.restitution);
    const Num<S> touching = number<S>(pass.touching);
    const Along<S> velocity(p.normal, p.velocity()), motion(p.normal, p.motion());
    for (int i = 0; i < block.points; ++i) {
        PatchPoint<S>& point = block.point[i];
        const AngVec<S> jB = p.jB(i);
        const Num<S> approach = velocity(jB), s = p.at(point.separation) + motion(jB);
        const auto fast = hn::And(e > zero, approach < number<S>(-pass.threshold));
        const auto apart = s > touching;
        const auto mayHit = hn::And(e > zero, s > number<S>(pass.restingGap));
        const auto open = hn::And(apart, hn::Or(fast, mayHit));
        p.at.set(p.rest.rebound[i], hn::IfThenElseZero(hn::AndNot(apart, fast), e * approach));
        p.at.set(p.rest.open[i], hn::IfThenElseZero(open, number<S>(1)));
        p.at.set(point.impulse, hn::IfThenElse(open, zero, p.at(point.impulse)));
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
    forPatches<based>(range, [&](auto& p) RIGOR_INLINE_LAMBDA { solveFriction(p, normals(p), pass.last); });
}
template <class S>
void solveAll(const PatchRange<S>& range, const PatchPass& pass) {
    range.base == nullptr ? solveFrom<false>(range, pass) : solveFrom<true>(range, pass);
}
/// Blocks of all colours side by side: velocities are read, and not written back.
template <bool based, class S>
HWY_INLINE void planFrom(const PatchRange<S>& range, const PatchPass& pass) {
    const std::size_t lanes = hn::Lanes(Tag<S>());
    for (std::size_t k = 0; k < range.count; ++k)
        for (std::size_t first = 0; range.blocks[k].bounces && first < kLanes; first += lanes) {
            PatchGroup<S, based> patches(range, k, first);
            plan(patches, pass);
        }
}
template <class S>
void planAll(const PatchRange<S>& range, const PatchPass& pass) {
    range.base == nullptr ? planFrom<false>(range, pass) : planFrom<true>(range, pass);
}

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
