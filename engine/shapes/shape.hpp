// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shapes of the engine, one type per kind over the Space trait; ShapeTypes says which kinds a dimension has. A
// shape frame has its origin at the shape's centre (hull: at the origin of the points given).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "engine/math/space.hpp"

namespace rigor::engine {

/// Ball (2D: disc). radius > 0 [m].
template <class S>
struct Sphere {
    typename S::Real radius;
};
/// Box of half extents > 0 [m] along the local axes.
template <class S>
struct Box {
    typename S::Vec halfExtents;
};
/// Segment (0,-halfLength) to (0,+halfLength) along local y, grown by radius; both > 0 [m].
template <class S>
struct Capsule {
    typename S::Real radius, halfLength;
};
/// Solid where normal . x <= offset, unit normal; static bodies only.
template <class S>
struct HalfSpace {
    typename S::Vec normal;
    typename S::Real offset;
};

/// Convex polygon (2D: vertices counter-clockwise, normals[i] outward of edge i to i+1) or polyhedron (3D).
template <class S>
struct HullData;
/// Shared, immutable; made by makeHull.
template <class S>
struct Hull {
    std::shared_ptr<const HullData<S>> data;
};

/// Solid cylinder along local y, 3D only; radius, halfLength > 0 [m].
template <class S>
struct Cylinder {
    typename S::Real radius, halfLength;
};
/// Solid cone along local y, 3D only: apex at +halfLength, base disc of `radius` at -halfLength; both > 0 [m].
template <class S>
struct Cone {
    typename S::Real radius, halfLength;
};

/// The kinds of shape that a dimension has.
template <class S>
struct ShapeTypes;
template <class R>
struct ShapeTypes<Space<R, 2>> {
    using S = Space<R, 2>;
    using Variant = std::variant<Sphere<S>, Box<S>, Capsule<S>, HalfSpace<S>, Hull<S>>;
};
template <class R>
struct ShapeTypes<Space<R, 3>> {
    using S = Space<R, 3>;
    using Variant = std::variant<Sphere<S>, Box<S>, Capsule<S>, HalfSpace<S>, Hull<S>, Cylinder<S>, Cone<S>>;
};
template <class S>
using Shape = typename ShapeTypes<S>::Variant;

/// Has the dimension this kind?
template <class S, class Kind>
inline constexpr bool kHasKind = requires(const Shape<S>& shape) { std::get_if<Kind>(&shape); };

/// Hull of the points; interior and duplicate points are dropped. Throws std::invalid_argument for fewer than
/// dim + 1 points or points without volume.
template <class S>
Hull<S> makeHull(std::span<const typename S::Vec> points);

/// Mass [kg], centre of mass [m] and inertia about it [kg m^2], in the shape frame.
template <class S>
struct MassProperties {
    typename S::Real mass;
    typename S::Vec center;
    typename S::Inertia inertia;
};
/// Throws std::invalid_argument for a half-space. density > 0 [kg/m^3] (2D: [kg/m^2]).
template <class S>
MassProperties<S> massProperties(const Shape<S>& shape, typename S::Real density);

/// The smallest box around the posed shape (half-spaces: +-max along unbounded axes).
template <class S>
Aabb<S> boundingBox(const Shape<S>& shape, const Pose<S>& X);

/// A point of the shape furthest along `direction` (need not be unit), shape frame. Not for half-spaces.
template <class S>
typename S::Vec support(const Shape<S>& shape, const typename S::Vec& direction);

}  // namespace rigor::engine
