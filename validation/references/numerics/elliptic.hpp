// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Elliptic integrals and Jacobi elliptic functions of real argument in extended precision, by Boost.Math.
//
// Everywhere the second argument is the PARAMETER m = k^2, 0 <= m < 1, as the formulas of the references have
// it; Boost takes the modulus k first. Notation: Abramowitz and Stegun, Handbook of Mathematical Functions,
// chapters 16 and 17; NIST DLMF, chapters 19 and 22.
#pragma once

#include "validation/references/numerics/real.hpp"

namespace rigor::validation::numerics {

/// Complete integral of the first kind K(m). Throws std::domain_error unless 0 <= m < 1.
Real ellipticK(Real m);
/// Complete integral of the second kind E(m), 0 <= m <= 1.
Real ellipticE(Real m);
/// Incomplete integral of the first kind F(phi | m) for every real phi; odd, F(phi + pi) = F(phi) + 2 K.
Real ellipticF(Real phi, Real m);

struct Jacobi {
    Real sn = 0, cn = 1, dn = 1;
    Real am = 0;  ///< amplitude, continuous in u: sn = sin(am), cn = cos(am)
};
/// Jacobi elliptic functions at u for the parameter m, 0 <= m <= 1 (m = 1: hyperbolic functions).
Jacobi jacobi(Real u, Real m);

}  // namespace rigor::validation::numerics
