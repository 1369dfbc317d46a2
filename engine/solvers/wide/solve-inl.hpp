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

#include "engine/solvers/wide/kernels.hpp"
#include "engine/solvers/wide/vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {

/// Lanes of a block while they are worked on: the velocities of both sides, and what rows read of the block.
template <class S>
struct PatchGroup {
    PatchBlock<S>& block;
    At<S> at;
    Side<S> sideA, sideB;
    Twist<S> a, b;
    LinVec<S> normal;
    Num<S> massA, massB;

    HWY_INLINE PatchGroup(const PatchRange<S>& range, PatchBlock<S>& of, std::size_t first)
        : block(of),
          at{first},
          sideA{range.bodies, of.a + first, of.movesA >> first},
          sideB{range.bodies, of.b + first, of.movesB >> first},
          a(sideA.velocity()),
          b(sideB.velocity()),
          normal(at(of.normal)),
          massA(at(of.invMassA)),
          massB(at(of.invMassB)) {}
    HWY_INLINE void store() const { sideA.store(a), sideB.store(b); }
    /// An impulse along a direction, of a row's angular part.
    HWY_INLINE void push(Num<S> lambda, const LinVec<S>& direction, const PatchRow<S>& row) {
        subtract(a.v, lambda * massA, direction);
        add(b.v, lambda * massB, direction);
        turn(lambda, row);
    }
    HWY_INLINE void turn(Num<S> lambda, const PatchRow<S>& row) {
        subtract(a.w, lambda, at(row.iA));
        add(b.w, lambda, at(row.iB));
    }
};

/// Calls visit(patches) for every register's worth of lanes, and stores their velocities.
template <class S, class Visit>
HWY_INLINE void forPatches(const PatchRange<S>& range, const Visit& visit) {
    const std::size_t lanes = hn::Lanes(Tag<S>());
    for (std::size_t k = 0; k < range.count; ++k)
        for (std::size_t first = 0; first < kLanes; first += lanes) {
            PatchGroup<S> patches(range, range.blocks[k], first);
            visit(patches);
            patches.store();
        }
}

template <class S>
HWY_INLINE void warmStart(PatchGroup<S>& p) {
    PatchBlock<S>& block = p.block;
    Num<S> sum = hn::Zero(Tag<S>());
    for (int i = 0; i < block.points; ++i) {
        const Num<S> lambda = p.at(block.point[i].impulse);
        sum = sum + lambda;
        p.turn(lambda, block.point[i].row);
    }
    subtract(p.a.v, sum * p.massA, p.normal);
    add(p.b.v, sum * p.massB, p.normal);
    for (int k = 0; k < PatchSize<S>::tangents; ++k)
        p.push(p.at(block.rubImpulse[k]), p.at(block.tangent[k]), block.rub[k]);
    if constexpr (S::dim == 3) {
        const Num<S> twist = p.at(block.twistImpulse);
        subtract(p.a.w, twist, p.at(block.twistA));
        add(p.b.w, twist, p.at(block.twistB));
    }
}

/// What friction may lean on.
template <class S>
struct Pressed {
    Num<S> sum;     ///< of normal impulses
    Num<S> moment;  ///< of them times their distances from the centre
};

/// All normal rows. The points of a patch are swept forwards and back: a body that the first corner turns is
/// turned back by the others before its neighbours see it. One sweep alone makes tall stacks rock.
template <class S>
HWY_INLINE Pressed<S> solveNormals(PatchGroup<S>& p, const PatchPass<typename S::Real>& pass) {
    const Tag<S> d;
    PatchBlock<S>& block = p.block;
    const Num<S> zero = hn::Zero(d), one = number<S>(1), invH = number<S>(pass.invH);
    const Twist<S> movedA = p.sideA.motion(), movedB = p.sideB.motion();
    const Num<S> moved = dot(p.normal, minus(movedB.v, movedA.v));
    const Num<S> mass = p.massA + p.massB;
    const Num<S> alpha = pass.soft ? number<S>(pass.massScale) : one;
    const Num<S> gamma = pass.soft ? number<S>(pass.impulseScale) : zero;
    const Num<S> beta = pass.soft ? number<S>(pass.biasRate) : zero;
    const Num<S> slop = number<S>(pass.slop), fastest = number<S>(-pass.fastestPush);
    Num<S> speed = dot(p.normal, minus(p.b.v, p.a.v)), pushed = zero;
    Pressed<S> pressed{zero, zero};
    const int n = block.points;
    for (int k = n > 1 ? 0 : n; k < 2 * n; ++k) {
        const int i = k < n ? k : 2 * n - 1 - k;
        const bool final = k >= n;
        PatchPoint<S>& point = block.point[i];
        const AngVec<S> jA = p.at(point.row.jA), jB = p.at(point.row.jB);
        const Num<S> s = p.at(point.separation) + moved + turning<S>(jA, jB, movedA.w, movedB.w);
        const auto apart = s > zero;
        const Num<S> push = hn::Max(beta * hn::Min(s + slop, zero), fastest);
        Num<S> bias = hn::IfThenElse(apart, s * invH, push), invK = p.at(point.invK);
        auto rigid = apart;
        if (block.bounces) {
            const Num<S> rebound = p.at(point.rebound);
            rigid = hn::Or(rigid, rebound < zero);
            bias = hn::IfThenElse(rebound < zero, rebound, bias);
            invK = hn::IfThenElseZero(p.at(point.open) == zero, invK);
        }
        const Num<S> error = speed + turning<S>(jA, jB, p.a.w, p.b.w) + bias;
        const Num<S> old = p.at(point.impulse);
        const Num<S> step = hn::IfThenElse(rigid, error * invK, alpha * (error * invK) + gamma * old);
        const Num<S> lambda = hn::Max(old - step, zero);
        const Num<S> change = lambda - old;
        p.at.set(point.impulse, lambda);
        if (pass.last && final) p.at.set(point.total, p.at(point.total) + lambda);
        speed = speed + change * mass;
        pushed = pushed + change;
        p.turn(change, point.row);
        if (!final) continue;
        pressed.sum = pressed.sum + lambda;
        if constexpr (S::dim == 3) pressed.moment = pressed.moment + lambda * p.at(point.radius);
    }
    subtract(p.a.v, pushed * p.massA, p.normal);
    add(p.b.v, pushed * p.massB, p.normal);
    return pressed;
}

/// Tangents and twist at once: in (lambda_t, lambda_twist / r) with r the mean distance of the pressure from
/// the centre, the limit surface is a ball.
template <class S>
HWY_INLINE void solveFriction(PatchGroup<S>& p, const Pressed<S>& pressed, bool last) {
    PatchBlock<S>& block = p.block;
    constexpr std::size_t tangents = PatchSize<S>::tangents;
    const LinVec<S> dv = minus(p.b.v, p.a.v);
    const Num<S> invK = p.at(block.rubInvK), one = number<S>(1);
    std::array<LinVec<S>, tangents> t;
    std::array<Num<S>, tangents> old, next;
    for (std::size_t k = 0; k < tangents; ++k) {
        t[k] = p.at(block.tangent[k]);
        const AngVec<S> jA = p.at(block.rub[k].jA), jB = p.at(block.rub[k].jB);
        old[k] = p.at(block.rubImpulse[k]);
        next[k] = old[k] - (dot(t[k], dv) + turning<S>(jA, jB, p.a.w, p.b.w)) * invK;
    }
    Num<S> size2 = dot(next, next);
    const Num<S> sticking = p.at(block.staticFriction) * pressed.sum;
    [[maybe_unused]] Num<S> twist = one, oldTwist = one, radius = one;
    if constexpr (S::dim == 3) {
        const auto spread = invertible(pressed.moment);
        radius = pressed.moment / hn::IfThenElse(spread, pressed.sum, one);
        oldTwist = p.at(block.twistImpulse);
        const Num<S> w = dot(p.normal, minus(p.b.w, p.a.w));
        // The pressure may have come together at the centre since the old one was found.
        const Num<S> before = oldTwist / hn::IfThenElse(spread, radius, one);
        const Num<S> bounded = hn::Max(hn::Min(before, sticking), hn::Zero(Tag<S>()) - sticking);
        twist = hn::IfThenElseZero(spread, bounded - radius * w * invK);
        size2 = size2 + twist * twist;
    }
    const auto sticks = size2 <= sticking * sticking;
    // Where it slides size2 > 0.
    const Num<S> size = hn::Sqrt(hn::IfThenElse(sticks, one, size2));
    const Num<S> scale = hn::IfThenElse(sticks, one, p.at(block.friction) * pressed.sum / size);
    for (std::size_t k = 0; k < tangents; ++k) {
        next[k] = scale * next[k];
        p.at.set(block.rubImpulse[k], next[k]);
        if (last) p.at.set(block.rubTotal[k], p.at(block.rubTotal[k]) + next[k]);
        p.push(next[k] - old[k], t[k], block.rub[k]);
    }
    if constexpr (S::dim == 3) {
        twist = scale * twist * radius;
        p.at.set(block.twistImpulse, twist);
        if (last) p.at.set(block.twistTotal, p.at(block.twistTotal) + twist);
        subtract(p.a.w, twist - oldTwist, p.at(block.twistA));
        add(p.b.w, twist - oldTwist, p.at(block.twistB));
    }
}

/// What a sub-step makes of points that can bounce, before forces: those that hit get their rebound; a gap
/// that may end in one is let through, because closing it would take the speed that is to be reversed.
template <class S>
HWY_INLINE void plan(PatchGroup<S>& p, const PatchPass<typename S::Real>& pass) {
    PatchBlock<S>& block = p.block;
    const Num<S> zero = hn::Zero(Tag<S>()), e = p.at(block.restitution);
    const Num<S> touching = number<S>(pass.touching);
    const Twist<S> movedA = p.sideA.motion(), movedB = p.sideB.motion();
    const Num<S> speed = dot(p.normal, minus(p.b.v, p.a.v)), moved = dot(p.normal, minus(movedB.v, movedA.v));
    for (int i = 0; i < block.points; ++i) {
        PatchPoint<S>& point = block.point[i];
        const AngVec<S> jA = p.at(point.row.jA), jB = p.at(point.row.jB);
        const Num<S> approach = speed + turning<S>(jA, jB, p.a.w, p.b.w);
        const Num<S> s = p.at(point.separation) + moved + turning<S>(jA, jB, movedA.w, movedB.w);
        const auto fast = hn::And(e > zero, approach < number<S>(-pass.threshold));
        const auto apart = s > touching;
        const auto mayHit = hn::And(e > zero, s > number<S>(pass.restingGap));
        const auto open = hn::And(apart, hn::Or(fast, mayHit));
        p.at.set(point.rebound, hn::IfThenElseZero(hn::AndNot(apart, fast), e * approach));
        p.at.set(point.open, hn::IfThenElseZero(open, number<S>(1)));
        p.at.set(point.impulse, hn::IfThenElse(open, zero, p.at(point.impulse)));
    }
}

template <class S>
void warmStartAll(const PatchRange<S>& range) {
    forPatches<S>(range, [](PatchGroup<S>& p) { warmStart(p); });
}
template <class S>
void solveAll(const PatchRange<S>& range, const PatchPass<typename S::Real>& pass) {
    forPatches<S>(range, [&pass](PatchGroup<S>& p) {
        const Pressed<S> pressed = solveNormals(p, pass);
        solveFriction(p, pressed, pass.last);
    });
}
template <class S>
void planAll(const PatchRange<S>& range, const PatchPass<typename S::Real>& pass) {
    forPatches<S>(range, [&pass](PatchGroup<S>& p) {
        if (p.block.bounces) plan(p, pass);
    });
}

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
