// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Forces of the scenario that Simbody's integrators evaluate at every stage.
#pragma once

#include "adapters/simbody/model.hpp"

namespace rigor::simbody {

/// Adds the scenario's springs and drags, the damping of velocities, and the gravity of bodies that have their own.
void addForces(const adapter::Scenario& scenario, Model& model);

/// Adds the spring and the motor of a coordinate between two bodies.
std::vector<Acting> addDriven(Model& model, const Driven& driven);

/// Place of a body of the scenario in Simbody's system; the world for kNone.
Frame frameOf(const adapter::Scenario& scenario, const Model& model, int body);
Sides sidesOf(const adapter::Scenario& scenario, const Model& model, const scenario::Joint& joint,
              bool planar);

}  // namespace rigor::simbody
