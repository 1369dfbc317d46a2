// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shapes of the engine, one type per kind over the Space trait; ShapeTypes says which kinds a dimension has.
// A shape frame has its origin at the shape's centre (hull: at the origin of the points given).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "engine/math/space.hpp"

namespace rigor::engine {

/// Sphere (2D: disc). radius > 0 [m].
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
/// Solid cone along local y, 3D only: apex at +halfLength, base disc of `radius` at -halfLength; both > 0
/// [m].
template <class S>
struct Cone {
    typename S::Real radius, halfLength;
};

/// Solid ellipsoid, 3D only: the half axes along the local axes, each > 0 [m].
template <class S>
struct Ellipsoid {
    typename S::Vec halfAxes;
};

/// Two-sided segment from a to b [m], a != b; 2D only, static bodies only.
template <class S>
struct Segment {
    typename S::Vec a, b;
};
/// Two-sided triangle without thickness [m]; 3D only, static bodies only. Meshes and height fields consist of
/// them.
template <class S>
struct Triangle {
    std::array<typename S::Vec, 3> v;
};

/// Composite static shapes: many segments or triangles, shared and immutable (surface.hpp). Their inner edges
/// do not catch what slides over them.
template <class S>
struct ChainData;
/// Polyline of two-sided segments, 2D; made by makeChain.
template <class S>
struct Chain {
    std::shared_ptr<const ChainData<S>> data;
};
template <class S>
struct MeshData;
/// Two-sided triangles with shared vertices, 3D; made by makeTriangleMesh.
template <class S>
struct TriangleMesh {
    std::shared_ptr<const MeshData<S>> data;
};
template <class S>
struct HeightFieldData;
/// Heights over a grid, solid below, 3D; made by makeHeightField.
template <class S>
struct HeightField {
    std::shared_ptr<const HeightFieldData<S>> data;
};

/// The kinds of shape that a dimension has.
template <class S>
struct ShapeTypes;
template <class R>
struct ShapeTypes<Space<R, 2>> {
    using S = Space<R, 2>;
    using Variant = std::variant<Sphere<S>, Box<S>, Capsule<S>, HalfSpace<S>, Hull<S>, Segment<S>, Chain<S>>;
};
template <class R>
struct ShapeTypes<Space<R, 3>> {
    using S = Space<R, 3>;
    using Variant = std::variant<Sphere<S>, Box<S>, Capsule<S>, HalfSpace<S>, Hull<S>, Cylinder<S>, Cone<S>,
                                 Ellipsoid<S>, Triangle<S>, TriangleMesh<S>, HeightField<S>>;
};
template <class S>
using Shape = typename ShapeTypes<S>::Variant;

/// Kinds without volume or bounds: static bodies only; two of them never touch.
template <class Kind>
inline constexpr bool kStaticOnly = false;
template <class S>
inline constexpr bool kStaticOnly<HalfSpace<S>> = true;
template <class S>
inline constexpr bool kStaticOnly<Segment<S>> = true;
template <class S>
inline constexpr bool kStaticOnly<Triangle<S>> = true;
/// Kinds that consist of children; static too.
template <class Kind>
inline constexpr bool kComposite = false;
template <class S>
inline constexpr bool kComposite<Chain<S>> = true;
template <class S>
inline constexpr bool kComposite<TriangleMesh<S>> = true;
template <class S>
inline constexpr bool kComposite<HeightField<S>> = true;
template <class S>
inline constexpr bool kStaticOnly<Chain<S>> = true;
template <class S>
inline constexpr bool kStaticOnly<TriangleMesh<S>> = true;
template <class S>
inline constexpr bool kStaticOnly<HeightField<S>> = true;

template <class S>
bool isStaticOnly(const Shape<S>& shape) {
    return std::visit([]<class Kind>(const Kind&) { return kStaticOnly<Kind>; }, shape);
}
template <class S>
bool isComposite(const Shape<S>& shape) {
    return std::visit([]<class Kind>(const Kind&) { return kComposite<Kind>; }, shape);
}
/// Name of the kind: "sphere", "box", ...; the same in both dimensions.
template <class S>
const char* shapeName(const Shape<S>& shape);

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
/// Throws std::invalid_argument for shapes without volume (kStaticOnly). density > 0 [kg/m^3] (2D: [kg/m^2]).
template <class S>
MassProperties<S> massProperties(const Shape<S>& shape, typename S::Real density);

/// The smallest box around the posed shape (half-spaces: +-max along unbounded axes; height fields: of the
/// surface and what is under it down to their floor).
template <class S>
Aabb<S> boundingBox(const Shape<S>& shape, const Pose<S>& X);

/// A point of the shape furthest along `direction` (need not be unit), shape frame. Half-spaces have none;
/// that of a composite is a point of its convex hull.
template <class S>
typename S::Vec support(const Shape<S>& shape, const typename S::Vec& direction);

}  // namespace rigor::engine
