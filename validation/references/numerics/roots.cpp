// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See roots.hpp.
#include "validation/references/numerics/roots.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

namespace rigor::validation::numerics {

Real findRoot(const std::function<Real(Real)>& f, Real a, Real b) {
    if (a > b) std::swap(a, b);
    const Real fa = f(a), fb = f(b);
    if (fa == 0) return a;
    if (fb == 0) return b;
    if (!(fa < 0 && fb > 0) && !(fa > 0 && fb < 0))
        throw std::domain_error("findRoot: no sign change in the bracket");
    std::uintmax_t calls = 300;
    const auto [low, high] = boost::math::tools::toms748_solve(
        f, a, b, fa, fb, boost::math::tools::eps_tolerance<Real>(std::numeric_limits<Real>::digits), calls);
    return std::abs(f(low)) < std::abs(f(high)) ? low : high;
}

std::optional<Real> firstDescent(Real a, Real b, Real c) {
    if (c <= 0) {
        // Touching: it descends at once, or leaves and comes back.
        if (b < 0 || (b == 0 && a < 0)) return Real(0);
        if (a < 0 && b > 0) return -b / a;
        return std::nullopt;
    }
    if (a == 0) return b < 0 ? std::optional<Real>(-c / b) : std::nullopt;
    const Real discriminant = b * b - 4 * a * c;
    if (discriminant < 0) return std::nullopt;
    const Real root = std::sqrt(discriminant);
    // The case c > 0: the first positive root is where the value descends through zero.
    if (a < 0) return b <= 0 ? 2 * c / (root - b) : (-b - root) / (2 * a);
    if (b >= 0) return std::nullopt;
    return discriminant == 0 ? std::nullopt : std::optional<Real>(2 * c / (root - b));
}

}  // namespace rigor::validation::numerics
