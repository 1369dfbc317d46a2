// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Euler's equations about a fixed point with the attitude as a quaternion, integrated in extended precision.
// Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., 2002, sections 5.5-5.7.
#include <array>
#include <cmath>

#include "validation/references/rotation.hpp"

namespace rigor::validation {
namespace {

using numerics::OdeState;
using numerics::Real;
using Vector = std::array<Real, 3>;
using Matrix = std::array<Vector, 3>;

Vector crossOf(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector product(const Matrix& m, const Vector& v) {
    Vector r{};
    for (std::size_t i = 0; i < 3; ++i) r[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return r;
}

Matrix inverseOf(const Matrix& m) {
    const Vector c0 = crossOf(m[1], m[2]), c1 = crossOf(m[2], m[0]), c2 = crossOf(m[0], m[1]);
    const Real det = m[0][0] * c0[0] + m[0][1] * c0[1] + m[0][2] * c0[2];
    Matrix r{};
    for (std::size_t i = 0; i < 3; ++i) r[i] = {c0[i] / det, c1[i] / det, c2[i] / det};
    return r;
}

/// R(q)^T v for a quaternion of any length near 1.
Vector toBody(const OdeState& y, const Vector& v) {
    const Real n = y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + y[3] * y[3];
    const Vector u{-y[1], -y[2], -y[3]};
    Vector t = crossOf(u, v);
    const Vector s = crossOf(u, t);
    Vector r{};
    for (std::size_t i = 0; i < 3; ++i) r[i] = v[i] + 2 * (y[0] * t[i] + s[i]) / n;
    return r;
}

}  // namespace

FixedPointMotion::FixedPointMotion(const Mat3& inertia, double mass, Vec3 arm, Vec3 gravity, Quat orientation,
                                   Vec3 angularVelocity, double duration) {
    Matrix moments{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) moments[i][j] = inertia.m[i][j];
    const Matrix inverse = inverseOf(moments);
    const Vector lever{static_cast<Real>(mass) * arm.x, static_cast<Real>(mass) * arm.y,
                       static_cast<Real>(mass) * arm.z};
    const Vector field{gravity.x, gravity.y, gravity.z};
    const auto rhs = [=](Real, const OdeState& y, OdeState& d) {
        const Vector w{y[4], y[5], y[6]};
        const Vector gyroscopic = crossOf(w, product(moments, w));
        Vector torque = crossOf(lever, toBody(y, field));
        for (std::size_t i = 0; i < 3; ++i) torque[i] -= gyroscopic[i];
        const Vector a = product(inverse, torque);
        d[0] = (-y[1] * w[0] - y[2] * w[1] - y[3] * w[2]) / 2;
        d[1] = (y[0] * w[0] + y[2] * w[2] - y[3] * w[1]) / 2;
        d[2] = (y[0] * w[1] + y[3] * w[0] - y[1] * w[2]) / 2;
        d[3] = (y[0] * w[2] + y[1] * w[1] - y[2] * w[0]) / 2;
        for (std::size_t i = 0; i < 3; ++i) d[4 + i] = a[i];
    };
    const Quat q = scenario::normalized(orientation);
    const Vec3 w = rotateInverse(q, angularVelocity);
    solution_ = numerics::DenseSolution(rhs, 0, {q.w, q.x, q.y, q.z, w.x, w.y, w.z}, duration);
}

Attitude FixedPointMotion::at(double t) const {
    const OdeState y = solution_.at(t);
    const auto d = [&](std::size_t i) { return static_cast<double>(y[i]); };
    Attitude attitude;
    attitude.orientation = scenario::normalized(Quat{d(0), d(1), d(2), d(3)});
    attitude.angularVelocity = rotate(attitude.orientation, {d(4), d(5), d(6)});
    return attitude;
}

}  // namespace rigor::validation
