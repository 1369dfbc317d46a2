// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bounded 3D shapes with round sides, as the oracle represents them. Every one is the convex hull of points
// and discs, grown by a rounding radius, so that its support function is
//   h(n) = max over points p . n,  max over discs c . n + r |n x u|;  plus the radius
// and the sphere of directions falls into regions of one point or one disc, bounded by arcs of circles
// n . axis = height: an edge of a polyhedron (its vector, 0), the side of a cylinder (axis, 0) and of a cone
// (axis, sine of the slope). Faces and caps are single directions. Private to this folder.
#pragma once

#include "validation/oracle/core.hpp"

namespace rigor::validation::oracle {

struct Disc {
    Vec center, axis;  ///< unit axis
    Real radius = 0;   ///< > 0
};

/// The directions of an edge or a side line. On it the support is anchor . n + radius |n x axis|, and the
/// second term is constant.
struct DirectionCircle {
    Vec axis;         ///< unit
    Real height = 0;  ///< height in (-1, 1)
    Vec anchor;
    Real radius = 0;
};

struct Solid {
    std::vector<Vec> points;
    std::vector<Disc> discs;
    std::vector<DirectionCircle> circles;
    std::vector<Vec> faceNormals;  ///< unit; of faces and caps, either sign
    Real radius = 0;
    Real size = 0;  ///< size, at least the diameter
};

/// Solid of a posed shape relative to `origin`; empty for shapes without bounds and those that are no solid.
std::optional<Solid> makeSolid(const scenario::Geometry& geometry, const scenario::Pose& pose,
                               scenario::Vec3 origin, bool features = true);

/// Point reflection at the origin.
Solid mirrored(const Solid& solid);

/// h(n) with the rounding radius; n unit.
Real supportOf(const Solid& solid, Vec n);

/// The contact of two solids. Both have their `core` where they are polyhedra, capsules or balls.
struct SolidContact {
    Real distance = 0;  ///< distance of the solids, radii included
    std::vector<Vec> normals;
    bool continuum = false;
    Vec onA, onB;
    Real residual = 0;  ///< deviation of the witness points' difference from `distance` times the first
                        ///< normal
};
SolidContact solidContact(const Solid& a, const Core* coreA, const Solid& b, const Core* coreB, Real tie);

/// Middle of what supports the solid along n, on its surface.
Vec supportPoint(const Solid& solid, Vec n);

}  // namespace rigor::validation::oracle
