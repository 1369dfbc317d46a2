// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Vectors, matrices and quaternions of space in extended precision, for equations of motion.
#pragma once

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "scenarios/model/math.hpp"
#include "validation/references/numerics/real.hpp"

namespace rigor::validation::numerics {

struct Real3 {
    Real x = 0, y = 0, z = 0;
};
inline Real3 real3(scenario::Vec3 v) {
    return {v.x, v.y, v.z};
}
inline scenario::Vec3 toVec3(Real3 v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
inline Real3 operator+(Real3 a, Real3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Real3 operator-(Real3 a, Real3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Real3 operator*(Real s, Real3 a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline Real dot(Real3 a, Real3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Real3 cross(Real3 a, Real3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real norm(Real3 a) {
    return std::sqrt(dot(a, a));
}

/// Rows of a 3 x 3 matrix.
using Real33 = std::array<Real3, 3>;
inline Real33 real33(const scenario::Mat3& m) {
    Real33 r{};
    for (int i = 0; i < 3; ++i) r[i] = {m(i, 0), m(i, 1), m(i, 2)};
    return r;
}
inline Real3 operator*(const Real33& m, Real3 v) {
    return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}
/// m^T v.
inline Real3 transposed(const Real33& m, Real3 v) {
    return v.x * m[0] + v.y * m[1] + v.z * m[2];
}
/// x with m x = b (Cramer's rule).
inline Real3 solve(const Real33& m, Real3 b) {
    const Real3 c0 = cross(m[1], m[2]), c1 = cross(m[2], m[0]), c2 = cross(m[0], m[1]);
    const Real det = dot(m[0], c0);
    if (det == 0) throw std::runtime_error("a 3 x 3 system is singular");
    return (1 / det) * (b.x * c0 + b.y * c1 + b.z * c2);
}

/// The rotation matrix, body to world, of the quaternion (w, x, y, z) of any length but zero.
inline Real33 rotationOf(Real w, Real x, Real y, Real z) {
    const Real s = 2 / (w * w + x * x + y * y + z * z);
    return {Real3{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
            Real3{s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
            Real3{s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}};
}
/// v turned about the unit vector n by the angle whose cosine and sine are c and s (Rodrigues).
inline Real3 turnedAbout(Real3 n, Real c, Real s, Real3 v) {
    return c * v + s * cross(n, v) + ((1 - c) * dot(n, v)) * n;
}
/// Writes dq/dt = q (0, w)/2 for the body rates w and q at y[at...at+3].
inline void quaternionRate(const std::vector<Real>& y, std::size_t at, Real3 w, std::vector<Real>& d) {
    const Real q0 = y[at], q1 = y[at + 1], q2 = y[at + 2], q3 = y[at + 3];
    d[at] = (-q1 * w.x - q2 * w.y - q3 * w.z) / 2;
    d[at + 1] = (q0 * w.x + q2 * w.z - q3 * w.y) / 2;
    d[at + 2] = (q0 * w.y + q3 * w.x - q1 * w.z) / 2;
    d[at + 3] = (q0 * w.z + q1 * w.y - q2 * w.x) / 2;
}

}  // namespace rigor::validation::numerics
