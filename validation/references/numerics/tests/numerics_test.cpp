// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Elliptic functions against defining integrals and identities, the integrator against closed forms.
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <stdexcept>

#include "validation/references/numerics/elliptic.hpp"
#include "validation/references/numerics/linear_system.hpp"
#include "validation/references/numerics/ode.hpp"
#include "validation/references/numerics/principal_axes.hpp"
#include "validation/references/numerics/roots.hpp"
#include "validation/references/numerics/vector.hpp"

namespace rigor::validation::numerics {
namespace {

/// Integral of a smooth function, panel by panel.
template <class Function>
Real integral(const Function& f, Real a, Real b) {
    constexpr int kPanels = 64;
    Real sum = 0;
    for (int i = 0; i < kPanels; ++i)
        sum += boost::math::quadrature::gauss<Real, 30>::integrate(f, a + (b - a) * i / kPanels,
                                                                   a + (b - a) * (i + 1) / kPanels);
    return sum;
}

TEST(Elliptic, CompleteIntegralsAgreeWithTheirDefinition) {
    for (const Real m : {0.0L, 0.1L, 0.5L, 0.9L, 0.999L}) {
        const Real k =
            integral([&](Real a) { return 1 / std::sqrt(1 - m * std::sin(a) * std::sin(a)); }, 0, kPi / 2);
        const Real e =
            integral([&](Real a) { return std::sqrt(1 - m * std::sin(a) * std::sin(a)); }, 0, kPi / 2);
        EXPECT_NEAR(static_cast<double>(ellipticK(m) - k), 0.0, 1e-16 * static_cast<double>(k));
        EXPECT_NEAR(static_cast<double>(ellipticE(m) - e), 0.0, 1e-16);
    }
    // The parameter, not the modulus: K(m = 1/2) = Gamma(1/4)^2/(4 sqrt(pi)).
    EXPECT_NEAR(static_cast<double>(ellipticK(0.5L)), 1.85407467730137191843, 1e-15);
    EXPECT_THROW(ellipticK(1), std::domain_error);
    EXPECT_THROW(ellipticK(std::nanl("")), std::domain_error);
}

TEST(Elliptic, LegendresRelationHolds) {
    for (const Real m : {0.05L, 0.3L, 0.77L}) {
        const Real sum = ellipticE(m) * ellipticK(1 - m) + ellipticE(1 - m) * ellipticK(m) -
                         ellipticK(m) * ellipticK(1 - m);
        EXPECT_NEAR(static_cast<double>(sum - kPi / 2), 0.0, 1e-17);
    }
}

TEST(Elliptic, IncompleteIntegralAgreesWithItsDefinitionForAnyAngle) {
    for (const Real m : {0.0L, 0.2L, 0.95L})
        for (const Real phi : {-7.0L, -1.0L, 0.3L, 1.5L, 2.0L, 4.0L, 12.0L}) {
            const Real f =
                integral([&](Real a) { return 1 / std::sqrt(1 - m * std::sin(a) * std::sin(a)); }, 0, phi);
            EXPECT_NEAR(static_cast<double>(ellipticF(phi, m) - f), 0.0, 1e-15) << static_cast<double>(phi);
        }
}

TEST(Elliptic, JacobiFunctionsInvertTheIntegralAndSolveTheirEquations) {
    for (const Real m : {0.0L, 0.4L, 0.99L, 0.999999L, 1.0L})
        for (const Real u : {-5.0L, -0.2L, 0.7L, 3.0L, 9.0L}) {
            const Jacobi f = jacobi(u, m);
            EXPECT_NEAR(static_cast<double>(f.sn * f.sn + f.cn * f.cn), 1.0, 1e-17);
            EXPECT_NEAR(static_cast<double>(f.dn * f.dn + m * f.sn * f.sn), 1.0, 1e-17);
            if (m < 0.9999L) {
                EXPECT_NEAR(static_cast<double>(ellipticF(f.am, m)), static_cast<double>(u), 1e-15);
            }
            if (m < 1) {  // values at the quarter period, where other forms of dn are 0/0
                const Jacobi quarter = jacobi(ellipticK(m), m);
                EXPECT_NEAR(static_cast<double>(quarter.dn), static_cast<double>(std::sqrt(1 - m)), 1e-12);
                EXPECT_NEAR(static_cast<double>(quarter.am - kPi / 2), 0.0, 1e-12);
            }
            // sn' = cn dn by a fourth-order difference.
            const Real h = 1e-4L;
            const Real slope = (8 * (jacobi(u + h, m).sn - jacobi(u - h, m).sn) -
                                (jacobi(u + 2 * h, m).sn - jacobi(u - 2 * h, m).sn)) /
                               (12 * h);
            EXPECT_NEAR(static_cast<double>(slope), static_cast<double>(f.cn * f.dn), 1e-14);
        }
}

TEST(Ode, HarmonicOscillatorToTwelveDigitsAndBack) {
    const OdeRhs f = [](Real, const OdeState& y, OdeState& d) { d = {y[1], -9 * y[0]}; };
    const OdeState y = integrateOde(f, 0, {1, 0}, 10);
    EXPECT_NEAR(static_cast<double>(y[0] - std::cos(30.0L)), 0.0, 1e-13);
    EXPECT_NEAR(static_cast<double>(y[1] + 3 * std::sin(30.0L)), 0.0, 1e-13);
    const OdeState back = integrateOde(f, 10, y, 0);
    EXPECT_NEAR(static_cast<double>(back[0]), 1.0, 1e-13);
}

TEST(Ode, DenseSolutionAnswersBetweenItsNodesAndAcrossBreaks) {
    const OdeRhs f = [](Real t, const OdeState& y, OdeState& d) { d = {y[0] * std::cos(t)}; };
    const DenseSolution smooth(f, 0, {1}, 20);
    for (Real t = 0; t <= 20; t += 0.0371L)
        EXPECT_NEAR(static_cast<double>(smooth.at(t)[0] - std::exp(std::sin(t))), 0.0, 3e-13);
    const OdeRhs kink = [](Real t, const OdeState&, OdeState& d) { d = {std::abs(t - 1.3L)}; };
    const DenseSolution broken(kink, 0, {0}, 3, 1e-14L, {1.3L});
    for (Real t = 0; t <= 3; t += 0.1L) {
        const Real s = t - 1.3L, exact = (1.69L + (s < 0 ? -s * s : s * s)) / 2;
        EXPECT_NEAR(static_cast<double>(broken.at(t)[0] - exact), 0.0, 1e-14);
    }
}

/// Lorenz 1963: neighbours part by exp(0.9 t).
void lorenz(Real, const OdeState& y, OdeState& d) {
    d = {10 * (y[1] - y[0]), y[0] * (28 - y[2]) - y[1], y[0] * y[1] - 8 * y[2] / 3};
}

TEST(Ode, ASolutionEndsWhereItsNeighbourParts) {
    const OdeState start{1, 1, 1};
    const OdeState scale{10, 10, 10};
    const DenseSolution followed(lorenz, 0, start, 100, 1e-14L, {}, scale,
                                 OdeLimits::neighbourOf(1e-12L, 1e-8L, scale));
    EXPECT_FALSE(followed.isWhole());
    EXPECT_GT(followed.end(), 5);
    EXPECT_LT(followed.end(), 30);
    const Real t = followed.end();
    const OdeState nearest = integrateOde(lorenz, 0, start, t, 1e-18L, 0, scale);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(static_cast<double>(followed.at(t)[i] - nearest[i]), 0.0, 1e-8);
    const OdeRhs regular = [](Real, const OdeState& y, OdeState& d) { d = {y[1], -9 * y[0]}; };
    const DenseSolution whole(regular, 0, {1, 0}, 100, 1e-14L, {}, {1, 3},
                              OdeLimits::neighbourOf(1e-12L, 1e-8L, {1, 3}));
    EXPECT_TRUE(whole.isWhole());
    EXPECT_EQ(whole.end(), 100);
}

TEST(Ode, ASolutionTakesNoMoreEvaluationsThanAllowed) {
    std::size_t count = 0;
    const OdeRhs f = [&count](Real, const OdeState& y, OdeState& d) {
        ++count;
        d = {y[1], -y[0]};
    };
    constexpr std::size_t kMost = 50'000;
    EXPECT_THROW(DenseSolution(f, 0, {1, 0}, 1e4L, 1e-14L, {}, {}, OdeLimits::ofEvaluations(kMost)),
                 std::runtime_error);
    EXPECT_EQ(count, kMost);
    count = 0;
    OdeLimits limits = OdeLimits::neighbourOf(1e-12L, 1e-8L, {});
    limits.evaluations = kMost;
    const DenseSolution part(f, 0, {1, 0}, 1e4L, 1e-14L, {}, {}, limits);
    EXPECT_EQ(count, kMost);
    EXPECT_FALSE(part.isWhole());
    EXPECT_GT(part.end(), 10);
    EXPECT_NEAR(static_cast<double>(part.at(part.end())[0] - std::cos(part.end())), 0.0, 1e-9);
    count = 0;
    const auto always = [](const OdeState&) { return true; };
    const auto pace = [](const OdeState&) { return Real(1); };
    const Real last = lastTimeOf(always, f, 0, {1, 0}, 1e4L, 10, pace, {}, kMost);
    EXPECT_EQ(count, kMost);
    EXPECT_GT(last, 10);
    EXPECT_LT(last, 1e4L);
}

TEST(Ode, ASolutionLooksForTheEndOfAConditionAtEveryNode) {
    // cos(200 t) is positive at every multiple of pi/100, where equal samples might fall.
    const OdeRhs f = [](Real, const OdeState& y, OdeState& d) { d = {y[1], -40000 * y[0]}; };
    const DenseSolution quick(f, 0, {1, 0}, kPi, 1e-14L, {}, {1, 200});
    const auto positive = [](const OdeState& y) { return y[0] > 0; };
    EXPECT_NEAR(static_cast<double>(quick.lastTimeOf(positive, kPi).value()), static_cast<double>(kPi / 400),
                1e-14);
    EXPECT_EQ(quick.lastTimeOf([](const OdeState& y) { return y[0] < 2; }, 2).value(), 2);
    EXPECT_FALSE(quick.lastTimeOf([](const OdeState& y) { return y[0] < 0; }, 2).has_value());
}

TEST(Ode, ASingularityIsReportedNotLoopedOn) {
    const OdeRhs f = [](Real, const OdeState& y, OdeState& d) { d = {y[0] * y[0]}; };  // pole at t = 1
    EXPECT_THROW(integrateOde(f, 0, {1}, 2), std::runtime_error);
}

TEST(Roots, FindRootAndFirstDescent) {
    EXPECT_NEAR(static_cast<double>(findRoot([](Real x) { return std::cos(x) - x; }, 0, 1)),
                0.73908513321516064, 1e-16);
    EXPECT_THROW(findRoot([](Real x) { return x * x + 1; }, 0, 1), std::domain_error);
    // Height 5 + 2 t - 4.905 t^2.
    const auto t = firstDescent(-4.905L, 2, 5);
    ASSERT_TRUE(t.has_value());
    EXPECT_NEAR(static_cast<double>(5 + 2 * *t - 4.905L * *t * *t), 0.0, 1e-17);
    EXPECT_GT(*t, 0);
    EXPECT_FALSE(firstDescent(1, 1, 1).has_value());                        // grows
    EXPECT_FALSE(firstDescent(1, -1, 1).has_value());                       // misses
    EXPECT_NEAR(static_cast<double>(*firstDescent(1, -3, 2)), 1.0, 1e-17);  // first of 1 and 2
    EXPECT_NEAR(static_cast<double>(*firstDescent(-1, 2, 0)), 2.0, 1e-17);  // thrown up from the floor
    EXPECT_EQ(*firstDescent(0, -1, 0), 0);
}

/// Hilbert's matrix of order 6, condition 1.5e7, against its inverse of integers; equations in other units
/// have the same solution, and a matrix of rank 5 is recognised even where rounding leaves no exact zero.
TEST(LinearSystem, SolvesInAnyUnitsAndFindsSingularMatrices) {
    constexpr int kOrder = 6;
    const double inverseOfLast[kOrder] = {-2772, 83160, -582120, 1552320, -1746360, 698544};
    Matrix hilbert(kOrder, kOrder);
    for (int i = 0; i < kOrder; ++i)
        for (int j = 0; j < kOrder; ++j) hilbert(i, j) = 1 / static_cast<Real>(i + j + 1);
    Vector last = Vector::Unit(kOrder, kOrder - 1);
    const auto x = solveDense(hilbert, last);
    ASSERT_TRUE(x.has_value());
    for (int i = 0; i < kOrder; ++i)
        EXPECT_NEAR(static_cast<double>((*x)[i] / inverseOfLast[i]), 1.0, 1e-11) << i;
    Matrix scaled = hilbert;
    Vector right = last;
    scaled.row(2) *= 1e-30L;
    scaled.row(5) *= 1e30L;
    right[5] *= 1e30L;
    const auto same = solveDense(scaled, right);
    ASSERT_TRUE(same.has_value());
    for (int i = 0; i < kOrder; ++i)
        EXPECT_NEAR(static_cast<double>((*same)[i] / inverseOfLast[i]), 1.0, 1e-11) << i;
    Matrix deficient = Matrix::Random(kOrder, kOrder);
    deficient.row(4) = 0.3L * deficient.row(0) - 0.7L * deficient.row(2);
    EXPECT_FALSE(solveDense(deficient, last).has_value());
    EXPECT_FALSE(solveDense(Matrix::Zero(2, 2), Vector::Zero(2)).has_value());
}

TEST(LinearSystem, OfThreeUnknowns) {
    const Real33 m{Real3{2, 1, -1}, Real3{0.5L, 3, 0.25L}, Real3{-1, 0.75L, 4}};
    const Real3 x{1.5L, -2.25L, 0.125L}, found = solve(m, m * x);
    EXPECT_NEAR(static_cast<double>(norm(found - x)), 0.0, 1e-17);
    EXPECT_THROW(solve({Real3{1, 2, 3}, Real3{2, 4, 6}, Real3{0, 1, 0}}, x), std::runtime_error);
}

TEST(Eigen, PrincipalAxesRebuildTheTensor) {
    scenario::Mat3 tensor;
    const double values[3][3] = {{2.0, 0.3, -0.1}, {0.3, 1.5, 0.2}, {-0.1, 0.2, 1.1}};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) tensor(i, j) = values[i][j];
    const PrincipalAxes p = principalAxes(tensor);
    const auto again =
        p.axes * scenario::Mat3::diagonal(p.values.x, p.values.y, p.values.z) * transpose(p.axes);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(again(i, j), values[i][j], 1e-15);
    EXPECT_LE(p.values.x, p.values.y);
    EXPECT_LE(p.values.y, p.values.z);
    const auto matrix = scenario::toMatrix(toQuaternion(p.axes));
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(matrix(i, j), p.axes(i, j), 1e-15);
}

/// Round trip over all four branches: near the identity and by half turns about every axis.
TEST(Eigen, QuaternionsOfAnyRotation) {
    for (int i = 0; i < 200; ++i) {
        const double a = 0.7 * i, b = 0.43 * i;
        const scenario::Vec3 axis{std::cos(a) * std::sin(b), std::sin(a) * std::sin(b), std::cos(b)};
        const scenario::Quat q = scenario::fromAxisAngle(axis, i % 2 ? 3.1 : 0.11 * i);
        const scenario::Quat back = toQuaternion(scenario::toMatrix(q));
        const double cosine = q.w * back.w + q.x * back.x + q.y * back.y + q.z * back.z;
        EXPECT_NEAR(std::abs(cosine), 1, 1e-14) << i;
    }
}

}  // namespace
}  // namespace rigor::validation::numerics
