// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/dart/swing.hpp"

#include <cmath>

namespace rigor::dart_adapter {

bool hasSwingSpring(const scenario::Joint& joint) {
    return joint.type == scenario::JointType::Ball && joint.axes[0].mode != scenario::AxisMode::Locked &&
           joint.axes[0].hasSpring();
}

Vec3 swingTorque(const scenario::Joint& joint, const adapter::BodyState& a, const adapter::BodyState& b) {
    const scenario::JointAxis& swing = joint.axes[0];
    const Vec3 axisA = rotate(a.orientation, joint.axisA), axisB = rotate(b.orientation, joint.axisB);
    const Vec3 across = cross(axisA, axisB);
    const double sine = norm(across);
    if (sine <= 0.0) return {};
    const Vec3 n = across / sine;
    const double angle = std::atan2(sine, dot(axisA, axisB));
    const double rate = dot(b.angularVelocity - a.angularVelocity, n);
    return -(swing.stiffness * (angle - swing.target) + swing.damping * rate) * n;
}

}  // namespace rigor::dart_adapter
