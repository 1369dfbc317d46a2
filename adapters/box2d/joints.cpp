// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints of the scenario format as Box2D joints: hinge and ball are a revolute joint in the plane, slider a
// prismatic joint, fixed a weld, distance a distance joint (rod, rope or spring), wheel a wheel joint.
// Reference angles are the initial ones.
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

[[noreturn]] void unsupported(const Joint& joint, const std::string& what, const char* documentation) {
    throw adapter::notInLibrary("box2d", what, documentation, "joint '" + joint.name + "'");
}

/// Stiffness [N/m] and damping [N s/m] of a spring along the unit vector n in the world. From frequency and
/// damping ratio on the mass that n moves: 1/m = sum 1/m_i + (r_i x n)^2 / I_i.
void setSpring(const scenario::JointAxis& axis, const Ends& ends, b2Vec2 n, float& stiffness,
               float& damping) {
    stiffness = static_cast<float>(axis.stiffness), damping = static_cast<float>(axis.damping);
    if (!(axis.frequency > 0.0)) return;
    double mobility = 0.0;
    const auto add = [&](const b2Body& body, b2Vec2 anchor) {
        if (body.GetType() != b2_dynamicBody) return;
        const double arm = b2Cross(body.GetWorldPoint(anchor) - body.GetWorldCenter(), n);
        const double central =
            body.GetInertia() - body.GetMass() * b2Dot(body.GetLocalCenter(), body.GetLocalCenter());
        mobility += 1.0 / body.GetMass() + arm * arm / central;
    };
    add(*ends.a.body, ends.anchorA);
    add(*ends.b.body, ends.anchorB);
    const double w = 2.0 * 3.14159265358979323846 * axis.frequency;
    stiffness = static_cast<float>(w * w / mobility);
    damping = static_cast<float>(2.0 * axis.dampingRatio * w / mobility);
}

/// Rod, rope, spring, or spring between stops.
void addDistance(b2World& world, const Joint& joint, const Ends& ends, double scale) {
    auto def = common<b2DistanceJointDef>(ends);
    const scenario::JointAxis& axis = joint.axes[0];
    def.length = def.minLength = def.maxLength = static_cast<float>(scale * joint.length);
    if (axis.mode == scenario::AxisMode::Free || axis.mode == scenario::AxisMode::Limited) {
        const bool limited = axis.mode == scenario::AxisMode::Limited;
        def.minLength = limited ? std::max(0.0f, toBound(axis.lower, scale)) : 0.0f;
        def.maxLength = limited ? toBound(axis.upper, scale) : 1e6f;
        if (axis.hasSpring()) {
            b2Vec2 n = ends.b.body->GetWorldPoint(ends.anchorB) - ends.a.body->GetWorldPoint(ends.anchorA);
            if (n.Normalize() <= b2_linearSlop)
                unsupported(joint, "spring between anchors that coincide",
                            "b2_distance_joint.h, m_minLength: at least b2_linearSlop");
            def.length = static_cast<float>(scale * axis.target);
            setSpring(axis, ends, n, def.stiffness, def.damping);
        } else {
            def.length = std::max(def.length, 2.0f * b2_linearSlop);
        }
    }
    if (def.length <= b2_linearSlop)
        unsupported(joint, "distance joint shorter than its slop",
                    "b2_distance_joint.h, length: clamped to a stable range");
    world.CreateJoint(&def);
}

/// Box2D's wheel has spring and stops along its axis and a motor about its pin. The spring pulls to zero: its
/// target moves A's anchor instead.
void addWheel(b2World& world, const Joint& joint, const Ends& ends, double scale) {
    auto def = common<b2WheelJointDef>(ends);
    const scenario::JointAxis &travel = joint.axes[0], &angle = joint.axes[1];
    if (travel.hasMotor() || angle.hasSpring() || angle.mode == scenario::AxisMode::Limited)
        unsupported(
            joint, "motor along a wheel's travel, spring or stop of its angle",
            "b2_wheel_joint.h, b2WheelJointDef: spring and stops of the translation, motor of the angle");
    def.localAxisA = toBox2d(joint.axisA, 1.0);
    def.localAnchorA += static_cast<float>(scale * travel.target) * def.localAxisA;
    def.enableLimit = travel.mode == scenario::AxisMode::Limited;
    if (def.enableLimit)
        def.lowerTranslation = toBound(travel.lower - travel.target, scale),
        def.upperTranslation = toBound(travel.upper - travel.target, scale);
    def.enableMotor = angle.hasMotor();
    def.motorSpeed = static_cast<float>(angle.motorSpeed);
    def.maxMotorTorque = static_cast<float>(scale * scale * angle.motorMaxForce);
    if (travel.hasSpring())
        setSpring(travel, ends, ends.a.body->GetWorldVector(def.localAxisA), def.stiffness, def.damping);
    world.CreateJoint(&def);
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
        case JointType::Distance:
            return addDistance(world, joint, ends, scale);
        case JointType::Wheel:
            return addWheel(world, joint, ends, scale);
        case JointType::ConeTwist:
        case JointType::SixDof:
            break;
    }
    throw adapter::notInAdapter("box2d", std::string("joint '") + jointName(joint.type) + "'",
                                "joint '" + joint.name + "'");
}

}  // namespace rigor::box2d
