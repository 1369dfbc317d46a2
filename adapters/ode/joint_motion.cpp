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

/// Below this the direction of a swing is rounding [rad].
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
    if (joint.type == JointType::SixDof) localTurning_ = localAxes_[2];  // in the plane its one angle
    localTurningNormal_ = anyNormal(localTurning_);
    axisInB_ = intoB(localAxes_[0]);
    normalInB_ = intoB(localAxes_[1]);
    turningNormalInB_ = intoB(localTurningNormal_);
    update();
}

void JointMotion::update() {
    const Pose A = a_.now(), B = b_.now();
    for (int k = 0; k < 3; ++k) axes_[k] = rotate(A.orientation, localAxes_[k]);
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

/// How far B's anchor is from A's along a direction fixed in A.
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
    const Vec3 &x = axes_[0], &b = axisOfB_;
    const Vec3 normal = cross(x, b);
    const double cosine = dot(x, b), sine = norm(normal), phi = std::atan2(sine, cosine);
    const Vec3 n = sine > kSmallSwing ? normal / sine : axes_[1];
    if (kind == Angle::Cone) return {phi, turning(n)};
    if (kind == Angle::Twist) {
        const Vec3& v = normalOfB_;  // rotated back by the swing
        const Vec3 back = cosine * v - sine * cross(n, v) + (1.0 - cosine) * dot(n, v) * n;
        return {std::atan2(dot(back, axes_[2]), dot(back, axes_[1])),
                turning((x + b) / std::max(1.0 + cosine, 1e-12))};
    }
    const Vec3& t = axes_[kind == Angle::SwingY ? 1 : 2];
    if (sine <= kSmallSwing) return {dot(t, normal), turning(t)};
    const Vec3 s = phi * n, e = cross(n, x);
    const double bent = phi * cosine / sine - 1.0;
    return {dot(t, s), turning(t + bent * dot(t, e) * e - dot(t, cross(s, x)) * x)};
}

std::vector<Rate> JointMotion::held() const {
    std::vector<Rate> rows;
    const auto holdAnchor = [&](std::initializer_list<int> axes) {
        for (const int k : axes) rows.push_back(travel(k).rate);
    };
    const auto holdTurns = [&](const Vec3& free) {
        const Vec3 n = anyNormal(free);
        for (const Vec3& t : {n, cross(free, n)}) rows.push_back(turning(t));
    };
    switch (joint_.type) {
        case JointType::Distance:
            break;
        case JointType::Ball:
        case JointType::ConeTwist:
            holdAnchor({0, 1, 2});
            break;
        case JointType::Hinge:
            holdAnchor({0, 1, 2});
            holdTurns(turning_);
            break;
        case JointType::Fixed:
            holdAnchor({0, 1, 2});
            for (const Vec3& t : axes_) rows.push_back(turning(t));
            break;
        case JointType::Slider:
            holdAnchor({1, 2});
            for (const Vec3& t : axes_) rows.push_back(turning(t));
            break;
        case JointType::Wheel:
            holdAnchor({1, 2});
            holdTurns(turning_);
            break;
        case JointType::SixDof: {
            constexpr Angle kinds[] = {Angle::Twist, Angle::SwingY, Angle::SwingZ};
            for (int k = 0; k < 6; ++k) {
                const AxisMode mode = joint_.axes[static_cast<std::size_t>(k)].mode;
                if (mode == AxisMode::Locked)
                    rows.push_back(k < 3 ? travel(k).rate : angle(kinds[k - 3]).rate);
            }
            break;
        }
    }
    return rows;
}

double JointMotion::coupling(const Rate& r, const Rate& s) const {
    double sum = 0.0;
    const auto add = [&](const JointEnd& end, const Vec3& angR, const Vec3& angS) {
        if (!end.hasMass()) return;
        dMass mass;
        dBodyGetMass(end.body, &mass);
        Mat3 I;
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) I(i, k) = mass.I[4 * i + k];
        const Quat q = quatFromOde(dBodyGetQuaternion(end.body));
        sum += dot(r.lin, s.lin) / mass.mass +
               dot(rotateInverse(q, angR), inverseOf(I) * rotateInverse(q, angS));
    };
    add(a_, r.angA, s.angA);
    add(b_, r.angB, s.angB);
    return sum;
}

/// Gaussian elimination of the held rows out of the bordered matrix; its last pivot is what is left of K.
double JointMotion::movedMass(const Rate& coordinate) const {
    std::vector<Rate> rows = held();
    rows.push_back(coordinate);
    const std::size_t n = rows.size();
    std::vector<std::vector<double>> K(n, std::vector<double>(n));
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) K[i][j] = coupling(rows[i], rows[j]);
    const double whole = K[n - 1][n - 1];
    for (std::size_t p = 0; p + 1 < n; ++p) {
        if (!(K[p][p] > 1e-14 * whole)) continue;  // held by another row already
        for (std::size_t i = p + 1; i < n; ++i) {
            const double factor = K[i][p] / K[p][p];
            for (std::size_t j = p; j < n; ++j) K[i][j] -= factor * K[p][j];
        }
    }
    return K[n - 1][n - 1] > 1e-14 * whole ? 1.0 / K[n - 1][n - 1] : 0.0;
}

SpringTerms springTerms(const scenario::JointAxis& axis, double moved, double dt) {
    double k = axis.stiffness, c = axis.damping;
    if (axis.frequency > 0.0) {
        const double w = 2.0 * 3.14159265358979323846 * axis.frequency;
        k = moved * w * w;
        c = 2.0 * axis.dampingRatio * w * moved;
    }
    return {dt * k / (dt * k + c), 1.0 / (dt * k + c)};
}

}  // namespace rigor::ode
