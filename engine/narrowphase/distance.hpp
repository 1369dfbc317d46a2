// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Signed distance and closest points of two posed convex shapes, by their support mappings alone.
#pragma once

#include "engine/math/space.hpp"
#include "engine/narrowphase/manifold.hpp"
#include "engine/shapes/shape.hpp"

namespace rigor::engine {

/// Apart: a closest pair of points. Overlapping: the pair that the shortest translation `distance * normal`
/// of B brings together. pointB - pointA = distance * normal up to rounding.
template <class S>
struct ClosestPoints {
    typename S::Vec pointA, pointB;  ///< points on the surfaces of A and B, world frame [m]
    typename S::Vec normal;          ///< unit, world frame, A to B; defined even where the points coincide
    typename S::Real distance = 0;   ///< [m]; < 0: minus the penetration depth
    int iterations = 0;              ///< support points computed
    bool converged = false;          ///< upper and lower bound of the distance met, to rounding
};

/// Closest points by GJK, and by EPA where the shapes' cores overlap (gjk.cpp, 2d/epa.cpp, 3d/epa.cpp).
/// Spheres and capsules are points and segments with a rounding radius, hence exact; half-spaces are closed
/// forms. Shapes with curved sides are approached to the bound that `converged` reports. Computed in the
/// frame of A: distance from the world's origin costs no digits but those of the positions. Two half-spaces
/// have no distance: converged is false, the distance the lowest number there is. Does not allocate.
template <class S>
ClosestPoints<S> closestPoints(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb);

/// Makes the closest points the one point of a manifold. Its memory stays.
template <class S>
void setToClosest(const ClosestPoints<S>& closest, Manifold<S>& manifold) {
    manifold.count = 1;
    manifold.normal = closest.normal;
    manifold.points[0] = {closest.pointA, closest.pointB, closest.distance, 0};
}

}  // namespace rigor::engine
