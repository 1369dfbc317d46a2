// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A body with the mass, centre of mass and inertia of its shapes.
#pragma once

#include <cstdint>
#include <initializer_list>

#include "engine/pipeline/world.hpp"

namespace rigor::engine {

/// A shape, where it is in the body frame, and what it is made of.
template <class S>
struct SolidPart {
    Shape<S> shape;
    typename S::Real density = 1000;  ///< [kg/m^3] (2D: [kg/m^2]), > 0
    std::uint32_t material = kUsualMaterial;
    Pose<S> pose = {};
};

/// Adds a body of these parts in one call. Its mass, centre of mass and inertia are those of the parts, whatever `def`
/// says; the velocity of `def` is that of the centre of mass. Throws EngineError as World::addBody and addShape do.
template <class S>
BodyId addSolid(World<S>& world, std::initializer_list<SolidPart<S>> parts, BodyDef<S> def = {});

}  // namespace rigor::engine
