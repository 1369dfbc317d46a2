// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Keeps every shape on its side of a surface. A chain or a mesh is a sheet without thickness: a shape whose
// middle is past it overlaps it as much as before, and its contacts would push it out on the wrong side. So
// no middle ever passes one:
//
//     p   the middle of the shape when the step began,  x  the middle when it ends
//     Where a piece of the surface is between p and x, x goes back along the normal of the piece until it is
//     `gap` in front of it, as often as another piece is in the way then; p itself moves up to each of them,
//     to a distance of `gap` from its plane, and is where x goes if nothing else is free.
//
// The body is moved by as much; its velocity stays: the contacts of the next step see to that. Each way from
// p is free by construction, so that the side of a shape follows from where it is. Rays hit the surface
// without gaps between its pieces (shapes/ray_cast.cpp). Cost: a ray for each shape whose way in this step
// is near a surface; a box for each other shape and surface.
#pragma once

#include <vector>

#include "engine/contacts/collision_filter.hpp"
#include "engine/contacts/shape_set.hpp"

namespace rigor::engine {

/// Moves `now` back to the side of `before`; both are in the frame of the surface. True: `now` was beyond a
/// piece. `gap` > 0: small beside the shape [m].
template <class S>
bool stayOnSideOf(const Shape<S>& surface, const typename S::Vec& before, typename S::Vec& now,
                  typename S::Real gap);

template <class S>
class SurfaceSides {
  public:
    /// Ends a step that began at the poses of `shapes`: moves bodies that have passed through a chain, mesh or
    /// height field back to the side that they came from.
    void keep(const ShapeSet<S>& shapes, const CollisionFilter<S>& filter, BodyArrays<S>& bodies,
              const Tasks& tasks);
    /// The same for the end of a step that has led to midpoints: bodies stay on the side that they have there.
    void keepOfMidpoints(const ShapeSet<S>& shapes, const CollisionFilter<S>& filter, BodyArrays<S>& bodies,
                         const Tasks& tasks);

  private:
    template <class Begin>
    void keepFrom(const Begin& begin, const ShapeSet<S>& shapes, const CollisionFilter<S>& filter,
                  BodyArrays<S>& bodies, const Tasks& tasks);

    std::vector<std::uint8_t> crossed_;  ///< flag of each shape: 1 if it has crossed a surface
};

}  // namespace rigor::engine
