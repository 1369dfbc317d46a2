// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints of the scenario format as Chipmunk constraints: hinge and ball are a pivot joint; fixed a pivot and a gear
// joint; slider a groove and a gear joint; wheel a groove joint; distance a pin joint, a slide joint or a damped spring.
// Stops of an angle are a rotary limit joint, its motor a simple motor, its spring a damped rotary spring. Stops along
// a groove are its ends, a spring along it a damped spring from a point far behind A's anchor.
#include "adapters/chipmunk/joints.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adapters/interface/planar_joints.hpp"

namespace rigor::chipmunk {
namespace {

using scenario::AxisMode;
using scenario::Joint;
using scenario::JointAxis;
using scenario::JointType;

/// Half of a groove without stops, and the distance to the far end of a spring along it [m].
constexpr double kFar = 1000.0;

[[noreturn]] void unsupported(const Joint& joint, const std::string& what, const char* documentation) {
    throw adapter::notInLibrary("chipmunk", what, documentation, "joint '" + joint.name + "'");
}

class JointBuilder {
  public:
    JointBuilder(const Joint& joint, const JointEnd& a, const JointEnd& b)
        : joint_(joint),
          a_(a.body),
          b_(b.body),
          anchorA_(toChipmunk(joint.anchorA)),
          anchorB_(toChipmunk(joint.anchorB)),
          axis_(toChipmunk(joint.axisA)),
          startAngle_(cpBodyGetAngle(b.body) - cpBodyGetAngle(a.body)) {}

    Parts take() {
        for (auto* parts : {&parts_.forces, &parts_.torques})
            for (auto& part : *parts) cpConstraintSetCollideBodies(part.get(), joint_.collideConnected);
        return std::move(parts_);
    }

    void pin() { force(cpPivotJointNew2(a_, b_, anchorA_, anchorB_)); }
    void holdAngle() { torque(cpGearJointNew(a_, b_, startAngle_, 1.0)); }

    void angle(const JointAxis& axis) {
        if (axis.mode == AxisMode::Limited)
            torque(cpRotaryLimitJointNew(a_, b_, startAngle_ + std::max(axis.lower, -1e9),
                                         startAngle_ + std::min(axis.upper, 1e9)));
        if (axis.hasMotor()) {
            cpConstraint* motor = cpSimpleMotorNew(a_, b_, -axis.motorSpeed);
            cpConstraintSetMaxForce(motor, axis.motorMaxForce);
            torque(motor);
        }
        // The spring's angle is that of A less that of B.
        if (axis.hasSpring())
            torque(
                cpDampedRotarySpringNew(a_, b_, -(startAngle_ + axis.target), axis.stiffness, axis.damping));
    }

    void travel(const JointAxis& axis) {
        if (axis.hasMotor())
            unsupported(joint_, "motor along a travel",
                        "chipmunk/cpSimpleMotor.h: drives the relative angular velocity, the one motor");
        const bool limited = axis.mode == AxisMode::Limited;
        const double lower = limited ? std::max(axis.lower, -kFar) : -kFar;
        const double upper = limited ? std::min(axis.upper, kFar) : kFar;
        force(cpGrooveJointNew(a_, b_, along(lower), along(upper), anchorB_));
        if (axis.hasSpring())
            force(cpDampedSpringNew(a_, b_, along(-kFar), anchorB_, kFar + axis.target, axis.stiffness,
                                    axis.damping));
    }

    void distance() {
        const JointAxis& axis = joint_.axes[0];
        const bool limited = axis.mode == AxisMode::Limited;
        if (axis.hasMotor())
            unsupported(joint_, "distance.motor",
                        "chipmunk/cpSimpleMotor.h: drives the relative angular velocity");
        if (limited)
            force(cpSlideJointNew(a_, b_, anchorA_, anchorB_, std::max(axis.lower, 0.0),
                                  std::min(axis.upper, 1e9)));
        if (axis.hasSpring())
            force(cpDampedSpringNew(a_, b_, anchorA_, anchorB_, axis.target, axis.stiffness, axis.damping));
        if (limited || axis.mode == AxisMode::Free) return;
        cpConstraint* rod = cpPinJointNew(a_, b_, anchorA_, anchorB_);
        cpPinJointSetDist(rod, joint_.length);
        force(rod);
    }

  private:
    void force(cpConstraint* part) { parts_.forces.emplace_back(part); }
    void torque(cpConstraint* part) { parts_.torques.emplace_back(part); }
    cpVect along(double u) const { return cpvadd(anchorA_, cpvmult(axis_, u)); }

    const Joint& joint_;
    cpBody *a_, *b_;
    cpVect anchorA_, anchorB_, axis_;
    double startAngle_;
    Parts parts_;
};

void addParts(JointBuilder& build, const Joint& joint) {
    switch (joint.type) {
        case JointType::Ball:
            return build.pin();
        case JointType::Hinge:
            build.pin();
            return build.angle(joint.axes[0]);
        case JointType::Fixed:
            build.pin();
            return build.holdAngle();
        case JointType::Slider:
            build.travel(joint.axes[0]);
            return build.holdAngle();
        case JointType::Wheel:
            build.travel(joint.axes[0]);
            return build.angle(joint.axes[1]);
        case JointType::Distance:
            return build.distance();
        case JointType::SixDof:
            unsupported(joint, "six_dof with two travels",
                        "chipmunk/cpGrooveJoint.h: one groove; no constraint leaves a plane free");
        case JointType::ConeTwist:
            break;
    }
    throw adapter::notInAdapter("chipmunk", std::string("joint '") + jointName(joint.type) + "'",
                                "joint '" + joint.name + "'");
}

}  // namespace

Parts buildJoint(const Joint& joint, const JointEnd& a, const JointEnd& b) {
    const auto simple = joint.type == JointType::SixDof ? adapter::reducedPlanarJoint(joint) : std::nullopt;
    const Joint& built = simple ? *simple : joint;
    JointBuilder build(built, a, b);
    addParts(build, built);
    return build.take();
}

Reaction reactionOf(const Parts& parts, double dt) {
    // Parts that push pull at one anchor in directions normal to each other: a groove and the spring along it.
    double squares = 0.0, torque = 0.0;
    for (const auto& part : parts.forces) {
        const double impulse = cpConstraintGetImpulse(part.get());
        squares += impulse * impulse;
    }
    for (const auto& part : parts.torques) torque += cpConstraintGetImpulse(part.get());
    return {std::sqrt(squares) / dt, std::abs(torque) / dt};
}

}  // namespace rigor::chipmunk
