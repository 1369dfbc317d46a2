// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Conversion between the scenario's doubles and Bullet's scalars.
#pragma once

#include <LinearMath/btTransform.h>

#include "adapters/interface/types.hpp"

namespace rigor::bullet {

using adapter::Pose;
using adapter::Quat;
using adapter::Vec3;

inline btVector3 toBullet(const Vec3& v) {
    return {static_cast<btScalar>(v.x), static_cast<btScalar>(v.y), static_cast<btScalar>(v.z)};
}
/// Bullet's constructor takes x, y, z, w.
inline btQuaternion toBullet(const Quat& q) {
    return {static_cast<btScalar>(q.x), static_cast<btScalar>(q.y), static_cast<btScalar>(q.z),
            static_cast<btScalar>(q.w)};
}
inline btTransform toBullet(const Pose& pose) {
    return btTransform(toBullet(pose.orientation), toBullet(pose.position));
}
inline Vec3 fromBullet(const btVector3& v) {
    return {v.x(), v.y(), v.z()};
}
inline Pose fromBullet(const btTransform& t) {
    const btQuaternion q = t.getRotation();
    const Quat unit{q.w(), q.x(), q.y(), q.z()};
    return {fromBullet(t.getOrigin()), normalized(unit)};
}

}  // namespace rigor::bullet
