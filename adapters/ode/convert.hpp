// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Conversion between the scenario's types and ODE's arrays. ODE's quaternions are w, x, y, z like the
// scenario's.
#pragma once

#include <ode/ode.h>

#include "adapters/interface/inverse.hpp"
#include "adapters/interface/types.hpp"

namespace rigor::ode {

using adapter::inverseOf;
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

}  // namespace rigor::ode
