// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Energy drift, gain and error; see energy.hpp for when they apply.
#include "validation/metrics/energy.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::validation {
namespace {

using namespace scenario;

constexpr int kSamples = 16;         // times at which the exact solution is tested for conservation of energy
constexpr double kConserved = 1e-9;  // relative to the scale: rounding of the references is below 1e-11

/// States of all bodies of the exact solution; empty unless complete for every dynamic one.
std::optional<std::vector<BodyState>> exactStates(const MetricInput& input, double t) {
    if (!input.reference || t > input.reference->validUntil()) return std::nullopt;
    const auto known = input.reference->bodies();
    std::vector<BodyState> states(input.scenario.bodies.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
        const Body& body = input.scenario.bodies[i];
        states[i] = {body.pose.position, body.pose.orientation, body.velocity, body.angularVelocity};
        if (body.type != BodyType::Dynamic) continue;
        if (std::find(known.begin(), known.end(), static_cast<int>(i)) == known.end()) return std::nullopt;
        const PartialState exact = input.reference->exact(i, t);
        if (!exact.position || !exact.orientation || !exact.velocity || !exact.angularVelocity)
            return std::nullopt;
        states[i] = {*exact.position, *exact.orientation, *exact.velocity, *exact.angularVelocity};
    }
    return states;
}

bool hasLossyForces(const Scenario& scenario) {
    for (const auto& force : scenario.forces) {
        if (const auto* drag = std::get_if<DragForce>(&force);
            drag && (drag->coefficient > 0.0 || drag->quadratic > 0.0))
            return true;
        if (const auto* spring = std::get_if<SpringForce>(&force); spring && spring->damping > 0.0)
            return true;
    }
    for (const auto& body : scenario.bodies)
        if (body.type == BodyType::Dynamic &&
            (body.linearVelocityKept != 1.0 || body.angularVelocityKept != 1.0))
            return true;
    return false;
}

bool contactsAreLossless(const Scenario& scenario) {
    const int count = scenario.bodies.size();
    for (int a = 0; a < count; ++a)
        for (int b = a + 1; b < count; ++b) {
            if (!mayCollide(scenario, a, b)) continue;
            for (const auto& sa : scenario.bodies[a].shapes)
                for (const auto& sb : scenario.bodies[b].shapes) {
                    if (!mayTouch(sa, sb)) continue;
                    const auto pair = pairCoefficients(scenario, sa.material, sb.material);
                    if (pair.friction > 0.0 || pair.restitution < 1.0 || pair.rollingFriction > 0.0 ||
                        pair.torsionalFriction > 0.0)
                        return false;
                }
        }
    return true;
}

/// True if a joint has stops: the energy that a stop removes, and whether it is reached, is known only from
/// the exact solution.
bool hasStops(const Scenario& scenario) {
    for (const auto& joint : scenario.joints)
        for (const auto& axis : joint.axes)
            if (axis.mode == scenario::AxisMode::Limited) return true;
    return false;
}

/// |E(t) - baseline(t)|/scale over the frames; `finalOnly`: the last frame alone.
std::vector<MetricValue> energyRows(const MetricInput& input, bool finalOnly) {
    const Trajectory& run = input.trajectory;
    if (run.frames() < 2 || !conservesEnergy(input)) return {};
    const double scale = energyScale(input);
    if (!(scale > 0.0)) return {};
    const double start = mechanicsOf(input.scenario, run.frame(0)).energy();
    Worst worst;
    for (std::size_t k = finalOnly ? run.frames() - 1 : 0; k < run.frames(); ++k)
        worst.add(std::abs(mechanicsOf(input.scenario, run.frame(k)).energy() - start) / scale, run.times[k]);
    return {worst.row("")};
}

}  // namespace

std::optional<double> exactEnergy(const MetricInput& input, double t) {
    const auto states = exactStates(input, t);
    return states ? std::optional<double>(mechanicsOf(input.scenario, *states).energy()) : std::nullopt;
}

std::optional<double> exactKinetic(const MetricInput& input, double t) {
    const auto states = exactStates(input, t);
    return states ? std::optional<double>(mechanicsOf(input.scenario, *states).kinetic) : std::nullopt;
}

bool isPassive(const Scenario& scenario) {
    for (const auto& force : scenario.forces)
        if (const auto* push = std::get_if<ConstantForce>(&force);
            push && (push->force != Vec3{} || push->torque != Vec3{}))
            return false;
    for (const auto& body : scenario.bodies)
        if (body.type == BodyType::Kinematic && (body.velocity != Vec3{} || body.angularVelocity != Vec3{}))
            return false;
    // Moving surfaces do work.
    for (const auto& body : scenario.bodies)
        for (const auto& shape : body.shapes)
            if (body.collides && shape.surfaceVelocity.moves()) return false;
    // Motors do work; springs of joints store what mechanicsOf() does not count.
    for (const auto& joint : scenario.joints)
        for (const auto& axis : joint.axes)
            if (axis.hasMotor() || axis.hasSpring()) return false;
    return scenario.events.empty();
}

bool conservesEnergy(const MetricInput& input) {
    if (!isPassive(input.scenario) || hasLossyForces(input.scenario)) return false;
    if (contactsAreLossless(input.scenario) && !hasStops(input.scenario)) return true;
    const auto start = exactEnergy(input, 0.0);
    const double scale = energyScale(input);
    if (!start || !(scale > 0.0)) return false;
    for (int k = 1; k <= kSamples; ++k) {
        const auto energy = exactEnergy(input, input.scenario.duration * k / kSamples);
        if (!energy || std::abs(*energy - *start) > kConserved * scale) return false;
    }
    return true;
}

double energyScale(const MetricInput& input) {
    const Trajectory& run = input.trajectory;
    if (run.frames() == 0) return 0.0;
    double scale = mechanicsOf(input.scenario, run.frame(0)).kinetic;
    for (std::size_t k = 1; k < run.frames(); ++k) {
        const auto exact = exactKinetic(input, run.times[k]);
        const double kinetic = exact ? *exact
                                     : (input.reference && exactKinetic(input, 0.0)
                                            ? 0.0
                                            : mechanicsOf(input.scenario, run.frame(k)).kinetic);
        if (std::isfinite(kinetic)) scale = std::max(scale, kinetic);
    }
    double resting = 0.0;
    for (const auto& body : input.scenario.bodies)
        if (body.type == BodyType::Dynamic)
            resting +=
                body.massProperties.mass * norm(body.gravityScale * input.scenario.gravity) * reachOf(body);
    // Motion that is nothing beside the weight is rest.
    return scale > 1e-6 * resting ? scale : resting;
}

std::vector<MetricValue> energyDrift(const MetricInput& input) {
    return energyRows(input, false);
}

std::vector<MetricValue> energyFinal(const MetricInput& input) {
    return energyRows(input, true);
}

std::vector<MetricValue> energyGain(const MetricInput& input) {
    const Trajectory& run = input.trajectory;
    if (run.frames() < 2 || !isPassive(input.scenario)) return {};
    const double scale = energyScale(input);
    if (!(scale > 0.0)) return {};
    double lowest = mechanicsOf(input.scenario, run.frame(0)).energy();
    Worst worst;
    for (std::size_t k = 0; k < run.frames(); ++k) {
        const double energy = mechanicsOf(input.scenario, run.frame(k)).energy();
        worst.add((energy - lowest) / scale, run.times[k]);
        lowest = std::min(lowest, energy);
    }
    return {worst.row("")};
}

std::vector<MetricValue> energyError(const MetricInput& input) {
    const Trajectory& run = input.trajectory;
    const std::size_t frames = validFrames(input);
    if (frames < 2 || !exactEnergy(input, 0.0)) return {};
    const double scale = energyScale(input);
    if (!(scale > 0.0)) return {};
    Worst worst;
    for (std::size_t k = 0; k < frames; ++k)
        if (const auto exact = exactEnergy(input, run.times[k]))
            worst.add(std::abs(mechanicsOf(input.scenario, run.frame(k)).energy() - *exact) / scale,
                      run.times[k]);
    return worst.any() ? std::vector<MetricValue>{worst.row("")} : std::vector<MetricValue>{};
}

}  // namespace rigor::validation
