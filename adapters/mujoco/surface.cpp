// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/mujoco/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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

double dampingRatioOf(double restitution) {
    if (restitution >= 1.0) return 0.0;
    const double l = std::log(restitution);
    return -l / std::sqrt(std::numbers::pi * std::numbers::pi + l * l);
}

double restitutionOf(const mjtNum* solref) {
    if (solref[0] >= 0.0) return 0.0;
    const double ratio = -0.5 * solref[1] / std::sqrt(-solref[0]);
    return ratio >= 1.0 ? 0.0 : std::exp(-std::numbers::pi * ratio / std::sqrt(1.0 - ratio * ratio));
}

}  // namespace rigor::mujoco
