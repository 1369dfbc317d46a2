// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The mass properties of a body: given by hand, or those of its shapes (BodyDef::mass).
//
// Two parts of masses m, n with centres c, d and inertias I, J about these make one of mass m + n with its centre at
// (m c + n d) / (m + n) and, by Steiner's theorem, with r = d - c, the inertia
//     I + J + m n / (m + n) (|r|^2 E - r r^T)        (2D: |r|^2)
// in which nothing cancels.
#pragma once

#include <cstdint>

#include "engine/contacts/shape_record.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {

template <class S>
struct BodyMass {
    // --- as given; zero: not
    typename S::Real mass = 0;
    typename S::Vec center = S::Vec::Zero();
    typename S::Inertia inertia = zeroInertia<S>();
    // --- of the shapes, in the body frame
    MassProperties<S> shapes{0, S::Vec::Zero(), zeroInertia<S>()};
    std::uint32_t shapeCount = 0;

    bool byHand() const;
    /// The mass properties that the body has if it is dynamic.
    MassProperties<S> properties() const;
};

/// Adds the part to the whole; both about their own centres, in one frame.
template <class S>
void addMass(const MassProperties<S>& part, MassProperties<S>& whole);
/// Mass properties of a shape on a body with this centre of mass, in the body frame; zero for shapes that have no density.
template <class S>
MassProperties<S> massOfShape(const ShapeRecord<S>& shape, const typename S::Vec& centerOfMass);

/// Throws EngineError "body_mass", "body_center_of_mass" or "body_inertia" for what a dynamic body cannot have.
template <class S>
void checkMass(const MassProperties<S>& properties);

}  // namespace rigor::engine
