// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints: how far anchors and axes have come apart and limits are overrun, from the states alone.
// Source: constraint functions as in Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems,
// 1989.
#include <algorithm>
#include <cmath>

#include "validation/metrics/metric_parts.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

Pose poseOf(const MetricInput& input, std::size_t frame, int body) {
    if (body == kNone) return {};
    const BodyState& s = input.trajectory.state(frame, body);
    return {s.position, s.orientation};
}

std::optional<double> anchorError(const MetricInput& input, const Joint& joint, std::size_t frame) {
    const Pose a = poseOf(input, frame, joint.bodyA), b = poseOf(input, frame, joint.bodyB);
    const Vec3 gap = b * joint.anchorB - a * joint.anchorA;
    switch (joint.type) {
        case JointType::Distance: {
            const JointAxis& length = joint.axes[0];
            if (length.mode == AxisMode::Limited)
                return std::max({0.0, norm(gap) - length.upper, length.lower - norm(gap)});
            if (length.mode == AxisMode::Free) return std::nullopt;
            return std::abs(norm(gap) - joint.length);
        }
        case JointType::SixDof: {
            // The part of the gap along the directions that are locked.
            const Vec3 x = joint.axisA;
            const bool flat = input.scenario.dimension == 2;
            const Vec3 y = flat ? Vec3{-x.y, x.x, 0.0} : joint.normalA;
            const Vec3 own = rotateInverse(a.orientation, gap), along[3] = {x, y, cross(x, y)};
            Vec3 locked;
            for (std::size_t k = 0; k < (flat ? 2u : 3u); ++k)
                if (joint.axes[k].mode == AxisMode::Usual || joint.axes[k].mode == AxisMode::Locked)
                    locked += dot(own, along[k]) * along[k];
            return norm(locked);
        }
        case JointType::Wheel:
        case JointType::Slider: {
            const Vec3 axis = rotate(a.orientation, joint.axisA);
            return norm(gap - dot(gap, axis) * axis);
        }
        case JointType::Ball:
        case JointType::Hinge:
        case JointType::Fixed:
        case JointType::ConeTwist:
            break;
    }
    return norm(gap);
}

std::optional<double> axisError(const MetricInput& input, const Joint& joint, std::size_t frame) {
    const Pose a = poseOf(input, frame, joint.bodyA), b = poseOf(input, frame, joint.bodyB);
    if (joint.type == JointType::Hinge) {
        if (input.scenario.dimension == 2) return std::nullopt;
        const Vec3 x = rotate(a.orientation, joint.axisA), y = rotate(b.orientation, joint.axisB);
        return angleBetween(x, y);
    }
    if (joint.type != JointType::Slider && joint.type != JointType::Fixed) return std::nullopt;
    const auto initial = [&](int body) {
        return body == kNone ? Quat{}
                             : input.scenario.bodies[static_cast<std::size_t>(body)].pose.orientation;
    };
    const Quat start = conjugate(initial(joint.bodyA)) * initial(joint.bodyB);
    return rotationAngle(start, conjugate(a.orientation) * b.orientation);
}

/// Rotation of B against A since the start, in A's frame (the world's where A is the world).
Quat turnOf(const MetricInput& input, const Joint& joint, const Pose& a, const Pose& b) {
    const auto initial = [&](int body) {
        return body == kNone ? Quat{}
                             : input.scenario.bodies[static_cast<std::size_t>(body)].pose.orientation;
    };
    const Quat start = conjugate(initial(joint.bodyA)) * initial(joint.bodyB);
    return conjugate(a.orientation) * b.orientation * conjugate(start);
}
/// The part of a rotation that is about the unit vector d, in (-pi, pi].
double twistAbout(const Quat& q, Vec3 d) {
    const double turn = 2.0 * std::atan2(dot(Vec3{q.x, q.y, q.z}, d), q.w);
    return std::remainder(turn, 6.283185307179586);
}

struct CoordinateValue {
    double value = 0.0;
    bool turn = false;  ///< an angle about one axis: counted over turns
};
/// Coordinate k of a joint as the scenario format counts it, angles within one turn; none where it has none.
std::optional<CoordinateValue> coordinate(const MetricInput& input, const Joint& joint, std::size_t k,
                                          std::size_t frame) {
    const Pose a = poseOf(input, frame, joint.bodyA), b = poseOf(input, frame, joint.bodyB);
    const Vec3 gap = rotateInverse(a.orientation, b * joint.anchorB - a * joint.anchorA);
    const Quat turn = turnOf(input, joint, a, b);
    const bool flat = input.scenario.dimension == 2;
    const Vec3 z{0, 0, 1};
    const auto swing = [&] {
        const Vec3 x = joint.axisA, y = rotate(turn, joint.axisA);
        return angleBetween(x, y);
    };
    switch (joint.type) {
        case JointType::Hinge:
            return CoordinateValue{twistAbout(turn, flat ? z : joint.axisA), true};
        case JointType::Slider:
            return CoordinateValue{dot(gap, joint.axisA), false};
        case JointType::Distance:
            return CoordinateValue{norm(gap), false};
        case JointType::Ball:
            return CoordinateValue{swing(), false};
        case JointType::ConeTwist:
            if (k == 1) return CoordinateValue{swing(), false};
            return CoordinateValue{twistAbout(turn, joint.axisA), true};
        case JointType::Wheel: {
            if (k == 0) return CoordinateValue{dot(gap, joint.axisA), false};
            const Quat start =
                joint.bodyB == kNone
                    ? Quat{}
                    : input.scenario.bodies[static_cast<std::size_t>(joint.bodyB)].pose.orientation;
            const Quat ofA =
                joint.bodyA == kNone
                    ? Quat{}
                    : input.scenario.bodies[static_cast<std::size_t>(joint.bodyA)].pose.orientation;
            const Vec3 spin = flat ? z : rotateInverse(ofA, rotate(start, joint.spinAxisB));
            return CoordinateValue{twistAbout(turn, spin), true};
        }
        case JointType::SixDof: {
            const Vec3 x = joint.axisA, y = flat ? Vec3{-x.y, x.x, 0} : joint.normalA;
            const Vec3 axes[3] = {x, y, flat ? z : cross(x, y)};
            if (flat ? k < 2 : k < 3) return CoordinateValue{dot(gap, axes[k]), false};
            // Angles of several free turns depend on their order: only where no other turns.
            for (std::size_t other = flat ? 2 : 3; jointAxisName(joint.type, flat ? 2 : 3, other); ++other)
                if (other != k &&
                    (joint.axes[other].mode == AxisMode::Free || joint.axes[other].mode == AxisMode::Limited))
                    return std::nullopt;
            return CoordinateValue{twistAbout(turn, axes[flat ? 2 : k - 3]), true};
        }
        case JointType::Fixed:
            break;
    }
    return std::nullopt;
}

template <class Error>
std::vector<MetricValue> jointRows(const MetricInput& input, Error error) {
    std::vector<MetricValue> rows;
    if (input.trajectory.frames() < 2) return rows;
    for (const auto& joint : input.scenario.joints) {
        Worst worst;
        for (std::size_t k = 0; k < input.trajectory.frames(); ++k)
            if (const auto value = error(input, joint, k)) worst.add(*value, input.trajectory.times[k]);
        if (worst.any()) rows.push_back(worst.row(joint.name));
    }
    return withWorst(std::move(rows));
}

}  // namespace

std::vector<MetricValue> jointDrift(const MetricInput& input) {
    return jointRows(input, anchorError);
}

std::vector<MetricValue> jointAxisDrift(const MetricInput& input) {
    return jointRows(input, axisError);
}

/// One row per coordinate with limits, named joint.coordinate; angles are followed over turns from frame to
/// frame. Joints that may break are left out: nothing has to be kept once they are broken.
std::vector<MetricValue> jointLimitViolation(const MetricInput& input) {
    std::vector<MetricValue> rows;
    if (input.trajectory.frames() < 2) return rows;
    for (const auto& joint : input.scenario.joints) {
        if (joint.breakForce < 1e299 || joint.breakTorque < 1e299) continue;  // nothing to keep once broken
        for (std::size_t k = 0; const char* name = jointAxisName(joint.type, input.scenario.dimension, k);
             ++k) {
            const JointAxis& axis = joint.axes[k];
            if (axis.mode != AxisMode::Limited) continue;
            Worst worst;
            double last = 0.0;
            for (std::size_t i = 0; i < input.trajectory.frames(); ++i) {
                const auto q = coordinate(input, joint, k, i);
                if (!q) break;
                double value = q->value;
                if (q->turn) value = last + std::remainder(value - last, 6.283185307179586);
                last = value;
                worst.add(std::max({0.0, value - axis.upper, axis.lower - value}), input.trajectory.times[i]);
            }
            if (worst.any()) rows.push_back(worst.row(joint.name + "." + name));
        }
    }
    return withWorst(std::move(rows));
}

}  // namespace rigor::validation
