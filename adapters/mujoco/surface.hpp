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
    double friction = 0.0;                  ///< coefficient of sliding
    double torsional = 0.0, rolling = 0.0;  ///< [m]
    double restitution = 0.0;
    friend bool operator==(const Surface&, const Surface&) = default;

    /// MuJoCo's condim: 1 without friction, 3 with that of sliding, 4 with that of spinning, 6 with that of rolling.
    int dimension() const;
    Softness softness(const Softness& plain, double bounceFrequency) const;
};

Surface surfaceOf(const scenario::PairCoefficients& pair);

/// A contact that bounces is a damped spring that only pushes: x'' = -w^2 x - 2 z w x' until the force vanishes. The
/// part of the approach speed that it returns [Schwager, Poeschel, Physical Review E 78, 051304, 2008]:
///     e = exp(-z t),   t = acos(2 z^2 - 1) / sqrt(1 - z^2)  for z < 1,   2  for z = 1,
///                          acosh(2 z^2 - 1) / sqrt(z^2 - 1)  for z > 1
/// MuJoCo takes such a spring as solref = (-w^2, -2 z w).
double restitutionOf(double dampingRatio);
/// Its inverse, for 0 < e <= 1.
double dampingRatioOf(double restitution);
/// Restitution of a contact with these solref and solimp of constant impedance; 0 where solref is a time constant.
double restitutionOf(const mjtNum* solref);

}  // namespace rigor::mujoco
