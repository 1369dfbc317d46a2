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
    dart::dynamics::Joint& joint = *model.bodies[body]->getParentJoint();
    if (link.joint == kNone) {
        const BodyState& state = states[body];
        return placeFree(joint, Pose{state.position, state.orientation} * link.frame, state);
    }
    if (joint.getNumDofs() == 0) return;

    const adapter::LinkMotion motion = adapter::motionOf(model.forest, scenario, body, states);
    if (joint.getNumDofs() == 3) {
        const Eigen::Matrix3d turned = toDart(Pose{{}, motion.turned}).linear();
        joint.setPositions(dart::dynamics::BallJoint::convertToPositions(turned));
        joint.setVelocities(toDart(motion.turn));
        return;
    }
    const bool turns = dynamic_cast<dart::dynamics::RevoluteJoint*>(&joint) != nullptr;
    const Vec3 axis = planar && turns ? Vec3{0.0, 0.0, 1.0} : axisIn(link, scenario.joints[link.joint]);
    if (turns) {
        const Quat& q = motion.turned;
        const double angle = 2.0 * std::atan2(dot(Vec3{q.x, q.y, q.z}, axis), q.w);
        joint.setPosition(0, near(angle, joint.getPosition(0)));
        joint.setVelocity(0, dot(motion.turn, axis));
        return;
    }
    const Vec3 along = rotate(link.rest.orientation, axis);
    joint.setPosition(0, dot(motion.relative * motion.anchor - link.rest * motion.anchor, along));
    joint.setVelocity(0, dot(motion.speed, rotate(motion.parent.orientation, along)));
}

}  // namespace rigor::dart_adapter
