// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <vector>

#include "adapters/box2d/convert.hpp"

namespace rigor::box2d {

/// One end of a joint: the Box2D body, its frame in the scenario's body frame, and the scenario's body pose.
struct JointEnd {
    b2Body* body = nullptr;
    Pose frame;
    Pose bodyPose;
};

/// The Box2D joints that together are one of the scenario's; the world owns them.
using Parts = std::vector<b2Joint*>;

/// Creates the joint in the world of its bodies. Throws Unsupported.
Parts addJoint(b2World& world, const scenario::Joint& joint, const JointEnd& a, const JointEnd& b,
               double scale);

/// Reaction of a joint on its bodies in the last step of dt, averaged.
struct Reaction {
    double force = 0.0;   ///< [N]
    double torque = 0.0;  ///< torque about B's anchor [N m]
};
Reaction reactionOf(const Parts& parts, double dt, double scale);

}  // namespace rigor::box2d
