// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The supporting feature of a convex shape along a direction d: the vertex, segment or face that lies within
// 2.5 degrees of the plane perpendicular to d at the shape's extreme point. Round sides give their line,
// discs an inscribed polygon that holds the rim's own extreme point. Private to this folder.
#pragma once

#include "engine/narrowphase/3d/polytope.hpp"

namespace rigor::engine {

/// 1 vertex, 2: segment, more: convex face, counter-clockwise seen from outside.
template <class R>
struct SupportFeature {
    static constexpr int kMost = 64;  ///< larger faces are thinned out evenly
    std::array<Vec3<R>, kMost> at;
    std::array<int, kMost> index;  ///< names of the vertices, unique in the shape
    int count = 0;
    Vec3<R> normal = Vec3<R>::Zero();  ///< outward unit normal of a face
    R radius = 0;                      ///< radius of the round side that a segment lies on; 0: unknown [m]

    void add(const Vec3<R>& x, int name) {
        at[count] = x;
        index[count++] = name;
    }
};

/// Cosine of the largest angle between d and the normal of a face that counts as supporting, and the sine
/// that goes with it for segments: 2.5 degrees.
template <class R>
inline constexpr R kFeatureFlat = R(0.999);
template <class R>
inline constexpr R kFeatureSlope = R(0.0447);

/// Points on the rim of a disc.
inline constexpr int kRimPoints = 16;
/// Relative to the radius: depths this close are equal. Resting bodies rock by the slop of position
/// correction (1e-5 m); below that another choice of the four points of a cap changes nothing but which they
/// are.
template <class R>
inline constexpr R kRimNoise = R(4e-6);

/// `d` is unit, in the frame of the shape. Half-spaces and composites have no features: count = 0.
template <class R>
void supportingFeature(const Shape<Space<R, 3>>& shape, const Vec3<R>& d, SupportFeature<R>& out);

/// The face or segment through the extreme point along d whose normal is nearest to d, at any angle: what an overlap
/// along d is bounded by. Points of spheres and ellipsoids; of triangles, half-spaces and composites count = 0.
template <class R>
void facingFeature(const Shape<Space<R, 3>>& shape, const Vec3<R>& d, SupportFeature<R>& out);

}  // namespace rigor::engine
