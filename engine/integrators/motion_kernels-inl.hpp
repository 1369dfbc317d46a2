// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Orientations of several bodies as registers: the laws of math/rotation.hpp and rotation_lie_midpoint.cpp,
// for all of them at once, to rounding.
#if defined(RIGOR_MOTION_KERNELS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef RIGOR_MOTION_KERNELS_INL_HPP
#undef RIGOR_MOTION_KERNELS_INL_HPP
#else
#define RIGOR_MOTION_KERNELS_INL_HPP
#endif

#include "engine/integrators/motion_kernels.hpp"
#include "engine/state/bodies-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {

template <class V>
using Vec3 = std::array<V, 3>;
/// x, y, z, w
template <class V>
using Quaternion = std::array<V, 4>;

template <class V>
HWY_INLINE V constant(double x) {
    const hn::DFromV<V> d;
    return hn::Set(d, static_cast<hn::TFromD<decltype(d)>>(x));
}
/// The polynomial of falling coefficients.
template <class V, std::size_t n>
HWY_INLINE V polynomial(V x, const double (&coefficients)[n]) {
    V sum = constant<V>(coefficients[0]);
    for (std::size_t k = 1; k < n; ++k) sum = sum * x + constant<V>(coefficients[k]);
    return sum;
}
/// cos(x) and sin(x)/x of x2 = x^2 <= 1/16: truncation below a unit in the last place.
template <class V>
HWY_INLINE void cosSinc(V x2, V& cosine, V& sinc) {
    if constexpr (sizeof(hn::TFromV<V>) == 4) {
        cosine = polynomial(x2, {1.0 / 40320, -1.0 / 720, 1.0 / 24, -1.0 / 2, 1.0});
        sinc = polynomial(x2, {-1.0 / 5040, 1.0 / 120, -1.0 / 6, 1.0});
    } else {
        cosine = polynomial(
            x2, {1.0 / 479001600, -1.0 / 3628800, 1.0 / 40320, -1.0 / 720, 1.0 / 24, -1.0 / 2, 1.0});
        sinc = polynomial(x2, {-1.0 / 39916800, 1.0 / 362880, -1.0 / 5040, 1.0 / 120, -1.0 / 6, 1.0});
    }
}

/// cosSincOfAny() of rotation_lie_midpoint.cpp.
template <class V>
HWY_INLINE void cosSincOfAny(V x2, V& cosine, V& sinc) {
    const V limit = constant<V>(1.0 / 16), quarter = constant<V>(0.25), one = constant<V>(1),
            zero = constant<V>(0);
    const hn::DFromV<V> d;
    V halvings = zero;
    constexpr int kMost = 64;
    for (int i = 0; i < kMost; ++i) {
        const auto large = x2 > limit;
        if (HWY_LIKELY(hn::AllFalse(d, large))) break;
        x2 = hn::IfThenElse(large, x2 * quarter, x2);
        halvings = hn::IfThenElse(large, halvings + one, halvings);
    }
    const auto counted = x2 <= limit;
    x2 = hn::IfThenElseZero(counted, x2);
    halvings = hn::IfThenElseZero(counted, halvings);
    cosSinc(x2, cosine, sinc);
    for (int i = 0; i < kMost; ++i) {
        const auto left = halvings > constant<V>(i);
        if (HWY_LIKELY(hn::AllFalse(d, left))) break;
        sinc = hn::IfThenElse(left, sinc * cosine, sinc);
        cosine = hn::IfThenElse(left, constant<V>(2) * cosine * cosine - one, cosine);
    }
}

/// Cosine and sine (of the angle of each lane, or of half of it times the axis): the angle is halved until
/// the polynomials hold, then the rotation squared as often.
template <std::size_t n, class V>
HWY_INLINE std::array<V, n + 1> cosineAndSines(std::array<V, n> x) {
    const V limit = constant<V>(1.0 / 16), half = constant<V>(0.5), one = constant<V>(1);
    V halvings = constant<V>(0);
    constexpr int kMost = 64;
    const hn::DFromV<V> d;
    for (int i = 0; i < kMost; ++i) {
        const auto large = dot(x, x) > limit;
        if (HWY_LIKELY(hn::AllFalse(d, large))) break;
        for (V& number : x) number = hn::IfThenElse(large, number * half, number);
        halvings = hn::IfThenElse(large, halvings + one, halvings);
    }
    const auto countless = dot(x, x) > limit;  // angle too large for its turns to be counted: no rotation
    V c, sinc;
    cosSinc(dot(x, x), c, sinc);
    for (V& number : x) number = number * sinc;
    for (int i = 0; i < kMost; ++i) {
        const auto left = halvings > constant<V>(i);
        if (HWY_LIKELY(hn::AllFalse(d, left))) break;
        const V c2 = c * c - dot(x, x);
        for (V& number : x) number = hn::IfThenElse(left, constant<V>(2) * c * number, number);
        c = hn::IfThenElse(left, c2, c);
    }
    std::array<V, n + 1> all;
    for (std::size_t k = 0; k < n; ++k) all[k] = hn::IfThenElse(countless, constant<V>(0), x[k]);
    all[n] = hn::IfThenElse(countless, one, c);
    return all;
}
template <class V>
HWY_INLINE Quaternion<V> expMap(const Vec3<V>& v) {
    const V half = constant<V>(0.5);
    return cosineAndSines<3>(Vec3<V>{v[0] * half, v[1] * half, v[2] * half});
}

template <class V>
HWY_INLINE Quaternion<V> compose(const Quaternion<V>& a, const Quaternion<V>& b) {
    return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
            a[3] * b[1] + a[1] * b[3] + a[2] * b[0] - a[0] * b[2],
            a[3] * b[2] + a[2] * b[3] + a[0] * b[1] - a[1] * b[0],
            a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}
/// v turned by q, or with `sign` = -1 by its inverse, at its own length whatever that of q.
template <class V>
HWY_INLINE Vec3<V> rotate(const Quaternion<V>& q, const Vec3<V>& v, double sign = 1) {
    const Vec3<V> u{q[0], q[1], q[2]}, t = moment(u, v), s = moment(u, t);
    const V twice = constant<V>(2) / dot(q, q), w = constant<V>(sign) * q[3];
    Vec3<V> turned = v;
    for (std::size_t k = 0; k < 3; ++k) turned[k] = v[k] + twice * (w * t[k] + s[k]);
    return turned;
}
template <class V, std::size_t n>
HWY_INLINE std::array<V, n> normalized(const std::array<V, n>& q) {
    const V scale = constant<V>(1) / hn::Sqrt(dot(q, q));
    std::array<V, n> unit;
    for (std::size_t k = 0; k < n; ++k) unit[k] = q[k] * scale;
    return unit;
}

/// Orientations turned by the rotation vectors v.
template <class S>
HWY_INLINE void turn(Place<S>& x, const AngVec<S>& v) {
    if constexpr (S::dim == 2) {
        const auto r = cosineAndSines<1>(v);  // sine, cosine
        x.q = normalized(std::array<Num<S>, 2>{r[1] * x.q[0] - r[0] * x.q[1], r[0] * x.q[0] + r[1] * x.q[1]});
    } else {
        x.q = normalized(compose(expMap(v), x.q));
    }
}

template <class V>
HWY_INLINE auto turnsAboutItself(const Vec3<V>& w, const Vec3<V>& momentum) {
    const Vec3<V> across = moment(w, momentum);
    const V bound = constant<V>(4.0 * std::numeric_limits<hn::TFromV<V>>::epsilon());
    return dot(across, across) <= bound * bound * (dot(w, w) * dot(momentum, momentum));
}

/// A x = b, the columns of A given (Cramer's rule).
template <class V>
HWY_INLINE Vec3<V> solve3(const Vec3<V>& a0, const Vec3<V>& a1, const Vec3<V>& a2, const Vec3<V>& b) {
    const Vec3<V> a12 = moment(a1, a2);
    const V scale = constant<V>(1) / dot(a0, a12);
    return {dot(b, a12) * scale, dot(moment(a2, a0), b) * scale, dot(moment(a0, a1), b) * scale};
}

/// One of Newton's steps of LieMidpoint::turn: from W to W - step; half is h/2.
template <class V>
HWY_INLINE Vec3<V> newtonStep(const std::array<V, 6>& I, const Vec3<V>& momentum, const Vec3<V>& W, V half) {
    const V zero = constant<V>(0);
    const V x2 = half * half * dot(W, W);
    V c, sinc;
    cosSincOfAny(x2, c, sinc);
    const V s = half * sinc;
    const Vec3<V> Pi = times(I, W), change = minus(Pi, momentum), across = moment(W, Pi);
    const Vec3<V> none{zero, zero, zero};
    Vec3<V> f = none, slope = none;
    add(f, c, change);
    add(f, s, across);
    const V third = half * (constant<V>(1.0 / 3) - x2 * constant<V>(1.0 / 30));
    subtract(slope, half * half * sinc, change);
    subtract(slope, half * half * third, across);
    // Column k of c I + s ([W]x I - [Pi]x) + slope W^T; `turned` is that of -[Pi]x.
    const auto column = [&](const Vec3<V>& inertia, const Vec3<V>& turned, const V& speed) {
        Vec3<V> turning = moment(W, inertia), sum = none;
        add(turning, constant<V>(1), turned);
        add(sum, c, inertia);
        add(sum, s, turning);
        add(sum, speed, slope);
        return sum;
    };
    return solve3(column({I[0], I[1], I[2]}, {zero, zero - Pi[2], Pi[1]}, W[0]),
                  column({I[1], I[3], I[4]}, {Pi[2], zero, zero - Pi[0]}, W[1]),
                  column({I[2], I[4], I[5]}, {zero - Pi[1], Pi[0], zero}, W[2]), f);
}

/// LieMidpoint::turn: from the angular velocity w to the one that moves the body, body axes. Lanes end when
/// they have converged.
template <class V>
HWY_INLINE Vec3<V> freeTurn(const std::array<V, 6>& I, const Vec3<V>& w, V h) {
    using R = hn::TFromV<V>;
    const hn::DFromV<V> d;
    const Vec3<V> momentum = times(I, w);
    const V enough = constant<V>(1e-2 * std::numeric_limits<R>::epsilon()), half = constant<V>(0.5) * h;
    Vec3<V> W = w;
    auto going = hn::Not(turnsAboutItself(w, momentum));
    V last = constant<V>(std::numeric_limits<R>::max());
    constexpr int kMaxNewton = 30;
    for (int i = 0; i < kMaxNewton && !hn::AllFalse(d, going); ++i) {
        const Vec3<V> step = newtonStep(I, momentum, W, half);
        const V size = dot(step, step);
        going = hn::And(going, size < last);
        last = size;
        for (std::size_t k = 0; k < 3; ++k) W[k] = hn::IfThenElse(going, W[k] - step[k], W[k]);
        going = hn::And(going, size > enough * dot(W, W));
    }
    const auto none = dot(W, times(I, W)) > constant<V>(1.01) * dot(w, momentum);
    for (std::size_t k = 0; k < 3; ++k) W[k] = hn::IfThenElse(none, w[k], W[k]);
    return W;
}

/// Calls work(side, at, block) for every register's worth of lanes.
template <class S, class Block, class Work>
HWY_INLINE void forBodies(Block* blocks, std::size_t count, const Work& work) {
    const std::size_t lanes = hn::Lanes(Tag<S>());
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t first = 0; blocks[k].moves != 0 && first < kLanes; first += lanes)
            work(Side<S>{blocks[k].index + first, blocks[k].moves >> first}, At<S>{first}, blocks[k]);
}

template <class S>
void moveAll(const BodyBlock* blocks, std::size_t count, Pose<S>* poses, const Velocity<S>* velocities,
             typename S::Real h) {
    forBodies<S>(blocks, count, [&](const Side<S>& side, At<S>, const BodyBlock&) RIGOR_INLINE_LAMBDA {
        const Twist<S> u = side.load(velocities);
        Place<S> x = side.load(poses);
        add(x.p, number<S>(h), u.v);
        AngVec<S> v = u.w;
        for (auto& angle : v) angle = angle * number<S>(h);
        turn<S>(x, v);
        side.store(x, poses);
    });
}

template <class S>
void predictAll(TumblingBlock<S>* blocks, std::size_t count, const Pose<S>* poses, Velocity<S>* velocities,
                typename S::Real h) {
    forBodies<S>(
        blocks, count, [&](const Side<S>& side, At<S> at, TumblingBlock<S>& block) RIGOR_INLINE_LAMBDA {
            Twist<S> u = side.load(velocities);
            const auto q = side.load(poses).q;
            const AngVec<S> pushed = rotate(q, times(at(block.invInertia), rotate(q, at(block.kick), -1)));
            add(u.w, number<S>(1), pushed);
            at.set(block.kicked, u.w);
            at.set(block.start, q);
            u.w = rotate(q, freeTurn(at(block.inertia), rotate(q, u.w, -1), number<S>(h)));
            at.set(block.predicted, u.w);
            side.store(u, velocities);
        });
}

template <class S>
void finishAll(const TumblingBlock<S>* blocks, std::size_t count, const Pose<S>* poses,
               Velocity<S>* velocities) {
    forBodies<S>(blocks, count,
                 [&](const Side<S>& side, At<S> at, const TumblingBlock<S>& block) RIGOR_INLINE_LAMBDA {
                     Twist<S> u = side.load(velocities);
                     const Quaternion<Num<S>> start = at(block.start), end = side.load(poses).q;
                     AngVec<S> w = at(block.kicked);
                     add(w, number<S>(1), minus(u.w, at(block.predicted)));
                     const auto I = at(block.inertia), inverse = at(block.invInertia);
                     const AngVec<S> kept = rotate(start, w, -1), momentum = times(I, kept);
                     const auto same = turnsAboutItself(kept, momentum);
                     const AngVec<S> now = rotate(end, rotate(start, momentum), -1);
                     AngVec<S> local = times(inverse, now);
                     // One refinement: the rounding of the inverse is the same in every step and would add
                     // up.
                     add(local, number<S>(1), times(inverse, minus(now, times(I, local))));
                     const AngVec<S> turned = rotate(end, local);
                     for (std::size_t k = 0; k < 3; ++k) u.w[k] = hn::IfThenElse(same, w[k], turned[k]);
                     side.store(u, velocities);
                 });
}

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
