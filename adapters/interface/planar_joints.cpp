// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/planar_joints.hpp"

namespace rigor::adapter {

using scenario::AxisMode;
using scenario::Joint;
using scenario::JointAxis;
using scenario::JointType;
using scenario::Vec3;

bool isHeld(const JointAxis& axis) {
    const bool locked = axis.mode == AxisMode::Locked || axis.mode == AxisMode::Usual;
    return locked && !axis.hasMotor() && !axis.hasSpring();
}

std::optional<Joint> reducedPlanarJoint(const Joint& joint) {
    const auto chosen = [](JointAxis axis) {
        if (axis.mode == AxisMode::Usual) axis.mode = AxisMode::Free;
        return axis;
    };
    const JointAxis &x = joint.axes[0], &y = joint.axes[1], &angle = joint.axes[2];
    if (!isHeld(x) && !isHeld(y)) return std::nullopt;
    Joint reduced = joint;
    reduced.axes = {};
    if (isHeld(x) && isHeld(y)) {
        reduced.type = isHeld(angle) ? JointType::Fixed : JointType::Hinge;
        if (!isHeld(angle)) reduced.axes[0] = chosen(angle);
        return reduced;
    }
    if (isHeld(x)) {
        const Vec3 up{0.0, 0.0, 1.0};
        reduced.axisA = cross(up, joint.axisA);
        reduced.axisB = cross(up, joint.axisB);
    }
    reduced.axes[0] = chosen(isHeld(x) ? y : x);
    reduced.type = isHeld(angle) ? JointType::Slider : JointType::Wheel;
    if (!isHeld(angle)) reduced.axes[1] = chosen(angle);
    return reduced;
}

}  // namespace rigor::adapter
