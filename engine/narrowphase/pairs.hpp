// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One overload per pair of kinds, each in one order only; sat.cpp swaps the others, and hands pairs that have
// none to collideFeatures. All have the contract of CollideFunction with out.count = 0 on entry. Private to
// this folder.
#pragma once

#include "engine/narrowphase/manifold.hpp"

namespace rigor::engine {

#define RIGOR_PAIR(A, B)                                                                 \
    template <class S>                                                                   \
    void collidePair(const A<S>& a, const Pose<S>& Xa, const B<S>& b, const Pose<S>& Xb, \
                     typename S::Real speculative, Manifold<S>& out);

// The same formulas in both dimensions: sphere_pairs.cpp, half_space_pairs.cpp.
RIGOR_PAIR(Sphere, Sphere)
RIGOR_PAIR(Sphere, Box)
RIGOR_PAIR(Sphere, Capsule)
RIGOR_PAIR(Sphere, HalfSpace)
RIGOR_PAIR(Box, HalfSpace)
RIGOR_PAIR(Capsule, HalfSpace)
RIGOR_PAIR(Hull, HalfSpace)
// Pairs of each dimension, declared as templates over the scalar: 2d/, 3d/.
#undef RIGOR_PAIR

#define RIGOR_PAIR(D, A, B)                                                                         \
    template <class R>                                                                              \
    void collidePair(const A<Space<R, D>>& a, const Pose<Space<R, D>>& Xa, const B<Space<R, D>>& b, \
                     const Pose<Space<R, D>>& Xb, typename Space<R, D>::Real speculative,           \
                     Manifold<Space<R, D>>& out);
#define RIGOR_PAIRS(D)              \
    RIGOR_PAIR(D, Sphere, Hull)     \
    RIGOR_PAIR(D, Capsule, Capsule) \
    RIGOR_PAIR(D, Box, Capsule)     \
    RIGOR_PAIR(D, Capsule, Hull)    \
    RIGOR_PAIR(D, Box, Box)         \
    RIGOR_PAIR(D, Box, Hull)        \
    RIGOR_PAIR(D, Hull, Hull)
RIGOR_PAIRS(2)
RIGOR_PAIRS(3)
#undef RIGOR_PAIRS
RIGOR_PAIR(2, Sphere, Segment)
RIGOR_PAIR(2, Box, Segment)
RIGOR_PAIR(2, Capsule, Segment)
RIGOR_PAIR(2, Hull, Segment)
RIGOR_PAIR(3, Sphere, Triangle)
RIGOR_PAIR(3, Sphere, Cylinder)
RIGOR_PAIR(3, Sphere, Cone)
RIGOR_PAIR(3, Cylinder, HalfSpace)
RIGOR_PAIR(3, Cone, HalfSpace)
RIGOR_PAIR(3, Ellipsoid, HalfSpace)
#undef RIGOR_PAIR

/// Any two convex shapes: the contact normal of the closest points, the points where supporting features meet
/// (3d/feature_pairs.cpp).
template <class R>
void collideFeatures(const Shape<Space<R, 3>>& a, const Pose<Space<R, 3>>& Xa, const Shape<Space<R, 3>>& b,
                     const Pose<Space<R, 3>>& Xb, R speculative, Manifold<Space<R, 3>>& out);

/// Contact points of a convex shape with a piece of a surface along the piece's normal: what of the shape's
/// supporting feature is over the piece. `front`: on the side of the normal. A is the piece; X poses the
/// shape in its frame, in which `out` is filled. `innerSides` (bit k: side or end k): beyond these the plane of the
/// piece goes on; points that are on them alone are left out, they are no corners of the contact.
template <class R>
void collideAlong(const Segment<Space<R, 2>>& piece, bool front, const Shape<Space<R, 2>>& convex,
                  const Pose<Space<R, 2>>& X, typename Space<R, 2>::Real speculative,
                  Manifold<Space<R, 2>>& out, unsigned innerSides = 0);
template <class R>
void collideAlong(const Triangle<Space<R, 3>>& piece, bool front, const Shape<Space<R, 3>>& convex,
                  const Pose<Space<R, 3>>& X, typename Space<R, 3>::Real speculative,
                  Manifold<Space<R, 3>>& out, unsigned innerSides = 0);

}  // namespace rigor::engine
