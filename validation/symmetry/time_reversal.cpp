// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Time reversal: a motion without friction and losses runs backwards. Impulses of -2 m v and -2 I w turn all
// velocities round at the end of the first run, in the same world, so that no state of the engine is lost.
// Symmetric schemes come back to rounding; symplectic Euler, whose adjoint is its reverse, to first order: a
// body in free flight for T comes back g dt T beside its start. Source: Hairer, Lubich, Wanner, Geometric
// Numerical Integration, 2006, ch. V.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "validation/metrics/mechanics.hpp"
#include "validation/symmetry/transforms.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

/// Friction or a loss at a contact that could happen.
bool contactsLose(const Scenario& s) {
    const int n = s.bodies.size();
    for (int a = 0; a < n; ++a)
        for (int b = a + 1; b < n; ++b) {
            if (!mayCollide(s, a, b)) continue;
            for (const Shape& x : s.bodies[a].shapes)
                for (const Shape& y : s.bodies[b].shapes) {
                    if (!mayTouch(x, y)) continue;
                    const PairCoefficients pair = pairCoefficients(s, x.material, y.material);
                    if (pair.friction > 0.0 || pair.restitution < 1.0 || pair.rollingFriction > 0.0 ||
                        pair.torsionalFriction > 0.0)
                        return true;
                }
        }
    return false;
}

std::string jointObstacle(const Joint& j) {
    if (j.breakForce < 1e299 || j.breakTorque < 1e299) return "joint " + j.name + " can break";
    for (const JointAxis& a : j.axes) {
        const bool stops = a.mode == AxisMode::Limited && a.lower < a.upper;
        if (stops || a.hasMotor()) return "joint " + j.name + " has stops or a motor";
        if (a.dampingRatio > 0.0 || a.damping > 0.0) return "joint " + j.name + " has a damper";
    }
    return "";
}

/// Trajectory backwards in time, at the times t for which states at T + t and T - t are both recorded.
Trajectory backwards(const Trajectory& trajectory) {
    const std::size_t frames = trajectory.frames();
    if (frames % 2 == 0) throw std::invalid_argument("the moment of reversal is not a frame");
    Trajectory t = trajectory;
    const std::size_t half = (frames - 1) / 2, n = trajectory.bodyCount;
    t.times.resize(half + 1);
    t.states.clear();
    t.contacts.assign(half + 1, {});
    for (std::size_t k = 0; k <= half; ++k)
        for (std::size_t i = 0; i < n; ++i) {
            BodyState s = trajectory.state(frames - 1 - k, static_cast<int>(i));
            // The velocities at the reversal itself are still those before it.
            if (k < half) {
                s.velocity = -s.velocity;
                s.angularVelocity = -s.angularVelocity;
            }
            t.states.push_back(s);
        }
    return t;
}

}  // namespace

std::string timeReversalObstacle(const Scenario& s) {
    if (!s.events.empty()) return "impulses of the scenario itself";
    for (const Body& b : s.bodies) {
        if (b.type == BodyType::Kinematic && (norm(b.velocity) > 0.0 || norm(b.angularVelocity) > 0.0))
            return "body " + b.name + " moves at its velocity whatever happens";
        if (b.type == BodyType::Dynamic && (b.linearVelocityKept < 1.0 || b.angularVelocityKept < 1.0))
            return "damping";
    }
    for (const Force& force : s.forces) {
        if (std::holds_alternative<DragForce>(force)) return "drag";
        if (const auto* f = std::get_if<SpringForce>(&force); f != nullptr && f->damping > 0.0)
            return "a damper";
        if (const auto* f = std::get_if<ConstantForce>(&force))
            if (f->start > 0.0 || f->end < s.duration) return "a force that comes or goes";
    }
    for (const Joint& j : s.joints)
        if (const std::string obstacle = jointObstacle(j); !obstacle.empty()) return obstacle;
    return contactsLose(s) ? "contacts with friction or losses" : "";
}

Transformed timeReversal(const Scenario& scenario, const Trajectory* firstRun) {
    require(timeReversalObstacle(scenario));
    if (firstRun == nullptr || firstRun->frames() < 2 ||
        std::abs(firstRun->times.back() - scenario.duration) > 0.5 * firstRun->dt)
        throw std::invalid_argument("no first run to the end of the scenario");
    Scenario s = bare(scenario);
    const std::size_t last = firstRun->frames() - 1;
    for (Force& force : s.forces)
        if (auto* f = std::get_if<ConstantForce>(&force)) f->end = 1e300;
    for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i) {
        const Body& b = s.bodies[i];
        if (b.type != BodyType::Dynamic) continue;
        const BodyState& end = firstRun->state(last, i);
        s.events.push_back({firstRun->times[last], i, -2.0 * b.massProperties.mass * end.velocity,
                            -2.0 * spinMomentum(s, b, end)});
    }
    s.duration = 2.0 * firstRun->times[last];
    return {s, 1.0, backwards};
}

}  // namespace rigor::validation
