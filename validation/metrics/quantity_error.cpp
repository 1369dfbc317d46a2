// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Errors of the named quantities of a reference: stopping distances, event times, velocities after an impact.
#include <cmath>

#include "validation/metrics/metric_parts.hpp"

namespace rigor::validation {
namespace {

/// There are contacts, and none of them has an impulse: the engine reports none.
bool lacksImpulses(const Trajectory& run) {
    bool touches = false;
    for (const auto& contacts : run.contacts)
        for (const auto& contact : contacts) {
            if (contact.hasImpulse) return false;
            touches = true;
        }
    return touches;
}

std::vector<MetricValue> relativeErrors(const MetricInput& input, bool scheme) {
    std::vector<MetricValue> rows;
    if (!input.reference || input.trajectory.frames() < 2) return rows;
    for (const auto& q : input.reference->quantities(input.trajectory.dt, input.scheme)) {
        if (!q.measure || (scheme && !q.schemeExact)) continue;
        if (q.needsImpulses && lacksImpulses(input.trajectory)) continue;
        const double expected = scheme ? *q.schemeExact : q.exact;
        const auto measured = q.measure(input.trajectory);
        Worst worst;
        worst.add(measured ? std::abs(*measured - expected) / scaleOf(q, expected) : 1.0, -1.0);
        rows.push_back(worst.row(q.name));
    }
    return withWorst(std::move(rows));
}

}  // namespace

double scaleOf(const Quantity& q, double expected) {
    const double scale = q.scale > 0.0 ? q.scale : std::abs(expected);
    return scale > 0.0 ? scale : 1.0;
}

std::vector<MetricValue> quantityError(const MetricInput& input) {
    return relativeErrors(input, false);
}

std::vector<MetricValue> schemeQuantityError(const MetricInput& input) {
    return relativeErrors(input, true);
}

std::vector<MetricValue> eventTimeError(const MetricInput& input) {
    std::vector<MetricValue> rows;
    if (!input.reference || input.trajectory.frames() < 2) return rows;
    for (const auto& q : input.reference->quantities(input.trajectory.dt, input.scheme)) {
        if (!q.measure || q.unit != "s") continue;
        const auto measured = q.measure(input.trajectory);
        Worst worst;
        worst.add(measured ? std::abs(*measured - q.exact) : input.scenario.duration, q.exact);
        rows.push_back(worst.row(q.name));
    }
    return withWorst(std::move(rows));
}

}  // namespace rigor::validation
