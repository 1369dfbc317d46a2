// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints. ODE measures angles and travels of the first body against the second, so B is attached first:
// an angle then grows when B turns about the axis. Anchors and axes are given in the world at build time.
#include "adapters/ode/joints.hpp"

#include "adapters/ode/convert.hpp"

namespace rigor::ode {

using scenario::JointType;

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
            break;
        case JointType::Slider:
            id = dJointCreateSlider(world, nullptr);
            dJointAttach(id, b.body, a.body);
            dJointSetSliderAxis(id, axis.x, axis.y, axis.z);
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
    }
    return id;
}

}  // namespace rigor::ode
