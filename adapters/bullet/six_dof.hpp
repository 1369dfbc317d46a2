// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/bullet/joints.hpp"

namespace rigor::bullet {

/// six_dof, wheel, and hinges and sliders with a spring as btGeneric6DofSpring2Constraint. Throws
/// Unsupported.
BuiltJoint buildSixDof(const scenario::Joint& joint, const JointEnd& a, const JointEnd& b,
                       const JointSettings& settings);

}  // namespace rigor::bullet
