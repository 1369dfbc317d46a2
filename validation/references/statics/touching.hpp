// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts of the bodies of a scenario at its start: the corner points of every contact area, in closed form.
#pragma once

#include <vector>

#include "validation/references/parts.hpp"

namespace rigor::validation {

struct TouchingPoint {
    int a = 0, b = 0;  ///< bodies
    Vec3 point;        ///< world [m]
    Vec3 normal;       ///< unit, from a to b
    double friction = 0.0;
};

/// Points at which two bodies touch: gap or overlap up to 1e-4 of the smaller body. Two dimensions: circles,
/// boxes, polygons, capsules, half-planes, segments. Three: spheres, boxes, half-spaces. Throws
/// AssumptionViolated for other shapes and for deeper overlaps.
std::vector<TouchingPoint> touchingPoints(const Scenario& scenario);

}  // namespace rigor::validation
