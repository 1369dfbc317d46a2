// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Runs two-dimensional scenarios in three-dimensional engines: every 2D shape becomes the solid of depth
// 2 * kPlanarHalfDepth around z = 0, the inertia about z is the 2D one, and the adapter locks z translation
// and x, y rotation.
#pragma once

#include "scenarios/model/scenario.hpp"

namespace rigor::adapter {

inline constexpr double kPlanarHalfDepth = 0.5;  ///< [m]

/// The 3D shape that touches others within the plane z = 0 as the 2D shape does: circle -> sphere, capsule ->
/// capsule, box -> box, polygon -> prism (hull of 2n points), half-plane -> half-space, segment and chain ->
/// a triangle mesh of two triangles over each segment. Throws std::invalid_argument for 3D surfaces.
scenario::Geometry planarGeometry(const scenario::Geometry& geometry);

/// A three-dimensional copy of a 2D scenario: shapes by planarGeometry, mass properties with inertia(0,0) =
/// inertia(1,1) = inertia(2,2), joint axes along z; the angle of a six_dof becomes its swing about z. Bodies,
/// indices and everything else as they were.
scenario::Scenario planarLift(const scenario::Scenario& scenario);

}  // namespace rigor::adapter
