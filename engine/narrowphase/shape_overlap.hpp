// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Whether two posed shapes overlap or touch, chains, meshes and height fields included.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/math/space.hpp"
#include "engine/shapes/shape.hpp"

namespace rigor::engine {

/// A piece of `other` that `shape` overlaps or touches: of a chain, mesh or height field the first one, kNullIndex of
/// other shapes, and where the lowest point of the shape is in the solid under a height field. `shape` is convex and
/// no half-space. The distance is that of closestPoints (distance.hpp).
template <class S>
std::optional<std::uint32_t> findOverlap(const Shape<S>& shape, const Pose<S>& X, const Shape<S>& other,
                                         const Pose<S>& Xother);

}  // namespace rigor::engine
