// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Conditions for energy as a measure of quality, and its scale.
#pragma once

#include <optional>

#include "validation/metrics/mechanics.hpp"
#include "validation/metrics/metric_parts.hpp"

namespace rigor::validation {

/// Energy of the exact solution at time t; empty unless the reference knows every dynamic body in full.
std::optional<double> exactEnergy(const MetricInput& input, double t);
/// Kinetic energy of the exact solution, likewise.
std::optional<double> exactKinetic(const MetricInput& input, double t);

/// Nothing does work on the scene: no constant force, event, moving kinematic body, moving surface, motor or spring of a
/// joint. Friction, impacts, drag and damping only take energy.
bool isPassive(const scenario::Scenario& scenario);
/// The scene keeps its energy: passive, without damping or drag, and either every possible contact is elastic
/// and frictionless and no joint has limits, or the exact solution keeps it (rolling, central elastic
/// impacts).
bool conservesEnergy(const MetricInput& input);

/// Scale of energies [J]: the largest kinetic energy of the exact solution if it is known in full, otherwise
/// of the run, at least that at the start; if nothing moves, the sum of m |g| times the bodies' size. 0 when
/// there is neither motion nor gravity.
double energyScale(const MetricInput& input);

}  // namespace rigor::validation
