// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Energy and momentum of a scene from states and the scenario's own mass properties: the one implementation
// for all engines. Dynamic bodies only.
//   T = sum m v^2/2 + w.(R I R^T w)/2,  V = -sum m g.x + sum k (l - L0)^2/2,
//   P = sum m v,  L = sum (x - o) x m v + R I R^T w.
// Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., 2002, chapters 1 and 5.
#pragma once

#include <span>

#include "scenarios/model/scenario.hpp"
#include "validation/trajectory.hpp"

namespace rigor::validation {

scenario::Vec3 centerOfMassOf(const scenario::Body& body, const BodyState& state);  ///< world [m]
/// Spin angular momentum about the centre of mass, world frame [kg m^2/s].
scenario::Vec3 spinMomentum(const scenario::Scenario& scenario, const scenario::Body& body,
                            const BodyState& state);

/// Radius of a ball about the centre of mass that holds the shapes of a dynamic body [m].
double reachOf(const scenario::Body& body);

struct Mechanics {
    double mass = 0.0;               ///< mass of all dynamic bodies [kg]
    double kinetic = 0.0;            ///< [J]
    double potential = 0.0;          ///< gravity (gravityScale included) and springs [J]
    scenario::Vec3 momentum;         ///< [kg m/s]
    scenario::Vec3 weight;           ///< sum of the gravity forces [N]
    scenario::Vec3 centerOfMass;     ///< centre of mass of all dynamic bodies [m]
    scenario::Vec3 angularMomentum;  ///< angular momentum about the common centre of mass [kg m^2/s]
    double momentumScale = 0.0;      ///< sum m |v| [kg m/s]
    double angularScale = 0.0;       ///< sum m |x - X||v - V| + |R I R^T w| [kg m^2/s]
    double energy() const { return kinetic + potential; }
};
Mechanics mechanicsOf(const scenario::Scenario& scenario, std::span<const BodyState> states);

}  // namespace rigor::validation
