// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The force of a drag: F = k (target - x) - c v at the held point x, critically damped,
//     c = 2 sqrt(k m),   1/m = 1/M + |r x n|^2 / I      (n: along the spring; m: what is felt at the point)
// constant during a step. k h^2 / m <= 1/4 keeps that stable for every requested stiffness.
#pragma once

#include <span>

#include "validation/live/instance_world.hpp"

namespace rigor::validation {

struct DragPull {
    scenario::Vec3 force, torque;  ///< force and torque at the centre of mass, world frame [N], [N m]
};
DragPull dragForce(const scenario::Scenario& scenario, const Drag& drag,
                   std::span<const adapter::BodyState> states, double dt);

}  // namespace rigor::validation
