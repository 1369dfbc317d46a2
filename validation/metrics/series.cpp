// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Series over the frames for the curves of a report.
#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/metrics/mechanics.hpp"
#include "validation/metrics/metric_parts.hpp"

namespace rigor::validation {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void addMechanics(const MetricInput& input, std::vector<Series>& result) {
    const std::size_t frames = input.trajectory.frames();
    Series energy{"energy", "", "J", std::vector<double>(frames)},
        kinetic{"kinetic_energy", "", "J", std::vector<double>(frames)};
    Series momentum{"linear_momentum", "", "kg m/s", std::vector<double>(frames)};
    Series angular{"angular_momentum", "", "kg m^2/s", std::vector<double>(frames)};
    for (std::size_t k = 0; k < frames; ++k) {
        const Mechanics m = mechanicsOf(input.scenario, input.trajectory.frame(k));
        energy.values[k] = m.energy();
        kinetic.values[k] = m.kinetic;
        momentum.values[k] = norm(m.momentum);
        angular.values[k] = norm(m.angularMomentum);
    }
    for (auto* series : {&energy, &kinetic, &momentum, &angular}) result.push_back(std::move(*series));
}

void addErrors(const MetricInput& input, std::vector<Series>& result) {
    const std::size_t frames = input.trajectory.frames(), valid = validFrames(input);
    for (const int body : comparedBodies(input)) {
        const bool isMeasured = input.reference->measured(body, 0.0).has_value();
        Series position{"position_error", bodyName(input, body), "m", std::vector<double>(frames, kNone)};
        Series velocity{"velocity_error", bodyName(input, body), "m/s", std::vector<double>(frames, kNone)};
        Series orientation{"orientation_error", bodyName(input, body), "rad",
                           std::vector<double>(frames, kNone)};
        for (std::size_t k = 0; k < valid; ++k) {
            const auto& state = input.trajectory.state(k, body);
            const double t = input.trajectory.times[k];
            const PartialState exact =
                isMeasured ? *input.reference->measured(body, t) : input.reference->exact(body, t);
            position.values[k] = positionError(state, exact).value_or(kNone);
            velocity.values[k] = velocityError(state, exact).value_or(kNone);
            orientation.values[k] = orientationError(state, exact).value_or(kNone);
        }
        for (auto* series : {&position, &velocity, &orientation})
            if (std::any_of(series->values.begin(), series->values.end(),
                            [](double v) { return !std::isnan(v); }))
                result.push_back(std::move(*series));
    }
}

void addContacts(const MetricInput& input, std::vector<Series>& result) {
    const std::size_t frames = input.trajectory.frames();
    if (input.trajectory.contacts.size() != frames) return;
    bool any = false;
    Series depth{"penetration", "", "m", std::vector<double>(frames, 0.0)},
        count{"contacts", "", "1", std::vector<double>(frames, 0.0)};
    for (std::size_t k = 0; k < frames; ++k) {
        for (const auto& contact : input.trajectory.contacts[k])
            depth.values[k] = std::max(depth.values[k], contact.depth);
        count.values[k] = input.trajectory.contacts[k].size();
        any = any || !input.trajectory.contacts[k].empty();
    }
    if (!any) return;
    const bool atEnd = input.trajectory.contactInstant == adapter::ContactInstant::StepEnd;
    const std::size_t without = atEnd ? 0 : frames - 1;  // no step ends, or begins, there
    depth.values[without] = count.values[without] = kNone;
    result.push_back(std::move(depth));
    result.push_back(std::move(count));
}

}  // namespace

std::vector<Series> diagnosticSeries(const MetricInput& input) {
    std::vector<Series> result;
    if (input.trajectory.frames() == 0) return result;
    addMechanics(input, result);
    if (input.reference) addErrors(input, result);
    addContacts(input, result);
    return result;
}

}  // namespace rigor::validation
