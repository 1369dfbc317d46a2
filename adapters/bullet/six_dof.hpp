// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/bullet/joints.hpp"

namespace rigor::bullet {

/// Adds to a hinge or cone_twist a constraint that leaves all free and drives its turn, or springs it.
void addTurnMotor(const scenario::Joint& joint, const JointEnd& a, const JointEnd& b, BuiltJoint& built);
void addTurnSpring(const scenario::Joint& joint, const JointEnd& a, const JointEnd& b,
                   const JointSettings& settings, BuiltJoint& built);

/// Adds to a ball or cone_twist a constraint that leaves all free and springs its swing.
void addSwingSpring(const scenario::Joint& joint, const JointEnd& a, const JointEnd& b,
                    const JointSettings& settings, BuiltJoint& built);

/// six_dof, wheel, and hinges and sliders with a spring as btGeneric6DofSpring2Constraint, several where one
/// does not do. Throws Unsupported.
BuiltJoint buildSixDof(const scenario::Joint& joint, const JointEnd& a, const JointEnd& b,
                       const JointSettings& settings);

}  // namespace rigor::bullet
