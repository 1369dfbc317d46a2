// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Starts a little beside that of a scenario.
#pragma once

#include <cstdint>

#include "scenarios/model/scenario.hpp"

namespace rigor::validation {

/// Largest differences of the start, uniform for each component.
struct Perturbation {
    double position = 0.0;  ///< [m]
    double angle = 0.0;     ///< [rad], about each axis
    double velocity = 0.0;  ///< [m/s]
    double spin = 0.0;      ///< [rad/s], about each axis
};

/// Start number `member` of an ensemble: a function of the arguments alone, the same on every machine.
/// Dynamic bodies that joints hold together are moved as one rigid body, so that anchors still coincide: a
/// group that nothing fixed holds is shifted and turned about its centre of mass; one that hangs on a single
/// ball joint or hinge is turned about it. A group held otherwise stays. Throws std::invalid_argument when
/// nothing can be moved.
scenario::Scenario perturbed(const scenario::Scenario& scenario, const Perturbation& size, std::uint64_t seed,
                             std::uint32_t member);

}  // namespace rigor::validation
