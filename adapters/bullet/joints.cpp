// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints of the scenario format as Bullet constraints. Bullet's anchors and axes are in the centre-of-mass
// frames of the two bodies; with useReferenceFrameA = true an angle or travel is that of B relative to A.
#include "adapters/bullet/joints.hpp"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>

#include "adapters/bullet/convert.hpp"
#include "adapters/bullet/six_dof.hpp"

namespace rigor::bullet {
using scenario::Joint;
using scenario::JointType;

Quat fromXTo(const Vec3& n) {
    if (n.x < -1.0 + 1e-12) return {0.0, 0.0, 1.0, 0.0};
    const Vec3 axis = cross(Vec3{1.0, 0.0, 0.0}, n);
    return normalized(Quat{1.0 + n.x, axis.x, axis.y, axis.z});
}

Frames framesOf(const Joint& joint, const Quat& inA, const JointEnd& a, const JointEnd& b) {
    const Quat inB = conjugate(b.bodyPose.orientation) * a.bodyPose.orientation * inA;
    return {toBullet(inverse(a.comFrame) * Pose{joint.anchorA, inA}),
            toBullet(inverse(b.comFrame) * Pose{joint.anchorB, normalized(inB)})};
}

namespace {

[[noreturn]] void notInLibrary(const Joint& joint, const std::string& what, const char* document) {
    throw adapter::notInLibrary("bullet", what, document, "joint '" + joint.name + "'");
}

/// A bound of the format; what is none there is far away.
btScalar toBound(double x) {
    return static_cast<btScalar>(std::clamp(x, -1e9, 1e9));
}

bool beyondHalfTurn(const scenario::JointAxis& axis) {
    return axis.mode == scenario::AxisMode::Limited &&
           (std::abs(axis.upper) > 3.141592 || std::abs(axis.lower) > 3.141592);
}

/// Bullet's angle is that of B against A by its reference frame A. A motor's bound is an impulse per step.
BuiltJoint buildHinge(const Joint& joint, const JointEnd& a, const JointEnd& b,
                      const JointSettings& settings) {
    const btVector3 axisA = toBullet(rotateInverse(a.comFrame.orientation, joint.axisA));
    const btVector3 axisB = toBullet(rotateInverse(b.comFrame.orientation, joint.axisB));
    auto hinge = std::make_unique<btHingeConstraint>(
        *a.body, *b.body, toBullet(inverse(a.comFrame) * joint.anchorA),
        toBullet(inverse(b.comFrame) * joint.anchorB), axisA, axisB, true);
    hinge->setUseFrameOffset(settings.frameOffset);
    const scenario::JointAxis& axis = joint.axes[0];
    const bool windowed = beyondHalfTurn(axis);
    if (axis.hasMotor() && !windowed)
        hinge->enableAngularMotor(true, static_cast<btScalar>(axis.motorSpeed),
                                  static_cast<btScalar>(axis.motorMaxForce * settings.dt));
    if (axis.mode == scenario::AxisMode::Limited && !windowed) setHingeLimit(*hinge, axis.lower, axis.upper);
    btHingeConstraint& limited = *hinge;
    BuiltJoint built(std::move(hinge));
    if (windowed) {
        built.turnLimits.push_back({&limited, axis.lower, axis.upper, 0.0});
        // A hinge's own motor does not slow down before stops whose window holds half a turn, and pushes on.
        if (axis.hasMotor()) addTurnMotor(joint, a, b, built);
    }
    return built;
}

/// Lower above upper: free.
void setAxis(const Joint& joint, btSliderConstraint& slider) {
    const scenario::JointAxis& axis = joint.axes[0];
    const bool limited = axis.mode == scenario::AxisMode::Limited;
    slider.setLowerLinLimit(limited ? toBound(axis.lower) : btScalar(1.0));
    slider.setUpperLinLimit(limited ? toBound(axis.upper) : btScalar(-1.0));
    slider.setLowerAngLimit(0.0);
    slider.setUpperAngLimit(0.0);
    if (!axis.hasMotor()) return;
    slider.setPoweredLinMotor(true);
    slider.setTargetLinMotorVelocity(static_cast<btScalar>(axis.motorSpeed));
    slider.setMaxLinMotorForce(static_cast<btScalar>(axis.motorMaxForce));
}

/// A ball joint whose swing is limited to a cone, and its twist (cone_twist alone) to a range. Bullet's twist
/// limit is symmetric: the joint frame of B is turned by the middle of the range. A relaxation factor of 1,
/// the default, keeps the limits: with 0 they are gone.
std::unique_ptr<btTypedConstraint> buildConeTwist(const Joint& joint, const JointEnd& a, const JointEnd& b) {
    const bool hasTwist = joint.type == JointType::ConeTwist;
    const scenario::JointAxis& swing = joint.axes[hasTwist ? 1 : 0];
    const auto limited = [](const scenario::JointAxis& axis) {
        return axis.mode == scenario::AxisMode::Limited;
    };
    const btScalar none = btScalar(BT_LARGE_FLOAT);
    btScalar cone = none, twistSpan = none;
    if (limited(swing)) {
        if (swing.lower > 0.0)
            notInLibrary(joint, "lower limit of a swing", "btConeTwistConstraint.h, setLimit: spans");
        cone = toBound(swing.upper);
    }
    const Quat inA = fromXTo(joint.axisA);
    Frames frames = framesOf(joint, inA, a, b);
    if (hasTwist && limited(joint.axes[0])) {
        const double lower = joint.axes[0].lower, upper = joint.axes[0].upper;
        if (std::abs(lower) > 3.141592 || std::abs(upper) > 3.141592)
            notInLibrary(joint, "twist limits beyond half a turn, or on one side alone",
                         "btConeTwistConstraint.h, setLimit: spans");
        twistSpan = static_cast<btScalar>(0.5 * (upper - lower));
        const Quat middle = scenario::fromAxisAngle(Vec3{1.0, 0.0, 0.0}, -0.5 * (upper + lower));
        frames.inB = frames.inB * btTransform(toBullet(middle));
    }
    auto coneTwist = std::make_unique<btConeTwistConstraint>(*a.body, *b.body, frames.inA, frames.inB);
    coneTwist->setLimit(cone, cone, twistSpan, btScalar(1.0), btScalar(0.3), btScalar(1.0));
    return coneTwist;
}

/// A spherical joint, with a cone where its swing is limited, and what another constraint does for it: motor
/// and spring of a twist, spring of a swing.
BuiltJoint buildSpherical(const Joint& joint, const JointEnd& a, const JointEnd& b,
                          const JointSettings& settings) {
    const bool hasTwist = joint.type == JointType::ConeTwist;
    const scenario::JointAxis& swing = joint.axes[hasTwist ? 1 : 0];
    BuiltJoint built;
    if (hasTwist || swing.mode == scenario::AxisMode::Limited)
        built.parts.push_back(buildConeTwist(joint, a, b));
    else
        built.parts.push_back(std::make_unique<btPoint2PointConstraint>(
            *a.body, *b.body, toBullet(inverse(a.comFrame) * joint.anchorA),
            toBullet(inverse(b.comFrame) * joint.anchorB)));
    if (hasTwist && joint.axes[0].hasMotor()) addTurnMotor(joint, a, b, built);
    if (hasTwist && joint.axes[0].hasSpring()) addTurnSpring(joint, a, b, settings, built);
    if (swing.hasSpring()) addSwingSpring(joint, a, b, settings, built);
    return built;
}

}  // namespace

BuiltJoint buildJoint(const Joint& joint, const JointEnd& a, const JointEnd& b,
                      const JointSettings& settings) {
    const bool sprung = joint.axes[0].hasSpring();
    switch (joint.type) {
        case JointType::Ball:
        case JointType::ConeTwist:
            return buildSpherical(joint, a, b, settings);
        case JointType::Hinge: {
            if (sprung && !beyondHalfTurn(joint.axes[0])) return buildSixDof(joint, a, b, settings);
            BuiltJoint built = buildHinge(joint, a, b, settings);
            if (sprung) addTurnSpring(joint, a, b, settings, built);
            return built;
        }
        case JointType::Slider: {
            if (sprung) return buildSixDof(joint, a, b, settings);
            const Frames frames = framesOf(joint, fromXTo(joint.axisA), a, b);
            auto slider =
                std::make_unique<btSliderConstraint>(*a.body, *b.body, frames.inA, frames.inB, true);
            setAxis(joint, *slider);
            return BuiltJoint(std::move(slider));
        }
        case JointType::Fixed: {
            const Frames frames = framesOf(joint, fromXTo(joint.axisA), a, b);
            return BuiltJoint(std::make_unique<btFixedConstraint>(*a.body, *b.body, frames.inA, frames.inB));
        }
        case JointType::SixDof:
        case JointType::Wheel:
            return buildSixDof(joint, a, b, settings);
        case JointType::Distance:
            break;
    }
    notInLibrary(joint, std::string("joint '") + jointName(joint.type) + "'",
                 "btTypedConstraint.h, enum btTypedConstraintType: none keeps a distance");
}

}  // namespace rigor::bullet
