// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact points of two geoms that a step uses.
#pragma once

#include <ode/ode.h>

#include <vector>

#include "adapters/interface/types.hpp"

namespace rigor::ode {

/// One point of dCollide in the convention of ContactPoint.
struct FoundPoint {
    adapter::Vec3 position;  ///< position as ODE reports it: on either surface or between them [m]
    adapter::Vec3 normal;    ///< unit, from the first geom to the second (ODE's own points the other way)
    double depth = 0.0;      ///< [m], >= 0
};

/// All points of two geoms (untruncated). If `planar`, they are moved into the plane z = 0 and equal ones are
/// merged: the two edges of a prism are one corner of a polygon. Replaces `points`.
void collideGeoms(dGeomID a, dGeomID b, bool planar, std::vector<FoundPoint>& points);

/// Keeps at most `count` points: the deepest, then again and again the one farthest from those kept.
void reducePoints(std::size_t count, std::vector<FoundPoint>& points);

/// Merges one sphere's points on facets: keeps those whose normal differs from every deeper one's by more
/// than the angle of this cosine: ODE reports each triangle that a sphere penetrates, and those ahead of it
/// act as walls.
void mergeNormals(double cosine, std::vector<FoundPoint>& points);

/// ODE's parameters of one contact between surfaces of these coefficients. `cfm` > 0 softens the normal of a
/// contact that does not bounce; a bounce would lose speed in proportion to it.
dSurfaceParameters surfaceFor(const scenario::PairCoefficients& pair, double bounceThreshold, double cfm);

}  // namespace rigor::ode
