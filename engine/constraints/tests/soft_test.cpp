// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Soft rows against the spring that they stand for: the implicit step, the oscillator, the limits of stiffness.
#include "engine/constraints/soft.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rigor::engine {
namespace {

constexpr double kTwoPi = 6.283185307179586;

/// A point of mass m [kg] at x on a soft row C = x, J = 1.
struct Oscillator {
    double m = 1, x = 0, v = 0;
    /// One step of h: solves J v + bias + gamma lambda = 0 with m (v - v0) = lambda exactly.
    void step(const SoftTerms<double>& soft, double h) {
        const double lambda = -(v + soft.biasRate * x) / (1 / m + soft.gamma);
        v += lambda / m;
        x += h * v;
    }
    double energy(double k) const { return 0.5 * m * v * v + 0.5 * k * x * x; }
};

/// The row is the implicit Euler step m (v' - v) = -h (k (x + h v') + c v') of spring and damper, whatever h.
TEST(SpringTerms, AreTheImplicitStepOfSpringAndDamper) {
    for (const double m : {0.1, 1.0, 30.0})
        for (const double k : {0.0, 1.0, 1e3, 1e8})
            for (const double c : {0.0, 0.3, 50.0})
                for (const double h : {1e-4, 1e-2, 1.0}) {
                    if (k == 0 && c == 0) continue;
                    Oscillator point{m, 0.7, -1.3};
                    const double x = point.x, v = point.v;
                    point.step(springTerms(k, c, h), h);
                    const double implicit = (m * v - h * k * x) / (m + h * c + h * h * k);
                    EXPECT_NEAR(point.v, implicit, 1e-12 * (1 + std::abs(implicit)))
                        << "m " << m << " k " << k << " c " << c << " h " << h;
                }
}

/// k = m omega^2, c = 2 m zeta omega for the effective mass m = 1/K.
TEST(SoftTerms, AreSpringTermsOfTheEffectiveMass) {
    for (const double K : {0.01, 1.0, 40.0})
        for (const double frequency : {0.5, 30.0, 500.0})
            for (const double dampingRatio : {0.0, 0.2, 1.0, 10.0})
                for (const double h : {1e-4, 1.0 / 60}) {
                    const double m = 1 / K, omega = kTwoPi * frequency;
                    const SoftTerms<double> soft = softTerms(Softness<double>{frequency, dampingRatio}, K, h);
                    const SoftTerms<double> spring =
                        springTerms(m * omega * omega, 2 * m * dampingRatio * omega, h);
                    EXPECT_NEAR(soft.biasRate / spring.biasRate, 1, 1e-12);
                    EXPECT_NEAR(soft.gamma / spring.gamma, 1, 1e-12);
                    const SoftTerms<float> single = softTerms(
                        Softness<float>{static_cast<float>(frequency), static_cast<float>(dampingRatio)},
                        static_cast<float>(K), static_cast<float>(h));
                    EXPECT_NEAR(static_cast<double>(single.biasRate) / soft.biasRate, 1, 1e-6);
                    EXPECT_NEAR(static_cast<double>(single.gamma) / soft.gamma, 1, 1e-6);
                }
}

/// The error to x(t) = e^(-zeta w t) (...) halves with the step: the first order of implicit Euler.
TEST(SoftTerms, ConvergeToTheDampedOscillator) {
    const double frequency = 2, zeta = 0.1, omega = kTwoPi * frequency, end = 0.8, m = 3;
    const double damped = omega * std::sqrt(1 - zeta * zeta);
    const double exact = std::exp(-zeta * omega * end) *
                         (std::cos(damped * end) + zeta * omega / damped * std::sin(damped * end));
    std::vector<double> errors;
    for (const int steps : {2000, 4000, 8000}) {
        const double h = end / steps;
        Oscillator point{m, 1, 0};
        const SoftTerms<double> soft = softTerms(Softness<double>{frequency, zeta}, 1 / m, h);
        for (int i = 0; i < steps; ++i) point.step(soft, h);
        errors.push_back(std::abs(point.x - exact));
    }
    EXPECT_LT(errors.back(), 5e-3);
    EXPECT_NEAR(errors[0] / errors[1], 2, 0.1);
    EXPECT_NEAR(errors[1] / errors[2], 2, 0.1);
}

/// However stiff the spring and large the step, energy never grows, and an overdamped point does not overshoot.
TEST(SoftTerms, NeverGainEnergy) {
    for (const double frequency : {1.0, 60.0, 1e4})
        for (const double zeta : {0.0, 1.0, 10.0})
            for (const double h : {1e-3, 1.0 / 60, 1.0}) {
                const double omega = kTwoPi * frequency, k = omega * omega;
                Oscillator point{1, 1, 0};
                const SoftTerms<double> soft = softTerms(Softness<double>{frequency, zeta}, 1.0, h);
                double before = point.energy(k);
                for (int i = 0; i < 200; ++i) {
                    point.step(soft, h);
                    ASSERT_LE(point.energy(k), before * (1 + 1e-12)) << frequency << " Hz, h " << h;
                    before = point.energy(k);
                    if (zeta >= 1) {
                        ASSERT_GE(point.x, 0) << "overshoots at " << frequency << " Hz, h " << h;
                    }
                }
            }
}

/// The stiffer the spring, the more it is a rigid row whose error is removed in one step.
TEST(SoftTerms, OfHighFrequencyAreRigid) {
    const double h = 1.0 / 60;
    double last = 1;
    for (const double frequency : {10.0, 1e2, 1e4, 1e6}) {
        const SoftTerms<double> soft = softTerms(Softness<double>{frequency, 1}, 1.0, h);
        Oscillator point{1, 1, 0};
        point.step(soft, h);
        EXPECT_LT(std::abs(point.x), last);
        last = std::abs(point.x);
    }
    EXPECT_LT(last, 1e-4);
}

}  // namespace
}  // namespace rigor::engine
