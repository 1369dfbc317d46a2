// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Data of a convex hull, per dimension. Immutable; made by makeHull (shape.hpp).
#pragma once

#include <span>
#include <vector>

#include "engine/shapes/shape.hpp"

namespace rigor::engine {

/// Convex polygon, vertices counter-clockwise, no three collinear.
template <class R>
struct HullData<Space<R, 2>> {
    using Vec = typename Space<R, 2>::Vec;
    std::vector<Vec> vertices;  ///< shape frame [m]
    std::vector<Vec> normals;   ///< unit, outward, of the edge from vertices[i] to vertices[i + 1]
    Vec center;                 ///< mean of the vertices: strictly inside
};

/// One face of a polyhedron; its loop is counter-clockwise seen from outside.
template <class R>
struct HullFace {
    typename Space<R, 3>::Vec normal;  ///< unit, outward
    R offset = 0;                      ///< normal . x of the face's plane [m]
    int first = 0, count = 0;          ///< slice of HullData::loops
};

/// Edge from v0 to v1; `left` is the face whose loop runs from v0 to v1, `right` the one that runs back.
struct HullEdge {
    int v0 = 0, v1 = 0, left = 0, right = 0;
};

/// Convex polyhedron: coplanar triangles are merged, so that each face is one whole polygon.
template <class R>
struct HullData<Space<R, 3>> {
    using Vec = typename Space<R, 3>::Vec;
    std::vector<Vec> vertices;       ///< shape frame [m]
    std::vector<HullFace<R>> faces;  ///< neighbours are never coplanar
    std::vector<int> loops;          ///< vertex indices of all faces
    std::vector<HullEdge> edges;     ///< each once
    Vec center;                      ///< mean of the vertices: strictly inside
};

/// One per dimension; the makeHull of shape.hpp forwards here.
template <class R>
HullData<Space<R, 2>> buildHull(std::span<const Eigen::Matrix<R, 2, 1>> points);
template <class R>
HullData<Space<R, 3>> buildHull(std::span<const Eigen::Matrix<R, 3, 1>> points);

/// Relative to the size of a point set: points closer than this to a face count as lying on it. Hulls are
/// built in double; the bound covers the rounding of the coordinates given.
template <class R>
inline constexpr double kHullTolerance = 1e-11;
template <>
inline constexpr double kHullTolerance<float> = 2e-6;

}  // namespace rigor::engine
