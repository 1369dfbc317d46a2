// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Helper for libraries that report one point per contact and not where between the two surfaces it lies.
#pragma once

#include "adapters/interface/types.hpp"

namespace rigor::adapter {

struct SurfacePoints {
    Vec3 onA, onB;  ///< world frame [m]; onA - onB = depth * normal
};

/// The points on the surfaces of A and B for a contact whose library gave `reported` somewhere on the line
/// between them (on A, on B or in the middle, or somewhere near), the unit `normal` from A to B and the
/// penetration `depth`. Spheres are computed in closed form; else the candidate on that line whose ends lie
/// nearest to the surfaces is taken.
SurfacePoints surfacePoints(const PosedShape& a, const PosedShape& b, const Vec3& reported,
                            const Vec3& normal, double depth);

/// Signed distance of a point in the shape's frame from its surface, negative inside; nothing for hulls and
/// segments. A lower bound outside of cones.
std::optional<double> pointDistance(const Geometry& geometry, const Vec3& point);

}  // namespace rigor::adapter
