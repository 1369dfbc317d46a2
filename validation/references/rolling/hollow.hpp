// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Hollow cylinders made of flat facets: a chain of segments (2D) or a mesh of triangles whose corners lie on
// one cylinder. Shared by the references of balls that roll inside.
#pragma once

#include "validation/references/parts.hpp"

namespace rigor::validation {

/// A ball that touches facets of angle d moves on a polygon between R - r and (R - r)/cos(d/2) from the axis;
/// each facet it reaches takes the part d^2/(1 + k) of its energy at most. Both vanish with d.
struct Hollow {
    Vec3 axis;            ///< unit; +z in 2D
    Vec3 center;          ///< a point on the axis
    double radius = 0.0;  ///< distance to the middles of the facets [m]
    double facet = 0.0;   ///< largest angle between neighbouring facets [rad]
    int material = 0;
    /// Vector from the axis, perpendicular to it.
    Vec3 across(Vec3 p) const {
        const Vec3 d = p - center;
        return d - dot(d, axis) * axis;
    }
};

/// The hollow that `base`, a static body, has around the point `inside`. Throws AssumptionViolated where its
/// corners are not on a cylinder, to 1e-6 of its radius, or facets turn by more than 2 degrees.
Hollow hollowOf(const Scenario& scenario, int base, Vec3 inside);

}  // namespace rigor::validation
