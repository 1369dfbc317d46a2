// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The integrators of Simbody 3.7 by the value of the option `integrator`.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "adapters/interface/types.hpp"
#include "adapters/simbody/convert.hpp"

namespace rigor::simbody {

const std::vector<std::string>& integratorNames();

/// Throws BadInput for integrators that cannot step as the settings say.
std::shared_ptr<SimTK::Integrator> makeIntegrator(const SimTK::MultibodySystem& system, double dt,
                                                  const adapter::Settings& settings);

}  // namespace rigor::simbody
