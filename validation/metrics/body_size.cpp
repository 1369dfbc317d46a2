// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See body_size.hpp.
#include "validation/metrics/body_size.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "validation/metrics/closed_forms.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

/// Bound of a shape without a closed form against a half-space: the box about it.
Geometry boundOf(const Geometry& geometry) {
    const auto round = [](double radius, double halfLength) { return Box{{radius, halfLength, radius}}; };
    if (const auto* c = std::get_if<Cylinder>(&geometry)) return round(c->radius, c->halfLength);
    if (const auto* c = std::get_if<Cone>(&geometry)) return round(c->radius, c->halfLength);
    if (const auto* e = std::get_if<Ellipsoid>(&geometry)) return Box{e->halfAxes};
    return geometry;
}

/// Least of direction . x over the body, in its own frame [m].
double lowestAlong(const Body& body, Vec3 direction, int dimension) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Shape& shape : body.shapes)
        if (const auto to =
                closedFormPair(boundOf(shape.geometry), shape.pose, HalfSpace{direction, 0.0}, {}, dimension))
            lowest = std::min(lowest, to->distance);
    return lowest;
}

}  // namespace

double widthOf(const Body& body, int dimension) {
    constexpr std::array<Vec3, 3> kAxes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    double width = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i)
        width = std::min(width,
                         -lowestAlong(body, -kAxes[i], dimension) - lowestAlong(body, kAxes[i], dimension));
    return width;
}

}  // namespace rigor::validation
