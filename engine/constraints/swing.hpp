// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rotations of B against A as a twist about A's axis followed by a swing of the axis (3D).
#pragma once

#include "engine/constraints/joint.hpp"

namespace rigor::engine {

/// Adds the coordinate "twist about the axis", counted over turns from joint.lastCoordinate [rad].
template <class S>
void addTwistCoordinate(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out);
/// Adds the coordinate "angle between turnA and turnB", in [0, pi] [rad].
template <class S>
void addConeCoordinate(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out);
/// Adds two coordinates: the swing vector's components along turnPerpA1 and turnPerpA2 [rad].
template <class S>
void addSwingCoordinates(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out);

}  // namespace rigor::engine
