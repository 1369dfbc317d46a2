// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Triangulated convex hull of a point set in double; the first stage of makeHull in 3D.
#pragma once

#include <array>
#include <vector>

#include "engine/math/space.hpp"

namespace rigor::engine {

/// A triangle of the hull, counter-clockwise seen from outside.
struct HullTriangle {
    std::array<int, 3> v;  ///< indices into the points given
    Eigen::Vector3d normal;
    double offset = 0.0;
    double area = 0.0;
};

/// No point is further than `tolerance` [m] out of a triangle's plane (up to rounding). Throws
/// std::invalid_argument where the points have no volume.
std::vector<HullTriangle> quickhull(const std::vector<Eigen::Vector3d>& points, double tolerance);

}  // namespace rigor::engine
