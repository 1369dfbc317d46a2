// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts of a convex shape with a chain, triangle mesh or height field, a piece at a time, for any narrow
// phase of the table.
#pragma once

#include <span>
#include <vector>

#include "engine/narrowphase/manifold.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine {

/// True where x, in the frame of the surface, is in front of some of the pieces and behind others. Names of
/// facets and their pieces are allowed.
template <class S>
bool facesDiffer(const Shape<S>& surface, std::span<const std::uint32_t> pieces, const typename S::Vec& x);

/// Fills `out` (A = surface) for one piece of the surface and a posed convex shape. `narrowPhase` finds
/// contacts of the piece as a Segment or Triangle; `ridge`: facesDiffer() of the pieces near the shape and
/// its middle. Inner edges do not catch: see surface_contact.cpp.
template <class S>
void collidePiece(const NarrowPhase<S>& narrowPhase, const Shape<S>& surface, std::uint32_t piece, bool ridge,
                  const Pose<S>& Xsurface, const Shape<S>& convex, const Pose<S>& Xconvex,
                  typename S::Real speculative, Manifold<S>& out);

/// Bit of the name of a contact with a piece of a facet that is not along the facet's normal.
inline constexpr std::uint32_t kBorderPiece = 0x80000000u;

/// Names of the contacts that a surface may have with a convex shape in `box` (frame of the surface), in
/// ascending order: its facets by their lowest piece, and pieces at the border of a facet with kBorderPiece.
template <class S>
void addFacetNames(const Shape<S>& surface, const Aabb<S>& box, std::vector<std::uint32_t>& names);

/// collidePiece() for such a name: one manifold for all pieces of a facet (facet_contact.cpp).
template <class S>
void collideFacet(const NarrowPhase<S>& narrowPhase, const Shape<S>& surface, std::uint32_t name, bool ridge,
                  const Pose<S>& Xsurface, const Shape<S>& convex, const Pose<S>& Xconvex,
                  typename S::Real speculative, Manifold<S>& out);

/// The manifold (A = surface) of the piece that the shape is deepest in; the first of equals.
template <class S>
void collideDeepestPiece(CollideFunction<S> collide, const Shape<S>& surface, const Pose<S>& Xsurface,
                         const Shape<S>& convex, const Pose<S>& Xconvex, typename S::Real speculative,
                         Manifold<S>& out);

/// Used by narrow phases that accept any two shapes. True if one of them is a chain, mesh or field (`out`
/// then is that of its deepest piece) or neither can move (`out` is empty).
template <class S>
bool collideSurfaces(CollideFunction<S> collide, const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b,
                     const Pose<S>& Xb, typename S::Real speculative, Manifold<S>& out);

/// The manifold of (A, B) from that of (B, A).
template <class S>
void flipManifold(Manifold<S>& manifold);

/// Box of the convex shape in the frame of the surface, grown by `margin` [m]: where to look for pieces.
template <class S>
Aabb<S> boxOnSurface(const Pose<S>& Xsurface, const Shape<S>& convex, const Pose<S>& Xconvex,
                     typename S::Real margin);

}  // namespace rigor::engine
