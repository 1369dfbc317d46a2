// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A joint that holds a body to the fixed world, in world coordinates.
#pragma once

#include "validation/references/parts.hpp"

namespace rigor::validation {

/// Throws where the joint has limits (unless `limitsAllowed`), a motor or a spring, or may break.
void requirePassive(const scenario::Joint& joint, bool limitsAllowed = false);

struct FixedJoint {
    const scenario::Joint* joint = nullptr;
    Vec3 anchor;  ///< world [m]
    Vec3 axis;    ///< world, unit; +z in 2D
};
/// Throws AssumptionViolated unless the joint holds `body` to the world or to a static body, with both
/// anchors at one point.
FixedJoint fixedJoint(const Scenario& scenario, int joint, int body, bool limitsAllowed = false);

/// The body's own anchor and the joint's axis in the world, at the initial pose.
Vec3 anchorOf(const Scenario& scenario, const scenario::Joint& joint, int body);
Vec3 axisOf(const Scenario& scenario, const scenario::Joint& joint);

/// Throws AssumptionViolated unless the body's velocity is that of turning about `anchor` with its spin.
void requireTurnsAbout(const Scenario& scenario, int body, Vec3 anchor);
/// Throws AssumptionViolated when another joint, or a force, event or damping acts on the body.
void requireOnlyJoints(const Scenario& scenario, int body,
                       std::initializer_list<const scenario::Joint*> joints);

}  // namespace rigor::validation
