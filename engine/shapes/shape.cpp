// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Support mappings and bounding boxes, the same formulas in both dimensions.
#include "engine/shapes/shape.hpp"

#include <cmath>
#include <limits>

#include "engine/math/portable.hpp"
#include "engine/shapes/hull.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine {
namespace {

template <class S>
typename S::Vec unitOr(const typename S::Vec& v) {
    const typename S::Real n = v.norm();
    return n > 0 ? typename S::Vec(v / n) : typename S::Vec(S::Vec::UnitY());
}

template <class S>
typename S::Vec supportOf(const Sphere<S>& s, const typename S::Vec& d) {
    return s.radius * unitOr<S>(d);
}
template <class S>
typename S::Vec supportOf(const Box<S>& s, const typename S::Vec& d) {
    typename S::Vec p;
    for (int i = 0; i < S::dim; ++i) p[i] = d[i] < 0 ? -s.halfExtents[i] : s.halfExtents[i];
    return p;
}
template <class S>
typename S::Vec supportOf(const Capsule<S>& s, const typename S::Vec& d) {
    typename S::Vec p = s.radius * unitOr<S>(d);
    p.y() += d.y() < 0 ? -s.halfLength : s.halfLength;
    return p;
}
template <class S>
typename S::Vec supportOf(const HalfSpace<S>& s, const typename S::Vec&) {
    return s.offset * s.normal;
}
template <class S>
typename S::Vec supportOf(const Hull<S>& s, const typename S::Vec& d) {
    const auto& v = s.data->vertices;
    std::size_t best = 0;
    for (std::size_t i = 1; i < v.size(); ++i)
        if (v[i].dot(d) > v[best].dot(d)) best = i;
    return v[best];
}

/// The rim point of the cap on the side of d; straight along the axis any will do.
template <class S>
typename S::Vec rimPoint(typename S::Real radius, typename S::Real y, const typename S::Vec& d) {
    const typename S::Real across = portable::hypot(d.x(), d.z());
    if (!(across > 0)) return {radius, y, 0};
    const typename S::Real k = radius / across;
    return {k * d.x(), y, k * d.z()};
}
template <class S>
typename S::Vec supportOf(const Cylinder<S>& s, const typename S::Vec& d) {
    return rimPoint<S>(s.radius, d.y() < 0 ? -s.halfLength : s.halfLength, d);
}
template <class S>
typename S::Vec supportOf(const Cone<S>& s, const typename S::Vec& d) {
    if (typename S::Real(2) * s.halfLength * d.y() > s.radius * portable::hypot(d.x(), d.z()))
        return {0, s.halfLength, 0};
    return rimPoint<S>(s.radius, -s.halfLength, d);
}

/// The point with the outward normal d: E^2 d / |E d|, E the diagonal matrix of the half axes.
template <class S>
typename S::Vec supportOf(const Ellipsoid<S>& s, const typename S::Vec& d) {
    return s.halfAxes.cwiseProduct(unitOr<S>(s.halfAxes.cwiseProduct(d)));
}

template <class S>
typename S::Vec supportOf(const Segment<S>& s, const typename S::Vec& d) {
    return s.b.dot(d) > s.a.dot(d) ? s.b : s.a;
}
template <class S>
typename S::Vec supportOf(const Triangle<S>& s, const typename S::Vec& d) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (s.v[i].dot(d) > s.v[best].dot(d)) best = i;
    return s.v[best];
}
/// The vertex of a surface furthest along d.
template <class S, class Data>
typename S::Vec furthest(const Data& data, std::uint32_t vertices, const typename S::Vec& d) {
    std::uint32_t best = 0;
    for (std::uint32_t i = 1; i < vertices; ++i)
        if (data.point(i).dot(d) > data.point(best).dot(d)) best = i;
    return data.point(best);
}
template <class S>
typename S::Vec supportOf(const Chain<S>& s, const typename S::Vec& d) {
    return furthest<S>(*s.data, static_cast<std::uint32_t>(s.data->vertices.size()), d);
}
template <class S>
typename S::Vec supportOf(const TriangleMesh<S>& s, const typename S::Vec& d) {
    return furthest<S>(*s.data, static_cast<std::uint32_t>(s.data->vertices.size()), d);
}
template <class S>
typename S::Vec supportOf(const HeightField<S>& s, const typename S::Vec& d) {
    return furthest<S>(*s.data, static_cast<std::uint32_t>(s.data->heights.size()), d);
}

template <class S>
Aabb<S> boxOf(const Sphere<S>& s, const Pose<S>& X) {
    const typename S::Vec r = S::Vec::Constant(s.radius);
    return {X.p - r, X.p + r};
}
template <class S>
Aabb<S> boxOf(const Box<S>& s, const Pose<S>& X) {
    const typename S::Mat m = toMatrix(X.q);
    const typename S::Vec r = m.cwiseAbs() * s.halfExtents;
    return {X.p - r, X.p + r};
}
template <class S>
Aabb<S> boxOf(const Capsule<S>& s, const Pose<S>& X) {
    const typename S::Vec axis = rotate(X.q, typename S::Vec(s.halfLength * S::Vec::UnitY()));
    const typename S::Vec r = axis.cwiseAbs() + S::Vec::Constant(s.radius);
    return {X.p - r, X.p + r};
}
/// Half extents of a disc of unit radius around the unit vector `axis`: sqrt(1 - axis_i^2).
template <class S>
typename S::Vec discExtents(const typename S::Vec& axis) {
    return {portable::hypot(axis.y(), axis.z()), portable::hypot(axis.z(), axis.x()),
            portable::hypot(axis.x(), axis.y())};
}
template <class S>
Aabb<S> boxOf(const Cylinder<S>& s, const Pose<S>& X) {
    const typename S::Vec axis = rotate(X.q, typename S::Vec(S::Vec::UnitY()));
    const typename S::Vec r = s.halfLength * axis.cwiseAbs() + s.radius * discExtents<S>(axis);
    return {X.p - r, X.p + r};
}
template <class S>
Aabb<S> boxOf(const Cone<S>& s, const Pose<S>& X) {
    using Vec = typename S::Vec;
    const Vec axis = rotate(X.q, Vec(Vec::UnitY())), apex = s.halfLength * axis;
    const Vec r = s.radius * discExtents<S>(axis);
    return {X.p + apex.cwiseMin(Vec(-apex - r)), X.p + apex.cwiseMax(Vec(-apex + r))};
}
/// Half extents sqrt(sum_j (m_ij h_j)^2): the support along each axis.
template <class S>
Aabb<S> boxOf(const Ellipsoid<S>& s, const Pose<S>& X) {
    const typename S::Mat m = toMatrix(X.q) * s.halfAxes.asDiagonal();
    const typename S::Vec r = m.rowwise().norm();
    return {X.p - r, X.p + r};
}
/// Unbounded but along an axis that the normal is exactly parallel to.
template <class S>
Aabb<S> boxOf(const HalfSpace<S>& s, const Pose<S>& X) {
    using R = typename S::Real;
    const R infinite = std::numeric_limits<R>::max();
    Aabb<S> box{S::Vec::Constant(-infinite), S::Vec::Constant(infinite)};
    const typename S::Vec n = rotate(X.q, s.normal);
    const R offset = s.offset + n.dot(X.p);
    for (int i = 0; i < S::dim; ++i) {
        if (n[i] == R(1)) box.max[i] = offset;
        if (n[i] == R(-1)) box.min[i] = -offset;
    }
    return box;
}
/// Box around `count` posed points.
template <class S, class Point>
Aabb<S> boxAround(std::size_t count, Point point, const Pose<S>& X) {
    const typename S::Mat m = toMatrix(X.q);
    Aabb<S> box;
    for (std::size_t i = 0; i < count; ++i) {
        const typename S::Vec p = m * point(i);
        box.min = i == 0 ? p : typename S::Vec(box.min.cwiseMin(p));
        box.max = i == 0 ? p : typename S::Vec(box.max.cwiseMax(p));
    }
    return {box.min + X.p, box.max + X.p};
}
template <class S>
Aabb<S> boxOf(const Hull<S>& s, const Pose<S>& X) {
    const auto& v = s.data->vertices;
    return boxAround<S>(
        v.size(), [&](std::size_t i) -> const typename S::Vec& { return v[i]; }, X);
}
template <class S>
Aabb<S> boxOf(const Segment<S>& s, const Pose<S>& X) {
    return boxAround<S>(
        2, [&](std::size_t i) { return i == 0 ? s.a : s.b; }, X);
}
template <class S>
Aabb<S> boxOf(const Triangle<S>& s, const Pose<S>& X) {
    return boxAround<S>(
        3, [&](std::size_t i) { return s.v[i]; }, X);
}
template <class S>
Aabb<S> boxOf(const Chain<S>& s, const Pose<S>& X) {
    const auto& v = s.data->vertices;
    return boxAround<S>(
        v.size(), [&](std::size_t i) { return v[i]; }, X);
}
template <class S>
Aabb<S> boxOf(const TriangleMesh<S>& s, const Pose<S>& X) {
    const auto& v = s.data->vertices;
    return boxAround<S>(
        v.size(), [&](std::size_t i) { return v[i]; }, X);
}
/// Every vertex, and its foot on the floor of the field.
template <class S>
Aabb<S> boxOf(const HeightField<S>& s, const Pose<S>& X) {
    const auto& d = *s.data;
    const auto point = [&](std::size_t i) {
        typename S::Vec p = d.point(static_cast<std::uint32_t>(i / 2));
        if (i % 2 == 1) p.y() = d.lowest - d.thickness;
        return p;
    };
    return boxAround<S>(2 * d.heights.size(), point, X);
}

struct NameOf {
    template <class S>
    const char* operator()(const Sphere<S>&) const {
        return "sphere";
    }
    template <class S>
    const char* operator()(const Box<S>&) const {
        return "box";
    }
    template <class S>
    const char* operator()(const Capsule<S>&) const {
        return "capsule";
    }
    template <class S>
    const char* operator()(const HalfSpace<S>&) const {
        return "half_space";
    }
    template <class S>
    const char* operator()(const Hull<S>&) const {
        return "hull";
    }
    template <class S>
    const char* operator()(const Cylinder<S>&) const {
        return "cylinder";
    }
    template <class S>
    const char* operator()(const Cone<S>&) const {
        return "cone";
    }
    template <class S>
    const char* operator()(const Ellipsoid<S>&) const {
        return "ellipsoid";
    }
    template <class S>
    const char* operator()(const Segment<S>&) const {
        return "segment";
    }
    template <class S>
    const char* operator()(const Triangle<S>&) const {
        return "triangle";
    }
    template <class S>
    const char* operator()(const Chain<S>&) const {
        return "chain";
    }
    template <class S>
    const char* operator()(const TriangleMesh<S>&) const {
        return "triangle_mesh";
    }
    template <class S>
    const char* operator()(const HeightField<S>&) const {
        return "height_field";
    }
};

}  // namespace

template <class S>
Hull<S> makeHull(std::span<const typename S::Vec> points) {
    return {std::make_shared<const HullData<S>>(buildHull<typename S::Real>(points))};
}

template <class S>
Aabb<S> boundingBox(const Shape<S>& shape, const Pose<S>& X) {
    return std::visit([&](const auto& s) { return boxOf<S>(s, X); }, shape);
}

template <class S>
typename S::Vec support(const Shape<S>& shape, const typename S::Vec& direction) {
    return std::visit([&](const auto& s) { return supportOf<S>(s, direction); }, shape);
}

template <class S>
const char* shapeName(const Shape<S>& shape) {
    return std::visit(NameOf{}, shape);
}

#define INSTANTIATE(S)                                                \
    template const char* shapeName<S>(const Shape<S>&);               \
    template Hull<S> makeHull<S>(std::span<const typename S::Vec>);   \
    template Aabb<S> boundingBox<S>(const Shape<S>&, const Pose<S>&); \
    template S::Vec support<S>(const Shape<S>&, const S::Vec&);
RIGOR_FOR_ALL_SPACES(INSTANTIATE)
#undef INSTANTIATE

}  // namespace rigor::engine
