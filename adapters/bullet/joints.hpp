// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <BulletDynamics/ConstraintSolver/btTypedConstraint.h>

#include <memory>

#include "adapters/interface/types.hpp"

namespace rigor::bullet {

/// One end of a joint: the Bullet body, its frame in the scenario's body frame, and the scenario's body pose.
struct JointEnd {
    btRigidBody* body = nullptr;
    adapter::Pose comFrame;
    adapter::Pose bodyPose;
};

/// The joint as a Bullet constraint for steps of dt; axes and signs follow the format (B relative to A).
/// Throws Unsupported for what Bullet does not have.
std::unique_ptr<btTypedConstraint> buildJoint(const scenario::Joint& joint, const JointEnd& a,
                                              const JointEnd& b, double dt);

}  // namespace rigor::bullet
