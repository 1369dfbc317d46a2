// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A pair of surfaces in MuJoCo's terms: coefficients of friction, and restitution as a damped spring.
#pragma once

#include "adapters/mujoco/convert.hpp"

namespace rigor::mujoco {

/// Softness of constraints: MuJoCo's solref and solimp.
struct Softness {
    double solref[mjNREF];
    double solimp[mjNIMP];
};

/// Coefficients of a pair, as one contact has them.
struct Surface {
    double friction = 0.0;                  ///< of sliding
    double torsional = 0.0, rolling = 0.0;  ///< [m]
    double restitution = 0.0;
    friend bool operator==(const Surface&, const Surface&) = default;

    /// MuJoCo's condim: 1 without friction, 3 with that of sliding, 4 with that of spinning, 6 with that of rolling.
    int dimension() const;
    Softness softness(const Softness& plain, double bounceFrequency) const;
};

Surface surfaceOf(const scenario::PairCoefficients& pair);

/// A contact that bounces is a spring of angular frequency w with the damping ratio z of e = exp(-pi z / sqrt(1 - z^2)):
/// half a swing returns the part e of the approach speed. MuJoCo takes it as solref = (-w^2, -2 z w).
double dampingRatioOf(double restitution);
double restitutionOf(const mjtNum* solref);

}  // namespace rigor::mujoco
