// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints of the scenario format as Box2D joints: hinge and ball are a revolute joint, slider a
// prismatic joint, fixed a weld, distance a distance joint (rod, rope or spring), wheel a wheel joint. The
// spring of a hinge is a weld joint that gives way about its anchor, that of a slider a wheel joint along the
// same axis. Reference angles are the initial ones.
#include "adapters/box2d/joints.hpp"

#include <algorithm>
#include <cmath>

#include "adapters/interface/planar_joints.hpp"

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

/// Stiffness too small to have an effect, but enough for Box2D to take a damper for a spring.
constexpr float kLeastStiffness = 1e-20f;

/// A bound in Box2D's units; what is no bound in the format is far away.
float toBound(double x, double scale) {
    return static_cast<float>(std::clamp(scale * x, -1e6, 1e6));
}

[[noreturn]] void unsupported(const Joint& joint, const std::string& what, const char* documentation) {
    throw adapter::notInLibrary("box2d", what, documentation, "joint '" + joint.name + "'");
}

/// Stiffness and damping of a spring in Box2D's units; `unit` is 1 for a travel and the scale squared for an
/// angle. Box2D takes no notice of the damping of a spring without stiffness.
void setSpring(const scenario::JointAxis& axis, double unit, float& stiffness, float& damping) {
    stiffness = std::max(static_cast<float>(unit * axis.stiffness), kLeastStiffness);
    damping = static_cast<float>(unit * axis.damping);
}

/// Rod, rope, spring, or spring between stops.
b2Joint* addDistance(b2World& world, const Joint& joint, const Ends& ends, double scale) {
    auto def = common<b2DistanceJointDef>(ends);
    const scenario::JointAxis& axis = joint.axes[0];
    def.length = def.minLength = def.maxLength = static_cast<float>(scale * joint.length);
    if (axis.mode == scenario::AxisMode::Free || axis.mode == scenario::AxisMode::Limited) {
        const bool limited = axis.mode == scenario::AxisMode::Limited;
        def.minLength = limited ? std::max(0.0f, toBound(axis.lower, scale)) : 0.0f;
        def.maxLength = limited ? toBound(axis.upper, scale) : 1e6f;
        if (axis.hasSpring()) {
            const bool sprung = axis.stiffness > 0.0;
            b2Vec2 n = ends.b.body->GetWorldPoint(ends.anchorB) - ends.a.body->GetWorldPoint(ends.anchorA);
            if (n.Normalize() <= b2_linearSlop)
                unsupported(joint, "spring between anchors that coincide",
                            "b2_distance_joint.h, m_minLength: at least b2_linearSlop");
            // A damper without a spring has no use for the target.
            if (sprung) def.length = static_cast<float>(scale * axis.target);
            setSpring(axis, 1.0, def.stiffness, def.damping);
        } else {
            def.length = std::max(def.length, 2.0f * b2_linearSlop);
        }
    }
    if (def.length <= b2_linearSlop)
        unsupported(joint, "distance joint shorter than its slop",
                    "b2_distance_joint.h, length: clamped to a stable range");
    return world.CreateJoint(&def);
}

/// Box2D's wheel has spring and stops along its axis and a motor about its pin. The spring pulls to zero: its
/// target moves A's anchor instead.
b2Joint* addWheel(b2World& world, const Joint& joint, const Ends& ends, double scale) {
    auto def = common<b2WheelJointDef>(ends);
    const scenario::JointAxis &travel = joint.axes[0], &angle = joint.axes[1];
    if (travel.hasMotor() || angle.hasSpring() || angle.mode == scenario::AxisMode::Limited)
        unsupported(
            joint, "motor along a wheel's travel, spring or stop of its angle",
            "b2_wheel_joint.h, b2WheelJointDef: spring and stops of the translation, motor of the angle");
    def.localAxisA = toBox2d(joint.axisA, 1.0);
    def.localAnchorA += static_cast<float>(scale * travel.target) * def.localAxisA;
    def.enableLimit = travel.mode == scenario::AxisMode::Limited;
    if (def.enableLimit) {
        def.lowerTranslation = toBound(travel.lower - travel.target, scale);
        def.upperTranslation = toBound(travel.upper - travel.target, scale);
    }
    def.enableMotor = angle.hasMotor();
    def.motorSpeed = static_cast<float>(angle.motorSpeed);
    def.maxMotorTorque = static_cast<float>(scale * scale * angle.motorMaxForce);
    if (travel.hasSpring()) setSpring(travel, 1.0, def.stiffness, def.damping);
    return world.CreateJoint(&def);
}

/// A revolute joint where there is no spring, or stops or a motor beside it, and a weld joint for the spring.
Parts addHinge(b2World& world, const Joint& joint, const Ends& ends, double scale) {
    Parts parts;
    const scenario::JointAxis& axis = joint.axes[0];
    auto def = common<b2RevoluteJointDef>(ends);
    def.referenceAngle = ends.referenceAngle;
    def.enableLimit = axis.mode == scenario::AxisMode::Limited;
    if (def.enableLimit) {
        def.lowerAngle = toBound(axis.lower, 1.0);
        def.upperAngle = toBound(axis.upper, 1.0);
    }
    def.enableMotor = axis.hasMotor();
    def.motorSpeed = static_cast<float>(axis.motorSpeed);
    def.maxMotorTorque = static_cast<float>(scale * scale * axis.motorMaxForce);
    if (!axis.hasSpring() || def.enableLimit || def.enableMotor) parts.push_back(world.CreateJoint(&def));
    if (axis.hasSpring()) {
        auto spring = common<b2WeldJointDef>(ends);
        spring.referenceAngle = ends.referenceAngle + static_cast<float>(axis.target);
        setSpring(axis, scale * scale, spring.stiffness, spring.damping);
        parts.push_back(world.CreateJoint(&spring));
    }
    return parts;
}

/// A prismatic joint, and for a spring a wheel joint along its axis, whose spring pulls to zero.
Parts addSlider(b2World& world, const Joint& joint, const Ends& ends, double scale) {
    auto def = common<b2PrismaticJointDef>(ends);
    def.referenceAngle = ends.referenceAngle;
    def.localAxisA = toBox2d(joint.axisA, 1.0);
    const scenario::JointAxis& axis = joint.axes[0];
    def.enableLimit = axis.mode == scenario::AxisMode::Limited;
    if (def.enableLimit) {
        def.lowerTranslation = toBound(axis.lower, scale);
        def.upperTranslation = toBound(axis.upper, scale);
    }
    def.enableMotor = axis.hasMotor();
    def.motorSpeed = static_cast<float>(scale * axis.motorSpeed);
    def.maxMotorForce = static_cast<float>(scale * axis.motorMaxForce);
    Parts parts{world.CreateJoint(&def)};
    if (axis.hasSpring()) {
        auto spring = common<b2WheelJointDef>(ends);
        spring.localAxisA = def.localAxisA;
        spring.localAnchorA += static_cast<float>(scale * axis.target) * def.localAxisA;
        setSpring(axis, 1.0, spring.stiffness, spring.damping);
        parts.push_back(world.CreateJoint(&spring));
    }
    return parts;
}

bool freeAltogether(const scenario::JointAxis& axis) {
    return axis.mode == scenario::AxisMode::Free && !axis.hasMotor() && !axis.hasSpring();
}

/// Two travels left altogether free: nothing, or a motor joint that has a torque alone and holds the angle.
Parts addFreeTravels(b2World& world, const Joint& joint, const Ends& ends) {
    const scenario::JointAxis &x = joint.axes[0], &y = joint.axes[1], &angle = joint.axes[2];
    if (!freeAltogether(x) || !freeAltogether(y) || !(freeAltogether(angle) || adapter::isHeld(angle)))
        unsupported(joint, "six_dof with two travels, one of which or whose angle is more than free",
                    "b2_joint.h, enum b2JointType; b2_motor_joint.h, b2MotorJointDef: one pose to hold");
    if (!adapter::isHeld(angle)) return {};
    b2MotorJointDef def;
    def.bodyA = ends.a.body;
    def.bodyB = ends.b.body;
    def.collideConnected = ends.collideConnected;
    def.angularOffset = ends.referenceAngle;
    def.maxForce = 0.0f;
    def.maxTorque = 1e9f;
    return {world.CreateJoint(&def)};
}

}  // namespace

Parts addJoint(b2World& world, const Joint& joint, const JointEnd& a, const JointEnd& b, double scale) {
    const double turn = angleAboutZ(conjugate(a.bodyPose.orientation) * b.bodyPose.orientation);
    const Ends ends{a,
                    b,
                    toBox2d(inverse(a.frame) * joint.anchorA, scale),
                    toBox2d(inverse(b.frame) * joint.anchorB, scale),
                    static_cast<float>(turn),
                    joint.collideConnected};
    switch (joint.type) {
        case JointType::Ball:
        case JointType::Hinge:
            return addHinge(world, joint, ends, scale);
        case JointType::Slider:
            return addSlider(world, joint, ends, scale);
        case JointType::Fixed: {
            auto def = common<b2WeldJointDef>(ends);
            def.referenceAngle = ends.referenceAngle;
            return {world.CreateJoint(&def)};
        }
        case JointType::Distance:
            return {addDistance(world, joint, ends, scale)};
        case JointType::Wheel:
            return {addWheel(world, joint, ends, scale)};
        case JointType::SixDof:
            if (const auto reduced = adapter::reducedPlanarJoint(joint))
                return addJoint(world, *reduced, a, b, scale);
            return addFreeTravels(world, joint, ends);
        case JointType::ConeTwist:
            break;
    }
    throw adapter::notInAdapter("box2d", std::string("joint '") + jointName(joint.type) + "'",
                                "joint '" + joint.name + "'");
}

Reaction reactionOf(const Parts& parts, double dt, double scale) {
    const auto perSecond = static_cast<float>(1.0 / dt);
    b2Vec2 force(0.0f, 0.0f);
    float torque = 0.0f;
    for (const b2Joint* part : parts) {
        force += part->GetReactionForce(perSecond);
        torque += part->GetReactionTorque(perSecond);
    }
    return {norm(fromBox2d(force, scale)), std::abs(static_cast<double>(torque)) / (scale * scale)};
}

}  // namespace rigor::box2d
