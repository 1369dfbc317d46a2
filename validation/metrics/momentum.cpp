// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Balance of linear and angular momentum of scenes that nothing fixed touches or holds. Gravity adds t sum(m
// g) to the linear momentum; where it accelerates all bodies alike it does nothing to the angular momentum
// about the common centre of mass. Source: Goldstein, Poole, Safko 2002, chapter 1.
#include <cmath>

#include "validation/metrics/mechanics.hpp"
#include "validation/metrics/metric_parts.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

/// True if only internal forces and gravity act on the dynamic bodies.
bool isIsolated(const Scenario& scenario) {
    for (const auto& body : scenario.bodies)
        if (body.type == BodyType::Dynamic &&
            (body.linearVelocityKept != 1.0 || body.angularVelocityKept != 1.0))
            return false;
    if (!scenario.events.empty()) return false;
    for (const auto& force : scenario.forces) {
        const auto* spring = std::get_if<SpringForce>(&force);
        if (!spring || !isDynamic(scenario, spring->bodyA) || !isDynamic(scenario, spring->bodyB))
            return false;
    }
    for (const auto& joint : scenario.joints)
        if (!isDynamic(scenario, joint.bodyA) || !isDynamic(scenario, joint.bodyB)) return false;
    const int count = scenario.bodies.size();
    for (int a = 0; a < count; ++a)
        for (int b = 0; b < count; ++b)
            if (isDynamic(scenario, a) && !isDynamic(scenario, b) && mayCollide(scenario, a, b)) return false;
    return true;
}

bool fallsTogether(const Scenario& scenario) {
    if (scenario.gravity == Vec3{}) return true;
    std::optional<double> first;
    for (const auto& body : scenario.bodies) {
        if (body.type != BodyType::Dynamic) continue;
        if (first && *first != body.gravityScale) return false;
        first = body.gravityScale;
    }
    return true;
}

}  // namespace

std::vector<MetricValue> linearMomentumDrift(const MetricInput& input) {
    const Trajectory& run = input.trajectory;
    if (run.frames() < 2 || !isIsolated(input.scenario)) return {};
    const Mechanics start = mechanicsOf(input.scenario, run.frame(0));
    const double scale = start.momentumScale + norm(start.weight) * run.times.back();
    if (!(scale > 0.0)) return {};
    Worst worst;
    for (std::size_t k = 0; k < run.frames(); ++k) {
        const Mechanics now = mechanicsOf(input.scenario, run.frame(k));
        worst.add(norm(now.momentum - start.momentum - (run.times[k] - run.times[0]) * start.weight) / scale,
                  run.times[k]);
    }
    return {worst.row("")};
}

std::vector<MetricValue> angularMomentumDrift(const MetricInput& input) {
    const Trajectory& run = input.trajectory;
    if (run.frames() < 2 || !isIsolated(input.scenario) || !fallsTogether(input.scenario)) return {};
    const Mechanics start = mechanicsOf(input.scenario, run.frame(0));
    if (!(start.angularScale > 0.0)) return {};
    Worst worst;
    for (std::size_t k = 0; k < run.frames(); ++k) {
        const Mechanics now = mechanicsOf(input.scenario, run.frame(k));
        worst.add(norm(now.angularMomentum - start.angularMomentum) / start.angularScale, run.times[k]);
    }
    return {worst.row("")};
}

}  // namespace rigor::validation
