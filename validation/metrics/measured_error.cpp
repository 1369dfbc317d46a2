// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Distance of a run from a recorded motion, over the frames that the recording covers. Lengths are in widths
// of the body, so that bodies of any size compare. Source of the loss: Acosta, Yang, Posa, Validating
// Robotics Simulators on Real-World Impacts, IEEE RA-L 7 (2022) 6471; it adds metres and squared angles,
// because it divides by the half width alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "validation/metrics/body_size.hpp"
#include "validation/metrics/metric_parts.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

struct Errors {
    std::vector<double> position, orientation;  ///< [m], [rad]; as many as known
    std::vector<double> times;                  ///< times of the samples
};

Errors errorsOf(const MetricInput& input, int body) {
    Errors errors;
    const std::size_t frames = validFrames(input);
    for (std::size_t k = 0; k < frames; ++k) {
        const double t = input.trajectory.times[k];
        const auto recorded = input.reference->measured(body, t);
        if (!recorded) return {};
        const BodyState& state = input.trajectory.state(k, body);
        errors.times.push_back(t);
        if (const auto e = positionError(state, *recorded)) errors.position.push_back(*e);
        if (const auto e = orientationError(state, *recorded)) errors.orientation.push_back(*e);
    }
    return errors;
}

double meanOf(const std::vector<double>& values, int power) {
    double sum = 0.0;
    for (const double v : values) sum += power == 2 ? v * v : v;
    return sum / values.size();
}

/// One row per compared body that a recording knows; `value` adds its number and when it was met.
template <class Value>
std::vector<MetricValue> rowsOfRecorded(const MetricInput& input, Value value) {
    std::vector<MetricValue> rows;
    if (!input.reference || validFrames(input) < 2) return rows;
    for (const int body : comparedBodies(input)) {
        Worst worst;
        value(body, errorsOf(input, body), worst);
        if (worst.any()) rows.push_back(worst.row(bodyName(input, body)));
    }
    return withWorst(std::move(rows));
}

/// Rows of the bodies whose position was recorded and whose shapes have a width [m] to compare it with.
template <class Value>
std::vector<MetricValue> positionRows(const MetricInput& input, Value value) {
    return rowsOfRecorded(input, [&](int body, const Errors& errors, Worst& worst) {
        const double width = widthOf(input.scenario.bodies[body], input.scenario.dimension);
        if (!errors.position.empty() && width > 0.0 && std::isfinite(width)) value(errors, width, worst);
    });
}

/// Rows of the bodies whose orientation was recorded.
template <class Value>
std::vector<MetricValue> orientationRows(const MetricInput& input, Value value) {
    return rowsOfRecorded(input, [&](int, const Errors& errors, Worst& worst) {
        if (!errors.orientation.empty()) value(errors, worst);
    });
}

void addLargest(const std::vector<double>& values, const std::vector<double>& times, double scale,
                Worst& worst) {
    for (std::size_t k = 0; k < values.size(); ++k) worst.add(values[k] / scale, times[k]);
}

}  // namespace

std::vector<MetricValue> measuredPositionMean(const MetricInput& input) {
    return positionRows(input, [](const Errors& e, double width, Worst& worst) {
        worst.add(meanOf(e.position, 1) / width, -1.0);
    });
}

std::vector<MetricValue> measuredPositionMax(const MetricInput& input) {
    return positionRows(input, [](const Errors& e, double width, Worst& worst) {
        addLargest(e.position, e.times, width, worst);
    });
}

std::vector<MetricValue> measuredPositionFinal(const MetricInput& input) {
    return positionRows(input, [](const Errors& e, double width, Worst& worst) {
        worst.add(e.position.back() / width, e.times.back());
    });
}

std::vector<MetricValue> measuredOrientationMean(const MetricInput& input) {
    return orientationRows(input,
                           [](const Errors& e, Worst& worst) { worst.add(meanOf(e.orientation, 1), -1.0); });
}

std::vector<MetricValue> measuredOrientationRms(const MetricInput& input) {
    return orientationRows(
        input, [](const Errors& e, Worst& worst) { worst.add(std::sqrt(meanOf(e.orientation, 2)), -1.0); });
}

std::vector<MetricValue> measuredOrientationMax(const MetricInput& input) {
    return orientationRows(
        input, [](const Errors& e, Worst& worst) { addLargest(e.orientation, e.times, 1.0, worst); });
}

std::vector<MetricValue> measuredLoss(const MetricInput& input) {
    return positionRows(input, [](const Errors& e, double width, Worst& worst) {
        if (!e.orientation.empty())
            worst.add(meanOf(e.position, 2) / (0.5 * width) + meanOf(e.orientation, 2), -1.0);
    });
}

}  // namespace rigor::validation
