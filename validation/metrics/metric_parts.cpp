// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See metric_parts.hpp.
#include "validation/metrics/metric_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rigor::validation {

using scenario::Quat;

void Worst::add(double value, double at) {
    const double number = std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
    if (any_ && !(number > value_)) return;
    any_ = true;
    value_ = number;
    at_ = at;
}

std::vector<MetricValue> withWorst(std::vector<MetricValue> rows) {
    if (rows.empty()) return rows;
    Worst worst;
    for (const auto& row : rows) worst.add(row.value, row.at);
    rows.insert(rows.begin(), worst.row(""));
    return rows;
}

bool isDynamic(const scenario::Scenario& scenario, int body) {
    return body >= 0 && scenario.bodies[body].type == scenario::BodyType::Dynamic;
}

const std::string& bodyName(const MetricInput& input, int body) {
    return input.scenario.bodies[body].name;
}

std::vector<int> comparedBodies(const MetricInput& input) {
    if (!input.reference) return {};
    const std::vector<int> known = input.reference->bodies();
    std::vector<int> both;
    for (const int body : known)
        if (std::find(input.scenario.observed.begin(), input.scenario.observed.end(), body) !=
            input.scenario.observed.end())
            both.push_back(body);
    return both.empty() ? known : both;
}

std::vector<int> observedDynamic(const MetricInput& input) {
    std::vector<int> bodies;
    for (const int body : input.scenario.observed)
        if (isDynamic(input.scenario, body)) bodies.push_back(body);
    return bodies;
}

std::size_t validFrames(const MetricInput& input) {
    const auto& times = input.trajectory.times;
    if (!input.reference) return times.size();
    const double until = input.reference->validUntil();
    return std::upper_bound(times.begin(), times.end(), until) - times.begin();
}

double angleBetween(const scenario::Vec3& a, const scenario::Vec3& b) {
    return std::atan2(norm(cross(a, b)), dot(a, b));
}

double nearestAngle(const scenario::Vec3& direction, const std::vector<scenario::Vec3>& good) {
    double best = std::numbers::pi;
    for (const scenario::Vec3& d : good) best = std::min(best, angleBetween(direction, d));
    return best;
}

double rotationAngle(const Quat& a, const Quat& b) {
    const Quat d = conjugate(a) * b;
    return 2.0 * std::atan2(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), std::abs(d.w));
}

std::optional<double> positionError(const BodyState& state, const PartialState& exact) {
    return exact.position ? std::optional<double>(norm(state.position - *exact.position)) : std::nullopt;
}
std::optional<double> velocityError(const BodyState& state, const PartialState& exact) {
    return exact.velocity ? std::optional<double>(norm(state.velocity - *exact.velocity)) : std::nullopt;
}
std::optional<double> orientationError(const BodyState& state, const PartialState& exact) {
    return exact.orientation ? std::optional<double>(rotationAngle(*exact.orientation, state.orientation))
                             : std::nullopt;
}
std::optional<double> spinError(const BodyState& state, const PartialState& exact) {
    return exact.angularVelocity ? std::optional<double>(norm(state.angularVelocity - *exact.angularVelocity))
                                 : std::nullopt;
}

namespace {

std::optional<double> errorAt(const MetricInput& input, StateError error, bool scheme, int body,
                              std::size_t frame) {
    const Trajectory& run = input.trajectory;
    if (!scheme) return error(run.state(frame, body), input.reference->exact(body, run.times[frame]));
    const auto step = frame * run.stride;
    const auto ideal = input.reference->schemeExact(body, step, run.dt, input.scheme);
    return ideal ? error(run.state(frame, body), *ideal) : std::nullopt;
}

}  // namespace

std::vector<MetricValue> stateErrors(const MetricInput& input, StateError error, Over over, bool scheme) {
    std::vector<MetricValue> rows;
    const std::size_t frames = validFrames(input);
    // Frame 0 is the given initial state: nothing is measured there.
    if (!input.reference || frames < 2) return rows;
    for (const int body : comparedBodies(input)) {
        Worst worst;
        double squares = 0.0;
        std::size_t count = 0;
        for (std::size_t frame = over == Over::Final ? frames - 1 : 0; frame < frames; ++frame) {
            const auto value = errorAt(input, error, scheme, body, frame);
            if (!value) continue;
            worst.add(*value, input.trajectory.times[frame]);
            squares += *value * *value;
            ++count;
        }
        if (count == 0) continue;
        MetricValue row = worst.row(bodyName(input, body));
        if (over == Over::Rms) {
            const double mean = std::sqrt(squares / count);
            row.value = std::isnan(mean) ? std::numeric_limits<double>::infinity() : mean;
        }
        rows.push_back(row);
    }
    return withWorst(std::move(rows));
}

}  // namespace rigor::validation
