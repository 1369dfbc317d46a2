// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Kinematic bodies: their motion is given as a function of time.
#pragma once

#include "adapters/simbody/convert.hpp"
#include "scenarios/model/scenario.hpp"

namespace rigor::simbody {

/// Pose of a body that turns and moves with constant velocities.
Pose poseAt(const scenario::Body& body, double time);

/// Prescribes the motion of a body on a free joint of Simbody's. `frame` is the frame of Simbody's body in the
/// scenario's.
void prescribe(const scenario::Body& body, const Pose& frame, SimTK::MobilizedBody& mobilizer);

}  // namespace rigor::simbody
