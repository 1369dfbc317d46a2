// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts of a convex shape with a chain, triangle mesh or height field, a piece at a time, for any narrow
// phase of the table.
#pragma once

#include "engine/narrowphase/manifold.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine {

/// On which side of a piece a shape belongs.
enum class PieceSide : std::uint8_t {
    Middle,        ///< where its middle is
    ThroughFront,  ///< in front, though its middle has gone through the piece: it is pushed back
    ThroughBack,   ///< likewise behind
};

/// The side of a piece, of a point in the frame of the surface: its distance in front [m].
template <class S>
typename S::Real inFrontOf(const Shape<S>& surface, std::uint32_t piece, const typename S::Vec& point);

/// Fills `out` (A = surface) for one piece of the surface and a posed convex shape. `narrowPhase` finds
/// contacts of the piece as a Segment or Triangle. Inner edges do not catch: see surface_contact.cpp.
template <class S>
void collidePiece(const NarrowPhase<S>& narrowPhase, const Shape<S>& surface, std::uint32_t piece,
                  PieceSide side, const Pose<S>& Xsurface, const Shape<S>& convex, const Pose<S>& Xconvex,
                  typename S::Real speculative, Manifold<S>& out);

/// The manifold (A = surface) of the piece that the shape is deepest in; the first of equals.
template <class S>
void collideDeepestPiece(CollideFunction<S> collide, const Shape<S>& surface, const Pose<S>& Xsurface,
                         const Shape<S>& convex, const Pose<S>& Xconvex, typename S::Real speculative,
                         Manifold<S>& out);

/// For narrow phases that are asked about any two shapes: true where one is a chain, mesh or field (`out`
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
