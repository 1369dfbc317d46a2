// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Errors of position, velocity, orientation and spin against the exact solution and, kept apart, against an
// ideal run of the engine's own scheme. Formulas stand in metrics.def. Source: the geodesic angle: Huynh, J.
// Math. Imaging Vis. 35 (2009) 155.
#include "validation/metrics/metric_parts.hpp"

namespace rigor::validation {

using Rows = std::vector<MetricValue>;

Rows positionFinal(const MetricInput& input) {
    return stateErrors(input, positionError, Over::Final, false);
}
Rows positionMax(const MetricInput& input) {
    return stateErrors(input, positionError, Over::Max, false);
}
Rows positionRmse(const MetricInput& input) {
    return stateErrors(input, positionError, Over::Rms, false);
}
Rows velocityFinal(const MetricInput& input) {
    return stateErrors(input, velocityError, Over::Final, false);
}
Rows velocityMax(const MetricInput& input) {
    return stateErrors(input, velocityError, Over::Max, false);
}
Rows orientationFinal(const MetricInput& input) {
    return stateErrors(input, orientationError, Over::Final, false);
}
Rows orientationMax(const MetricInput& input) {
    return stateErrors(input, orientationError, Over::Max, false);
}
Rows spinFinal(const MetricInput& input) {
    return stateErrors(input, spinError, Over::Final, false);
}

Rows schemePositionFinal(const MetricInput& input) {
    return stateErrors(input, positionError, Over::Final, true);
}
Rows schemePositionMax(const MetricInput& input) {
    return stateErrors(input, positionError, Over::Max, true);
}
Rows schemeVelocityMax(const MetricInput& input) {
    return stateErrors(input, velocityError, Over::Max, true);
}
Rows schemeOrientationMax(const MetricInput& input) {
    return stateErrors(input, orientationError, Over::Max, true);
}

}  // namespace rigor::validation
