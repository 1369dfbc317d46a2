// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints of the scenario format as Box2D joints: hinge and ball are a revolute joint in the plane, slider a
// prismatic joint, fixed a weld, distance a distance joint of one length. Reference angles are the initial
// ones.
#include "adapters/box2d/joints.hpp"

#include <algorithm>

namespace rigor::box2d {
namespace {

using scenario::Joint;
using scenario::JointType;

struct Ends {
    const JointEnd& a;
    const JointEnd& b;
    b2Vec2 anchorA, anchorB;
    float referenceAngle;
    bool collideConnected;
};

template <class Def>
Def common(const Ends& ends) {
    Def def;
    def.bodyA = ends.a.body;
    def.bodyB = ends.b.body;
    def.collideConnected = ends.collideConnected;
    def.localAnchorA = ends.anchorA;
    def.localAnchorB = ends.anchorB;
    return def;
}

/// A bound in Box2D's units; what is no bound in the format is far away.
float toBound(double x, double scale) {
    return static_cast<float>(std::clamp(scale * x, -1e6, 1e6));
}

}  // namespace

void addJoint(b2World& world, const Joint& joint, const JointEnd& a, const JointEnd& b, double scale) {
    const double turn = angleAboutZ(conjugate(a.bodyPose.orientation) * b.bodyPose.orientation);
    const Ends ends{a,
                    b,
                    toBox2d(inverse(a.frame) * joint.anchorA, scale),
                    toBox2d(inverse(b.frame) * joint.anchorB, scale),
                    static_cast<float>(turn),
                    joint.collideConnected};
    switch (joint.type) {
        case JointType::Ball:
        case JointType::Hinge: {
            auto def = common<b2RevoluteJointDef>(ends);
            def.referenceAngle = ends.referenceAngle;
            const scenario::JointAxis& axis = joint.axes[0];
            def.enableLimit = axis.mode == scenario::AxisMode::Limited;
            if (def.enableLimit)
                def.lowerAngle = toBound(axis.lower, 1.0), def.upperAngle = toBound(axis.upper, 1.0);
            def.enableMotor = axis.hasMotor();
            def.motorSpeed = static_cast<float>(axis.motorSpeed);
            def.maxMotorTorque = static_cast<float>(scale * scale * axis.motorMaxForce);
            world.CreateJoint(&def);
            return;
        }
        case JointType::Slider: {
            auto def = common<b2PrismaticJointDef>(ends);
            def.referenceAngle = ends.referenceAngle;
            def.localAxisA = toBox2d(joint.axisA, 1.0);
            const scenario::JointAxis& axis = joint.axes[0];
            def.enableLimit = axis.mode == scenario::AxisMode::Limited;
            if (def.enableLimit)
                def.lowerTranslation = toBound(axis.lower, scale),
                def.upperTranslation = toBound(axis.upper, scale);
            def.enableMotor = axis.hasMotor();
            def.motorSpeed = static_cast<float>(scale * axis.motorSpeed);
            def.maxMotorForce = static_cast<float>(scale * axis.motorMaxForce);
            world.CreateJoint(&def);
            return;
        }
        case JointType::Fixed: {
            auto def = common<b2WeldJointDef>(ends);
            def.referenceAngle = ends.referenceAngle;
            world.CreateJoint(&def);
            return;
        }
        case JointType::Distance: {
            auto def = common<b2DistanceJointDef>(ends);
            def.length = def.minLength = def.maxLength = static_cast<float>(scale * joint.length);
            if (def.length <= b2_linearSlop)
                throw adapter::Unsupported("box2d has no distance joint shorter than its slop (joint '" +
                                           joint.name + "')");
            world.CreateJoint(&def);
            return;
        }
        case JointType::ConeTwist:
        case JointType::SixDof:
        case JointType::Wheel:
            break;
    }
    throw adapter::Unsupported(std::string("box2d has no joint '") + jointName(joint.type) + "' (joint '" +
                               joint.name + "')");
}

}  // namespace rigor::box2d
