// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Elliptic integrals and Jacobi elliptic functions of real argument in extended precision.
//
// Everywhere the second argument is the PARAMETER m = k^2, 0 <= m < 1 (std::ellint_1, Boost and GSL take the
// modulus k). Arithmetic-geometric mean for K, E and the amplitude; descending Landen for F.
// Source: Abramowitz and Stegun, Handbook of Mathematical Functions, 16.4, 17.6; NIST DLMF 19.8, 22.20.
#pragma once

namespace rigor::validation::numerics {

using Real = long double;

inline constexpr Real kPi = 3.14159265358979323846264338327950288L;

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
