// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Stops, motors and springs of joints, and what has to be done for them in every step.
//
// An AMotor in user mode acts about one axis g in the world and takes its angle from us. A coordinate u whose
// rate is s (g . w), g a unit vector, is the angle u / s to it, its motor's speed and torque are v / s and s
// T, and a spring's CFM is that of u over s^2. An LMotor has no stops: a row that holds or springs is a motor
// of unlimited force whose speed is ERP / h of the error and whose CFM is the spring's, which is the same
// row.
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
void OdeJoint::setSpring(const JointAxis& axis, dJointID id, SetParam set, Current coordinate) {
    set(id, dParamLoStop, axis.target);
    set(id, dParamHiStop, axis.target);
    set(id, dParamLoStop, axis.target);
    softenSpring(axis, id, set, dParamStopERP, dParamStopCFM, std::move(coordinate));
}

/// What a spring by frequency swings depends on the pose where both ends move, or where a rod is turned to.
void OdeJoint::softenSpring(const JointAxis& axis, dJointID id, SetParam set, int erp, int cfm,
                            Current coordinate) {
    const SpringTerms terms = springTerms(axis, motion_.movedMass(coordinate(motion_).rate), dt_);
    set(id, erp, terms.erp);
    set(id, cfm, terms.cfm);
    const bool bothMove = a_.hasMass() && b_.hasMass();
    if (axis.frequency > 0.0 && (bothMove || joint_.type == scenario::JointType::Distance))
        springs_.push_back({id, set, erp, cfm, axis, std::move(coordinate)});
}

/// What is asked of an angle: held, or stops and a motor in one AMotor, a spring in another.
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

void OdeJoint::addTravelMotor(const JointAxis& axis, int along) {
    const dJointID id = dJointCreateLMotor(world_, nullptr);
    dJointAttach(id, b_.body, a_.body);
    dJointSetLMotorNumAxes(id, 1);
    add(id);
    travelMotors_.push_back({id, along, axis});
    update(travelMotors_.back());
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
        const SpringTerms terms = springTerms(axis, motion_.movedMass(now.rate), dt_);
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

void OdeJoint::update(const TravelMotor& motor) {
    const Coordinate now = motion_.travel(motor.along);
    const Vec3 g = motion_.axis(motor.along);
    dJointSetLMotorAxis(motor.id, 0, 0, g.x, g.y, g.z);
    if (motor.axis.hasMotor()) {
        setMotor(motor.axis, motor.id, dJointSetLMotorParam);
        return;
    }
    SpringTerms terms{dWorldGetERP(world_), dWorldGetCFM(world_)};
    double target = 0.0;
    if (motor.axis.hasSpring()) {
        terms = springTerms(motor.axis, motion_.movedMass(now.rate), dt_);
        target = motor.axis.target;
    }
    dJointSetLMotorParam(motor.id, dParamVel, terms.erp / dt_ * (target - now.value));
    dJointSetLMotorParam(motor.id, dParamFMax, dInfinity);
    dJointSetLMotorParam(motor.id, dParamCFM, terms.cfm);
}

/// DBall has no stops. At its bound a distance is what a frictionless contact is, a row that pushes in one
/// sense alone and acts along the line of the anchors, so it is a contact joint with that line as normal and
/// the overrun as depth, made anew in each step that starts at the bound or beyond, as ODE's own stops act.
void OdeJoint::updateLengthStop() {
    if (lengthStop_->id != nullptr) dJointDestroy(lengthStop_->id);
    *lengthStop_ = {};
    const JointAxis& axis = joint_.axes[0];
    const Coordinate length = motion_.length();
    const bool taut = length.value >= axis.upper;
    if (!taut && length.value > axis.lower) return;
    dContact contact{};
    toOde(motion_.anchorB(), contact.geom.pos);
    toOde((taut ? -1.0 : 1.0) * length.rate.lin, contact.geom.normal);
    contact.geom.depth = taut ? length.value - axis.upper : axis.lower - length.value;
    lengthStop_->id = dJointCreateContact(world_, nullptr, &contact);
    dJointAttach(lengthStop_->id, b_.body, a_.body);
    if (breaks_) dJointSetFeedback(lengthStop_->id, &lengthStop_->feedback);
}

void OdeJoint::beforeStep() {
    const bool passive = angleMotors_.empty() && travelMotors_.empty() && springs_.empty();
    if (!holds_ || (passive && lengthStop_ == nullptr && !breaks_)) return;
    motion_.update();
    if (lengthStop_ != nullptr) updateLengthStop();
    for (AngleMotor& motor : angleMotors_) update(motor);
    for (const TravelMotor& motor : travelMotors_) update(motor);
    for (const PosedSpring& spring : springs_) {
        const SpringTerms terms =
            springTerms(spring.axis, motion_.movedMass(spring.coordinate(motion_).rate), dt_);
        spring.set(spring.id, spring.erp, terms.erp);
        spring.set(spring.id, spring.cfm, terms.cfm);
    }
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
