// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/box2d/convert.hpp"

namespace rigor::box2d {

/// One end of a joint: the Box2D body, its frame in the scenario's body frame, and the scenario's body pose.
struct JointEnd {
    b2Body* body = nullptr;
    Pose frame;
    Pose bodyPose;
};

/// Creates the joint in the world of its bodies. Throws Unsupported.
void addJoint(b2World& world, const scenario::Joint& joint, const JointEnd& a, const JointEnd& b,
              double scale);

}  // namespace rigor::box2d
