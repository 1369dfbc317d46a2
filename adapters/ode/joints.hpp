// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <ode/ode.h>

#include "adapters/interface/types.hpp"

namespace rigor::ode {

/// One end of a joint: the ODE body (null for the world and for static bodies) and the initial pose of the
/// body frame.
struct JointEnd {
    dBodyID body = nullptr;
    adapter::Pose pose;
};

/// The scenario's joint between two bodies at their initial poses, for steps of dt; null when neither end
/// moves. Throws Unsupported for what ODE does not have.
dJointID buildJoint(dWorldID world, const scenario::Joint& joint, const JointEnd& a, const JointEnd& b,
                    double dt);

}  // namespace rigor::ode
