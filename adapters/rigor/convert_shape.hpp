// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenario geometry and poses as the engine's, and vectors back.
#pragma once

#include <vector>

#include "adapters/interface/types.hpp"
#include "engine/shapes/surface.hpp"
#include "engine/state/shape_filter.hpp"

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

template <class S>
std::vector<typename S::Vec> toEngineVecs(const std::vector<Vec3>& points) {
    std::vector<typename S::Vec> result;
    for (const Vec3& v : points) result.push_back(toEngineVec<S>(v));
    return result;
}

template <class R>
engine::Shape<engine::Space<R, 2>> toPlaneShape(const Geometry& geometry) {
    using S = engine::Space<R, 2>;
    if (const auto* s = std::get_if<scenario::Segment>(&geometry))
        return engine::Segment<S>{toEngineVec<S>(s->a), toEngineVec<S>(s->b)};
    if (const auto* s = std::get_if<scenario::Chain>(&geometry))
        return engine::makeChain<S>(toEngineVecs<S>(s->vertices), s->loop);
    throw notInAdapter("rigor", std::string("shape '") + scenario::geometryName(geometry, 2) + "' in 2D");
}

template <class R>
engine::Shape<engine::Space<R, 3>> toSpaceShape(const Geometry& geometry) {
    using S = engine::Space<R, 3>;
    if (const auto* s = std::get_if<scenario::Cylinder>(&geometry))
        return engine::Cylinder<S>{static_cast<R>(s->radius), static_cast<R>(s->halfLength)};
    if (const auto* s = std::get_if<scenario::Cone>(&geometry))
        return engine::Cone<S>{static_cast<R>(s->radius), static_cast<R>(s->halfLength)};
    if (const auto* s = std::get_if<scenario::Ellipsoid>(&geometry))
        return engine::Ellipsoid<S>{toEngineVec<S>(s->halfAxes)};
    if (const auto* s = std::get_if<scenario::TriangleMesh>(&geometry)) {
        std::vector<std::array<std::uint32_t, 3>> triangles;
        for (const std::array<int, 3>& t : s->triangles)
            triangles.push_back({static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]),
                                 static_cast<std::uint32_t>(t[2])});
        return engine::makeTriangleMesh<S>(toEngineVecs<S>(s->vertices), triangles);
    }
    if (const auto* s = std::get_if<scenario::HeightField>(&geometry)) {
        std::vector<R> heights;
        for (const double h : s->heights) heights.push_back(static_cast<R>(h));
        return engine::makeHeightField<S>(s->columns, s->rows, static_cast<R>(s->spacingX),
                                          static_cast<R>(s->spacingZ), heights, static_cast<R>(s->thickness));
    }
    throw notInAdapter("rigor", std::string("shape '") + scenario::geometryName(geometry, 3) + "' in 3D");
}

/// Throws Unsupported for shapes of the other dimension.
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
        return engine::makeHull<S>(toEngineVecs<S>(s->vertices));
    }
    if constexpr (S::dim == 2)
        return toPlaneShape<R>(geometry);
    else
        return toSpaceShape<R>(geometry);
}

/// A shape that collides with all layers of a file has the engine's default mask.
inline engine::ShapeFilter toEngineFilter(const scenario::ContactFilter& filter) {
    const bool all = filter.collidesWith == scenario::kAllLayers;
    return {filter.layers, all ? engine::ShapeFilter{}.mask : filter.collidesWith, filter.group};
}

}  // namespace rigor::adapter
