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

}  // namespace

dJointID buildJoint(dWorldID world, const scenario::Joint& joint, const JointEnd& a, const JointEnd& b) {
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
            break;
        case JointType::Slider:
            id = dJointCreateSlider(world, nullptr);
            dJointAttach(id, b.body, a.body);
            dJointSetSliderAxis(id, axis.x, axis.y, axis.z);
            setAxis(joint, id, dJointSetSliderParam);
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
