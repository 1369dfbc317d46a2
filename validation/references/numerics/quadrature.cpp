// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See quadrature.hpp for methods and sources.
#include "validation/references/numerics/quadrature.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace rigor::validation::numerics {
namespace {

constexpr int kPoints = 20;

struct Rule {
    std::array<Real, kPoints> node{}, weight{};
};

Rule legendreRule() {
    Rule rule;
    for (int i = 0; i < kPoints; ++i) {
        Real x = std::cos(kPi * (i + 0.75L) / (kPoints + 0.5L)), slope = 1;
        for (int newton = 0; newton < 30; ++newton) {
            Real p = 1, before = 0;
            for (int n = 1; n <= kPoints; ++n) {
                const Real next = ((2 * n - 1) * x * p - (n - 1) * before) / n;
                before = p;
                p = next;
            }
            slope = kPoints * (x * p - before) / (x * x - 1);
            const Real dx = p / slope;
            x -= dx;
            if (std::abs(dx) < 1e-19L) break;
        }
        rule.node[static_cast<std::size_t>(i)] = x;
        rule.weight[static_cast<std::size_t>(i)] = 2 / ((1 - x * x) * slope * slope);
    }
    return rule;
}

Real composite(const std::function<Real(Real)>& f, Real a, Real b, int panels) {
    static const Rule rule = legendreRule();
    const Real half = (b - a) / (2 * panels);
    Real sum = 0;
    for (int p = 0; p < panels; ++p) {
        const Real middle = a + (2 * p + 1) * half;
        for (std::size_t i = 0; i < kPoints; ++i) sum += rule.weight[i] * f(middle + half * rule.node[i]);
    }
    return sum * half;
}

}  // namespace

Real integrate(const std::function<Real(Real)>& f, Real a, Real b, Real tolerance) {
    if (a == b) return 0;
    Real coarse = composite(f, a, b, 1);
    for (int panels = 2; panels <= 4096; panels *= 2) {
        const Real fine = composite(f, a, b, panels);
        if (std::abs(fine - coarse) <= tolerance + 4e-19L * std::abs(fine)) return fine;
        coarse = fine;
    }
    return coarse;
}

Real findRoot(const std::function<Real(Real)>& f, Real a, Real b) {
    Real fa = f(a), fb = f(b);
    if (fa == 0) return a;
    if (fb == 0) return b;
    if (!(fa * fb < 0)) throw std::domain_error("findRoot: no sign change in the bracket");
    for (int i = 0; i < 300; ++i) {
        // Alternate secant and bisection: the secant converges fast, the bisection always shrinks the
        // bracket.
        Real x = (a + b) / 2;
        if (i % 2 == 1) {
            const Real secant = a - fa * (b - a) / (fb - fa);
            if ((secant - a) * (secant - b) < 0) x = secant;
        }
        const Real fx = f(x);
        if (fx == 0) return x;
        if (fa * fx < 0) {
            b = x;
            fb = fx;
        } else {
            a = x;
            fa = fx;
        }
        if (std::abs(b - a) <= 2e-19L * (std::abs(a) + std::abs(b))) break;
    }
    return std::abs(fa) < std::abs(fb) ? a : b;
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
    // With c > 0 the first positive root is where the value descends through zero.
    if (a < 0) return b <= 0 ? 2 * c / (root - b) : (-b - root) / (2 * a);
    if (b >= 0) return std::nullopt;
    return discriminant == 0 ? std::nullopt : std::optional<Real>(2 * c / (root - b));
}

}  // namespace rigor::validation::numerics
