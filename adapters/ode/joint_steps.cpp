// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Stops, motors and springs of joints, and what has to be done for them in every step.
//
// An AMotor in user mode acts about one axis g in the world and takes its angle from us. A coordinate u whose
// rate is s (g . w), g a unit vector, is the angle u / s to it, its motor's speed and torque are v / s and s
// T, and a spring's CFM is that of u over s^2.
//
// Along a line ODE has rows of its own at centres of mass (LMotor) and on rails (Slider, Piston), at any other
// point those of a contact joint: its normal's pushes one way alone, its friction's both ways, towards a
// surface speed (motion1), within a force (mu), with a softness (slip1). So a stop is a contact without
// friction whose depth is the overrun, and what holds, drives or springs is the friction of a contact whose
// normal is made powerless by its CFM; a row that holds or springs has unlimited force, the speed ERP / h of
// the error and the spring's CFM, which is the row of ODE's own soft stops.
#include <algorithm>
#include <cmath>

#include "adapters/ode/convert.hpp"
#include "adapters/ode/joints.hpp"

namespace rigor::ode {

using scenario::AxisMode;
using scenario::JointAxis;

namespace {

double odeBound(double x) {
    if (std::abs(x) < 1e299) return x;
    return x < 0.0 ? -dInfinity : dInfinity;
}

double unwrapped(double angle, double seen) {
    constexpr double turn = 6.283185307179586;
    return angle + turn * std::round((seen - angle) / turn);
}

}  // namespace

/// ODE ignores an upper stop below the lower one of the moment, hence the order.
void OdeJoint::setStops(const JointAxis& axis, dJointID id, SetParam set) {
    set(id, dParamLoStop, odeBound(axis.lower));
    set(id, dParamHiStop, odeBound(axis.upper));
    set(id, dParamLoStop, odeBound(axis.lower));
}

void OdeJoint::setMotor(const JointAxis& axis, dJointID id, SetParam set) {
    set(id, dParamVel, axis.motorSpeed);
    set(id, dParamFMax, axis.motorMaxForce);
}

/// A spring is two stops in one place that give way.
void OdeJoint::setSpring(const JointAxis& axis, dJointID id, SetParam set) {
    set(id, dParamLoStop, axis.target);
    set(id, dParamHiStop, axis.target);
    set(id, dParamLoStop, axis.target);
    softenSpring(axis, id, set, dParamStopERP, dParamStopCFM);
}

void OdeJoint::softenSpring(const JointAxis& axis, dJointID id, SetParam set, int erp, int cfm) {
    const SpringTerms terms = springTerms(axis, dt_);
    set(id, erp, terms.erp);
    set(id, cfm, terms.cfm);
}

/// Adds an angle of the joint: locked, or with stops and a motor in one AMotor, a spring in another.
void OdeJoint::addTurn(const JointAxis& axis, Angle kind) {
    if (axis.mode != AxisMode::Free || axis.hasMotor()) addAngleMotor(axis, kind, false);
    if (axis.hasSpring()) addAngleMotor(axis, kind, true);
}

void OdeJoint::addAngleMotor(const JointAxis& axis, Angle kind, bool spring) {
    const dJointID id = dJointCreateAMotor(world_, nullptr);
    dJointAttach(id, standIn(b_, motion_.anchorB()), a_.body);
    dJointSetAMotorMode(id, dAMotorUser);
    dJointSetAMotorNumAxes(id, 1);
    add(id, b_.body != nullptr);
    angleMotors_.push_back({id, kind, axis, spring, 0.0});
    update(angleMotors_.back());
}

void OdeJoint::addPointRow(const JointAxis& axis, int along, PointRow does) {
    add(nullptr);
    pointRows_.push_back({&parts_.back(), along, axis, does});
}

void OdeJoint::update(AngleMotor& motor) {
    const Coordinate now = motion_.angle(motor.kind);
    const bool counts = motor.kind == Angle::Turn || motor.kind == Angle::Twist;
    motor.seen = counts ? unwrapped(now.value, motor.seen) : now.value;
    const double s = norm(now.rate.angB);
    const Vec3 g = now.rate.angB / s;
    dJointSetAMotorAxis(motor.id, 0, 0, g.x, g.y, g.z);
    dJointSetAMotorAngle(motor.id, 0, motor.seen / s);
    JointAxis axis = motor.axis;
    if (motor.spring) {
        const SpringTerms terms = springTerms(axis, dt_);
        dJointSetAMotorParam(motor.id, dParamStopERP, terms.erp);
        dJointSetAMotorParam(motor.id, dParamStopCFM, terms.cfm / (s * s));
        axis.lower = axis.upper = axis.target;
    } else if (axis.mode == AxisMode::Locked) {
        axis.lower = axis.upper = 0.0;
    } else if (axis.hasMotor()) {
        axis.motorSpeed /= s;
        axis.motorMaxForce *= s;
        setMotor(axis, motor.id, dJointSetAMotorParam);
    }
    if (!motor.spring && axis.mode == AxisMode::Free) return;
    axis.lower = odeBound(axis.lower) / s;
    axis.upper = odeBound(axis.upper) / s;
    setStops(axis, motor.id, dJointSetAMotorParam);
}

/// A stop acts in each step that starts at its bound or beyond, as ODE's own do; false where it does not.
bool OdeJoint::stopAt(const Coordinate& now, const JointAxis& axis, dContact& contact) const {
    const bool above = now.value >= axis.upper;
    if (!above && now.value > axis.lower) return false;
    toOde((above ? -1.0 : 1.0) * now.rate.lin, contact.geom.normal);
    contact.geom.depth = above ? now.value - axis.upper : axis.lower - now.value;
    return true;
}

void OdeJoint::driveAt(const Coordinate& now, const PointJoint& row, dContact& contact) const {
    const Vec3& along = now.rate.lin;
    const Vec3 other = std::abs(along.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, normal = cross(along, other);
    toOde(normal / norm(normal), contact.geom.normal);
    toOde(along, contact.fdir1);
    SpringTerms terms{dWorldGetERP(world_), dWorldGetCFM(world_)};
    double target = 0.0;
    if (row.does == PointRow::Springs) {
        terms = springTerms(row.axis, dt_);
        target = row.axis.target;
    }
    const bool drives = row.does == PointRow::Drives;
    const double speed = drives ? row.axis.motorSpeed : terms.erp / dt_ * (target - now.value);
    dSurfaceParameters& surface = contact.surface;
    surface.mode = dContactSoftCFM | dContactFDir1 | dContactMu2 | dContactMotion1 | dContactSlip1;
    surface.soft_cfm = 1e30;
    surface.mu = drives ? odeBound(row.axis.motorMaxForce) : dInfinity;
    // motion of the joint's first body that is not null
    surface.motion1 = b_.body != nullptr ? speed : -speed;
    surface.slip1 = drives ? dWorldGetCFM(world_) : terms.cfm;
}

void OdeJoint::update(const PointJoint& row) {
    if (row.part->id != nullptr) dJointDestroy(row.part->id);
    *row.part = {};
    const Coordinate now = row.along == kAlongLine ? motion_.length() : motion_.travel(row.along);
    dContact contact{};
    toOde(motion_.anchorB(), contact.geom.pos);
    if (row.does == PointRow::Stops) {
        if (!stopAt(now, row.axis, contact)) return;
    } else {
        driveAt(now, row, contact);
    }
    row.part->id = dJointCreateContact(world_, nullptr, &contact);
    dJointAttach(row.part->id, b_.body, a_.body);
    if (breaks_) dJointSetFeedback(row.part->id, &row.part->feedback);
}

void OdeJoint::beforeStep() {
    const bool passive = angleMotors_.empty() && pointRows_.empty();
    if (!holds_ || (passive && !breaks_)) return;
    motion_.update();
    for (AngleMotor& motor : angleMotors_) update(motor);
    for (const PointJoint& row : pointRows_) update(row);
}

/// The wrench on B about its anchor, of all parts; where B does not move, minus that on A. The levers are
/// those of the poses at which the step's rows were made (`motion_` has not been updated since).
bool OdeJoint::breakIfOverloaded() {
    if (!breaks_ || !holds_) return false;
    Vec3 force, torque;
    for (const Part& part : parts_) {
        const Vec3 f = fromOde(part.firstForce ? part.feedback.f1 : part.feedback.f2);
        const Vec3 center = b_.body != nullptr ? motion_.centerB() : motion_.centerA();
        force += f;
        torque += fromOde(part.firstForce ? part.feedback.t1 : part.feedback.t2);
        torque += cross(center - motion_.anchorB(), f);
    }
    if (!(norm(force) > joint_.breakForce || norm(torque) > joint_.breakTorque)) return false;
    holds_ = false;
    for (const Part& part : parts_)
        if (part.id != nullptr) dJointAttach(part.id, nullptr, nullptr);
    return true;
}

/// A kinematic body at rest for an end that has no body, for joints of ODE that need two.
dBodyID OdeJoint::standIn(const JointEnd& end, const Vec3& at) {
    if (end.body != nullptr) return end.body;
    const dBodyID body = dBodyCreate(world_);
    dBodySetKinematic(body);
    dBodySetPosition(body, at.x, at.y, at.z);
    return body;
}

std::vector<double> OdeJoint::memory() const {
    std::vector<double> all{holds_ ? 1.0 : 0.0};
    for (const AngleMotor& motor : angleMotors_) all.push_back(motor.seen);
    return all;
}

void OdeJoint::setMemory(const std::vector<double>& memory) {
    for (std::size_t i = 0; i < angleMotors_.size(); ++i) angleMotors_[i].seen = memory[i + 1];
}

}  // namespace rigor::ode
