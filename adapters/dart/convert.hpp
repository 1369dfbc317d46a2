// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Vectors, rotations and poses between the scenario's types and Eigen's.
#pragma once

#include <Eigen/Geometry>

#include "adapters/interface/types.hpp"

namespace rigor::dart_adapter {

using adapter::Mat3;
using adapter::Pose;
using adapter::Quat;
using adapter::Vec3;

inline Eigen::Vector3d toDart(const Vec3& v) {
    return {v.x, v.y, v.z};
}
inline Vec3 fromDart(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}
inline Eigen::Isometry3d toDart(const Pose& pose) {
    const Quat& q = pose.orientation;
    Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
    out.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
    out.translation() = toDart(pose.position);
    return out;
}
inline Pose fromDart(const Eigen::Isometry3d& pose) {
    const Eigen::Quaterniond q(pose.linear());
    return {fromDart(Eigen::Vector3d(pose.translation())), normalized(Quat{q.w(), q.x(), q.y(), q.z()})};
}

}  // namespace rigor::dart_adapter
