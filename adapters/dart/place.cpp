// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// States of bodies as coordinates of DART's joints.
#include <cmath>
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PlanarJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <numbers>

#include "adapters/dart/model.hpp"

namespace rigor::dart_adapter {
namespace {

using adapter::BodyState;
using scenario::BodyType;

/// The angle in the turn nearest to where the coordinate is: stops and springs count turns.
double near(double angle, double now) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    return angle + kTurn * std::round((now - angle) / kTurn);
}

void placeFree(dart::dynamics::Joint& joint, const Pose& pose, const BodyState& state) {
    if (auto* free = dynamic_cast<dart::dynamics::FreeJoint*>(&joint)) {
        free->setTransform(toDart(pose));
        free->setLinearVelocity(toDart(state.velocity));
        free->setAngularVelocity(toDart(state.angularVelocity));
        return;
    }
    const double angle = near(angleAboutZ(pose.orientation), joint.getPosition(2));
    joint.setPositions(Eigen::Vector3d(pose.position.x, pose.position.y, angle));
    joint.setVelocities(Eigen::Vector3d(state.velocity.x, state.velocity.y, state.angularVelocity.z));
}

}  // namespace

void placeBody(const Model& model, const adapter::Scenario& scenario, bool planar, int body,
               std::span<const BodyState> states) {
    const Link& link = model.forest.links[body];
    if (link.fixed) return;
    const BodyState& state = states[body];
    const Pose pose = Pose{state.position, state.orientation} * link.frame;
    dart::dynamics::Joint& joint = *model.bodies[body]->getParentJoint();
    if (link.joint == kNone) return placeFree(joint, pose, state);
    if (joint.getNumDofs() == 0) return;

    // The parent: pose, and velocity at the point of it that is at the child's anchor.
    const Vec3 anchor = anchorIn(link, scenario.joints[link.joint]);
    Pose parent;
    Vec3 parentTurn, parentSpeed;
    if (link.parent != kNone) {
        const BodyState& of = states[link.parent];
        parent = Pose{of.position, of.orientation} * model.forest.links[link.parent].frame;
        parentTurn = of.angularVelocity;
        parentSpeed = of.velocity + cross(parentTurn, pose * anchor - parent.position);
    }
    const Vec3 turn = rotateInverse(pose.orientation, state.angularVelocity - parentTurn);
    const Pose relative = inverse(parent) * pose;
    const Quat turned = conjugate(link.rest.orientation) * relative.orientation;
    if (joint.getNumDofs() == 3) {
        joint.setPositions(dart::dynamics::BallJoint::convertToPositions(toDart(Pose{{}, turned}).linear()));
        joint.setVelocities(toDart(turn));
        return;
    }
    const scenario::Joint& of = scenario.joints[link.joint];
    const bool turns = dynamic_cast<dart::dynamics::RevoluteJoint*>(&joint) != nullptr;
    const Vec3 axis = planar && turns ? Vec3{0.0, 0.0, 1.0} : axisIn(link, of);
    if (turns) {
        const double angle = 2.0 * std::atan2(dot(Vec3{turned.x, turned.y, turned.z}, axis), turned.w);
        joint.setPosition(0, near(angle, joint.getPosition(0)));
        joint.setVelocity(0, dot(turn, axis));
        return;
    }
    const Vec3 along = rotate(link.rest.orientation, axis);
    const Vec3 speed =
        state.velocity + cross(state.angularVelocity, pose * anchor - pose.position) - parentSpeed;
    joint.setPosition(0, dot(relative * anchor - link.rest * anchor, along));
    joint.setVelocity(0, dot(speed, rotate(parent.orientation, along)));
}

}  // namespace rigor::dart_adapter
