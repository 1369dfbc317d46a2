// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/simbody/loops.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adapters/interface/joint_trees.hpp"
#include "adapters/interface/unsupported.hpp"

namespace rigor::simbody {

using scenario::Joint;
using scenario::JointType;
using SimTK::Constraint;
using SimTK::UnitVec3;

namespace {

/// Two directions across an axis.
std::pair<Vec3, Vec3> across(const Vec3& axis) {
    const Vec3 other = std::abs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 side = other - dot(other, axis) * axis, one = side / norm(side);
    return {one, cross(axis, one)};
}

/// True for a joint that is no more than its kind.
bool isPlain(const Joint& joint) {
    const scenario::JointAxis& axis = joint.axes[0];
    if (joint.type == JointType::Fixed || joint.type == JointType::Distance) return true;
    return !axis.hasMotor() && !axis.hasSpring() &&
           (axis.mode == scenario::AxisMode::Free || axis.mode == scenario::AxisMode::Usual);
}

}  // namespace

template <class Kind, class... Arguments>
void LoopJoint::add(Arguments&&... arguments) {
    parts_.push_back(Kind(std::forward<Arguments>(arguments)...));
}

LoopJoint::LoopJoint(const Joint& joint, int index, const Frame& a, const Frame& b, const Quat& relative,
                     bool planar)
    : joint_(index),
      breakForce_(joint.breakForce),
      breakTorque_(joint.breakTorque),
      a_(a.body),
      b_(b.body),
      anchorA_(a.pose * joint.anchorA),
      anchorB_(b.pose * joint.anchorB) {
    const Vec3 axisA = rotate(a.pose.orientation, joint.axisA),
               axisB = rotate(b.pose.orientation, joint.axisB);
    const bool known = joint.type == JointType::Ball || joint.type == JointType::Hinge ||
                       joint.type == JointType::Slider || joint.type == JointType::Fixed ||
                       joint.type == JointType::Distance;
    if (!known || !isPlain(joint))
        throw adapter::notInAdapter("simbody",
                                    std::string("a ") + jointName(joint.type) +
                                        " with more than its kind that " +
                                        (adapter::canBreak(joint) ? "breaks" : "closes a loop"),
                                    "joint '" + joint.name + "'");
    // Simbody's bodies have frames of their own.
    const Quat turn = a.pose.orientation * relative * conjugate(b.pose.orientation);
    switch (joint.type) {
        case JointType::Distance:
            add<Constraint::Rod>(a_, toSimbody(anchorA_), b_, toSimbody(anchorB_), joint.length);
            break;
        case JointType::Slider:
            keepOnLine(axisA, planar);
            keepTurn(turn, planar);
            break;
        case JointType::Fixed:
            keepPoints(planar);
            keepTurn(turn, planar);
            break;
        default:
            keepPoints(planar);
            if (joint.type == JointType::Hinge && !planar) keepAxis(axisA, axisB);
    }
}

/// In a plane the third equation of a point would be none.
void LoopJoint::keepPoints(bool planar) {
    if (!planar) return add<Constraint::Ball>(a_, toSimbody(anchorA_), b_, toSimbody(anchorB_));
    for (const Vec3& normal : {Vec3{1, 0, 0}, Vec3{0, 1, 0}})
        add<Constraint::PointInPlane>(a_, UnitVec3(toSimbody(normal)), dot(normal, anchorA_), b_,
                                      toSimbody(anchorB_));
}

void LoopJoint::keepTurn(const Quat& turn, bool planar) {
    if (!planar) return add<Constraint::ConstantOrientation>(a_, toSimbody(turn), b_, SimTK::Rotation());
    add<Constraint::ConstantAngle>(a_, UnitVec3(1, 0, 0), b_,
                                   UnitVec3(toSimbody(rotateInverse(turn, Vec3{0, 1, 0}))));
}

/// The axis of B is normal to two directions across that of A.
void LoopJoint::keepAxis(const Vec3& axisA, const Vec3& axisB) {
    const auto [one, two] = across(axisA);
    for (const Vec3& side : {one, two})
        add<Constraint::ConstantAngle>(a_, UnitVec3(toSimbody(side)), b_, UnitVec3(toSimbody(axisB)));
}

void LoopJoint::keepOnLine(const Vec3& axisA, bool planar) {
    if (!planar)
        return add<Constraint::PointOnLine>(a_, UnitVec3(toSimbody(axisA)), toSimbody(anchorA_), b_,
                                            toSimbody(anchorB_));
    const Vec3 normal{-axisA.y, axisA.x, 0.0};
    add<Constraint::PointInPlane>(a_, UnitVec3(toSimbody(normal)), dot(normal, anchorA_), b_,
                                  toSimbody(anchorB_));
}

bool LoopJoint::isIdle(const Constraint& part, const SimTK::State& state) {
    constexpr double kSmallest = 1e-9;
    const SimTK::Matrix rows = part.calcPositionConstraintMatrixP(state);
    const SimTK::Vector errors = part.getPositionErrorsAsVector(state);
    for (int i = 0; i < rows.nrow(); ++i) {
        if (std::abs(errors[i]) > kSmallest) return false;
        for (int j = 0; j < rows.ncol(); ++j)
            if (std::abs(rows(i, j)) > kSmallest) return false;
    }
    return true;
}

/// Looked at where the bodies are and at two places near by, to which all coordinates go at once.
void LoopJoint::dropIdle(const SimTK::MultibodySystem& system, SimTK::State& state) {
    std::vector<bool> idle(parts_.size(), true);
    for (const double way : {0.0, 0.1, -0.23}) {
        SimTK::State near = state;
        for (int i = 0; i < near.getNU(); ++i) near.updU()[i] = way * std::cos(1.7 * i + 0.4);
        system.realize(near, SimTK::Stage::Velocity);
        const SimTK::Vector rates = near.getQDot();
        near.updQ() += rates;
        system.realize(near, SimTK::Stage::Velocity);
        for (std::size_t k = 0; k < parts_.size(); ++k) idle[k] = idle[k] && isIdle(parts_[k], near);
    }
    std::vector<Constraint> kept;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        if (idle[k])
            parts_[k].disable(state);
        else
            kept.push_back(parts_[k]);
    }
    parts_ = std::move(kept);
}

bool LoopJoint::holds(const SimTK::State& state) const {
    return std::none_of(parts_.begin(), parts_.end(),
                        [&](const Constraint& part) { return part.isDisabled(state); });
}

void LoopJoint::setHolds(SimTK::State& state, bool holds) const {
    for (const Constraint& part : parts_) holds ? part.enable(state) : part.disable(state);
}

/// Force, and torque about B's anchor, of all constraints together on B. B is the second body of each of them.
bool LoopJoint::isOverloaded(const SimTK::State& state) const {
    if (breakForce_ > 1e299 && breakTorque_ > 1e299) return false;
    const SimTK::Vec3 arm =
        b_.findStationLocationInGround(state, toSimbody(anchorB_)) - b_.getBodyOriginLocation(state);
    SimTK::Vec3 force(0), torque(0);
    for (const Constraint& part : parts_) {
        const SimTK::SpatialVec on =
            part.getConstrainedBodyForcesAsVector(state)[SimTK::ConstrainedBodyIndex(1)];
        force += on[1];
        torque += on[0] - arm % on[1];
    }
    return force.norm() > breakForce_ || torque.norm() > breakTorque_;
}

}  // namespace rigor::simbody
