// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Conversion between the scenario's vectors and MuJoCo's arrays. Quaternions are w, x, y, z in both.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>

#include "adapters/interface/types.hpp"

namespace rigor::mujoco {

using adapter::Mat3;
using adapter::Pose;
using adapter::Quat;
using adapter::Vec3;

inline Vec3 fromMujoco(const mjtNum* v) {
    return {v[0], v[1], v[2]};
}
inline Quat quatFromMujoco(const mjtNum* q) {
    return {q[0], q[1], q[2], q[3]};
}
inline void toMujoco(const Vec3& v, mjtNum* out) {
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}
inline void toMujoco(const Quat& q, mjtNum* out) {
    out[0] = q.w;
    out[1] = q.x;
    out[2] = q.y;
    out[3] = q.z;
}

struct Deleter {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
};
using ModelOwner = std::unique_ptr<mjModel, Deleter>;
using DataOwner = std::unique_ptr<mjData, Deleter>;

}  // namespace rigor::mujoco
