// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <vector>

#include "adapters/chipmunk/convert.hpp"

namespace rigor::chipmunk {

/// The Chipmunk constraints that together are one of the scenario's joints.
struct Parts {
    std::vector<Owned<cpConstraint>> forces;   ///< impulses are forces at the anchors
    std::vector<Owned<cpConstraint>> torques;  ///< impulses are torques
    bool empty() const { return forces.empty() && torques.empty(); }
};

/// One end of a joint: the Chipmunk body and the scenario's pose of it.
struct JointEnd {
    cpBody* body = nullptr;
    Pose pose;
};

/// Constraints of a joint, in no space. Angles are measured from the initial ones. Throws Unsupported.
Parts buildJoint(const scenario::Joint& joint, const JointEnd& a, const JointEnd& b);

/// Reaction of a joint in the last step of dt, averaged.
struct Reaction {
    double force = 0.0;   ///< [N]
    double torque = 0.0;  ///< [N m]
};
Reaction reactionOf(const Parts& parts, double dt);

}  // namespace rigor::chipmunk
