// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Resting quality of bodies whose exact solution is not to move. Without a reference only the speed left in a
// scene is reported (jitter, kinetic energy), which means something where it should have settled. Source:
// quantities as in Erleben, ACM Trans. Graph. 26 (2007) 12, and Mirtich and Canny 1995.
#include <algorithm>
#include <cmath>

#include "validation/metrics/mechanics.hpp"
#include "validation/metrics/metric_parts.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

constexpr int kRestSamples = 8;  // times at which the exact solution is tested for motion

bool restsExactly(const MetricInput& input, int body) {
    const PartialState start = input.reference->exact(body, 0.0);
    if (!start.position || !start.velocity || norm(*start.velocity) > 0.0) return false;
    for (int k = 1; k <= kRestSamples; ++k) {
        const double t = std::min(input.scenario.duration * k / kRestSamples, input.reference->validUntil());
        const PartialState now = input.reference->exact(body, t);
        if (!now.position || norm(*now.position - *start.position) > 0.0) return false;
    }
    return true;
}

std::vector<int> restingBodies(const MetricInput& input) {
    std::vector<int> bodies;
    for (const int body : comparedBodies(input))
        if (restsExactly(input, body)) bodies.push_back(body);
    return bodies;
}

Vec3 movedBy(const MetricInput& input, int body, std::size_t frame) {
    const Body& b = input.scenario.bodies[body];
    return centerOfMassOf(b, input.trajectory.state(frame, body)) -
           centerOfMassOf(b, input.trajectory.state(0, body));
}

Vec3 downwards(const Scenario& scenario) {
    const double g = norm(scenario.gravity);
    return g > 0.0 ? scenario.gravity / g : Vec3{};
}

template <class Value>
std::vector<MetricValue> restRows(const MetricInput& input, Value value, bool finalOnly = false) {
    std::vector<MetricValue> rows;
    const std::size_t frames = input.trajectory.frames();
    if (!input.reference || frames < 2) return rows;
    for (const int body : restingBodies(input)) {
        Worst worst;
        for (std::size_t k = finalOnly ? frames - 1 : 0; k < frames; ++k)
            worst.add(value(body, k), input.trajectory.times[k]);
        rows.push_back(worst.row(bodyName(input, body)));
    }
    return withWorst(std::move(rows));
}

}  // namespace

std::vector<MetricValue> restMotion(const MetricInput& input) {
    return restRows(input, [&](int body, std::size_t k) { return norm(movedBy(input, body, k)); });
}

std::vector<MetricValue> restSink(const MetricInput& input) {
    const Vec3 down = downwards(input.scenario);
    if (down == Vec3{}) return {};
    return restRows(input, [&](int body, std::size_t k) {
        const double sink = dot(down, movedBy(input, body, k));
        return sink < 0.0 ? 0.0 : sink;
    });
}

std::vector<MetricValue> restCreep(const MetricInput& input) {
    const Vec3 down = downwards(input.scenario);
    return restRows(
        input,
        [&](int body, std::size_t k) {
            const Vec3 moved = movedBy(input, body, k);
            return norm(moved - dot(moved, down) * down);
        },
        true);
}

std::vector<MetricValue> restTurn(const MetricInput& input) {
    return restRows(input, [&](int body, std::size_t k) {
        return rotationAngle(input.trajectory.state(0, body).orientation,
                             input.trajectory.state(k, body).orientation);
    });
}

std::vector<MetricValue> restJitter(const MetricInput& input) {
    const Trajectory& run = input.trajectory;
    std::vector<MetricValue> rows;
    if (run.frames() < 2) return rows;
    const auto bodies = input.reference ? restingBodies(input) : observedDynamic(input);
    const std::size_t first = run.frames() - std::max<std::size_t>(1, run.frames() / 4);
    for (const int body : bodies) {
        double squares = 0.0;
        for (std::size_t k = first; k < run.frames(); ++k) {
            const Vec3 v = run.state(k, body).velocity;
            squares += dot(v, v);
        }
        Worst worst;
        worst.add(std::sqrt(squares / (run.frames() - first)), run.times.back());
        rows.push_back(worst.row(bodyName(input, body)));
    }
    return withWorst(std::move(rows));
}

std::vector<MetricValue> kineticEnergyFinal(const MetricInput& input) {
    const Trajectory& run = input.trajectory;
    if (run.frames() < 2) return {};
    if (input.reference && restingBodies(input).size() != input.reference->bodies().size()) return {};
    Worst worst;
    worst.add(mechanicsOf(input.scenario, run.frame(run.frames() - 1)).kinetic, run.times.back());
    return {worst.row("")};
}

}  // namespace rigor::validation
