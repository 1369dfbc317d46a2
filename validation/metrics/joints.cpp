// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints: how far anchors and axes have come apart and limits are overrun, from the states alone.
// Source: constraint functions as in Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems,
// 1989.
#include <algorithm>
#include <cmath>

#include "validation/metrics/joint_coordinates.hpp"
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
        return body == kNone ? Quat{} : input.scenario.bodies[body].pose.orientation;
    };
    const Quat start = conjugate(initial(joint.bodyA)) * initial(joint.bodyB);
    return rotationAngle(start, conjugate(a.orientation) * b.orientation);
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
                const auto q = jointCoordinate(input.scenario, joint, k, poseOf(input, i, joint.bodyA),
                                               poseOf(input, i, joint.bodyB));
                if (!q) break;
                const double value = q->after(last);
                last = value;
                worst.add(std::max({0.0, value - axis.upper, axis.lower - value}), input.trajectory.times[i]);
            }
            if (worst.any()) rows.push_back(worst.row(joint.name + "." + name));
        }
    }
    return withWorst(std::move(rows));
}

}  // namespace rigor::validation
