// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Quadrature of smooth functions and root finding, extended precision.
// Source: Golub and Welsch, Math. Comp. 23 (1969) 221 (Gauss-Legendre; nodes here by Newton's method on the
// Legendre recursion); Brent, Algorithms for Minimization without Derivatives, 1973 (bracketing).
#pragma once

#include <functional>
#include <optional>

#include "validation/references/numerics/elliptic.hpp"

namespace rigor::validation::numerics {

/// Integral of f over [a, b] by composite 20-point Gauss-Legendre, panels doubled until two results agree to
/// `tolerance` (absolute).
Real integrate(const std::function<Real(Real)>& f, Real a, Real b, Real tolerance = 1e-16L);

/// The root of a continuous f in [a, b] with f(a) f(b) <= 0, to the last bits (bisection with secant steps).
/// Throws std::domain_error without a sign change.
Real findRoot(const std::function<Real(Real)>& f, Real a, Real b);

/// The smallest t >= 0 with a t^2 + b t + c = 0 where the value goes from >= 0 to < 0 (an approach), given
/// c >= 0: first time a distance c + b t + a t^2 reaches zero while shrinking. Empty if never.
std::optional<Real> firstDescent(Real a, Real b, Real c);

}  // namespace rigor::validation::numerics
