// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/live/drag.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::validation {
namespace {

using namespace scenario;

constexpr double kUsualFrequency = 2.0;  ///< [Hz]
constexpr double kTwoPi = 6.283185307179586;

/// Effective mass at the end of `arm`, the least over directions: the lightest principal moment is not above
/// the smallest diagonal element.
double feltMass(const Body& body, int dimension, const Vec3& arm) {
    const MassProperties& m = body.massProperties;
    const double lightest =
        dimension == 2 ? m.inertia(2, 2) : std::min({m.inertia(0, 0), m.inertia(1, 1), m.inertia(2, 2)});
    const double turn = lightest > 0.0 ? dot(arm, arm) / lightest : 0.0;
    return 1.0 / (1.0 / m.mass + turn);
}

}  // namespace

DragPull dragForce(const Scenario& scenario, const Drag& drag, std::span<const adapter::BodyState> states,
                   double dt) {
    const Body& body = scenario.bodies[drag.body];
    const adapter::BodyState& s = states[drag.body];
    const Vec3 arm = rotate(s.orientation, drag.point - body.massProperties.centerOfMass);
    const Vec3 x = s.position + rotate(s.orientation, drag.point);
    const Vec3 v = s.velocity + cross(s.angularVelocity, arm);
    const double m = feltMass(body, scenario.dimension, arm);
    const double w = kTwoPi * kUsualFrequency;
    const double requested = drag.stiffness > 0.0 ? drag.stiffness : body.massProperties.mass * w * w;
    const double k = std::min(requested, 0.25 * m / (dt * dt));
    Vec3 force = k * (drag.target - x) - 2.0 * std::sqrt(k * m) * v;
    Vec3 torque = cross(arm, force);
    if (scenario.dimension == 2) {
        force.z = 0.0;
        torque = {0.0, 0.0, torque.z};
    }
    return {force, torque};
}

}  // namespace rigor::validation
