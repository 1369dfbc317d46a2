// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Roots, extended precision. Source: Alefeld, Potra, Shi, ACM Trans. Math. Softw. 21 (1995) 327 (algorithm
// 748, as in Boost.Math).
#pragma once

#include <functional>
#include <optional>

#include "validation/references/numerics/real.hpp"

namespace rigor::validation::numerics {

/// The root of a continuous f in [a, b] with f(a) f(b) <= 0, to the last bits. Throws std::domain_error
/// without a sign change.
Real findRoot(const std::function<Real(Real)>& f, Real a, Real b);

/// The smallest t >= 0 with a t^2 + b t + c = 0 where the value goes from >= 0 to < 0 (an approach), given
/// c >= 0: first time a distance c + b t + a t^2 reaches zero while shrinking. Empty if never.
std::optional<Real> firstDescent(Real a, Real b, Real c);

}  // namespace rigor::validation::numerics
