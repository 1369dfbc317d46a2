// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// States of bodies as coordinates of DART's joints.
#include <cmath>
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PlanarJoint.hpp>
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

void placeTurns(const std::vector<Coordinate>& coordinates, const adapter::LinkMotion& motion) {
    std::vector<Vec3> axes;
    std::vector<dart::dynamics::Joint*> joints;
    for (const Coordinate& coordinate : coordinates) {
        if (coordinate.kind == CoordinateKind::Ball) {
            const Eigen::Matrix3d turned = toDart(Pose{{}, motion.turned}).linear();
            coordinate.joint->setPositions(dart::dynamics::BallJoint::convertToPositions(turned));
            coordinate.joint->setVelocities(toDart(motion.turn));
        } else if (coordinate.kind == CoordinateKind::Turn) {
            axes.push_back(coordinate.axis);
            joints.push_back(coordinate.joint);
        }
    }
    if (axes.empty()) return;
    const Angles found = anglesOf(axes, motion.turned, motion.turn);
    for (std::size_t k = 0; k < joints.size(); ++k) {
        joints[k]->setPosition(0, near(found.angles[k], joints[k]->getPosition(0)));
        joints[k]->setVelocity(0, found.rates[k]);
    }
}

}  // namespace

void placeBody(const Model& model, const adapter::Scenario& scenario, int body,
               std::span<const BodyState> states) {
    const Link& link = model.forest.links[body];
    if (link.fixed) return;
    if (link.joint == kNone) {
        const BodyState& state = states[body];
        return placeFree(*model.bodies[body]->getParentJoint(),
                         Pose{state.position, state.orientation} * link.frame, state);
    }
    const adapter::LinkMotion motion = adapter::motionOf(model.forest, scenario, body, states);
    const std::vector<Coordinate>& coordinates = model.coordinates[body];
    placeTurns(coordinates, motion);
    // A body whose turns come first slides along axes of its own, others along axes of their parents.
    const bool byItself = !coordinates.empty() && coordinates.front().kind != CoordinateKind::Travel;
    for (const Coordinate& coordinate : coordinates) {
        if (coordinate.kind != CoordinateKind::Travel) continue;
        const Vec3 along = rotate(byItself ? Quat{} : link.rest.orientation, coordinate.axis);
        const Vec3 moved = byItself ? motion.anchor - inverse(motion.relative) * (link.rest * motion.anchor)
                                    : motion.relative * motion.anchor - link.rest * motion.anchor;
        const Vec3 speed =
            byItself ? rotateInverse(motion.pose.orientation, motion.speed) - cross(motion.turn, moved)
                     : rotateInverse(motion.parent.orientation, motion.speed);
        coordinate.joint->setPosition(0, dot(moved, along));
        coordinate.joint->setVelocity(0, dot(speed, along));
    }
}

}  // namespace rigor::dart_adapter
