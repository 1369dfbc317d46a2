// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The spring of a ball's swing. DART's springs are of single coordinates, those of a BallJoint the three parts of its rotation
// vector, which a twist stretches too: the adapter gives the torque.
#pragma once

#include "adapters/dart/convert.hpp"
#include "adapters/interface/types.hpp"

namespace rigor::dart_adapter {

bool hasSwingSpring(const scenario::Joint& joint);

/// Torque on B of the spring and damper of a ball's swing, the angle between the axes of A and B; A bears the opposite one.
/// None where the axes coincide or are opposite, for the swing has no direction there.
Vec3 swingTorque(const scenario::Joint& joint, const adapter::BodyState& a, const adapter::BodyState& b);

}  // namespace rigor::dart_adapter
