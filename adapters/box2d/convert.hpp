// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Conversion between the scenario's metres and doubles and Box2D's floats, in a world whose lengths are S
// times larger. Time and mass stay; velocities, accelerations, forces and impulses scale with S, inertia and
// torque with S^2, angles not at all.
#pragma once

#include <box2d/box2d.h>

#include "adapters/interface/types.hpp"

namespace rigor::box2d {

using adapter::Pose;
using adapter::Vec3;

inline constexpr const char* kTwoDimensions =
    "manual v2.4, Overview: \"Box2D is a 2D rigid body simulation library\"";
/// Declaration that shows that Box2D computes in single precision.
inline constexpr const char* kSinglePrecision = "b2_math.h, struct b2Vec2: float x, y";

inline b2Vec2 toBox2d(const Vec3& v, double scale) {
    return {static_cast<float>(scale * v.x), static_cast<float>(scale * v.y)};
}
inline Vec3 fromBox2d(const b2Vec2& v, double scale) {
    return {v.x / scale, v.y / scale, 0.0};
}
inline b2Transform toBox2d(const Pose& pose, double scale) {
    return {toBox2d(pose.position, scale), b2Rot(static_cast<float>(angleAboutZ(pose.orientation)))};
}
inline Pose fromBox2d(const b2Vec2& position, float angle, double scale) {
    return {fromBox2d(position, scale), scenario::fromAxisAngle({0.0, 0.0, 1.0}, angle)};
}

}  // namespace rigor::box2d
