// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <BulletDynamics/ConstraintSolver/btTypedConstraint.h>

#include <memory>
#include <string>
#include <vector>

#include "adapters/bullet/damper.hpp"
#include "adapters/bullet/swing_spring.hpp"
#include "adapters/bullet/turn_limit.hpp"
#include "adapters/interface/types.hpp"

namespace rigor::bullet {

/// One end of a joint: the Bullet body, its frame in the scenario's body frame, and the scenario's body with
/// its pose; null for the world.
struct JointEnd {
    btRigidBody* body = nullptr;
    adapter::Pose comFrame;
    adapter::Pose bodyPose;
    const scenario::Body* scenarioBody = nullptr;
};

struct JointSettings {
    double dt = 0.0;           ///< [s]
    bool frameOffset = true;   ///< Bullet's hinge weights its anchors by the bodies' masses
    bool limitSprings = true;  ///< Bullet softens springs and dampers that are stiff for the step
};

/// The shortest rotation that takes +x to the unit vector n.
adapter::Quat fromXTo(const adapter::Vec3& n);

/// A joint frame in A and in B, in Bullet's body frames: anchors as given, one common orientation at the
/// initial poses, which is `inA` in A's body frame.
struct Frames {
    btTransform inA, inB;
};
Frames framesOf(const scenario::Joint& joint, const adapter::Quat& inA, const JointEnd& a, const JointEnd& b);

/// Bullet constraints that are one joint, and the values that they need before each step.
struct BuiltJoint {
    BuiltJoint() = default;
    explicit BuiltJoint(std::unique_ptr<btTypedConstraint> only) { parts.push_back(std::move(only)); }

    std::vector<std::unique_ptr<btTypedConstraint>> parts;
    std::vector<Damper> dampers;
    std::vector<TurnLimit> turnLimits;
    std::vector<SwingSpring> swingSprings;
};

/// The joint as Bullet constraints; axes and signs follow the format (B relative to A). Throws Unsupported
/// for what Bullet does not have.
BuiltJoint buildJoint(const scenario::Joint& joint, const JointEnd& a, const JointEnd& b,
                      const JointSettings& settings);

}  // namespace rigor::bullet
