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

namespace rigor::bullet {
namespace {

using scenario::Joint;
using scenario::JointType;

/// The shortest rotation that takes +x to the unit vector n: Bullet's slider travels along x of its frame.
Quat fromXTo(const Vec3& n) {
    if (n.x < -1.0 + 1e-12) return {0.0, 0.0, 1.0, 0.0};
    const Vec3 axis = cross(Vec3{1.0, 0.0, 0.0}, n);
    return normalized(Quat{1.0 + n.x, axis.x, axis.y, axis.z});
}

/// The joint frame in A and in B, both as Bullet wants them: anchors as given, one common orientation at the
/// initial poses whose x axis is the joint's axis.
struct Frames {
    btTransform inA, inB;
};
Frames jointFrames(const Joint& joint, const JointEnd& a, const JointEnd& b) {
    const Quat inBodyA = fromXTo(joint.axisA);
    const Quat inBodyB = conjugate(b.bodyPose.orientation) * a.bodyPose.orientation * inBodyA;
    return {toBullet(inverse(a.comFrame) * Pose{joint.anchorA, inBodyA}),
            toBullet(inverse(b.comFrame) * Pose{joint.anchorB, normalized(inBodyB)})};
}

[[noreturn]] void unsupported(const Joint& joint, const std::string& what) {
    throw adapter::Unsupported("bullet has no " + what + " (joint '" + joint.name + "')");
}

/// A bound of the format; what is none there is far away.
btScalar toBound(double x) {
    return static_cast<btScalar>(std::clamp(x, -1e9, 1e9));
}

/// Bullet's angle is that of B against A by its reference frame A. The stop's "relaxation factor" is the
/// restitution of what hits it, 1 by default. A motor's bound is an impulse per step.
void setAxis(const Joint& joint, btScalar dt, btHingeConstraint& hinge) {
    const scenario::JointAxis& axis = joint.axes[0];
    if (axis.mode == scenario::AxisMode::Limited) {
        if (axis.upper - axis.lower > 6.283 || std::abs(axis.upper) > 3.141592 ||
            std::abs(axis.lower) > 3.141592)
            unsupported(joint, "hinge limits beyond half a turn, or on one side alone");
        hinge.setLimit(static_cast<btScalar>(axis.lower), static_cast<btScalar>(axis.upper), btScalar(0.9),
                       btScalar(0.3), btScalar(0.0));
    }
    if (axis.hasMotor())
        hinge.enableAngularMotor(true, static_cast<btScalar>(axis.motorSpeed),
                                 static_cast<btScalar>(axis.motorMaxForce) * dt);
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

}  // namespace

std::unique_ptr<btTypedConstraint> buildJoint(const Joint& joint, const JointEnd& a, const JointEnd& b,
                                              double dt) {
    const btVector3 anchorA = toBullet(inverse(a.comFrame) * joint.anchorA);
    const btVector3 anchorB = toBullet(inverse(b.comFrame) * joint.anchorB);
    switch (joint.type) {
        case JointType::Ball:
            return std::make_unique<btPoint2PointConstraint>(*a.body, *b.body, anchorA, anchorB);
        case JointType::Hinge: {
            const btVector3 axisA = toBullet(rotateInverse(a.comFrame.orientation, joint.axisA));
            const btVector3 axisB = toBullet(rotateInverse(b.comFrame.orientation, joint.axisB));
            auto hinge =
                std::make_unique<btHingeConstraint>(*a.body, *b.body, anchorA, anchorB, axisA, axisB, true);
            setAxis(joint, static_cast<btScalar>(dt), *hinge);
            return hinge;
        }
        case JointType::Slider: {
            const Frames frames = jointFrames(joint, a, b);
            auto slider =
                std::make_unique<btSliderConstraint>(*a.body, *b.body, frames.inA, frames.inB, true);
            setAxis(joint, *slider);
            return slider;
        }
        case JointType::Fixed: {
            const Frames frames = jointFrames(joint, a, b);
            return std::make_unique<btFixedConstraint>(*a.body, *b.body, frames.inA, frames.inB);
        }
        case JointType::Distance:
        case JointType::ConeTwist:
        case JointType::SixDof:
        case JointType::Wheel:
            break;
    }
    unsupported(joint, std::string("joint '") + jointName(joint.type) + "'");
}

}  // namespace rigor::bullet
