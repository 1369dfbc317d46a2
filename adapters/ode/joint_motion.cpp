// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Twist and swing: with x, y, z A's axis and normals, b the axis of B, phi the angle from x to b and
// n = x x b / |x x b| the swing is the shortest rotation from x to b, the twist what is left about x. Rates,
// with w = wB - wA:
//     cone   phi_dot = n . w             twist  tau_dot = (x + b) . w / (1 + x . b)
//     swing  s = phi n,   s_dot = [n n^T + phi cot(phi) e e^T] w - phi e (x . w),   e = n x x
#include "adapters/ode/joint_motion.hpp"

#include <algorithm>
#include <cmath>

#include "adapters/ode/convert.hpp"

namespace rigor::ode {

using scenario::AxisMode;
using scenario::JointType;

namespace {

/// Angle below which the direction of a swing is rounding [rad].
constexpr double kSmallSwing = 1e-8;

Vec3 anyNormal(const Vec3& x) {
    const Vec3 other = std::abs(x.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 n = cross(x, other);
    return n / norm(n);
}

/// The normal that a joint names, made normal to its axis; any where it names none.
Vec3 normalOf(const scenario::Joint& joint) {
    const Vec3 n = joint.normalA - dot(joint.normalA, joint.axisA) * joint.axisA;
    return joint.type == JointType::SixDof && norm(n) > 1e-9 ? n / norm(n) : anyNormal(joint.axisA);
}

}  // namespace

Pose JointEnd::now() const {
    if (body == nullptr) return pose;
    const Quat q = quatFromOde(dBodyGetQuaternion(body));
    return {fromOde(dBodyGetPosition(body)) - rotate(q, com), q};
}

Vec3 JointEnd::center() const {
    return body != nullptr ? fromOde(dBodyGetPosition(body)) : pose * com;
}

bool JointEnd::hasMass() const {
    return body != nullptr && dBodyIsKinematic(body) == 0;
}

JointMotion::JointMotion(const scenario::Joint& joint, const JointEnd& a, const JointEnd& b)
    : joint_(joint), a_(a), b_(b) {
    const auto intoB = [&](const Vec3& inA) {
        return rotateInverse(b.pose.orientation, rotate(a.pose.orientation, inA));
    };
    localAxes_[0] = joint.axisA;
    localAxes_[1] = normalOf(joint);
    localAxes_[2] = cross(localAxes_[0], localAxes_[1]);
    localTurning_ = joint.axisA;
    if (joint.type == JointType::Wheel)
        localTurning_ = rotateInverse(a.pose.orientation, rotate(b.pose.orientation, joint.spinAxisB));
    if (joint.type == JointType::SixDof) localTurning_ = localAxes_[2];  // the one angle in 2D
    localTurningNormal_ = anyNormal(localTurning_);
    const bool turnsAboutPin = joint.type == JointType::Wheel;
    localTurnAxes_[0] = turnsAboutPin ? localTurning_ : localAxes_[0];
    localTurnAxes_[1] = turnsAboutPin ? localTurningNormal_ : localAxes_[1];
    localTurnAxes_[2] = cross(localTurnAxes_[0], localTurnAxes_[1]);
    axisInB_ = intoB(localTurnAxes_[0]);
    normalInB_ = intoB(localTurnAxes_[1]);
    turningNormalInB_ = intoB(localTurningNormal_);
    update();
}

void JointMotion::update() {
    const Pose A = a_.now(), B = b_.now();
    for (int k = 0; k < 3; ++k) {
        axes_[k] = rotate(A.orientation, localAxes_[k]);
        turnAxes_[k] = rotate(A.orientation, localTurnAxes_[k]);
    }
    turning_ = rotate(A.orientation, localTurning_);
    turningNormal_ = rotate(A.orientation, localTurningNormal_);
    axisOfB_ = rotate(B.orientation, axisInB_);
    normalOfB_ = rotate(B.orientation, normalInB_);
    turningNormalOfB_ = rotate(B.orientation, turningNormalInB_);
    anchorA_ = A * joint_.anchorA;
    anchorB_ = B * joint_.anchorB;
    centerA_ = a_.center();
    centerB_ = b_.center();
}

/// Distance of B's anchor from A's along a direction fixed in A.
Coordinate JointMotion::point(const Vec3& direction) const {
    return {dot(direction, anchorB_ - anchorA_),
            {direction, -cross(anchorB_ - centerA_, direction), cross(anchorB_ - centerB_, direction)}};
}

Coordinate JointMotion::travel(int k) const {
    return point(axes_[k]);
}

Coordinate JointMotion::length() const {
    const Vec3 d = anchorB_ - anchorA_;
    const double distance = norm(d);
    const Vec3 u = distance > 0.0 ? d / distance : Vec3{1, 0, 0};
    return {distance, {u, -cross(anchorA_ - centerA_, u), cross(anchorB_ - centerB_, u)}};
}

Coordinate JointMotion::angle(Angle kind) const {
    if (kind == Angle::Turn) {
        const Vec3 side = cross(turning_, turningNormal_);
        return {std::atan2(dot(side, turningNormalOfB_), dot(turningNormal_, turningNormalOfB_)),
                turning(turning_)};
    }
    const Vec3 &x = turnAxes_[0], &b = axisOfB_;
    const Vec3 normal = cross(x, b);
    const double cosine = dot(x, b), sine = norm(normal), phi = std::atan2(sine, cosine);
    const Vec3 n = sine > kSmallSwing ? normal / sine : turnAxes_[1];
    if (kind == Angle::Cone) return {phi, turning(n)};
    if (kind == Angle::Twist) {
        const Vec3& v = normalOfB_;  // rotated back by the swing
        const Vec3 back = cosine * v - sine * cross(n, v) + (1.0 - cosine) * dot(n, v) * n;
        return {std::atan2(dot(back, turnAxes_[2]), dot(back, turnAxes_[1])),
                turning((x + b) / std::max(1.0 + cosine, 1e-12))};
    }
    const Vec3& t = turnAxes_[kind == Angle::SwingY ? 1 : 2];
    if (sine <= kSmallSwing) return {dot(t, normal), turning(t)};
    const Vec3 s = phi * n, e = cross(n, x);
    const double bent = phi * cosine / sine - 1.0;
    return {dot(t, s), turning(t + bent * dot(t, e) * e - dot(t, cross(s, x)) * x)};
}

SpringTerms springTerms(const scenario::JointAxis& axis, double dt) {
    const double k = axis.stiffness, c = axis.damping;
    return {dt * k / (dt * k + c), 1.0 / (dt * k + c)};
}

}  // namespace rigor::ode
