// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenario geometry and poses as the engine's, and vectors back.
#pragma once

#include <vector>

#include "adapters/interface/types.hpp"
#include "engine/shapes/shape.hpp"

namespace rigor::adapter {

template <class S>
typename S::Vec toEngineVec(const Vec3& v) {
    using R = typename S::Real;
    typename S::Vec result;
    const double from[3] = {v.x, v.y, v.z};
    for (int i = 0; i < S::dim; ++i) result[i] = static_cast<R>(from[i]);
    return result;
}

template <class R>
Vec3 fromEngineVec(const Eigen::Matrix<R, 2, 1>& v) {
    return {static_cast<double>(v.x()), static_cast<double>(v.y()), 0.0};
}
template <class R>
Vec3 fromEngineVec(const Eigen::Matrix<R, 3, 1>& v) {
    return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

template <class R>
void setRotation(const Quat& q, engine::Rot2<R>& out) {
    // Half angle to angle without trigonometry.
    out = {static_cast<R>(q.w * q.w - q.z * q.z), static_cast<R>(2.0 * q.w * q.z)};
}
template <class R>
void setRotation(const Quat& q, Eigen::Quaternion<R>& out) {
    out = Eigen::Quaternion<R>(static_cast<R>(q.w), static_cast<R>(q.x), static_cast<R>(q.y),
                               static_cast<R>(q.z));
}

template <class S>
engine::Pose<S> toEnginePose(const Pose& pose) {
    engine::Pose<S> result;
    result.p = toEngineVec<S>(pose.position);
    setRotation(pose.orientation, result.q);
    return result;
}

/// Throws Unsupported for cylinder, cone and segment.
template <class S>
engine::Shape<S> toEngineShape(const Geometry& geometry) {
    using R = typename S::Real;
    if (const auto* s = std::get_if<scenario::Sphere>(&geometry))
        return engine::Sphere<S>{static_cast<R>(s->radius)};
    if (const auto* s = std::get_if<scenario::Box>(&geometry))
        return engine::Box<S>{toEngineVec<S>(s->halfExtents)};
    if (const auto* s = std::get_if<scenario::Capsule>(&geometry))
        return engine::Capsule<S>{static_cast<R>(s->radius), static_cast<R>(s->halfLength)};
    if (const auto* s = std::get_if<scenario::HalfSpace>(&geometry))
        return engine::HalfSpace<S>{toEngineVec<S>(s->normal), static_cast<R>(s->offset)};
    if (const auto* s = std::get_if<scenario::ConvexHull>(&geometry)) {
        std::vector<typename S::Vec> points;
        for (const Vec3& v : s->vertices) points.push_back(toEngineVec<S>(v));
        return engine::makeHull<S>(points);
    }
    throw Unsupported(std::string("rigor has no shape ") + scenario::geometryName(geometry, S::dim));
}

}  // namespace rigor::adapter
