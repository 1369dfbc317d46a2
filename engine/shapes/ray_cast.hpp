// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rays against single shapes, by closed forms.
#pragma once

#include "engine/shapes/shape.hpp"

namespace rigor::engine {

/// First intersection of a ray x(t) = origin + t translation, 0 <= t <= 1, with a shape.
template <class S>
struct RayHit {
    typename S::Real fraction = 0;  ///< t
    typename S::Vec point, normal;  ///< world frame; the normal is unit, out of the shape, towards the origin
    std::uint32_t piece = 0xffffffffu;  ///< index of the piece of a chain, mesh or height field
    bool startsInside = false;          ///< the origin is in the solid: fraction 0, normal against the ray
};

/// False where the ray misses. Surfaces (segments, triangles, chains, meshes, fields) are hit from both sides
/// and have no inside. `translation` finite, not zero.
template <class S>
bool castRay(const Shape<S>& shape, const Pose<S>& X, const typename S::Vec& origin,
             const typename S::Vec& translation, RayHit<S>& hit);

}  // namespace rigor::engine
