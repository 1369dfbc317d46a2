// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A shape as Python gives it, for a world of any dimension and precision.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/python/numbers.hpp"
#include "engine/shapes/shape.hpp"

namespace rigor::engine::python {

enum class ShapeKind {
    Sphere,
    Box,
    Capsule,
    Cylinder,
    Cone,
    Ellipsoid,
    HalfSpace,
    Hull,
    Segment,
    Chain,
    Mesh,
    HeightField
};
const char* shapeKindName(ShapeKind kind);  ///< "sphere", "half_space", ...

struct ShapeArgs {
    ShapeKind kind = ShapeKind::Sphere;
    std::vector<double> sizes;  ///< radius; half extents; radius, half length; offset; spacings and thickness
    Numbers vector;             ///< normal of a half-space
    Numbers points;             ///< points x dimension; heights of a field, rows x columns
    std::vector<std::array<std::uint32_t, 3>> triangles;
    bool loop = false;  ///< a chain that ends where it begins
};

/// Throws EngineError "shape_dimension" for a kind that the dimension does not have, "array" for numbers of another
/// dimension, and as makeHull and its like.
template <class S>
Shape<S> toShape(const ShapeArgs& args);

void bindShapes(py::module_& module);

}  // namespace rigor::engine::python
