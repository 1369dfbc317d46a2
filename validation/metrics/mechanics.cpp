// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See mechanics.hpp.
#include "validation/metrics/mechanics.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::validation {

using namespace scenario;

Vec3 centerOfMassOf(const Body& body, const BodyState& state) {
    return state.position + rotate(state.orientation, body.massProperties.centerOfMass);
}

Vec3 spinMomentum(const Scenario& scenario, const Body& body, const BodyState& state) {
    const Mat3& inertia = body.massProperties.inertia;
    if (scenario.dimension == 2) return {0.0, 0.0, inertia(2, 2) * state.angularVelocity.z};
    return rotate(state.orientation, inertia * rotateInverse(state.orientation, state.angularVelocity));
}

double reachOf(const Body& body) {
    double reach = 0.0;
    for (const auto& shape : body.shapes) {
        double own = 0.0;
        if (const auto* s = std::get_if<Sphere>(&shape.geometry)) own = s->radius;
        if (const auto* s = std::get_if<Box>(&shape.geometry)) own = norm(s->halfExtents);
        if (const auto* s = std::get_if<Ellipsoid>(&shape.geometry))
            own = std::max({s->halfAxes.x, s->halfAxes.y, s->halfAxes.z});
        if (const auto* s = std::get_if<Capsule>(&shape.geometry)) own = s->radius + s->halfLength;
        if (const auto* s = std::get_if<Cylinder>(&shape.geometry))
            own = std::hypot(s->radius, s->halfLength);
        if (const auto* s = std::get_if<Cone>(&shape.geometry)) own = std::hypot(s->radius, s->halfLength);
        if (const auto* s = std::get_if<ConvexHull>(&shape.geometry))
            for (const Vec3 p : s->vertices) own = std::max(own, norm(p));
        reach = std::max(reach, own + norm(shape.pose.position - body.massProperties.centerOfMass));
    }
    return reach;
}

namespace {

double springEnergy(std::span<const BodyState> states, const SpringForce& spring) {
    const auto place = [&](int body, Vec3 anchor) {
        if (body == kNone) return anchor;
        const BodyState& s = states[body];
        return s.position + rotate(s.orientation, anchor);
    };
    const double stretch =
        norm(place(spring.bodyA, spring.anchorA) - place(spring.bodyB, spring.anchorB)) - spring.restLength;
    return 0.5 * spring.stiffness * stretch * stretch;
}

}  // namespace

Mechanics mechanicsOf(const Scenario& scenario, std::span<const BodyState> states) {
    Mechanics m;
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
        const Body& body = scenario.bodies[i];
        if (body.type != BodyType::Dynamic) continue;
        const double mass = body.massProperties.mass;
        const Vec3 com = centerOfMassOf(body, states[i]), v = states[i].velocity;
        const Vec3 force = (mass * body.gravityScale) * scenario.gravity;
        m.mass += mass;
        m.kinetic += 0.5 * mass * dot(v, v) +
                     0.5 * dot(states[i].angularVelocity, spinMomentum(scenario, body, states[i]));
        m.potential -= dot(force, com);
        m.momentum += mass * v;
        m.weight += force;
        m.centerOfMass += mass * com;
        m.momentumScale += mass * norm(v);
    }
    if (m.mass > 0.0) m.centerOfMass = m.centerOfMass / m.mass;
    const Vec3 mean = m.mass > 0.0 ? m.momentum / m.mass : Vec3{};
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
        const Body& body = scenario.bodies[i];
        if (body.type != BodyType::Dynamic) continue;
        const double mass = body.massProperties.mass;
        const Vec3 arm = centerOfMassOf(body, states[i]) - m.centerOfMass, v = states[i].velocity - mean;
        const Vec3 spin = spinMomentum(scenario, body, states[i]);
        m.angularMomentum += mass * cross(arm, v) + spin;
        m.angularScale += mass * norm(arm) * norm(v) + norm(spin);
    }
    for (const auto& force : scenario.forces)
        if (const auto* spring = std::get_if<SpringForce>(&force))
            m.potential += springEnergy(states, *spring);
    return m;
}

}  // namespace rigor::validation
