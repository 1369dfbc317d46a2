// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A body that stays flat on its support: it slides along a plane and turns about the normal alone.
#pragma once

#include "validation/references/numerics/ode.hpp"
#include "validation/references/parts.hpp"

namespace rigor::validation {

/// Unknowns: two coordinates of the centre of mass along the plane from where it starts [m], the angle turned
/// about the normal [rad], and their rates.
struct FlatMotion {
    /// Three-dimensional scenes in which the body touches a still plane, nothing else acts on it but gravity,
    /// it moves along the plane and spins about the normal, and the normal is along a principal axis; says so
    /// where it is not.
    FlatMotion(const Scenario& scenario, int index, int floor, const Plane& plane);

    struct Place {
        numerics::Real x = 0, y = 0;
    };
    Place place(Vec3 point) const { return {dot(along, point - centre), dot(across, point - centre)}; }
    numerics::OdeState start() const;
    PartialState state(const numerics::OdeState& y) const;

    const Body& body;
    Vec3 normal, along, across;  ///< unit
    Vec3 centre;                 ///< centre of mass at the start [m]
    Support support;
    numerics::Real mass = 0, inertia = 0;  ///< [kg], about the normal [kg m^2]
    numerics::Real friction = 0;           ///< coefficient of the pair
};

}  // namespace rigor::validation
