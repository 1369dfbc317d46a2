// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// States of bodies as coordinates of DART's joints.
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PlanarJoint.hpp>

#include "adapters/dart/model.hpp"

namespace rigor::dart_adapter {
namespace {

using adapter::BodyState;
using scenario::BodyType;

void placeFree(dart::dynamics::Joint& joint, const Pose& pose, const BodyState& state) {
    if (auto* free = dynamic_cast<dart::dynamics::FreeJoint*>(&joint)) {
        free->setTransform(toDart(pose));
        free->setLinearVelocity(toDart(state.velocity));
        free->setAngularVelocity(toDart(state.angularVelocity));
        return;
    }
    const double angle = adapter::nearestTurn(angleAboutZ(pose.orientation), joint.getPosition(2));
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
        joints[k]->setPosition(0, adapter::nearestTurn(found.angles[k], joints[k]->getPosition(0)));
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
    placeTurns(model.coordinates[body], motion);
    for (const Coordinate& coordinate : model.coordinates[body]) {
        if (coordinate.kind != CoordinateKind::Travel) continue;
        const adapter::Travel travel = adapter::travelOf(link, motion, coordinate.axis);
        coordinate.joint->setPosition(0, travel.length);
        coordinate.joint->setVelocity(0, travel.speed);
    }
}

}  // namespace rigor::dart_adapter
