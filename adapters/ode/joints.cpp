// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints. ODE measures angles and travels of the first body against the second, so B is attached first:
// an angle then grows when B turns about the axis. Anchors and axes are given in the world at build time.
#include "adapters/ode/joints.hpp"

#include <cmath>

#include "adapters/ode/convert.hpp"

namespace rigor::ode {

using scenario::JointType;

namespace {

/// Limits and motor of a hinge or slider; `set` is its parameter function. ODE ignores an upper stop below
/// the lower one of the moment, hence the order, and hinge stops beyond half a turn.
void setAxis(const scenario::Joint& joint, dJointID id, void (*set)(dJointID, int, dReal)) {
    const scenario::JointAxis& axis = joint.axes[0];
    if (axis.mode == scenario::AxisMode::Limited) {
        const double lower = axis.lower > -1e299 ? axis.lower : -dInfinity;
        const double upper = axis.upper < 1e299 ? axis.upper : dInfinity;
        const auto beyond = [](double x) { return std::isfinite(x) && std::abs(x) > 3.141592; };
        if (joint.type == JointType::Hinge && (beyond(lower) || beyond(upper)))
            throw adapter::Unsupported("ode has no hinge limits beyond half a turn (joint '" + joint.name +
                                       "')");
        set(id, dParamLoStop, lower);
        set(id, dParamHiStop, upper);
        set(id, dParamLoStop, lower);
    }
    if (axis.hasMotor()) {
        set(id, dParamVel, axis.motorSpeed);
        set(id, dParamFMax, axis.motorMaxForce);
    }
}

/// Mass or moment about the axis that a spring of the joint swings: of the one body that moves.
double swungMass(const scenario::Joint& joint, const JointEnd& a, const JointEnd& b, const Vec3& anchor,
                 const Vec3& axis) {
    if (a.body != nullptr && b.body != nullptr)
        throw adapter::Unsupported(
            "ode has no joint spring by frequency between two moving bodies: give its "
            "stiffness and damping (joint '" +
            joint.name + "')");
    dBodyID body = a.body != nullptr ? a.body : b.body;
    dMass mass;
    dBodyGetMass(body, &mass);
    if (joint.type == JointType::Slider) return mass.mass;
    const dReal* x = dBodyGetPosition(body);
    const Vec3 across = cross(Vec3{x[0], x[1], x[2]} - anchor, axis);
    dVector3 u;
    dBodyVectorFromWorld(body, axis.x, axis.y, axis.z, u);
    double moment = mass.mass * dot(across, across);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) moment += u[i] * mass.I[4 * i + k] * u[k];
    return moment;
}

/// A spring is two stops in one place that give way: with stiffness k and damping c, ERP h k/(h k + c) and
/// CFM 1/(h k + c) are the implicit spring (ODE manual, section 3.8.2).
void setSpring(const scenario::Joint& joint, dJointID id, void (*set)(dJointID, int, dReal), double dt,
               const JointEnd& a, const JointEnd& b, const Vec3& anchor, const Vec3& axisDirection) {
    const scenario::JointAxis& axis = joint.axes[0];
    if (axis.mode == scenario::AxisMode::Limited || axis.hasMotor())
        throw adapter::Unsupported("ode has no limits or motor beside a joint's spring (joint '" +
                                   joint.name + "')");
    if (joint.type == JointType::Hinge && std::abs(axis.target) > 3.141592)
        throw adapter::Unsupported("ode has no hinge spring to beyond half a turn (joint '" + joint.name +
                                   "')");
    double k = axis.stiffness, c = axis.damping;
    if (axis.frequency > 0.0) {
        const double w = 2.0 * 3.14159265358979323846 * axis.frequency;
        const double J = swungMass(joint, a, b, anchor, axisDirection);
        k = J * w * w, c = 2.0 * axis.dampingRatio * w * J;
    }
    set(id, dParamLoStop, axis.target);
    set(id, dParamHiStop, axis.target);
    set(id, dParamLoStop, axis.target);
    set(id, dParamStopERP, dt * k / (dt * k + c));
    set(id, dParamStopCFM, 1.0 / (dt * k + c));
}

}  // namespace

dJointID buildJoint(dWorldID world, const scenario::Joint& joint, const JointEnd& a, const JointEnd& b,
                    double dt) {
    if (a.body == nullptr && b.body == nullptr) return nullptr;
    const Vec3 anchorA = a.pose * joint.anchorA, anchorB = b.pose * joint.anchorB;
    const Vec3 axis = rotate(a.pose.orientation, joint.axisA);
    dJointID id = nullptr;
    switch (joint.type) {
        case JointType::Ball:
            id = dJointCreateBall(world, nullptr);
            dJointAttach(id, b.body, a.body);
            dJointSetBallAnchor(id, anchorA.x, anchorA.y, anchorA.z);
            break;
        case JointType::Hinge:
            id = dJointCreateHinge(world, nullptr);
            dJointAttach(id, b.body, a.body);
            dJointSetHingeAnchor(id, anchorA.x, anchorA.y, anchorA.z);
            dJointSetHingeAxis(id, axis.x, axis.y, axis.z);
            setAxis(joint, id, dJointSetHingeParam);
            if (joint.axes[0].hasSpring()) setSpring(joint, id, dJointSetHingeParam, dt, a, b, anchorA, axis);
            break;
        case JointType::Slider:
            id = dJointCreateSlider(world, nullptr);
            dJointAttach(id, b.body, a.body);
            dJointSetSliderAxis(id, axis.x, axis.y, axis.z);
            setAxis(joint, id, dJointSetSliderParam);
            if (joint.axes[0].hasSpring())
                setSpring(joint, id, dJointSetSliderParam, dt, a, b, anchorA, axis);
            break;
        case JointType::Fixed:
            id = dJointCreateFixed(world, nullptr);
            dJointAttach(id, b.body, a.body);
            dJointSetFixed(id);
            break;
        case JointType::Distance:
            id = dJointCreateDBall(world, nullptr);
            dJointAttach(id, b.body, a.body);
            dJointSetDBallAnchor1(id, anchorB.x, anchorB.y, anchorB.z);
            dJointSetDBallAnchor2(id, anchorA.x, anchorA.y, anchorA.z);
            dJointSetDBallDistance(id, joint.length);
            break;
        case JointType::ConeTwist:
        case JointType::SixDof:
        case JointType::Wheel:
            throw adapter::Unsupported(std::string("ode has no joint '") + jointName(joint.type) +
                                       "' (joint '" + joint.name + "')");
    }
    return id;
}

}  // namespace rigor::ode
