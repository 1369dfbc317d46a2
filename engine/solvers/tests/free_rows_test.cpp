// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Taking out the free rows changes no step of Newton's method, and what contradictory free rows require goes into no
// impulse.
#include "engine/solvers/lcp/free_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "engine/math/space.hpp"
#include "engine/solvers/methods/contact_newton.hpp"

namespace rigor::engine::test {
namespace {

/// Rows 3 k + 2 are bounded, the others free; W = G G^T with `columns` random columns in G, and 1e-7 times as much that is
/// random, as single precision leaves, in as many more as there are rows, if `rounded`.
AssembledProblem randomProblem(std::size_t n, std::size_t columns, unsigned seed, bool rounded = false) {
    std::mt19937 random(seed);
    std::normal_distribution<double> u;
    Eigen::MatrixXd G(n, columns + (rounded ? n : 0));
    for (Eigen::Index i = 0; i < G.size(); ++i) G.data()[i] = u(random);
    G.rightCols(G.cols() - Eigen::Index(columns)) *= 1e-7;
    const Eigen::MatrixXd W = G * G.transpose();
    AssembledProblem p;
    p.n = n;
    for (std::size_t i = 0; i < n; ++i) {
        const bool bounded = i % 3 == 2;
        p.kind.push_back(bounded ? RowKind::Bounded : RowKind::Free);
        p.lower.push_back(bounded ? -0.1 : -std::numeric_limits<double>::infinity());
        p.upper.push_back(bounded ? 0.2 : std::numeric_limits<double>::infinity());
        p.lambda.push_back(0.1 * u(random));
        p.w.push_back(u(random));
        for (std::size_t j = 0; j < n; ++j) p.W.push_back(W(Eigen::Index(i), Eigen::Index(j)));
    }
    p.q.resize(n);
    p.findOffsets();
    return p;
}

/// w of all rows under some impulses.
std::vector<double> velocities(const AssembledProblem& p, const std::vector<double>& impulses) {
    std::vector<double> w;
    for (std::size_t i = 0; i < p.n; ++i) w.push_back(p.velocity(i, impulses));
    return w;
}

TEST(FreeRows, SolvedProblemsAreThoseOfAllRows) {
    int held = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
        AssembledProblem p = randomProblem(18, 30, seed);
        FreeRows free;
        ContactNewton newton;
        ASSERT_TRUE(free.eliminate(p));
        std::vector<double> reduced, all, whole;
        for (int step = 0; step < 20; ++step) {
            ASSERT_TRUE(newton.step(free.reduce(p), 1e-12, reduced));
            free.expand(p, reduced, all);
            p.lambda = all;
            p.w = velocities(p, all);
        }
        AssembledProblem direct = randomProblem(18, 30, seed);
        for (int step = 0; step < 20; ++step) {
            ASSERT_TRUE(newton.step(direct, 1e-12, whole));
            direct.lambda = whole;
        }
        for (std::size_t i = 0; i < p.n; ++i) {
            EXPECT_NEAR(all[i], whole[i], 1e-7) << seed << ": row " << i;
            held += p.kind[i] == RowKind::Bounded && (all[i] == p.lower[i] || all[i] == p.upper[i]);
            if (p.kind[i] == RowKind::Free) {
                EXPECT_NEAR(p.w[i], 0, 1e-7) << seed << ": row " << i;
            }
        }
    }
    EXPECT_GT(held, 20) << "rows at their bounds";
}

/// Impulses that rounding leaves in open contacts count as contact.
TEST(ContactNewton, RowsAtTheirBoundsAreThereExactly) {
    int held = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
        AssembledProblem p = randomProblem(18, 30, seed);
        ContactNewton newton;
        std::vector<double> next;
        for (int step = 0; step < 20; ++step) {
            ASSERT_TRUE(newton.step(p, 1e-12, next));
            p.lambda = next;
            for (std::size_t i = 0; i < p.n; ++i) {
                const double bound = p.lambda[i] < 0 ? p.lower[i] : p.upper[i];
                if (!(std::abs(p.lambda[i] - bound) < 1e-9)) continue;
                EXPECT_EQ(p.lambda[i], bound) << seed << ": row " << i;
                ++held;
            }
        }
    }
    EXPECT_GT(held, 400) << "rows at their bounds";
}

/// 18 rows with 8 directions of motion: the 12 free ones contradict each other.
TEST(FreeRows, ContradictionsTakeNoImpulse) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const AssembledProblem p = randomProblem(18, 8, seed);
        FreeRows free;
        ASSERT_TRUE(free.eliminate(p));
        std::vector<double> others, all;
        for (std::size_t i = 2; i < p.n; i += 3) others.push_back(p.lambda[i]);
        free.reduce(p);
        free.expand(p, others, all);
        const std::vector<double> w = velocities(p, all);
        double left = 0, before = 0;
        for (std::size_t i = 0; i < p.n; ++i) {
            if (p.kind[i] != RowKind::Free) continue;
            EXPECT_LT(std::abs(all[i]), 100) << seed << ": row " << i;
            left += w[i] * w[i];
            before += p.w[i] * p.w[i];
        }
        EXPECT_LT(left, before);
        EXPECT_GT(left, 1e-3 * before) << "nothing contradicts";
    }
}

/// The same where rounding to single precision has made the 12 rows independent: a shift far below it lets impulses grow to
/// what mends their contradictions through the rounding alone.
TEST(FreeRows, RoundedContradictionsTakeNoImpulse) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const AssembledProblem p = randomProblem(18, 8, seed, true);
        const auto largest = [&](double shift) {
            FreeRows free;
            EXPECT_TRUE(free.eliminate(p, shift));
            std::vector<double> others, all;
            for (std::size_t i = 2; i < p.n; i += 3) others.push_back(p.lambda[i]);
            free.reduce(p);
            free.expand(p, others, all);
            double most = 0;
            for (const double impulse : all) most = std::max(most, std::abs(impulse));
            return most;
        };
        EXPECT_LT(largest(2.4e-5), 100) << seed;
        EXPECT_GT(largest(1e-15), 1e4) << seed << ": the shift decides";
    }
}

/// Their tangents, of which there are none, begin after the normal: for the last row, after the end.
TEST(FreeRows, ContactsWithoutFrictionKeepTheirPlaces) {
    AssembledProblem p = randomProblem(18, 30, 1);
    for (const std::size_t normal : {5u, 17u}) {
        p.kind[normal] = RowKind::Normal;
        p.contacts.push_back({normal, 0, normal + 1});
    }
    FreeRows free;
    ASSERT_TRUE(free.eliminate(p));
    const AssembledProblem& reduced = free.reduce(p);
    ASSERT_EQ(reduced.contacts.size(), 2u);
    EXPECT_EQ(reduced.n, 6u);
    EXPECT_EQ(reduced.contacts[0].normal, 1u);
    EXPECT_EQ(reduced.contacts[0].first, 2u);
    EXPECT_EQ(reduced.contacts[1].normal, 5u);
    EXPECT_EQ(reduced.contacts[1].first, 6u);
}

TEST(FreeRows, ProblemsWithoutFreeRowsStayWhole) {
    AssembledProblem p = randomProblem(9, 12, 1);
    for (std::size_t i = 0; i < p.n; ++i) p.kind[i] = RowKind::Bounded;
    EXPECT_FALSE(FreeRows().eliminate(p));
}

}  // namespace
}  // namespace rigor::engine::test
