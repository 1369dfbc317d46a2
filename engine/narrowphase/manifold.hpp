// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A contact manifold: what two convex shapes that touch have in common. The normal points from A to B; a
// positive impulse along it pushes B away from A. separation < 0 means penetration (depth = -separation).
#pragma once

#include <array>
#include <cstdint>

#include "engine/math/space.hpp"
#include "engine/shapes/shape.hpp"

namespace rigor::engine {

template <class S>
struct ManifoldPoint {
    typename S::Vec pointA, pointB;   ///< points on the surfaces of A and B, world frame [m]
    typename S::Real separation = 0;  ///< (pointB - pointA) . normal [m]
    std::uint32_t feature = 0;  ///< names the touching features; stable from frame to frame while they touch
};

/// Choices of a narrow phase for a pair, remembered for the same pair in the next step. If another axis, or
/// another choice of points, is better by less than kKeep or kKeepSpread (detail.hpp), the last one stays, so
/// that normals and features do not alternate with rounding. Part of the world's state.
template <class S>
struct ManifoldMemory {
    enum Axis : std::uint8_t { kNoAxis, kFaceA, kFaceB, kEdges };
    std::uint8_t axis = kNoAxis;               ///< features that made the axis of two polytopes
    std::uint32_t featureA = 0, featureB = 0;  ///< their faces; of kEdges their edges
    typename S::Vec normal = S::Vec::Zero();   ///< normal as in Manifold
    std::uint32_t count = 0;                   ///< 0: nothing remembered
    std::array<std::uint32_t, S::maxManifoldPoints> names{};  ///< features of the points, in their order
};

template <class S>
struct Manifold {
    typename S::Vec normal = S::Vec::Zero();  ///< unit, world frame, A to B
    int count = 0;                            ///< 0: no contact within the speculative distance
    /// Lower bound of the separation of shapes without a contact [m], if the algorithm computes one at no
    /// extra cost; else 0.
    typename S::Real separationLowerBound = 0;
    std::array<ManifoldPoint<S>, S::maxManifoldPoints> points;
    ManifoldMemory<S> memory;
};

/// Fills `out` for two posed shapes. Points are reported up to `speculativeDistance` >= 0 [m] of separation.
/// Only the memory of `out` is read: that of the same pair in the last step, or an empty one, which gives the
/// deepest axis there is.
template <class S>
using CollideFunction = void (*)(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb,
                                 typename S::Real speculativeDistance, Manifold<S>& out);

/// A narrow phase as an object, for those that are not in the table: WorldDef::customNarrowPhase. With/ the
/// same shapes and poses it must give the same result.
template <class S>
class NarrowPhase {
  public:
    virtual ~NarrowPhase() = default;
    /// The contract of CollideFunction.
    virtual void collide(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb,
                         typename S::Real speculativeDistance, Manifold<S>& out) const = 0;
    /// True: `collide` may be called by several threads at the same time. Else by one at a time.
    virtual bool manyThreads() const { return false; }
};

/// A narrow phase by the names of narrowphases.def. Null when unknown.
template <class S>
CollideFunction<S> findNarrowPhase(const char* name);

}  // namespace rigor::engine
