// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/metrics/joint_coordinates.hpp"

#include "validation/metrics/metric_parts.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

Quat startOf(const Scenario& scenario, int body) {
    return body == kNone ? Quat{} : scenario.bodies[body].pose.orientation;
}

/// Rotation of B against A since the start, in A's frame (the world's where A is the world).
Quat turnOf(const Scenario& scenario, const Joint& joint, const Pose& a, const Pose& b) {
    const Quat start = conjugate(startOf(scenario, joint.bodyA)) * startOf(scenario, joint.bodyB);
    return conjugate(a.orientation) * b.orientation * conjugate(start);
}

/// The part of a rotation that is about the unit vector d, in (-pi, pi].
double twistAbout(const Quat& q, const Vec3& d) {
    const double turn = 2.0 * std::atan2(dot(Vec3{q.x, q.y, q.z}, d), q.w);
    return std::remainder(turn, 6.283185307179586);
}

std::optional<JointCoordinate> sixDof(const Joint& joint, std::size_t k, const Vec3& gap, const Quat& turn,
                                      bool flat) {
    const Vec3 x = joint.axisA, y = flat ? Vec3{-x.y, x.x, 0} : joint.normalA;
    const Vec3 axes[3] = {x, y, flat ? Vec3{0, 0, 1} : cross(x, y)};
    if (flat ? k < 2 : k < 3) return JointCoordinate{dot(gap, axes[k]), false};
    // Angles of several free turns depend on their order: only where no other turns.
    for (std::size_t other = flat ? 2 : 3; jointAxisName(joint.type, flat ? 2 : 3, other); ++other)
        if (other != k &&
            (joint.axes[other].mode == AxisMode::Free || joint.axes[other].mode == AxisMode::Limited))
            return std::nullopt;
    return JointCoordinate{twistAbout(turn, axes[flat ? 2 : k - 3]), true};
}

}  // namespace

std::optional<JointCoordinate> jointCoordinate(const Scenario& scenario, const Joint& joint, std::size_t k,
                                               const Pose& a, const Pose& b) {
    const bool flat = scenario.dimension == 2;
    if (jointAxisName(joint.type, scenario.dimension, k) == nullptr) return std::nullopt;
    const Vec3 gap = rotateInverse(a.orientation, b * joint.anchorB - a * joint.anchorA);
    const Quat turn = turnOf(scenario, joint, a, b);
    const Vec3 z{0, 0, 1};
    const auto swing = [&] { return angleBetween(joint.axisA, rotate(turn, joint.axisA)); };
    switch (joint.type) {
        case JointType::Hinge:
            return JointCoordinate{twistAbout(turn, flat ? z : joint.axisA), true};
        case JointType::Slider:
            return JointCoordinate{dot(gap, joint.axisA), false};
        case JointType::Distance:
            return JointCoordinate{norm(gap), false};
        case JointType::Ball:
            return JointCoordinate{swing(), false};
        case JointType::ConeTwist:
            if (k == 1) return JointCoordinate{swing(), false};
            return JointCoordinate{twistAbout(turn, joint.axisA), true};
        case JointType::Wheel: {
            if (k == 0) return JointCoordinate{dot(gap, joint.axisA), false};
            const Vec3 spin = flat ? z
                                   : rotateInverse(startOf(scenario, joint.bodyA),
                                                   rotate(startOf(scenario, joint.bodyB), joint.spinAxisB));
            return JointCoordinate{twistAbout(turn, spin), true};
        }
        case JointType::SixDof:
            return sixDof(joint, k, gap, turn, flat);
        case JointType::Fixed:
            break;
    }
    return std::nullopt;
}

}  // namespace rigor::validation
