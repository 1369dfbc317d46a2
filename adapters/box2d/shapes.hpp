// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <memory>
#include <vector>

#include "adapters/box2d/convert.hpp"

namespace rigor::box2d {

/// Half the thickness of the polygon that stands for a half-plane [m].
inline constexpr double kHalfPlaneDepth = 10.0;

/// The rounding that Box2D puts around its shapes [Box2D lengths].
struct Skin {
    float polygon = b2_polygonRadius;  ///< m_radius of polygons and edges
    float circle = 0.0f;               ///< added to the radius of circles
};
/// Skin of the library as it ships: 2 slops around polygons.
Skin librarySkin();
/// Half a slop around everything: Box2D lets shapes rest one slop inside each other's skins, so that their
/// true surfaces touch.
Skin leastSkin();

struct ShapeSettings {
    double scale = 1.0;  ///< Box2D lengths per metre
    Skin skin;
    double halfPlaneDepth = kHalfPlaneDepth;
    double halfPlaneReach = 100.0;  ///< half width of a half-plane's polygon [m]
    Vec3 halfPlaneCenter;           ///< its middle is the projection of this world point [m]
};

/// The Box2D shapes that together are one geometry, in the frame of the Box2D body. `inBody` is the shape's
/// frame there, `bodyPose` that frame in the world (it matters for half-planes alone). Throws Unsupported for
/// what Box2D lacks and for polygons it would abort on.
std::vector<std::unique_ptr<b2Shape>> buildGeometry(const adapter::Geometry& geometry, const Pose& inBody,
                                                    const Pose& bodyPose, const ShapeSettings& settings);

/// Distance by which Box2D's surface lies outside the shape's own [Box2D lengths].
float skinOf(const b2Shape& shape, const Skin& skin);

}  // namespace rigor::box2d
