// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Conversion of a shape's definition to its record.
#pragma once

#include "engine/contacts/shape_record.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {

/// Throws EngineError "half_space_body" or "surface_body" for shapes that need a static body where it is not.
template <class S>
void requireBodyType(const Shape<S>& shape, BodyType type);

/// Record of a shape on a body with these constants and this dense index. Throws EngineError for poses and
/// sizes out of range, and for shapes that need a static body where it is not.
template <class S>
ShapeRecord<S> makeShapeRecord(const ShapeDef<S>& def, const BodyConstants<S>& constants, std::uint32_t body);

/// Sets the velocity of the shape's surface over its body (ShapeDef::surfaceVelocity). Throws EngineError where it is
/// not finite.
template <class S>
void setSurfaceVelocity(ShapeRecord<S>& record, const Velocity<S>& surface,
                        const BodyConstants<S>& constants);

}  // namespace rigor::engine
