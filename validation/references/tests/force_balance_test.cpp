// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Linear programs against all vertices, and under degeneracy; the exact checks of forces and motions.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "validation/references/statics/contact_forces.hpp"

namespace rigor::validation {
namespace {

using numerics::LinearProgram;
using numerics::Real;
using numerics::Real3;

/// Dense rows to columns.
LinearProgram programOf(const std::vector<std::vector<Real>>& rows, const std::vector<Real>& right) {
    LinearProgram program(right);
    for (std::size_t j = 0; j < rows[0].size(); ++j) {
        LinearProgram::Column column;
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (rows[i][j] != 0) column.push_back({i, rows[i][j]});
        program.addColumn(column);
    }
    return program;
}
Real largestViolation(const std::vector<std::vector<Real>>& rows, const std::vector<Real>& y,
                      const std::vector<Real>& cost) {
    Real most = -1e30L;
    for (std::size_t j = 0; j < rows[0].size(); ++j) {
        Real sum = -cost[j];
        for (std::size_t i = 0; i < rows.size(); ++i) sum += y[i] * rows[i][j];
        most = std::max(most, sum);
    }
    return most;
}

TEST(LinearProgram, AgreesWithAllVerticesOfSmallPrograms) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    int feasible = 0;
    for (int round = 0; round < 300; ++round) {
        const std::size_t m = 2, n = 5;
        std::vector<std::vector<Real>> a(m, std::vector<Real>(n));
        std::vector<Real> b(m), c(n);
        for (auto& row : a)
            for (Real& v : row) v = number(random);
        for (Real& v : b) v = number(random);
        for (Real& v : c) v = 1 + number(random);  // bounded below
        // Every basis of two columns.
        Real best = 1e30L;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = i + 1; j < n; ++j) {
                const Real det = a[0][i] * a[1][j] - a[0][j] * a[1][i];
                const Real x = (b[0] * a[1][j] - a[0][j] * b[1]) / det,
                           y = (a[0][i] * b[1] - b[0] * a[1][i]) / det;
                if (x >= 0 && y >= 0) best = std::min(best, c[i] * x + c[j] * y);
            }
        LinearProgram program = programOf(a, b);
        ASSERT_EQ(program.reduceViolation(), LinearProgram::Status::Optimal);
        const std::vector<Real> y = program.multipliers();
        const Real gain = y[0] * b[0] + y[1] * b[1];
        EXPECT_NEAR(static_cast<double>(gain - program.violation()), 0.0, 1e-15);
        EXPECT_LT(largestViolation(a, y, std::vector<Real>(n, 0)), 1e-15L);
        EXPECT_EQ(program.violation() < 1e-15L, best < 1e29L);
        if (best > 1e29L) continue;
        ++feasible;
        ASSERT_EQ(program.minimise(c), LinearProgram::Status::Optimal);
        const auto x = program.point();
        const auto multipliers = program.multipliers();
        Real value = 0;
        for (std::size_t j = 0; j < n; ++j) value += c[j] * x[j];
        EXPECT_NEAR(static_cast<double>(value), static_cast<double>(best), 1e-15);
        EXPECT_LT(largestViolation(a, multipliers, c), 1e-15L);
        EXPECT_NEAR(static_cast<double>(multipliers[0] * b[0] + multipliers[1] * b[1]),
                    static_cast<double>(best), 1e-15);
        EXPECT_LT(program.violation(), 1e-16L);
    }
    EXPECT_GT(feasible, 50);
    LinearProgram ray = programOf({{1, -1}}, {0});
    ASSERT_EQ(ray.reduceViolation(), LinearProgram::Status::Optimal);
    EXPECT_EQ(ray.minimise({-1, 0}), LinearProgram::Status::Unbounded);
}

TEST(LinearProgram, EndsWhereDantzigsRuleCycles) {
    // Beale's example: with the least reduced cost and the first row among ties the method runs in a circle.
    const std::vector<std::vector<Real>> a{
        {1, 0, 0, 0.25L, -8, -1, 9}, {0, 1, 0, 0.5L, -12, -0.5L, 3}, {0, 0, 1, 0, 0, 1, 0}};
    LinearProgram program = programOf(a, {0, 0, 1});
    ASSERT_EQ(program.reduceViolation(), LinearProgram::Status::Optimal);
    const std::vector<Real> cost{0, 0, 0, -0.75L, 20, -0.5L, 6};
    ASSERT_EQ(program.minimise(cost), LinearProgram::Status::Optimal);
    const auto x = program.point();
    Real value = 0;
    for (std::size_t j = 0; j < x.size(); ++j) value += cost[j] * x[j];
    EXPECT_NEAR(static_cast<double>(value), -1.25, 1e-15);
}

TEST(LinearProgram, TakesColumnsBetweenCallsAndRowsThatRepeat) {
    // Twice the same row: one artificial unknown stays in the basis at zero.
    LinearProgram program({1, 1});
    program.addColumn({{0, 1}, {1, 1}});
    ASSERT_EQ(program.reduceViolation(), LinearProgram::Status::Optimal);
    EXPECT_EQ(program.violation(), 0);
    ASSERT_EQ(program.minimise({3}), LinearProgram::Status::Optimal);
    program.addColumn({{0, 0.5L}, {1, 0.5L}});
    ASSERT_EQ(program.minimise({3, 1}), LinearProgram::Status::Optimal);
    EXPECT_NEAR(static_cast<double>(program.point()[1]), 2.0, 1e-15);
    // A column that breaks one of them cannot enter with a step.
    program.addColumn({{0, 1}});
    ASSERT_EQ(program.minimise({3, 1, -5}), LinearProgram::Status::Optimal);
    EXPECT_EQ(program.point()[2], 0);
}

/// A block of weight 2 on a slope of the given tangent, held at its two lower corners.
LoadedBodies blockOnSlope(int dimension, double slope, double friction) {
    LoadedBodies problem;
    problem.dimension = dimension;
    const double c = 1 / std::hypot(1, slope), s = slope * c;
    problem.bodies = {{{0.25 * -s, 0.25 * c, 0}, {0, -2, 0}, {}, 1.0, 2.0}};
    for (const double along : {-0.5, 0.5}) {
        for (const double depth : {-0.5, 0.5})
            if (dimension == 3 || depth > 0)
                problem.contacts.push_back(
                    {-1, 0, 0, {along * c, along * s, dimension == 3 ? depth : 0}, {-s, c, 0}, friction});
    }
    return problem;
}

TEST(ForceBalance, ABlockOnASlopeHoldsUpToTheAngleOfFriction) {
    for (const int dimension : {2, 3}) {
        const double near = dimension == 2 ? 1e-7 : 1e-5;
        const LoadedBodies holds = blockOnSlope(dimension, 0.4, 0.4 * (1 + near)),
                           slides = blockOnSlope(dimension, 0.4, 0.4 * (1 - near));
        EXPECT_EQ(ContactForces(holds).verdict(), ContactForces::Verdict::Balance) << dimension;
        EXPECT_EQ(ContactForces(slides).verdict(), ContactForces::Verdict::Move) << dimension;
        ContactForces forces(holds);
        const auto known = forces.determinate();
        ASSERT_EQ(known.size(), 1u);
        EXPECT_NEAR(known.at(0), 2 / std::hypot(1, 0.4), 1e-8);
    }
}

TEST(ForceBalance, ForcesAreCheckedForBalanceConeAndSign) {
    const LoadedBodies problem = blockOnSlope(2, 0, 0.4);
    EXPECT_TRUE(balance(problem, {{0, 1, 0}, {0, 1, 0}}));
    EXPECT_TRUE(balance(problem, {{0.3L, 1, 0}, {-0.3L, 1, 0}}));
    EXPECT_TRUE(balance(problem, {{0, 1 + 1e-12L, 0}, {0, 1, 0}}));
    EXPECT_FALSE(balance(problem, {{0, 1 + 1e-10L, 0}, {0, 1, 0}}));    // force
    EXPECT_FALSE(balance(problem, {{0, 1.5L, 0}, {0, 0.5L, 0}}));       // torque
    EXPECT_FALSE(balance(problem, {{0.401L, 1, 0}, {-0.401L, 1, 0}}));  // cone
    LoadedBodies pulled = problem;
    pulled.contacts.push_back({-1, 0, 0, {0, 0.5, 0}, {0, -1, 0}, 0.4});
    EXPECT_TRUE(balance(pulled, {{0, 2, 0}, {0, 2, 0}, {0, -2, 0}}));
    EXPECT_FALSE(balance(pulled, {{0, 0.5L, 0}, {0, 0.5L, 0}, {0, 1, 0}}));  // a pull
    // forces far above any load
    EXPECT_FALSE(balance(pulled, {{0, 4e6L, 0}, {0, 4e6L, 0}, {0, -8e6L + 2, 0}}));
}

TEST(ForceBalance, MotionsAreCheckedForGainAndContacts) {
    const LoadedBodies steep = blockOnSlope(2, 0.5, 0.4), gentle = blockOnSlope(2, 0.5, 0.6);
    const VirtualMotion down{{{-2, -1, 0}}, {{}}}, up{{{2, 1, 0}}, {{}}}, sinks{{{-2, -1.1L, 0}}, {{}}},
        lifts{{{-2, -0.1L, 0}}, {{}}};
    // It slides against friction 0.4 only while it opens by 0.4 of the way it slides.
    EXPECT_FALSE(gainsEnergy(steep, down));
    EXPECT_TRUE(gainsEnergy(steep, lifts));
    EXPECT_FALSE(gainsEnergy(gentle, lifts));
    EXPECT_FALSE(gainsEnergy(steep, up));
    EXPECT_FALSE(gainsEnergy(steep, sinks));
    // Turning about the lower corner lifts the upper one, but also the weight.
    EXPECT_FALSE(gainsEnergy(steep, {{{0, 0, 0}}, {{0, 0, 1}}}));
}

TEST(ForceBalance, NoForcesBeyondTheCertifiedLeastSum) {
    // The sum of both normal forces of a block on level ground is its weight; one of them is open.
    const LoadedBodies problem = blockOnSlope(2, 0, 0.4);
    const VirtualMotion falls{{{0, -1, 0}}, {{}}};
    EXPECT_EQ(leastSum(problem, {1, 1}, falls), 2.0);
    EXPECT_LT(leastSum(problem, {1, 0}, falls), -1e5);
}

}  // namespace
}  // namespace rigor::validation
