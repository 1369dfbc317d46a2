// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Convex hulls by Qhull, and hulls of fewer corners for shapes of a scenario, which have up to 64.
#pragma once

#include <array>

#include "scenarios/exchange/common/builder.hpp"

namespace rigor::models {

struct HullOfMesh {
    std::vector<scenario::Vec3> corners;
    double volume = 0.0;  ///< [m^3]
    double dent = 0.0;    ///< distance of the deepest vertex of the mesh below the hull's surface [m]
};
/// Convex hull of points, by Qhull. Throws Refusal for points without volume.
HullOfMesh hullOf(const std::vector<scenario::Vec3>& points, const Place& place);

using Triangle = std::array<scenario::Vec3, 3>;
/// Surface of the convex hull of points as triangles. Throws Refusal for points without volume.
std::vector<Triangle> hullTriangles(const std::vector<scenario::Vec3>& points, const Place& place);

struct FewerCorners {
    std::vector<scenario::Vec3> corners;
    double farthest = 0.0;  ///< largest distance of a left out corner from the hull of the others [m]
};
/// `count` (at least 4) of the corners of a hull, chosen one after the other, each the farthest from the hull of those
/// before it. Since both hulls are convex, `farthest` is their Hausdorff distance.
FewerCorners fewerCorners(const std::vector<scenario::Vec3>& corners, std::size_t count, const Place& place);

/// Adds the hull of `corners` to a body. More corners than a scenario's hull has are refused, unless
/// `mostCorners` (--hull-corners) says how many of them to take; 0: all. `which` names the mesh in messages.
void addHull(SceneBuilder& builder, Report& report, int body, const std::vector<scenario::Vec3>& corners,
             const scenario::Pose& pose, const Surface& surface, int kind, int mostCorners,
             const std::string& element, const std::string& which, const Place& place);

}  // namespace rigor::models
