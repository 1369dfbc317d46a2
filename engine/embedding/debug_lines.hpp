// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A picture of a world as lines and points, for any program that can draw those: drawWorld() passes to a sink what
// there is, in the world frame [m]. What each kind shows:
//
//     Outline    shapes: edges of boxes and hulls, circles of round shapes, pieces of surfaces
//     Box        the bounding boxes that the broad phase has compared
//     Contact    the points of the contacts of the last step
//     Normal     normals at those points, from A to B, of one length
//     Impulse    impulses on B at those points, of a length in proportion
//     Velocity   velocities of the centres of mass, of a length in proportion
//     Joint      from each body's centre of mass to the joint's anchor on it, and between the anchors where they are apart
//     Island     from the centre of mass of each body to that of its island
//
// The body that a line belongs to lets a sink colour it.
#pragma once

#include <cstdint>

#include "engine/pipeline/world.hpp"

namespace rigor::engine {

enum class DebugKind : std::uint8_t { Outline, Box, Contact, Normal, Impulse, Velocity, Joint, Island };
inline constexpr int kDebugKinds = 8;
/// "outline", "box", ...
const char* debugKindName(DebugKind kind);

/// Receiver of lines and points. `body` is the one that they belong to; null for the world.
template <class S>
class LineSink {
  public:
    using Vec = typename S::Vec;
    virtual ~LineSink() = default;
    virtual void line(const Vec& from, const Vec& to, DebugKind kind, BodyId body) = 0;
    virtual void point(const Vec& at, DebugKind kind, BodyId body) = 0;
};

template <class S>
struct DebugOptions {
    using Real = typename S::Real;
    bool outlines = true, boxes = false, contacts = true, normals = true, impulses = false,
         velocities = false, joints = true, islands = false;
    int segments = 24;               ///< number of pieces of a circle, >= 3
    Real normalLength = Real(0.2);   ///< [m]
    Real impulseScale = Real(0.01);  ///< [m/(N s)]
    Real velocityScale = Real(0.1);  ///< [m/(m/s)]
    Real planeSize = Real(10);       ///< half-spaces are drawn so far from their foot [m]
};

/// Reads the world after a step, or between the phases of one. Islands are found on demand (World::islands).
template <class S>
void drawWorld(const World<S>& world, const DebugOptions<S>& options, LineSink<S>& sink);

/// A contact point with its normal, from A to B, and the impulse on B [N s]: what the options show of it.
template <class S>
void drawContact(const typename S::Vec& at, const typename S::Vec& normal, const typename S::Vec& impulse,
                 BodyId bodyB, const DebugOptions<S>& options, LineSink<S>& sink);
/// The velocity [m/s] of a body, if the options show it.
template <class S>
void drawVelocity(const typename S::Vec& center, const typename S::Vec& velocity, BodyId body,
                  const DebugOptions<S>& options, LineSink<S>& sink);

/// The edges of a box; nothing for one without end.
template <class S>
void drawBox(const Aabb<S>& box, BodyId body, LineSink<S>& sink);
/// The anchors of a joint on its bodies: a point, and a line between them where they are apart.
template <class S>
void drawAnchors(const typename S::Vec& anchorA, const typename S::Vec& anchorB, BodyId bodyA, BodyId bodyB,
                 LineSink<S>& sink);

/// The outline of one shape.
template <class S>
void drawShape(const Shape<S>& shape, const Pose<S>& pose, BodyId body, const DebugOptions<S>& options,
               LineSink<S>& sink);

}  // namespace rigor::engine
