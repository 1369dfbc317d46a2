// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Between the scenario's types and ODE's arrays. ODE's quaternions are w, x, y, z like ours.
#pragma once

#include <ode/ode.h>

#include "adapters/interface/types.hpp"

namespace rigor::ode {

using adapter::Mat3;
using adapter::Pose;
using adapter::Quat;
using adapter::Vec3;

inline Vec3 fromOde(const dReal* v) {
    return {v[0], v[1], v[2]};
}
inline Quat quatFromOde(const dReal* q) {
    return {q[0], q[1], q[2], q[3]};
}
inline void toOde(const Vec3& v, dReal* out) {
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}
inline void toOde(const Quat& q, dReal* out) {
    out[0] = q.w;
    out[1] = q.x;
    out[2] = q.y;
    out[3] = q.z;
}

/// Inverse of a symmetric positive definite tensor by cofactors.
inline Mat3 inverseOf(const Mat3& a) {
    const auto cofactor = [&](int i, int j) {
        const int r = (i + 1) % 3, s = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
        return a(r, c) * a(s, d) - a(r, d) * a(s, c);
    };
    const double det = a(0, 0) * cofactor(0, 0) + a(0, 1) * cofactor(0, 1) + a(0, 2) * cofactor(0, 2);
    Mat3 inverse;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) inverse(i, j) = cofactor(j, i) / det;
    return inverse;
}

}  // namespace rigor::ode
