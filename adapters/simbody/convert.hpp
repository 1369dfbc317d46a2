// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Vectors, rotations and poses between the scenario's types and Simbody's.
#pragma once

#include "adapters/interface/types.hpp"
#include "adapters/simbody/headers.hpp"

namespace rigor::simbody {

using adapter::Mat3;
using adapter::Pose;
using adapter::Quat;
using adapter::Vec3;

inline SimTK::Vec3 toSimbody(const Vec3& v) {
    return {v.x, v.y, v.z};
}
inline Vec3 fromSimbody(const SimTK::Vec3& v) {
    return {v[0], v[1], v[2]};
}
inline SimTK::Rotation toSimbody(const Quat& q) {
    return SimTK::Rotation(SimTK::Quaternion(q.w, q.x, q.y, q.z));
}
inline SimTK::Transform toSimbody(const Pose& pose) {
    return {toSimbody(pose.orientation), toSimbody(pose.position)};
}
inline Pose fromSimbody(const SimTK::Transform& pose) {
    const SimTK::Quaternion q = pose.R().convertRotationToQuaternion();
    return {fromSimbody(pose.p()), normalized(Quat{q[0], q[1], q[2], q[3]})};
}
/// A rotation that takes an axis of Simbody's onto a direction.
inline SimTK::Rotation axisTo(const Vec3& direction, SimTK::CoordinateAxis axis) {
    return {SimTK::UnitVec3(toSimbody(direction)), axis};
}

}  // namespace rigor::simbody
