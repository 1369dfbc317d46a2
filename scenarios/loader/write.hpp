// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The model as a scenario file: what programs make of scenarios (transformed, perturbed) is run and stored
// like a file.
#pragma once

#include <string>

#include "scenarios/model/scenario.hpp"

namespace rigor::scenario {

/// The physics of a scenario in format 1, everything said in full: no generators, mass, centre of mass and
/// inertia of every dynamic body. Bounds, deviations, the reference and settings of engines are left out.
/// Loading the text gives the same scenario, the same bits but for directions and angles, which the loader
/// normalises (a few ulp).
std::string scenarioText(const Scenario& scenario);

}  // namespace rigor::scenario
