// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Springs of joints that the scenario gives by frequency and damping ratio, as stiffness and damping. The
// format means the effective mass of the coordinate at the initial poses; what engines themselves make of a
// frequency differs (the mass of each step, of one body, of no arm), so every adapter passes numbers in N/m
// and N s/m from here.
#pragma once

#include "adapters/interface/types.hpp"

namespace rigor::adapter {

/// Effective mass [kg] or [kg m^2] of coordinate k of a joint at the initial poses, while the coordinates that
/// the joint locks do not move:
///     m = 1 / (j W j^T),  W = M^-1 - M^-1 H^T (H M^-1 H^T)^-1 H M^-1
/// with j the row of the coordinate, H those that are held, M the mass matrix of the two bodies, of which
/// static and kinematic ones do not move. Zero where nothing can move. A swing has no direction where it is
/// zero: its mass is that about the joint's normal.
double effectiveMass(const Scenario& scenario, const scenario::Joint& joint, std::size_t k);

/// The scenario with k = m (2 pi f)^2 and c = 4 pi zeta f m in place of every frequency f and damping ratio
/// zeta of its joints.
Scenario withStiffness(Scenario scenario);

}  // namespace rigor::adapter
