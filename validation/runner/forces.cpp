// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/forces.hpp"

#include <algorithm>

namespace rigor::validation {
namespace {

using adapter::BodyState;
using adapter::Vec3;
using scenario::kNone;
using scenario::Scenario;

struct Step {
    const Scenario& scenario;
    double begin, dt;
    std::span<const BodyState> states;
    adapter::World& world;

    const scenario::Body& body(int index) const { return scenario.bodies[index]; }

    void push(int index, Vec3 force, Vec3 torque) const {
        if (body(index).type == scenario::BodyType::Dynamic) world.applyForce(index, force, torque);
    }
};

/// A point fixed to a body (or the world), where it is and how it moves.
struct Anchor {
    Vec3 point, velocity, arm;  ///< arm: from the centre of mass, world frame
};

Anchor anchorOf(const Step& step, int index, Vec3 local) {
    if (index == kNone) return {local, {}, {}};
    const BodyState& s = step.states[index];
    const Vec3 arm = rotate(s.orientation, local - step.body(index).massProperties.centerOfMass);
    return {s.position + rotate(s.orientation, local), s.velocity + cross(s.angularVelocity, arm), arm};
}

/// The part of the step during which [start, end) lasts: its impulse is exact whatever dt is.
double activePart(const Step& step, double start, double end) {
    const double stepEnd = step.begin + step.dt;
    if (start <= step.begin && end >= stepEnd) return 1.0;
    return std::max(0.0, (std::min(stepEnd, end) - std::max(step.begin, start)) / step.dt);
}

void apply(const Step& step, const scenario::ConstantForce& f) {
    const double part = activePart(step, f.start, f.end);
    if (part > 0.0) step.push(f.body, part * f.force, part * f.torque);
}

void apply(const Step& step, const scenario::SpringForce& f) {
    const Anchor a = anchorOf(step, f.bodyA, f.anchorA), b = anchorOf(step, f.bodyB, f.anchorB);
    const Vec3 span = b.point - a.point;
    const double length = norm(span);
    if (length <= 0.0) return;  // no direction to pull in
    const Vec3 n = span / length;
    const double tension =
        f.stiffness * (length - f.restLength) + f.damping * dot(b.velocity - a.velocity, n);
    const Vec3 onB = -tension * n;
    step.push(f.bodyB, onB, cross(b.arm, onB));
    if (f.bodyA != kNone) step.push(f.bodyA, -onB, cross(a.arm, -onB));
}

void apply(const Step& step, const scenario::DragForce& f) {
    const Vec3 v = step.states[f.body].velocity;
    step.push(f.body, -(f.coefficient + f.quadratic * norm(v)) * v, {});
}

}  // namespace

bool forcesNeedStates(const Scenario& scenario, const adapter::World& world) {
    if (world.evaluatesForces()) return false;
    return std::any_of(scenario.forces.begin(), scenario.forces.end(), [](const scenario::Force& f) {
        return !std::holds_alternative<scenario::ConstantForce>(f);
    });
}

void applyForces(const Scenario& scenario, std::size_t step, double dt, std::span<const BodyState> states,
                 adapter::World& world) {
    const double begin = step * dt;
    const Step now{scenario, begin, dt, states, world};
    if (!world.evaluatesForces())
        for (const scenario::Force& force : scenario.forces)
            std::visit([&](const auto& f) { apply(now, f); }, force);
    // The first step that starts at or after the event; 1e-9 of a step takes the rounding out of step * dt.
    const double slack = 1e-9 * dt;
    for (const scenario::Event& event : scenario.events) {
        const bool due = event.time <= begin + slack;
        const bool wasDue = step > 0 && event.time <= begin - dt + slack;
        if (!due || wasDue || now.body(event.body).type != scenario::BodyType::Dynamic) continue;
        if (!world.applyImpulse(event.body, event.impulse, event.angularImpulse))
            now.push(event.body, event.impulse / dt, event.angularImpulse / dt);
    }
}

}  // namespace rigor::validation
