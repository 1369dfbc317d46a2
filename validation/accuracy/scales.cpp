// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The scales of a scene, from the scenario and its exact solution alone. A motion that stays within bounds
// errs by no more than its extent however long it goes on, so lengths and angles are the farthest from the
// start and not the sum of the way: a pendulum that has lost its phase altogether is not near the truth for
// having swung often.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "validation/accuracy/accuracy.hpp"
#include "validation/metrics/body_size.hpp"
#include "validation/metrics/energy.hpp"
#include "validation/table.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

constexpr int kSamples = 512;  // evenly over the time for which the exact solution is valid
// motion relative to Size or 1 rad; smaller ones are rounding of the reference
constexpr double kMoves = 1e-9;
constexpr double kRestsBeside = 1e-6;  // kinetic energy beside the weights: below it the scene rests

struct Extremes {
    double distance = 0.0, angle = 0.0, speed = 0.0, spin = 0.0, kinetic = 0.0;
    bool isKineticKnown = false;
};

Extremes extremesOf(const MetricInput& input) {
    Extremes most;
    if (input.reference == nullptr) return most;
    const double end = std::min(input.scenario.duration, input.reference->validUntil());
    most.isKineticKnown = exactKinetic(input, 0.0).has_value();
    for (const int body : comparedBodies(input)) {
        const PartialState start = input.reference->exact(body, 0.0);
        for (int k = 0; k <= kSamples; ++k) {
            const PartialState now = input.reference->exact(body, end * k / kSamples);
            if (now.position && start.position)
                most.distance = std::max(most.distance, norm(*now.position - *start.position));
            if (now.orientation && start.orientation)
                most.angle = std::max(most.angle, rotationAngle(*start.orientation, *now.orientation));
            if (now.velocity) most.speed = std::max(most.speed, norm(*now.velocity));
            if (now.angularVelocity) most.spin = std::max(most.spin, norm(*now.angularVelocity));
        }
    }
    if (most.isKineticKnown)
        for (int k = 0; k <= kSamples; ++k)
            if (const auto kinetic = exactKinetic(input, end * k / kSamples))
                most.kinetic = std::max(most.kinetic, *kinetic);
    return most;
}

std::vector<BodyState> initialStates(const Scenario& scenario) {
    std::vector<BodyState> states;
    for (const Body& body : scenario.bodies)
        states.push_back({body.pose.position, body.pose.orientation, body.velocity, body.angularVelocity});
    return states;
}

std::optional<double> sizeOf(const Scenario& scenario) {
    double least = std::numeric_limits<double>::infinity();
    for (const Body& body : scenario.bodies)
        if (body.type == BodyType::Dynamic) least = std::min(least, widthOf(body, scenario.dimension));
    return std::isfinite(least) && least > 0.0 ? std::optional<double>(least) : std::nullopt;
}

double weightsOf(const Scenario& scenario) {
    double sum = 0.0;
    for (const Body& body : scenario.bodies)
        if (body.type == BodyType::Dynamic)
            sum += body.massProperties.mass * norm(body.gravityScale * scenario.gravity);
    return sum;
}

/// Largest initial distance of bodies along gravity, at least the size of one of them [m].
double heightOf(const Scenario& scenario) {
    const double g = norm(scenario.gravity);
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest, reach = 0.0;
    for (const Body& body : scenario.bodies) {
        if (body.type == BodyType::Dynamic) reach = std::max(reach, reachOf(body));
        const double height = g > 0.0 ? -dot(scenario.gravity, body.pose.position) / g : 0.0;
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    }
    return std::max(reach, highest - lowest);
}

/// Weights by the size of the bodies: what a scene at rest compares energies with [J].
double restingEnergy(const Scenario& scenario) {
    double sum = 0.0;
    for (const Body& body : scenario.bodies)
        if (body.type == BodyType::Dynamic)
            sum += body.massProperties.mass * norm(body.gravityScale * scenario.gravity) * reachOf(body);
    return sum;
}

double energyOf(const Scenario& scenario, const Extremes& most) {
    const double resting = restingEnergy(scenario);
    if (most.isKineticKnown) return most.kinetic > kRestsBeside * resting ? most.kinetic : resting;
    return mechanicsOf(scenario, initialStates(scenario)).kinetic + weightsOf(scenario) * heightOf(scenario);
}

bool isLength(std::string_view axis) {
    constexpr std::array<std::string_view, 5> lengths{"travel", "length", "x", "y", "z"};
    return std::find(lengths.begin(), lengths.end(), axis) != lengths.end();
}

std::optional<double> jointTravelOf(const Scenario& scenario, std::optional<double> size) {
    std::optional<double> least;
    for (const Joint& joint : scenario.joints)
        for (std::size_t k = 0; const char* name = jointAxisName(joint.type, scenario.dimension, k); ++k) {
            if (joint.axes[k].mode != AxisMode::Limited) continue;
            const auto scale = isLength(name) ? size : std::optional<double>(1.0);
            if (scale && (!least || *scale < *least)) least = scale;
        }
    return least;
}

std::optional<double> positive(double value) {
    return value > 0.0 && std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

}  // namespace

SceneScales sceneScales(const Scenario& scenario, const Reference* reference) {
    const Trajectory none;
    const Extremes most = extremesOf({scenario, none, reference, adapter::Scheme::Unknown});
    SceneScales scales;
    scales.size = sizeOf(scenario);
    const double size = scales.size.value_or(0.0);
    scales.distance = most.distance > kMoves * size ? positive(most.distance) : scales.size;
    scales.angle = most.angle > kMoves ? most.angle : 1.0;
    double speed = most.speed, spin = most.spin;
    for (const Body& body : scenario.bodies) {
        speed = std::max(speed, norm(body.velocity));
        spin = std::max(spin, norm(body.angularVelocity));
    }
    const double fall = std::sqrt(2.0 * norm(scenario.gravity) * size);
    scales.speed = positive(speed > kMoves * fall ? speed : fall);
    scales.spin = positive(spin > 0.0 || size == 0.0 ? spin : scales.speed.value_or(0.0) / size);
    scales.energy = positive(energyOf(scenario, most));
    scales.jointTravel = jointTravelOf(scenario, scales.size);
    return scales;
}

const std::vector<ScaleEntry>& scaleTable() {
    static const std::vector<ScaleEntry> table{
#define SCALE(metric, scale, ideal) {#metric, ScaleKind::scale, IdealKind::ideal},
#include "validation/accuracy/scales.def"
#undef SCALE
    };
    return table;
}

const ScaleEntry* findScale(const std::string& metric) {
    return findEntry(scaleTable(), metric, &ScaleEntry::metric);
}

}  // namespace rigor::validation
