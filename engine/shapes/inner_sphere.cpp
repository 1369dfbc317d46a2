// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/shapes/inner_sphere.hpp"

#include <limits>
#include <type_traits>

#include "engine/shapes/hull.hpp"

namespace rigor::engine {
namespace {

/// Distance from the mean of the vertices to the nearest face.
template <class R>
R hullInnerRadius(const HullData<Space<R, 2>>& hull) {
    R inner = std::numeric_limits<R>::max();
    for (std::size_t i = 0; i < hull.normals.size(); ++i)
        inner = std::min(inner, hull.normals[i].dot(hull.vertices[i] - hull.center));
    return inner;
}
template <class R>
R hullInnerRadius(const HullData<Space<R, 3>>& hull) {
    R inner = std::numeric_limits<R>::max();
    for (const HullFace<R>& face : hull.faces)
        inner = std::min(inner, face.offset - face.normal.dot(hull.center));
    return inner;
}

}  // namespace

template <class S>
typename S::Real inscribedRadiusOf(const Shape<S>& shape) {
    using Real = typename S::Real;
    return std::visit(
        [&](const auto& s) -> Real {
            using Kind = std::decay_t<decltype(s)>;
            if constexpr (std::is_same_v<Kind, Sphere<S>> || std::is_same_v<Kind, Capsule<S>>) {
                return s.radius;
            } else if constexpr (std::is_same_v<Kind, Box<S>>) {
                return s.halfExtents.minCoeff();
            } else if constexpr (std::is_same_v<Kind, Ellipsoid<S>>) {
                return s.halfAxes.minCoeff();
            } else if constexpr (std::is_same_v<Kind, HalfSpace<S>>) {
                return std::numeric_limits<Real>::max();
            } else if constexpr (std::is_same_v<Kind, Hull<S>>) {
                return hullInnerRadius(*s.data);
            } else if constexpr (kComposite<Kind>) {
                return 0;
            } else {
                // Cylinders and cones: 0.4 of the shortest half edge of the box around is less than their
                // inscribed spheres have down to cones of aspect 1:1.5, and the right order beyond.
                const Aabb<S> box = boundingBox<S>(shape, {});
                return Real(0.4) * Real(0.5) * (box.max - box.min).minCoeff();
            }
        },
        shape);
}

template <class S>
typename S::Vec middleOf(const Shape<S>& shape) {
    const auto* hull = std::get_if<Hull<S>>(&shape);
    return hull == nullptr ? typename S::Vec(S::Vec::Zero()) : hull->data->center;
}

#define RIGOR_INSTANTIATE(S)                                \
    template S::Real inscribedRadiusOf<S>(const Shape<S>&); \
    template S::Vec middleOf<S>(const Shape<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
