// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See joint_parts.hpp.
#include "validation/references/joints/joint_parts.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::validation {

using scenario::BodyType;
using scenario::kNone;

Vec3 anchorOf(const Scenario& scenario, const scenario::Joint& joint, int body) {
    const Vec3 local = joint.bodyA == body ? joint.anchorA : joint.anchorB;
    return body == kNone ? local : scenario.bodies[body].pose * local;
}

Vec3 axisOf(const Scenario& scenario, const scenario::Joint& joint) {
    if (scenario.dimension == 2) return {0, 0, 1};
    if (joint.bodyA == kNone) return unit(joint.axisA);
    return unit(rotate(scenario.bodies[joint.bodyA].pose.orientation, joint.axisA));
}

void requirePassive(const scenario::Joint& joint, bool limitsAllowed) {
    for (const std::string& feature : joint.features())
        require(limitsAllowed && feature == "limit",
                "joint '" + joint.name + "' has a " + feature + ", which this reference does not know");
}

FixedJoint fixedJoint(const Scenario& scenario, int index, int body, bool limitsAllowed) {
    const auto& joint = scenario.joints[index];
    requirePassive(joint, limitsAllowed);
    require(joint.bodyA == body || joint.bodyB == body,
            "joint '" + joint.name + "' does not hold " + bodyTitle(scenario, body));
    const int other = joint.bodyA == body ? joint.bodyB : joint.bodyA;
    require(other == kNone || scenario.bodies[other].type == BodyType::Static,
            "joint '" + joint.name + "' does not hold " + bodyTitle(scenario, body) + " to a fixed point");
    FixedJoint fixed{&joint, anchorOf(scenario, joint, other), axisOf(scenario, joint)};
    const Vec3 own = anchorOf(scenario, joint, body);
    const double arm = norm(own - centerOfMass(scenario.bodies[body]));
    require(norm(own - fixed.anchor) <= 1e-6 * (arm + sizeOf(scenario.bodies[body])),
            "the anchors of joint '" + joint.name + "' are apart");
    return fixed;
}

void requireTurnsAbout(const Scenario& scenario, int index, Vec3 anchor) {
    const Body& body = scenario.bodies[index];
    const Vec3 arm = centerOfMass(body) - anchor, expected = cross(body.angularVelocity, arm);
    // A spin about the arm moves the centre of mass only by rounding: the scale is |w||r|, not |w x r|.
    const double fast = std::max(norm(body.velocity), norm(body.angularVelocity) * norm(arm)),
                 falling = std::sqrt(norm(gravityOn(scenario, index)) * norm(arm));
    require(norm(body.velocity - expected) <= 1e-6 * fast + 1e-12 * falling,
            "the velocity of " + bodyTitle(scenario, index) +
                " is not that of turning about its joint with its spin, " +
                shown(expected, scenario.dimension));
}

void requireOnlyJoints(const Scenario& scenario, int body,
                       std::initializer_list<const scenario::Joint*> joints) {
    requireUndisturbed(scenario, body, {.joints = true});
    for (const auto& joint : scenario.joints) {
        if (joint.bodyA != body && joint.bodyB != body) continue;
        require(std::find(joints.begin(), joints.end(), &joint) != joints.end(),
                "joint '" + joint.name + "' also holds " + bodyTitle(scenario, body));
    }
}

}  // namespace rigor::validation
