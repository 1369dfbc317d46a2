// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The exponential map, its inverse, and inertia tensors in world axes.
//
// exp and its callers use no libm sine or cosine, so that every platform gives the same bits: the angle is
// halved until a Taylor polynomial is exact to rounding, then the rotation is squared as often.
#pragma once

#include "engine/math/portable.hpp"
#include "engine/math/space.hpp"

namespace rigor::engine {

/// cos(x) and sin(x)/x for x2 = x^2 <= 1/16; truncation below 3e-17.
template <class R>
void cosSinc(R x2, R& cosine, R& sinc) {
    cosine = R(1) +
             x2 * (R(-1.0 / 2) +
                   x2 * (R(1.0 / 24) +
                         x2 * (R(-1.0 / 720) +
                               x2 * (R(1.0 / 40320) + x2 * (R(-1.0 / 3628800) + x2 * R(1.0 / 479001600))))));
    sinc =
        R(1) +
        x2 * (R(-1.0 / 6) +
              x2 * (R(1.0 / 120) + x2 * (R(-1.0 / 5040) + x2 * (R(1.0 / 362880) + x2 * R(-1.0 / 39916800)))));
}

/// Rotation by the angle v [rad] about +z.
template <class R>
Rot2<R> expMap(R v) {
    R x = v;
    int halvings = 0;
    while (x * x > R(1.0 / 16) && halvings < 64) {
        x *= R(0.5);
        ++halvings;
    }
    if (x * x > R(1.0 / 16)) return {};  // angle too large for its turns to be counted
    R c, s;
    cosSinc(x * x, c, s);
    s *= x;
    for (; halvings > 0; --halvings) {
        const R c2 = c * c - s * s;
        s = R(2) * c * s;
        c = c2;
    }
    return {c, s};
}
/// Rotation about v by |v| [rad].
template <class R>
Eigen::Quaternion<R> expMap(const Eigen::Matrix<R, 3, 1>& v) {
    Eigen::Matrix<R, 3, 1> u = R(0.5) * v;
    int halvings = 0;
    while (u.squaredNorm() > R(1.0 / 16) && halvings < 64) {
        u *= R(0.5);
        ++halvings;
    }
    // angle too large to be counted
    if (u.squaredNorm() > R(1.0 / 16)) return Eigen::Quaternion<R>::Identity();
    R c, s;
    cosSinc(u.squaredNorm(), c, s);
    u *= s;
    for (; halvings > 0; --halvings) {
        const R c2 = c * c - u.squaredNorm();
        u *= R(2) * c;
        c = c2;
    }
    return Eigen::Quaternion<R>(c, u.x(), u.y(), u.z());
}

/// The rotation vector of q, of angle at most pi. It must not be used in the step's hot path, since it uses
/// atan2.
template <class R>
R logMap(const Rot2<R>& q) {
    return q.angle();
}
template <class R>
Eigen::Matrix<R, 3, 1> logMap(const Eigen::Quaternion<R>& q) {
    const Eigen::Matrix<R, 3, 1> u = q.w() < R(0) ? Eigen::Matrix<R, 3, 1>(-q.vec()) : q.vec();
    const R s = u.norm();
    const R w = std::abs(q.w());
    if (s < R(1e-6)) return (R(2) / w) * u;
    return (R(2) * portable::atan2(s, w) / s) * u;
}

/// The rotation vector of q, of angle at most pi, without libm: q is rooted until the arc sine of its half
/// angle is a short series. Accurate to a few units in the last place.
template <class R>
Eigen::Matrix<R, 3, 1> rotationVector(const Eigen::Quaternion<R>& q) {
    const R sign = q.w() < R(0) ? R(-1) : R(1);
    const R length = q.vec().norm();
    if (!(length > R(0))) return Eigen::Matrix<R, 3, 1>::Zero();
    const R norm = std::sqrt(q.w() * q.w() + length * length);
    R c = std::abs(q.w()) / norm, s = length / norm, factor = R(2);
    while (s > R(0.0625)) {  // half of the half angle
        c = std::sqrt(R(0.5) * (R(1) + c));
        s = s / (R(2) * c);
        factor *= R(2);
    }
    // arcsin(s) = sum of (2k)! / (4^k k!^2 (2k + 1)) s^(2k + 1); s^2 <= 1/64: what is left out is below
    // 2e-18.
    const R x = s * s;
    R series = R(0);
    for (const double a : {231.0 / 13312, 63.0 / 2816, 35.0 / 1152, 5.0 / 112, 3.0 / 40, 1.0 / 6, 1.0})
        series = series * x + R(a);
    return (sign * factor * s * series / length) * q.vec();
}

template <class R>
Rot2<R> normalizedRot(const Rot2<R>& q) {
    const R n = std::sqrt(q.c * q.c + q.s * q.s);
    return {q.c / n, q.s / n};
}
template <class R>
Eigen::Quaternion<R> normalizedRot(const Eigen::Quaternion<R>& q) {
    const R n = std::sqrt(q.w() * q.w() + q.x() * q.x() + q.y() * q.y() + q.z() * q.z());
    return Eigen::Quaternion<R>(q.w() / n, q.x() / n, q.y() / n, q.z() / n);
}

/// exp(v) q, unit.
template <class R>
Rot2<R> rotatedBy(const Rot2<R>& q, R v) {
    return normalizedRot(compose(expMap(v), q));
}
template <class R>
Eigen::Quaternion<R> rotatedBy(const Eigen::Quaternion<R>& q, const Eigen::Matrix<R, 3, 1>& v) {
    return normalizedRot(compose(expMap(v), q));
}

// --- angular quantities, alike in both dimensions ---------------------------------------------------------
template <class S>
typename S::Ang zeroAng() {
    if constexpr (S::dim == 2)
        return typename S::Real(0);
    else
        return S::Ang::Zero();
}
template <class S>
typename S::Inertia zeroInertia() {
    if constexpr (S::dim == 2)
        return typename S::Real(0);
    else
        return S::Inertia::Zero();
}
/// I_W = R I_B R^T.
template <class S>
typename S::Inertia worldInertia(const typename S::Rot& q, const typename S::Inertia& body) {
    if constexpr (S::dim == 2) {
        (void)q;
        return body;
    } else {
        const typename S::Mat R = toMatrix(q);
        return R * body * R.transpose();
    }
}
template <class S>
typename S::Inertia inverseInertia(const typename S::Inertia& body) {
    if constexpr (S::dim == 2)
        return typename S::Real(1) / body;
    else
        return body.inverse();
}
template <class S>
bool isFinite(const typename S::Vec& v) {
    return v.allFinite();
}
template <class R>
bool finiteAng(R v) {
    return std::isfinite(v);
}
template <class R>
bool finiteAng(const Eigen::Matrix<R, 3, 1>& v) {
    return v.allFinite();
}

}  // namespace rigor::engine
