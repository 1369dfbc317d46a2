// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The arithmetic-geometric mean a(n+1) = (a + b)/2, b(n+1) = sqrt(a b), c(n+1) = (a - b)/2 converges
// quadratically; the amplitude follows from phi(N) = 2^N a(N) u by the descending recursion
// sin(2 phi(n-1) - phi(n)) = c(n)/a(n) sin(phi(n)).
#include "validation/references/numerics/elliptic.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace rigor::validation::numerics {
namespace {

constexpr int kMaxLevels = 40;
constexpr Real kEpsilon = std::numeric_limits<Real>::epsilon();

void requireParameter(Real m, bool oneAllowed) {
    if (!(m >= 0 && (m < 1 || (oneAllowed && m == 1))))
        throw std::domain_error("elliptic function: parameter m outside [0, 1)");
}

}  // namespace

Real ellipticK(Real m) {
    requireParameter(m, false);
    Real a = 1, b = std::sqrt(1 - m);
    for (int i = 0; i < kMaxLevels && std::abs(a - b) > 2 * kEpsilon * a; ++i) {
        const Real mean = (a + b) / 2;
        b = std::sqrt(a * b);
        a = mean;
    }
    return kPi / (a + b);
}

Real ellipticE(Real m) {
    requireParameter(m, true);
    if (m == 1) return 1;
    Real a = 1, b = std::sqrt(1 - m), weight = 0.5L, sum = weight * m;
    for (int i = 0; i < kMaxLevels && std::abs(a - b) > 2 * kEpsilon * a; ++i) {
        const Real c = (a - b) / 2, mean = (a + b) / 2;
        b = std::sqrt(a * b);
        a = mean;
        weight *= 2;
        sum += weight * c * c;
    }
    return (1 - sum) * kPi / (a + b);
}

Real ellipticF(Real phi, Real m) {
    requireParameter(m, false);
    // tan(phi(n+1) - phi(n)) = (b/a) tan(phi(n)), on the branch that keeps phi(n+1) close to 2 phi(n).
    Real a = 1, b = std::sqrt(1 - m), angle = phi, scale = 1;
    for (int i = 0; i < kMaxLevels && std::abs(a - b) > 2 * kEpsilon * a; ++i) {
        const Real turns = std::round(angle / kPi), rest = angle - turns * kPi;
        angle += std::atan2(b * std::sin(rest), a * std::cos(rest)) + turns * kPi;
        const Real mean = (a + b) / 2;
        b = std::sqrt(a * b);
        a = mean;
        scale *= 2;
    }
    return angle / (scale * a);
}

Jacobi jacobi(Real u, Real m) {
    requireParameter(m, true);
    if (m == 1) {
        const Real sech = 1 / std::cosh(u), tanh = std::tanh(u);
        return {tanh, sech, sech, std::atan2(tanh, sech)};
    }
    std::array<Real, kMaxLevels + 1> a{}, c{};
    a[0] = 1;
    Real b = std::sqrt(1 - m), scale = 1;
    int n = 0;
    while (n < kMaxLevels &&
           std::abs(a[static_cast<std::size_t>(n)] - b) > 2 * kEpsilon * a[static_cast<std::size_t>(n)]) {
        const auto i = static_cast<std::size_t>(n);
        a[i + 1] = (a[i] + b) / 2;
        c[i + 1] = (a[i] - b) / 2;
        b = std::sqrt(a[i] * b);
        scale *= 2;
        ++n;
    }
    Real phi = scale * a[static_cast<std::size_t>(n)] * u;
    for (; n > 0; --n) {
        const auto i = static_cast<std::size_t>(n);
        phi = (phi + std::asin(c[i] / a[i] * std::sin(phi))) / 2;
    }
    const Real sn = std::sin(phi), cn = std::cos(phi);
    return {sn, cn, std::sqrt(cn * cn + (1 - m) * sn * sn), phi};
}

}  // namespace rigor::validation::numerics
