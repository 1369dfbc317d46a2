// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Conversion of a joint's definition to the joint: checks, frames, modes of the coordinates.
#include "engine/constraints/joint.hpp"
#include "engine/core/error.hpp"

namespace rigor::engine {
namespace {

constexpr double kPi = 3.141592653589793;

void require(bool ok, const char* id, const std::string& message) {
    if (!ok) throw EngineError(id, message);
}

/// Coordinates that are never negative: a distance, the angle between two axes.
bool isDistance(JointType type) {
    return type == JointType::Distance;
}
bool isCone(JointType type, std::size_t k) {
    return (type == JointType::Ball && k == 0) || (type == JointType::ConeTwist && k == 1);
}

template <class R>
bool untouched(const JointAxis<R>& axis) {
    return axis.mode == AxisMode::Usual && !axis.hasMotor() && !axis.hasSpring();
}

/// True if the joint has an axis of its own that the definition must give.
template <class S>
bool usesAxis(const JointDef<S>& def) {
    switch (def.type) {
        case JointType::Slider:
        case JointType::SixDof:
        case JointType::Wheel:
        case JointType::ConeTwist:
            return true;
        case JointType::Hinge:
            return S::dim == 3;
        case JointType::Ball:
            return S::dim == 3 && !untouched(def.axes[0]);
        case JointType::Fixed:
        case JointType::Distance:
            break;
    }
    return false;
}

template <class S>
void makeFrames(const JointDef<S>& def, bool ownAxis, Joint<S>& joint) {
    using Vec = typename S::Vec;
    joint.axisA = ownAxis ? Vec(def.axisA.normalized()) : S::Vec::Unit(0);
    joint.axisB = ownAxis ? Vec(def.axisB.normalized()) : S::Vec::Unit(0);
    if constexpr (S::dim == 2) {
        joint.perpA1 = joint.perpA2 = Vec(-joint.axisA.y(), joint.axisA.x());
        joint.turnA = joint.turnB = joint.turnPerpA1 = joint.turnPerpA2 = joint.turnPerpB1 = Vec::Zero();
    } else {
        joint.perpA1 = joint.axisA.unitOrthogonal();
        const Vec normal = def.normalA - def.normalA.dot(joint.axisA) * joint.axisA;
        if (def.type == JointType::SixDof && normal.norm() > 0) joint.perpA1 = normal.normalized();
        joint.perpA2 = joint.axisA.cross(joint.perpA1);
        joint.turnA = joint.axisA;
        joint.turnB = joint.axisB;
        joint.turnPerpA1 = joint.perpA1;
        joint.turnPerpA2 = joint.perpA2;
        if (def.type == JointType::Wheel) {
            joint.turnB = def.spinAxisB.normalized();
            joint.turnA = rotate(joint.relative, joint.turnB);
            joint.turnPerpA1 = joint.turnA.unitOrthogonal();
            joint.turnPerpA2 = joint.turnA.cross(joint.turnPerpA1);
        }
        // Normal to turnB whatever the rounding of the axes given.
        const Vec u = rotateInverse(joint.relative, joint.turnPerpA1);
        joint.turnPerpB1 = (u - u.dot(joint.turnB) * joint.turnB).normalized();
    }
}

}  // namespace

template <class S>
void checkJointAxis(JointType type, std::size_t k, const JointAxis<typename S::Real>& axis) {
    using Real = typename S::Real;
    const bool exists = static_cast<int>(k) < findJoint<S>(type).axes;
    require(exists || untouched(axis), "joint_axes",
            "the joint has no coordinate " + std::to_string(k) + " to limit or drive");
    if (!exists) return;
    const auto notNegative = [](Real x) { return x >= 0 && std::isfinite(x); };
    const auto finite = [](Real x) { return std::isfinite(x); };
    if (axis.mode == AxisMode::Limited) {
        require(axis.lower <= axis.upper, "joint_limits", "limits must be numbers, lower <= upper");
        require(!isDistance(type) || axis.upper > 0, "joint_limits", "a longest distance must be positive");
        require(!isCone(type, k) || (!(axis.lower > 0) && axis.upper > 0 && axis.upper < Real(kPi)),
                "joint_limits", "a cone's half angle must be in (0, pi)");
    }
    require(!isCone(type, k) || axis.mode != AxisMode::Locked, "joint_limits",
            "the angle of a cone cannot be locked");
    require(finite(axis.motorSpeed) && notNegative(axis.motorMaxForce), "joint_motor",
            "motor speeds must be finite, their largest force or torque finite and not negative");
    require(!isCone(type, k) || !axis.hasMotor(), "joint_motor", "a cone cannot have a motor");
    require(finite(axis.target) && notNegative(axis.frequency) && notNegative(axis.dampingRatio) &&
                notNegative(axis.stiffness) && notNegative(axis.damping),
            "joint_spring", "numbers of a spring must be finite and not negative");
    require(axis.frequency == 0 || (axis.stiffness == 0 && axis.damping == 0), "joint_spring",
            "a spring has a frequency, or a stiffness and damping, not both");
    require(axis.frequency > 0 || axis.dampingRatio == 0, "joint_spring",
            "a damping ratio needs a frequency; without one give the damping");
    require(!isCone(type, k) || axis.target == 0, "joint_spring", "a cone's spring pulls to zero");
}

template <class S>
void resolveJointAxes(Joint<S>& joint) {
    using Real = typename S::Real;
    joint.hasLimitOrMotor = false;
    for (std::size_t k = 0; k < static_cast<std::size_t>(joint.axisCount); ++k) {
        JointAxis<Real>& axis = joint.axes[k];
        if (axis.mode == AxisMode::Usual)
            axis.mode = joint.type == JointType::Distance || joint.type == JointType::SixDof
                            ? AxisMode::Locked
                            : AxisMode::Free;
        if (axis.mode == AxisMode::Locked && axis.lower != axis.upper)
            axis.lower = axis.upper = joint.type == JointType::Distance ? joint.length : Real(0);
        if (axis.mode == AxisMode::Limited && axis.lower == axis.upper) axis.mode = AxisMode::Locked;
        joint.hasLimitOrMotor =
            joint.hasLimitOrMotor || axis.mode != AxisMode::Free || axis.hasMotor() || axis.hasSpring();
        require(axis.mode != AxisMode::Locked || !axis.hasMotor(), "joint_motor",
                "a locked coordinate cannot have a motor");
        require(axis.mode != AxisMode::Locked || !axis.hasSpring(), "joint_spring",
                "a locked coordinate cannot have a spring");
    }
}

template <class S>
Joint<S> makeJoint(const JointDef<S>& def, const Pose<S>& A, const typename S::Vec& centerA, const Pose<S>& B,
                   const typename S::Vec& centerB) {
    using Real = typename S::Real;
    const JointEntry<S>& entry = findJoint<S>(def.type);
    require(entry.axes >= 0, "joint_dimension",
            std::string("no ") + entry.name + " joint in " + std::to_string(S::dim) + "D");
    require(def.anchorA.allFinite() && def.anchorB.allFinite(), "joint_anchor",
            "anchors of a joint must be finite");
    const auto unit = [](const typename S::Vec& v) { return std::abs(v.norm() - Real(1)) < Real(1e-4); };
    const bool ownAxis = usesAxis<S>(def);
    require(!ownAxis || (unit(def.axisA) && unit(def.axisB)), "joint_axis",
            "axes of a joint must be unit vectors");
    require(!(def.type == JointType::Wheel && S::dim == 3) || unit(def.spinAxisB), "joint_axis",
            "the spin axis of a wheel must be a unit vector");
    require(def.normalA.allFinite(), "joint_axis", "axes of a joint must be finite");
    require(def.type != JointType::Distance || (def.length > 0 && std::isfinite(def.length)), "joint_length",
            "the length of a distance joint must be positive");
    require(def.breakForce > 0 && def.breakTorque > 0, "joint_break",
            "break force and torque must be positive");
    for (std::size_t k = 0; k < kMaxJointAxes; ++k) checkJointAxis<S>(def.type, k, def.axes[k]);
    Joint<S> joint;
    joint.type = def.type;
    joint.collideConnected = def.collideConnected;
    joint.anchorA = def.anchorA - centerA;
    joint.anchorB = def.anchorB - centerB;
    joint.relative = compose(inverse(A.q), B.q);
    joint.length = def.length;
    joint.axisCount = entry.axes;
    joint.axes = def.axes;
    joint.breakForce = def.breakForce;
    joint.breakTorque = def.breakTorque;
    makeFrames<S>(def, ownAxis, joint);
    resolveJointAxes<S>(joint);
    return joint;
}

#define RIGOR_INSTANTIATE(S)                                                                          \
    template void checkJointAxis<S>(JointType, std::size_t, const JointAxis<S::Real>&);               \
    template void resolveJointAxes<S>(Joint<S>&);                                                     \
    template Joint<S> makeJoint<S>(const JointDef<S>&, const Pose<S>&, const S::Vec&, const Pose<S>&, \
                                   const S::Vec&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
