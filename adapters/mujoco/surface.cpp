// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/mujoco/surface.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::mujoco {

Surface surfaceOf(const scenario::PairCoefficients& pair) {
    return {pair.friction, pair.torsionalFriction, pair.rollingFriction, pair.restitution};
}

int Surface::dimension() const {
    if (rolling > 0.0) return 6;
    if (torsional > 0.0) return 4;
    return friction > 0.0 ? 3 : 1;
}

Softness Surface::softness(const Softness& plain, double bounceFrequency) const {
    if (restitution == 0.0) return plain;
    Softness bouncing = plain;
    bouncing.solref[0] = -bounceFrequency * bounceFrequency;
    // Both numbers have to be negative for MuJoCo to take them as stiffness and damping.
    bouncing.solref[1] = -std::max(2.0 * dampingRatioOf(restitution) * bounceFrequency, 1e-12);
    // A constant impedance leaves stiffness and damping alone.
    bouncing.solimp[0] = bouncing.solimp[1] = 0.99;
    return bouncing;
}

double restitutionOf(double z) {
    if (z <= 0.0) return 1.0;
    const double cosine = 2.0 * z * z - 1.0;
    double time = 2.0;
    if (z < 1.0) time = std::acos(cosine) / std::sqrt(1.0 - z * z);
    if (z > 1.0) time = std::acosh(cosine) / std::sqrt(z * z - 1.0);
    return std::exp(-z * time);
}

/// Bisection: e falls with the ratio.
double dampingRatioOf(double restitution) {
    if (restitution >= 1.0) return 0.0;
    double low = 0.0, high = 1.0;
    while (restitutionOf(high) > restitution) high *= 2.0;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (restitutionOf(middle) > restitution ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double restitutionOf(const mjtNum* solref) {
    return solref[0] < 0.0 ? restitutionOf(-0.5 * solref[1] / std::sqrt(-solref[0])) : 0.0;
}

}  // namespace rigor::mujoco
