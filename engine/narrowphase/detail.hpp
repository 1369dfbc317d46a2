// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Small tools of the narrow phase, private to this folder. Feature names (ManifoldPoint::feature) are built
// here: they name geometric features (a vertex of A, a vertex of B, the crossing of two edges), never the
// order in which an algorithm found them, so that a switch of the reference face keeps them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/narrowphase/manifold.hpp"
#include "engine/shapes/hull.hpp"

namespace rigor::engine {

template <class R>
using Vec2 = Eigen::Matrix<R, 2, 1>;
template <class R>
using Vec3 = Eigen::Matrix<R, 3, 1>;

/// Rounding of one coordinate operation, with head-room for a chain of a few of them.
template <class R>
inline constexpr R kRounding = R(16) * std::numeric_limits<R>::epsilon();

/// Hysteresis, as a fraction of the smaller shape's size: the axis and the deepest point of the last step
/// stay until another is deeper, or parts more, by this. Ten times what bodies at rest rock by (the slop of
/// position correction, 1e-5 m of a body of one metre), and a tenth of a millimetre for it.
template <class R>
inline constexpr R kKeep = R(1e-4);
/// The same for the spread of the points kept, as a fraction of itself: which of two equally wide sets it is
/// makes no difference to a body.
template <class R>
inline constexpr R kKeepSpread = R(1e-2);

template <class R>
Vec2<R> anyPerpendicular(const Vec2<R>& v) {
    return Vec2<R>(-v.y(), v.x()).normalized();
}
template <class R>
Vec3<R> anyPerpendicular(const Vec3<R>& v) {
    return v.unitOrthogonal();
}

enum class FeatureKind : std::uint32_t { VertexA = 1, VertexB = 2, Crossing = 3 };
inline std::uint32_t vertexFeature(bool onA, int vertex) {
    const auto kind = static_cast<std::uint32_t>(onA ? FeatureKind::VertexA : FeatureKind::VertexB);
    return (kind << 30) | static_cast<std::uint32_t>(vertex);
}
/// An edge by its two vertices, in either order.
inline std::uint32_t edgeName(int v0, int v1) {
    const auto low = static_cast<std::uint32_t>(std::min(v0, v1));
    return low * 8191u + static_cast<std::uint32_t>(std::max(v0, v1));
}
inline std::uint32_t crossingFeature(std::uint32_t edgeA, std::uint32_t edgeB) {
    const std::uint32_t mixed = (edgeA * 2654435761u) ^ (edgeB * 2246822519u + (edgeB >> 7));
    return (static_cast<std::uint32_t>(FeatureKind::Crossing) << 30) | (mixed & 0x3fffffffu);
}

template <class S>
void addPoint(Manifold<S>& out, const typename S::Vec& pointA, const typename S::Vec& pointB,
              typename S::Real separation, std::uint32_t feature) {
    ManifoldPoint<S>& p = out.points[out.count++];
    p.pointA = pointA;
    p.pointB = pointB;
    p.separation = separation;
    p.feature = feature;
}

/// The name of a feature with A and B exchanged.
inline std::uint32_t flippedFeature(std::uint32_t feature) {
    const std::uint32_t kind = feature >> 30;
    return kind == 1 || kind == 2 ? (feature & 0x3fffffffu) | ((3u - kind) << 30) : feature;
}

/// The manifold of (A, B) from that of (B, A).
template <class S>
void flip(Manifold<S>& out) {
    out.normal = -out.normal;
    for (int i = 0; i < out.count; ++i) {
        ManifoldPoint<S>& p = out.points[i];
        std::swap(p.pointA, p.pointB);
        p.feature = flippedFeature(p.feature);
    }
    ManifoldMemory<S>& memory = out.memory;
    memory.normal = -memory.normal;
    std::swap(memory.featureA, memory.featureB);
    if (memory.axis == ManifoldMemory<S>::kFaceA)
        memory.axis = ManifoldMemory<S>::kFaceB;
    else if (memory.axis == ManifoldMemory<S>::kFaceB)
        memory.axis = ManifoldMemory<S>::kFaceA;
    for (std::uint32_t& name : memory.names) name = flippedFeature(name);
}

/// Depth below the deepest point that reducePoints may pass over.
template <class S>
typename S::Real keepSlack(const ManifoldMemory<S>& memory, typename S::Real size) {
    return memory.count > 0 ? kKeep<typename S::Real> * size : typename S::Real(0);
}

/// Stores the features of a complete manifold in world coordinates for the next step.
template <class S>
void remember(Manifold<S>& out) {
    ManifoldMemory<S>& memory = out.memory;
    memory.normal = out.normal;
    memory.count = static_cast<std::uint32_t>(out.count);
    for (std::size_t i = 0; i < memory.names.size(); ++i)
        memory.names[i] = i < memory.count ? out.points[i].feature : 0;
    if (out.count == 0) memory = {};
}

/// Transforms a manifold from the frame of A's pose to the world.
template <class S>
void toWorldFrame(Manifold<S>& out, const Pose<S>& Xa) {
    out.normal = rotate(Xa.q, out.normal);
    for (int i = 0; i < out.count; ++i) {
        ManifoldPoint<S>& p = out.points[i];
        p.pointA = toWorld<S>(Xa, p.pointA);
        p.pointB = toWorld<S>(Xa, p.pointB);
    }
}

/// B's pose in the frame of A. The difference of the positions comes first: far from the origin it is exact.
template <class S>
Pose<S> relativePose(const Pose<S>& Xa, const Pose<S>& Xb) {
    return {rotateInverse<typename S::Real>(Xa.q, Xb.p - Xa.p), compose(inverse(Xa.q), Xb.q)};
}

/// One point between two spheres of radius rA, rB around a and b (points of the cores of A and B). Where a
/// and b coincide, the normal is `fallback` (unit).
template <class S>
void roundedPoint(const typename S::Vec& a, typename S::Real rA, const typename S::Vec& b,
                  typename S::Real rB, const typename S::Vec& fallback, typename S::Real speculative,
                  std::uint32_t feature, Manifold<S>& out) {
    using R = typename S::Real;
    const typename S::Vec d = b - a;
    const R distance = d.norm();
    const R size = std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), rA + rB});
    if (distance - rA - rB > speculative) return;
    out.normal = distance > kRounding<R> * size ? typename S::Vec(d / distance) : fallback;
    addPoint<S>(out, a + rA * out.normal, b - rB * out.normal, distance - rA - rB, feature);
}

/// Parameter in [-h, h] of the point of the local y axis nearest to x.
template <class S>
typename S::Real onAxis(const typename S::Vec& x, typename S::Real h) {
    return std::clamp(x.y(), -h, h);
}

/// Keeps at most maxManifoldPoints of `count` candidates: the deepest, and those that span the largest area;
/// of candidates that are as good within kKeep or kKeepSpread those that `memory` knows, in its order.
/// `separation(i)`, `position(i)`, `name(i)`, `emit(i)`; `normal` is the contact normal, `size` that of the
/// smaller shape.
template <class S, class Separation, class Position, class Name, class Emit>
void reducePoints(int count, const typename S::Vec& normal, typename S::Real size,
                  const ManifoldMemory<S>& memory, Separation separation, Position position, Name name,
                  Emit emit) {
    using R = typename S::Real;
    using V = typename S::Vec;
    if (count <= S::maxManifoldPoints) {
        for (int i = 0; i < count; ++i) emit(i);
        return;
    }
    // The highest score, or of those hardly lower the one remembered first.
    const auto best = [&](auto score, R share, R tolerance) {
        int index = 0;
        R top = score(0);
        for (int i = 1; i < count; ++i)
            if (const R s = score(i); s > top) {
                top = s;
                index = i;
            }
        const R enough = (R(1) - share) * top - tolerance;
        for (std::uint32_t k = 0; k < memory.count; ++k)
            for (int i = 0; i < count; ++i)
                if (name(i) == memory.names[k] && score(i) >= enough) return std::pair<int, R>(i, top);
        return std::pair<int, R>(index, top);
    };
    const int p0 = best([&](int i) { return R(-separation(i)); }, R(0), kKeep<R> * size).first;
    const V a = position(p0);
    const int p1 = best(
                       [&](int i) {
                           const V d = position(i) - a;
                           return R((d - normal * normal.dot(d)).squaredNorm());
                       },
                       R(2) * kKeepSpread<R>, R(0))
                       .first;
    emit(p0);
    if (p1 == p0) return;
    emit(p1);
    if constexpr (S::maxManifoldPoints > 2) {
        const V across = normal.cross(V(position(p1) - a));
        const auto [p2, high] =
            best([&](int i) { return R(across.dot(position(i) - a)); }, kKeepSpread<R>, R(0));
        const auto [p3, low] =
            best([&](int i) { return R(-across.dot(position(i) - a)); }, kKeepSpread<R>, R(0));
        const R flat = kRounding<R> * across.squaredNorm();
        if (high > flat) emit(p2);
        if (low > flat) emit(p3);
    }
}

/// The same without a memory.
template <class S, class Separation, class Position, class Emit>
void reducePoints(int count, const typename S::Vec& normal, Separation separation, Position position,
                  Emit emit) {
    reducePoints<S>(
        count, normal, typename S::Real(0), ManifoldMemory<S>{}, separation, position,
        [](int) { return std::uint32_t(0); }, emit);
}

}  // namespace rigor::engine
