// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A 2D six_dof as the simpler joint that it is, for engines without such a joint.
#pragma once

#include <optional>

#include "scenarios/model/scenario.hpp"

namespace rigor::adapter {

/// True where a coordinate of a six_dof is locked and neither driven nor sprung.
bool isHeld(const scenario::JointAxis& axis);

/// The fixed joint, hinge, slider or wheel that leaves a 2D six_dof's travel, angle, or both to choose for. If its
/// travel is along the normal, that is the axis. Empty where neither travel is held.
std::optional<scenario::Joint> reducedPlanarJoint(const scenario::Joint& joint);

}  // namespace rigor::adapter
