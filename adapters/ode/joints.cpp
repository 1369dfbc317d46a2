// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints of the format out of ODE's. ODE measures angles and travels of the first body against the second, so
// B is attached first: an angle then grows when B turns about the axis. The work of each step (user-mode
// motors, breaking) is in joint_steps.cpp.
#include "adapters/ode/joints.hpp"

#include <algorithm>
#include <cmath>

#include "adapters/ode/convert.hpp"

namespace rigor::ode {

using scenario::AxisMode;
using scenario::JointAxis;
using scenario::JointType;

namespace {

bool onlyHeld(const JointAxis& axis) {
    return axis.mode == AxisMode::Locked;
}
/// Hinges measure angles from -pi to pi.
bool beyondHalfTurn(double x) {
    return std::abs(x) < 1e299 && std::abs(x) > 3.141592;
}

/// The joint with definite modes.
scenario::Joint resolved(scenario::Joint joint) {
    for (JointAxis& axis : joint.axes) {
        if (axis.mode != AxisMode::Usual) continue;
        const bool locked = joint.type == JointType::SixDof ||
                            (joint.type == JointType::Distance && !axis.hasSpring() && !axis.hasMotor());
        axis.mode = locked ? AxisMode::Locked : AxisMode::Free;
    }
    return joint;
}

}  // namespace

OdeJoint::OdeJoint(dWorldID world, const scenario::Joint& joint, const JointEnd& a, const JointEnd& b,
                   double dt, bool planar)
    : world_(world),
      joint_(resolved(joint)),
      a_(a),
      b_(b),
      dt_(dt),
      planar_(planar),
      motion_(joint_, a, b),
      breaks_(joint.breakForce < 1e299 || joint.breakTorque < 1e299) {
    if (a.body == nullptr && b.body == nullptr) return;
    build();
    if (!breaks_) return;
    for (Part& part : parts_)
        if (part.id != nullptr) dJointSetFeedback(part.id, &part.feedback);
}

void OdeJoint::build() {
    switch (joint_.type) {
        case JointType::Ball:
            addBall();
            addTurn(joint_.axes[0], Angle::Cone);
            break;
        case JointType::Hinge:
            buildHinge();
            break;
        case JointType::Slider:
            buildSlider();
            break;
        case JointType::Fixed:
            addFixed();
            break;
        case JointType::Distance:
            buildDistance();
            break;
        case JointType::ConeTwist:
            addBall();
            addTurn(joint_.axes[0], Angle::Twist);
            addTurn(joint_.axes[1], Angle::Cone);
            break;
        case JointType::SixDof:
            buildSixDof();
            break;
        case JointType::Wheel:
            buildWheel();
            break;
    }
}

void OdeJoint::add(dJointID id, bool firstForce) {
    parts_.push_back({id, firstForce, {}});
}

void OdeJoint::addBall() {
    const dJointID id = dJointCreateBall(world_, nullptr);
    dJointAttach(id, b_.body, a_.body);
    const Vec3 p = motion_.anchorA();
    dJointSetBallAnchor(id, p.x, p.y, p.z);
    add(id);
}

void OdeJoint::addFixed() {
    const dJointID id = dJointCreateFixed(world_, nullptr);
    dJointAttach(id, b_.body, a_.body);
    dJointSetFixed(id);
    add(id);
}

void OdeJoint::buildHinge() {
    const JointAxis& axis = joint_.axes[0];
    const dJointID id = dJointCreateHinge(world_, nullptr);
    dJointAttach(id, b_.body, a_.body);
    const Vec3 p = motion_.anchorA(), along = motion_.axis(0);
    dJointSetHingeAnchor(id, p.x, p.y, p.z);
    dJointSetHingeAxis(id, along.x, along.y, along.z);
    add(id);
    const bool limited = axis.mode == AxisMode::Limited;
    const bool far = (limited && (beyondHalfTurn(axis.lower) || beyondHalfTurn(axis.upper))) ||
                     (axis.hasSpring() && beyondHalfTurn(axis.target));
    if (far || (axis.hasSpring() && (limited || axis.hasMotor()))) {
        addTurn(axis, Angle::Turn);
        return;
    }
    if (limited) setStops(axis, id, dJointSetHingeParam);
    if (axis.hasMotor()) setMotor(axis, id, dJointSetHingeParam);
    if (axis.hasSpring()) setSpring(axis, id, dJointSetHingeParam);
}

void OdeJoint::buildSlider() {
    const JointAxis& axis = joint_.axes[0];
    const dJointID id = dJointCreateSlider(world_, nullptr);
    dJointAttach(id, b_.body, a_.body);
    const Vec3 along = motion_.axis(0);
    dJointSetSliderAxis(id, along.x, along.y, along.z);
    add(id);
    if (axis.mode == AxisMode::Limited) setStops(axis, id, dJointSetSliderParam);
    if (axis.hasMotor()) setMotor(axis, id, dJointSetSliderParam);
    if (!axis.hasSpring()) return;
    if (axis.mode == AxisMode::Limited || axis.hasMotor()) {
        // A slider's one set of stops is taken, or its motor would be idle between them.
        addPointRow(axis, 0, PointRow::Springs);
    } else {
        setSpring(axis, id, dJointSetSliderParam);
    }
}

void OdeJoint::buildDistance() {
    const JointAxis& axis = joint_.axes[0];
    if (axis.mode == AxisMode::Limited) addPointRow(axis, kAlongLine, PointRow::Stops);
    if (axis.hasMotor()) addPointRow(axis, kAlongLine, PointRow::Drives);
    if (axis.mode != AxisMode::Locked && !axis.hasSpring()) return;
    const dJointID id = dJointCreateDBall(world_, nullptr);
    dJointAttach(id, b_.body, a_.body);
    const Vec3 p = motion_.anchorA(), q = motion_.anchorB();
    dJointSetDBallAnchor1(id, q.x, q.y, q.z);
    dJointSetDBallAnchor2(id, p.x, p.y, p.z);
    dJointSetDBallDistance(id, axis.hasSpring() ? axis.target : joint_.length);
    add(id);
    if (axis.hasSpring()) softenSpring(axis, id, dJointSetDBallParam, dParamERP, dParamCFM);
}

/// Hinge2 with its steering locked. Its suspension pulls to the place of the anchors when they were set, so
/// they are set with B moved by the spring's target. It needs two bodies: the world is a kinematic one at the
/// anchor. Its locked steering holds turns about the strut: of a pin that leans it would hold a part (0.09 m
/// off after 1 s, at every step), so such a wheel is made of rows.
void OdeJoint::buildWheel() {
    const JointAxis &travel = joint_.axes[0], &angle = joint_.axes[1];
    const Vec3 along = motion_.axis(0), pin = motion_.turningAxis();
    if (std::abs(dot(along, pin)) > 1e-6) return buildLeaningWheel();
    const dBodyID a = standIn(a_, motion_.anchorA()), b = standIn(b_, motion_.anchorB());
    const dJointID id = dJointCreateHinge2(world_, nullptr);
    dJointAttach(id, a, b);
    const dReal* at = dBodyGetPosition(b);
    const Vec3 start = fromOde(at), shift = (travel.hasSpring() ? travel.target : 0.0) * along;
    const Vec3 moved = start + shift, anchor = motion_.anchorB() + shift;
    dBodySetPosition(b, moved.x, moved.y, moved.z);
    dJointSetHinge2Anchor(id, anchor.x, anchor.y, anchor.z);
    dVector3 axis1, axis2;
    toOde(along, axis1);
    toOde(-pin, axis2);
    dJointSetHinge2Axes(id, axis1, axis2);
    dBodySetPosition(b, start.x, start.y, start.z);
    dJointSetHinge2Param(id, dParamLoStop, 0.0);
    dJointSetHinge2Param(id, dParamHiStop, 0.0);
    add(id, b_.body == nullptr);
    if (travel.hasSpring()) {
        softenSpring(travel, id, dJointSetHinge2Param, dParamSuspensionERP, dParamSuspensionCFM);
    } else {
        dJointSetHinge2Param(id, dParamSuspensionERP, 0.0);
        dJointSetHinge2Param(id, dParamSuspensionCFM, 1e30);
    }
    if (travel.mode == AxisMode::Limited) addPointRow(travel, 0, PointRow::Stops);
    if (travel.hasMotor()) addPointRow(travel, 0, PointRow::Drives);
    if (angle.hasMotor() && angle.mode == AxisMode::Free) {
        dJointSetHinge2Param(id, dParamVel2, angle.motorSpeed);
        dJointSetHinge2Param(id, dParamFMax2, angle.motorMaxForce);
        if (angle.hasSpring()) addAngleMotor(angle, Angle::Turn, true);
    } else {
        addTurn(angle, Angle::Turn);
    }
}

/// A wheel whose pin is not normal to its strut: rows at B's anchor along the strut and across it, and the
/// swings of the pin held.
void OdeJoint::buildLeaningWheel() {
    const JointAxis &travel = joint_.axes[0], &angle = joint_.axes[1];
    JointAxis held;
    held.mode = AxisMode::Locked;
    for (const int across : {1, 2}) addPointRow(held, across, PointRow::Holds);
    if (travel.mode == AxisMode::Limited) addPointRow(travel, 0, PointRow::Stops);
    if (travel.hasMotor()) addPointRow(travel, 0, PointRow::Drives);
    if (travel.hasSpring()) addPointRow(travel, 0, PointRow::Springs);
    for (const Angle swing : {Angle::SwingY, Angle::SwingZ}) addTurn(held, swing);
    addTurn(angle, Angle::Turn);
}

/// The travels by the joint of ODE that leaves just these free; true where it holds the turns as well.
bool OdeJoint::buildSixDofTravels() {
    const auto free = [&](std::size_t k) { return !onlyHeld(joint_.axes[k]); };
    const int travels = free(0) + free(1) + free(2), turns = free(3) + free(4) + free(5);
    if (travels == 0 && turns == 0) {
        addFixed();
        return true;
    }
    if (travels == 0) {
        addBall();
        return false;
    }
    const std::size_t k = free(0) ? 0 : free(1) ? 1 : 2;
    const JointAxis& axis = joint_.axes[k];
    const bool plainAxis = !axis.hasSpring() || (axis.mode == AxisMode::Free && !axis.hasMotor());
    if (travels == 1 && plainAxis && (turns == 0 || (turns == 1 && free(3 + k)))) {
        const bool slider = turns == 0;
        const dJointID id =
            slider ? dJointCreateSlider(world_, nullptr) : dJointCreatePiston(world_, nullptr);
        dJointAttach(id, b_.body, a_.body);
        const Vec3 along = motion_.axis(k), p = motion_.anchorA();
        if (slider) {
            dJointSetSliderAxis(id, along.x, along.y, along.z);
        } else {
            dJointSetPistonAnchor(id, p.x, p.y, p.z);
            dJointSetPistonAxis(id, along.x, along.y, along.z);
        }
        add(id);
        const SetParam set = slider ? dJointSetSliderParam : dJointSetPistonParam;
        if (axis.mode == AxisMode::Limited) setStops(axis, id, set);
        if (axis.hasMotor()) setMotor(axis, id, set);
        if (axis.hasSpring()) setSpring(axis, id, set);
        if (!slider)
            addTurn(joint_.axes[3 + k], k == 0 ? Angle::Twist : k == 1 ? Angle::SwingY : Angle::SwingZ);
        return true;
    }
    for (int i = 0; i < (planar_ ? 2 : 3); ++i) {
        const JointAxis& travel = joint_.axes[i];
        if (onlyHeld(travel)) addPointRow(travel, i, PointRow::Holds);
        if (travel.mode == AxisMode::Limited) addPointRow(travel, i, PointRow::Stops);
        if (travel.hasMotor()) addPointRow(travel, i, PointRow::Drives);
        if (travel.hasSpring()) addPointRow(travel, i, PointRow::Springs);
    }
    return false;
}

void OdeJoint::buildSixDof() {
    if (buildSixDofTravels()) return;
    if (planar_) {
        addTurn(joint_.axes[5], Angle::Turn);
        return;
    }
    constexpr Angle kinds[] = {Angle::Twist, Angle::SwingY, Angle::SwingZ};
    for (std::size_t k = 3; k < 6; ++k) addTurn(joint_.axes[k], kinds[k - 3]);
}

}  // namespace rigor::ode
