// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/references/sliding/flat_motion.hpp"

#include <cmath>

namespace rigor::validation {

using numerics::OdeState;

FlatMotion::FlatMotion(const Scenario& scenario, int index, int floor, const Plane& plane)
    : body(scenario.bodies[index]),
      normal(plane.normal),
      along(perpendicular(plane.normal)),
      across(cross(plane.normal, along)),
      centre(centerOfMass(body)),
      support(supportOf(scenario, index, plane)) {
    const std::string subject = bodyTitle(scenario, index);
    require(scenario.dimension == 3, subject + " slides and spins in three dimensions only");
    requireUndisturbed(scenario, index);
    requireContact(scenario, index, floor);
    requireStill(scenario, floor);
    require(std::abs(support.gap) <= 1e-4 * sizeOf(body), subject + " does not stand on the floor");
    const Vec3 w = body.angularVelocity, moment = worldInertia(body) * normal;
    require(norm(cross(w, normal)) <= 1e-9 * norm(w), subject + " does not spin about the normal");
    require(std::abs(dot(body.velocity, normal)) <= 1e-9 * norm(body.velocity),
            subject + " leaves the floor");
    require(norm(moment - dot(normal, moment) * normal) <= 1e-9 * norm(moment),
            "the normal is not along a principal axis of " + subject);
    mass = body.massProperties.mass;
    inertia = dot(normal, moment);
    friction = pairCoefficients(scenario, support.material, plane.material).friction;
}

OdeState FlatMotion::start() const {
    return {
        0, 0, 0, dot(along, body.velocity), dot(across, body.velocity), dot(normal, body.angularVelocity)};
}

PartialState FlatMotion::state(const OdeState& y) const {
    const auto d = [&](std::size_t i) { return static_cast<double>(y[i]); };
    return stateOf(body, centre + d(0) * along + d(1) * across,
                   scenario::normalized(scenario::fromAxisAngle(normal, d(2)) * body.pose.orientation),
                   d(3) * along + d(4) * across, d(5) * normal);
}

}  // namespace rigor::validation
