// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints of the format as btGeneric6DofSpring2Constraint. Signs of Bullet 3.24, measured: its travel is that
// of B's anchor in A's frame, as the format's; its angles are those of A against B, so limits, targets and
// speeds of turns are negated; the target velocity of a motor is that of A against B in both kinds. Angles
// are Euler angles: where at most one turn is free or limited they are the format's twist and swing, else
// they differ from the second order on. The middle angle of the rotation order ends at a quarter turn.
#include "adapters/bullet/six_dof.hpp"

#include <btBulletDynamicsCommon.h>

#include <array>
#include <cmath>

#include "adapters/bullet/convert.hpp"

namespace rigor::bullet {
namespace {

using scenario::AxisMode;
using scenario::Joint;
using scenario::JointAxis;
using scenario::JointType;

/// A joint in Bullet's terms: its frame in A's body frame, and what each of Bullet's six coordinates (travel
/// along x, y, z, turn about x, y, z) does; null is locked.
struct Layout {
    Vec3 x, y;  ///< unit, orthogonal, in A's body frame
    std::array<const JointAxis*, 6> axis{};

    Vec3 direction(std::size_t k) const { return k % 3 == 0 ? x : k % 3 == 1 ? y : cross(x, y); }
};

Vec3 anyNormalOf(const Vec3& n) {
    const Vec3 other = std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 side = other - dot(other, n) * n;
    return side / norm(side);
}

Layout layoutOf(const Joint& joint, const JointEnd& a, const JointEnd& b) {
    Layout layout;
    layout.x = joint.axisA;
    switch (joint.type) {
        case JointType::Hinge:
        case JointType::ConeTwist:
            layout.axis[3] = &joint.axes[0];
            break;
        case JointType::Slider:
            layout.axis[0] = &joint.axes[0];
            break;
        case JointType::Wheel: {
            // Bullet's own suspension joint: x is the spin axis, the suspension is normal to it.
            const Vec3 spinWorld = rotate(b.bodyPose.orientation, joint.spinAxisB);
            layout.x = rotateInverse(a.bodyPose.orientation, spinWorld);
            layout.y = joint.axisA;
            layout.axis[1] = &joint.axes[0];
            layout.axis[3] = &joint.axes[1];
            return layout;
        }
        default:
            layout.y = joint.normalA;
            for (std::size_t k = 0; k < 6; ++k) {
                const AxisMode mode = joint.axes[k].mode;
                const bool locked = mode == AxisMode::Locked || mode == AxisMode::Usual;
                if (!locked || joint.axes[k].hasMotor() || joint.axes[k].hasSpring())
                    layout.axis[k] = &joint.axes[k];
            }
            return layout;
    }
    layout.y = anyNormalOf(layout.x);
    return layout;
}

/// The rotation order whose middle angle, which ends at a quarter turn, is one that does not turn.
RotateOrder rotationOrder(const Layout& layout) {
    if (layout.axis[4] == nullptr) return RO_XYZ;
    if (layout.axis[5] == nullptr) return RO_XZY;
    if (layout.axis[3] == nullptr) return RO_YXZ;
    return RO_XYZ;
}

/// The joint frame in A's body frame: its x axis along the layout's, then its y axis turned about that.
Quat frameOf(const Layout& layout) {
    const Quat swing = fromXTo(layout.x);
    const Vec3 y = rotate(swing, Vec3{0, 1, 0});
    const double angle = std::atan2(dot(cross(y, layout.y), layout.x), dot(y, layout.y));
    return normalized(scenario::fromAxisAngle(layout.x, angle) * swing);
}

btScalar toScalar(double x) {
    return static_cast<btScalar>(x);
}

/// Bounds of one coordinate in the format's sign; lower above upper is free.
struct Range {
    double lower = 0.0, upper = 0.0;
};
Range rangeOf(const JointAxis* axis, bool turn, const Joint& joint) {
    if (axis == nullptr) return {0.0, 0.0};
    if (axis->mode == AxisMode::Locked) return {0.0, 0.0};
    if (axis->mode != AxisMode::Limited) return {1.0, -1.0};
    if (turn && (std::abs(axis->lower) > 3.141592 || std::abs(axis->upper) > 3.141592))
        throw adapter::notInLibrary("bullet", "limits of a turn beyond half a turn, or on one side alone",
                                    "btGeneric6DofSpring2Constraint.h, setAngularLowerLimit: normalised",
                                    "joint '" + joint.name + "'");
    const auto bound = [](double x) { return std::min(std::max(x, -1e9), 1e9); };
    return {bound(axis->lower), bound(axis->upper)};
}

using SixDof = btGeneric6DofSpring2Constraint;

/// A constraint in the layout's frame that leaves everything free.
std::unique_ptr<SixDof> freeJoint(const Layout& layout, const Joint& joint, const JointEnd& a,
                                  const JointEnd& b) {
    const Frames frames = framesOf(joint, frameOf(layout), a, b);
    auto free = std::make_unique<SixDof>(*a.body, *b.body, frames.inA, frames.inB, rotationOrder(layout));
    for (int k = 0; k < 6; ++k) free->setLimit(k, btScalar(1.0), btScalar(-1.0));
    return free;
}

void setRange(SixDof& part, std::size_t k, const Range& range) {
    const bool negated = k >= 3 && range.lower <= range.upper;
    part.setLimit(k, toScalar(negated ? -range.upper : range.lower),
                  toScalar(negated ? -range.lower : range.upper));
}

void setMotor(SixDof& part, std::size_t k, const JointAxis& axis) {
    const int index = k;
    part.enableMotor(index, true);
    part.setTargetVelocity(index, toScalar(-axis.motorSpeed));
    part.setMaxMotorForce(index, toScalar(axis.motorMaxForce));
}

/// A damper takes the coordinate's motor.
void setSpring(SixDof& part, std::size_t k, const JointAxis& axis, const JointSettings& settings,
               std::vector<Damper>& dampers) {
    const int index = k;
    if (axis.stiffness == 0.0) {
        part.enableMotor(index, true);
        part.setTargetVelocity(index, btScalar(0.0));
        dampers.push_back({&part, index, axis.damping});
        return;
    }
    part.enableSpring(index, true);
    part.setStiffness(index, toScalar(axis.stiffness), settings.limitSprings);
    part.setDamping(index, toScalar(axis.damping), settings.limitSprings);
    part.setEquilibriumPoint(index, toScalar(k >= 3 ? -axis.target : axis.target));
}

/// The turns about a spin axis that leans: a constraint of its own, whose frame has that axis for x.
void addLeaningSpin(const Joint& joint, const JointEnd& a, const JointEnd& b, const JointSettings& settings,
                    BuiltJoint& built) {
    const JointAxis& angle = joint.axes[1];
    Layout layout;
    layout.x = rotateInverse(a.bodyPose.orientation, rotate(b.bodyPose.orientation, joint.spinAxisB));
    layout.y = anyNormalOf(layout.x);
    layout.axis[3] = &angle;
    auto part = freeJoint(layout, joint, a, b);
    for (const std::size_t k : {4, 5}) setRange(*part, k, {0.0, 0.0});
    setRange(*part, 3, rangeOf(&angle, true, joint));
    if (angle.hasMotor()) setMotor(*part, 3, angle);
    if (angle.hasSpring() && angle.stiffness == 0.0 && angle.hasMotor()) {
        auto damper = freeJoint(layout, joint, a, b);
        setSpring(*damper, 3, angle, settings, built.dampers);
        built.parts.push_back(std::move(damper));
    } else if (angle.hasSpring()) {
        setSpring(*part, 3, angle, settings, built.dampers);
    }
    built.parts.push_back(std::move(part));
}

}  // namespace

void addTurnMotor(const Joint& joint, const JointEnd& a, const JointEnd& b, BuiltJoint& built) {
    auto part = freeJoint(layoutOf(joint, a, b), joint, a, b);
    setMotor(*part, 3, joint.axes[0]);
    built.parts.push_back(std::move(part));
}

void addTurnSpring(const Joint& joint, const JointEnd& a, const JointEnd& b, const JointSettings& settings,
                   BuiltJoint& built) {
    auto part = freeJoint(layoutOf(joint, a, b), joint, a, b);
    setSpring(*part, 3, joint.axes[0], settings, built.dampers);
    built.parts.push_back(std::move(part));
}

void addSwingSpring(const Joint& joint, const JointEnd& a, const JointEnd& b, const JointSettings& settings,
                    BuiltJoint& built) {
    Layout layout;
    layout.x = anyNormalOf(joint.axisA);
    layout.y = joint.axisA;
    auto part = freeJoint(layout, joint, a, b);
    const scenario::JointAxis& swing = joint.axes[joint.type == JointType::Ball ? 0 : 1];
    setSpring(*part, 3, swing, settings, built.dampers);
    const auto inBullet = [](const JointEnd& end, const Vec3& v) {
        return toBullet(rotateInverse(end.comFrame.orientation, v));
    };
    built.swingSprings.push_back(
        {part.get(), inBullet(a, joint.axisA), inBullet(b, joint.axisB), inBullet(a, layout.x)});
    built.parts.push_back(std::move(part));
}

BuiltJoint buildSixDof(const Joint& joint, const JointEnd& a, const JointEnd& b,
                       const JointSettings& settings) {
    Layout layout = layoutOf(joint, a, b);
    const bool leans = joint.type == JointType::Wheel && std::abs(dot(layout.x, layout.y)) > 1e-9;
    if (leans) {
        layout.x = layout.y;  // the strut alone
        layout.y = anyNormalOf(layout.x);
        layout.axis = {&joint.axes[0]};
    }
    BuiltJoint built;
    auto sixDof = freeJoint(layout, joint, a, b);
    for (std::size_t k = 0; k < (leans ? 3 : 6); ++k) {
        const JointAxis* axis = layout.axis[k];
        setRange(*sixDof, k, rangeOf(axis, k >= 3, joint));
        if (axis == nullptr) continue;
        if (axis->hasMotor()) setMotor(*sixDof, k, *axis);
        if (!axis->hasSpring()) continue;
        if (axis->stiffness == 0.0 && axis->hasMotor()) {
            auto damper = freeJoint(layout, joint, a, b);
            setSpring(*damper, k, *axis, settings, built.dampers);
            built.parts.push_back(std::move(damper));
        } else {
            setSpring(*sixDof, k, *axis, settings, built.dampers);
        }
    }
    built.parts.insert(built.parts.begin(), std::move(sixDof));
    if (leans) addLeaningSpin(joint, a, b, settings, built);
    return built;
}

}  // namespace rigor::bullet
