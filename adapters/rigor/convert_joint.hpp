// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joint types and coordinates of a scenario as the engine's.
#pragma once

#include <cmath>
#include <limits>

#include "adapters/interface/types.hpp"
#include "engine/constraints/joint.hpp"

namespace rigor::adapter {

inline engine::JointType toEngineJoint(scenario::JointType type) {
    switch (type) {
        case scenario::JointType::Ball:
            return engine::JointType::Ball;
        case scenario::JointType::Hinge:
            return engine::JointType::Hinge;
        case scenario::JointType::Slider:
            return engine::JointType::Slider;
        case scenario::JointType::Fixed:
            return engine::JointType::Fixed;
        case scenario::JointType::ConeTwist:
            return engine::JointType::ConeTwist;
        case scenario::JointType::SixDof:
            return engine::JointType::SixDof;
        case scenario::JointType::Wheel:
            return engine::JointType::Wheel;
        case scenario::JointType::Distance:
            break;
    }
    return engine::JointType::Distance;
}
inline engine::AxisMode toEngineMode(scenario::AxisMode mode) {
    switch (mode) {
        case scenario::AxisMode::Free:
            return engine::AxisMode::Free;
        case scenario::AxisMode::Locked:
            return engine::AxisMode::Locked;
        case scenario::AxisMode::Limited:
            return engine::AxisMode::Limited;
        case scenario::AxisMode::Usual:
            break;
    }
    return engine::AxisMode::Usual;
}
/// A bound of the format; beyond 1e299 there is none.
template <class R>
R toEngineBound(double x) {
    if (std::abs(x) < 1e299) return static_cast<R>(x);
    return x < 0 ? -std::numeric_limits<R>::infinity() : std::numeric_limits<R>::infinity();
}
template <class R>
engine::JointAxis<R> toEngineAxis(const scenario::JointAxis& axis) {
    engine::JointAxis<R> result;
    result.mode = toEngineMode(axis.mode);
    result.lower = toEngineBound<R>(axis.lower);
    result.upper = toEngineBound<R>(axis.upper);
    result.motorSpeed = static_cast<R>(axis.motorSpeed);
    result.motorMaxForce = static_cast<R>(axis.motorMaxForce);
    result.target = static_cast<R>(axis.target);
    result.stiffness = static_cast<R>(axis.stiffness);
    result.damping = static_cast<R>(axis.damping);
    return result;
}

}  // namespace rigor::adapter
