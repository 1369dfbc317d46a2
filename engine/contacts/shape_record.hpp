// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A shape of a body.
#pragma once

#include <cstdint>

#include "engine/core/ids.hpp"
#include "engine/shapes/bounding_sphere.hpp"
#include "engine/shapes/shape.hpp"
#include "engine/state/body_arrays.hpp"
#include "engine/state/shape_filter.hpp"

namespace rigor::engine {

/// The dense index of a shape is its broad-phase proxy.
template <class S>
struct ShapeRecord {
    Shape<S> shape;
    Pose<S> local;           ///< pose in the frame at the body's centre of mass
    std::uint32_t body = 0;  ///< dense index
    std::uint32_t material = 0;
    ShapeId id;
    ShapeFilter filter;
    bool sensor = false;           ///< it has no contacts (sensors.hpp)
    typename S::Real density = 0;  ///< as in ShapeDef; 0 of a sensor
    /// Bounding radius of the core about the centre of mass, and inscribed radius (contacts/moving_shape.hpp) [m].
    typename S::Real boundingRadius = 0, inscribedRadius = 0;
    typename S::Real radius = 0;              ///< bounding radius about the shape's own origin [m]
    typename S::Vec middle = S::Vec::Zero();  ///< a point well inside, in the frame of the shape [m]
    BoundingSphere<S> sphere;                 ///< in the frame of the shape
    /// ShapeDef::surfaceVelocity with the velocity of the point at the centre of mass, axes of the body frame.
    Velocity<S> surface;
    bool hasSurfaceVelocity = false;  ///< false: surface is zero
};

}  // namespace rigor::engine
