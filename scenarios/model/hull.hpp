// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <vector>

#include "scenarios/model/math.hpp"

namespace rigor::scenario {

/// Boundary of a convex polyhedron. Faces are loops of vertex indices, counter-clockwise seen from outside;
/// coplanar triangles are one face.
struct HullMesh {
    std::vector<Vec3> vertices;  ///< corners only
    std::vector<std::vector<int>> faces;
};

/// Convex hull of points [m] by testing every plane through three of them; O(n^4), meant for the few dozen
/// corners of a shape. Throws std::invalid_argument for points without volume.
HullMesh convexHull3d(const std::vector<Vec3>& points);

/// Corners of the convex hull of points in the x-y plane, counter-clockwise (monotone chain; Andrew 1979).
/// Throws std::invalid_argument for points without area.
std::vector<Vec3> convexHull2d(const std::vector<Vec3>& points);

}  // namespace rigor::scenario
