// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/simbody/loops.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rigor::simbody {

using scenario::AxisMode;
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

/// Directions of the scenario in the frames of Simbody's bodies.
Vec3 axisOfA(const Sides& sides) {
    return rotate(sides.a.pose.orientation, sides.joint.axisA);
}
Vec3 axisOfB(const Sides& sides) {
    return rotate(sides.b.pose.orientation, sides.joint.axisB);
}
std::array<Vec3, 3> axesOfA(const Sides& sides) {
    const Vec3 x = axisOfA(sides), y = rotate(sides.a.pose.orientation, sides.joint.normalA);
    return {x, y, cross(x, y)};
}
/// Turns from the frame of Simbody's body B to that of A at the initial poses.
Quat turnOfB(const Sides& sides) {
    return sides.a.pose.orientation * sides.relative * conjugate(sides.b.pose.orientation);
}
/// A direction of A as B has it at the initial poses.
Vec3 inB(const Sides& sides, const Vec3& ofA) {
    return rotateInverse(turnOfB(sides), ofA);
}

}  // namespace

template <class Kind, class... Arguments>
void LoopJoint::add(Arguments&&... arguments) {
    parts_.push_back(Kind(std::forward<Arguments>(arguments)...));
}

LoopJoint::LoopJoint(const Sides& sides, int index, SimTK::SimbodyMatterSubsystem& matter)
    : joint_(index),
      breakForce_(sides.joint.breakForce),
      breakTorque_(sides.joint.breakTorque),
      a_(sides.a.body),
      b_(sides.b.body),
      anchorA_(sides.a.pose * sides.joint.anchorA),
      anchorB_(sides.b.pose * sides.joint.anchorB) {
    const Joint& joint = sides.joint;
    const bool isLocked = joint.axes[0].mode == AxisMode::Locked;
    switch (joint.type) {
        case JointType::Distance:
            if (!isOpen(joint.axes[0]))
                add<Constraint::Rod>(a_, toSimbody(anchorA_), b_, toSimbody(anchorB_), joint.length);
            break;
        case JointType::Slider:
            isLocked ? keepPoints(sides.planar) : keepOnLine(axisOfA(sides), sides.planar);
            keepTurn(sides);
            break;
        case JointType::Fixed:
            keepPoints(sides.planar);
            keepTurn(sides);
            break;
        case JointType::Hinge:
            keepPoints(sides.planar);
            if (isLocked)
                keepTurn(sides);
            else if (!sides.planar)
                keepAxis(axisOfA(sides), axisOfB(sides));
            break;
        case JointType::Ball:
            keepPoints(sides.planar);
            if (isLocked) keepAxis(axisOfA(sides), axisOfB(sides));
            break;
        case JointType::ConeTwist:
            keepCone(sides, matter);
            break;
        case JointType::Wheel:
            keepWheel(sides);
            break;
        case JointType::SixDof:
            keepSixDof(sides, matter);
            break;
    }
}

void LoopJoint::keepCone(const Sides& sides, SimTK::SimbodyMatterSubsystem& matter) {
    keepPoints(sides.planar);
    const auto& axes = sides.joint.axes;
    if (axes[1].mode != AxisMode::Locked) {
        for (const Constraint& part : keepAngles(sides, matter)) parts_.push_back(part);
    } else if (axes[0].mode == AxisMode::Locked) {
        keepTurn(sides);
    } else {
        keepAxis(axisOfA(sides), axisOfB(sides));
    }
}

void LoopJoint::keepWheel(const Sides& sides) {
    const auto& axes = sides.joint.axes;
    axes[0].mode == AxisMode::Locked ? keepPoints(sides.planar) : keepOnLine(axisOfA(sides), sides.planar);
    const Vec3& spin = sides.joint.spinAxisB;
    if (axes[1].mode == AxisMode::Locked)
        keepTurn(sides);
    else if (!sides.planar)
        keepAxis(rotate(sides.a.pose.orientation, rotate(sides.relative, spin)),
                 rotate(sides.b.pose.orientation, spin));
}

void LoopJoint::keepSixDof(const Sides& sides, SimTK::SimbodyMatterSubsystem& matter) {
    const auto& use = sides.joint.axes;
    const std::array<Vec3, 3> axes = axesOfA(sides);
    const std::size_t travels = sides.planar ? 2 : 3;
    if (std::none_of(use.begin(), use.begin() + travels, isOpen)) {
        keepPoints(sides.planar);
    } else {
        for (std::size_t k = 0; k < travels; ++k)
            if (!isOpen(use[k])) keepInPlane(axes[k]);
    }
    const int open = openAngles(sides.joint);
    if (open == 0) keepTurn(sides);
    if (open > 1)
        for (const Constraint& part : keepAngles(sides, matter)) parts_.push_back(part);
    if (open != 1 || sides.planar) return;
    for (std::size_t k = 0; k < 3; ++k)
        if (isOpen(use[3 + k])) keepAxis(axes[k], inB(sides, axes[k]));
}

/// In a plane the third equation of a point would be none.
void LoopJoint::keepPoints(bool planar) {
    if (!planar) return add<Constraint::Ball>(a_, toSimbody(anchorA_), b_, toSimbody(anchorB_));
    for (const Vec3& normal : {Vec3{1, 0, 0}, Vec3{0, 1, 0}}) keepInPlane(normal);
}

/// B's anchor stays where A's is, along a direction of A.
void LoopJoint::keepInPlane(const Vec3& normal) {
    add<Constraint::PointInPlane>(a_, UnitVec3(toSimbody(normal)), dot(normal, anchorA_), b_,
                                  toSimbody(anchorB_));
}

void LoopJoint::keepTurn(const Sides& sides) {
    const Quat turn = turnOfB(sides);
    if (!sides.planar)
        return add<Constraint::ConstantOrientation>(a_, toSimbody(turn), b_, SimTK::Rotation());
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
    keepInPlane({-axisA.y, axisA.x, 0.0});
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
                        [&](const Constraint& part) { return part.isDisabled(state); }) &&
           std::none_of(acting_.begin(), acting_.end(),
                        [&](const Acting& on) { return on.handle.isDisabled(state); });
}

void LoopJoint::setHolds(SimTK::State& state, bool holds) const {
    for (const Constraint& part : parts_) holds ? part.enable(state) : part.disable(state);
    for (const Acting& on : acting_) {
        holds ? on.handle.enable(state) : on.handle.disable(state);
        if (!holds && on.hold && !on.hold->isDisabled(state)) on.hold->disable(state);
    }
}

/// Force, and torque about B's anchor, of all constraints, springs and motors together on B. B is the second body of each
/// constraint.
bool LoopJoint::isOverloaded(const SimTK::State& state) const {
    if (breakForce_ > 1e299 && breakTorque_ > 1e299) return false;
    const SimTK::Vec3 arm =
        b_.findStationLocationInGround(state, toSimbody(anchorB_)) - b_.getBodyOriginLocation(state);
    SimTK::SpatialVec on(SimTK::Vec3(0), SimTK::Vec3(0));
    const auto addConstraint = [&](const Constraint& part) {
        on += part.getConstrainedBodyForcesAsVector(state)[SimTK::ConstrainedBodyIndex(1)];
    };
    for (const Constraint& part : parts_) addConstraint(part);
    for (const Acting& acting : acting_) {
        on += acting.force->onB(state);
        if (acting.hold && !acting.hold->isDisabled(state)) addConstraint(*acting.hold);
    }
    return on[1].norm() > breakForce_ || (on[0] - arm % on[1]).norm() > breakTorque_;
}

/// The swing along y is zero where B's axis is normal to z, and along z where it is normal to y.
std::vector<Constraint> keepAngles(const Sides& sides, SimTK::SimbodyMatterSubsystem& matter) {
    const bool isSixDof = sides.joint.type == JointType::SixDof;
    const auto& use = sides.joint.axes;
    std::vector<Constraint> kept;
    if (isSixDof ? !isOpen(use[3]) : use[0].mode == AxisMode::Locked)
        kept.push_back(keepZero(matter, PairCoordinate(PairKind::Turn, sides, sides.joint.axisA)));
    if (!isSixDof) return kept;
    const std::array<Vec3, 3> axes = axesOfA(sides);
    SimTK::MobilizedBody a = sides.a.body, b = sides.b.body;
    for (const std::size_t k : {1, 2})
        if (!isOpen(use[3 + k]))
            kept.push_back(Constraint::ConstantAngle(a, UnitVec3(toSimbody(axes[3 - k])), b,
                                                     UnitVec3(toSimbody(inB(sides, axes[0])))));
    return kept;
}

}  // namespace rigor::simbody
