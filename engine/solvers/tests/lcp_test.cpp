// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The pivoting methods against enumeration of all complementary sets.
#include <gtest/gtest.h>

#include <random>

#include "engine/math/space.hpp"
#include "engine/solvers/lcp/box_lcp.hpp"
#include "engine/solvers/lcp/lemke_lcp.hpp"

namespace rigor::engine {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Vector = Eigen::VectorXd;

/// All z with w = M z + q, 0 <= w _|_ z >= 0 that belong to a regular complementary set.
std::vector<Vector> allLcpSolutions(const Matrix& M, const Vector& q) {
    const auto n = static_cast<int>(q.size());
    std::vector<Vector> found;
    for (int set = 0; set < (1 << n); ++set) {
        Matrix A = Matrix::Identity(n, n);
        Vector b = Vector::Zero(n);
        for (int i = 0; i < n; ++i)
            if (set >> i & 1) {
                A.row(i) = M.row(i);
                b[i] = -q[i];
            }
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                if ((set >> i & 1) && !(set >> j & 1)) A(i, j) = 0;
        const Eigen::FullPivLU<Matrix> lu(A);
        if (!lu.isInvertible()) continue;
        const Vector z = lu.solve(b), w = M * z + q;
        if (z.minCoeff() >= -1e-9 && w.minCoeff() >= -1e-9) found.push_back(z);
    }
    return found;
}

Matrix randomGram(std::mt19937& random, int n, int rank, bool integers) {
    std::uniform_real_distribution<double> u(-1, 1);
    Matrix G(n, rank);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < rank; ++j) G(i, j) = integers ? std::round(2 * u(random)) : u(random);
    return G * G.transpose();
}

TEST(LemkeLcp, FindsWhatEnumerationFinds) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> u(-1, 1);
    int solved = 0, without = 0, degenerate = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const int n = 1 + trial % 7;
        const bool integers = trial % 3 == 0;  // ties and singular minors
        Matrix M = randomGram(random, n, trial % 2 == 0 ? n : std::max(1, n / 2), integers);
        if (trial % 5 == 0) {  // skew: bisymmetric, still positive semi-definite
            const Matrix K = randomGram(random, n, n, integers).triangularView<Eigen::StrictlyUpper>();
            M += K - Matrix(K.transpose());
        }
        Vector q(n);
        for (int i = 0; i < n; ++i) q[i] = integers ? std::round(2 * u(random)) : u(random);
        LemkeLcp lcp;
        Vector z(n);
        const auto outcome = lcp.solve(static_cast<std::size_t>(n), M.data(), q.data(), z.data());
        const std::vector<Vector> all = allLcpSolutions(M, q);
        if (all.empty()) {
            // Positive semi-definite: no solution exactly where Lemke ends in a ray.
            EXPECT_EQ(outcome, LemkeLcp::Outcome::Ray) << trial;
            ++without;
            continue;
        }
        ASSERT_EQ(outcome, LemkeLcp::Outcome::Solved) << trial;
        const Vector w = M * z + q;
        ASSERT_GE(z.minCoeff(), 0);
        ASSERT_GE(w.minCoeff(), -1e-10) << trial;
        ASSERT_LT(z.cwiseMin(w).cwiseAbs().maxCoeff(), 1e-9) << trial;
        // w is unique for symmetric semi-definite matrices even where z is not.
        if (trial % 5 != 0) {
            ASSERT_LT((w - (M * all[0] + q)).cwiseAbs().maxCoeff(), 1e-8) << trial;
        }
        degenerate += all.size() > 1;
        ++solved;
    }
    EXPECT_GT(solved, 1000);
    EXPECT_GT(without, 50);
    EXPECT_GT(degenerate, 50);
}

/// Murty's problem takes 2^n pivots by the least index rule; and a classic example on which careless ratio
/// tests cycle must end.
TEST(LemkeLcp, EndsOnDegenerateProblems) {
    for (int n = 2; n <= 40; n += 2) {
        Matrix M = Matrix::Ones(n, n);  // rank one
        Vector q = Vector::Constant(n, -1), z(n);
        LemkeLcp lcp;
        ASSERT_EQ(lcp.solve(static_cast<std::size_t>(n), M.data(), q.data(), z.data()),
                  LemkeLcp::Outcome::Solved);
        EXPECT_NEAR(z.sum(), 1, 1e-12);
        EXPECT_LE(lcp.pivots(), 4 * n);
    }
}

TEST(BoxLcp, FindsTheOneSolution) {
    std::mt19937 random(12);
    std::uniform_real_distribution<double> u(-1, 1);
    const double infinity = std::numeric_limits<double>::infinity();
    BoxLcp warm;
    for (int trial = 0; trial < 2000; ++trial) {
        const int n = 1 + trial % 6;
        const auto size = static_cast<std::size_t>(n);
        Matrix A = randomGram(random, n, n, trial % 3 == 0);
        Vector shift = Vector::Constant(n, 0.1), q(n), lower(n), upper(n), x(n);
        for (int i = 0; i < n; ++i) {
            q[i] = trial % 3 == 0 ? std::round(2 * u(random)) : u(random);
            const int kind = static_cast<int>(2.5 * (u(random) + 1));
            lower[i] = kind == 0 ? -infinity : kind == 1 ? 0.0 : -std::abs(u(random));
            upper[i] = kind == 0 || kind == 1 ? infinity : kind == 2 ? lower[i] : std::abs(u(random));
        }
        BoxLcp cold;
        Vector again(n);
        ASSERT_TRUE(cold.solve(size, A.data(), shift.data(), q.data(), lower.data(), upper.data(), x.data()));
        ASSERT_TRUE(
            warm.solve(size, A.data(), shift.data(), q.data(), lower.data(), upper.data(), again.data()));
        ASSERT_LT((x - again).cwiseAbs().maxCoeff(), 1e-9) << trial;
        // Enumerate: each index at its lower bound, free, or at its upper bound.
        int sets = 1, matches = 0;
        for (int i = 0; i < n; ++i) sets *= 3;
        const Matrix whole = A + Matrix(shift.asDiagonal());
        for (int set = 0; set < sets; ++set) {
            Matrix B = Matrix::Identity(n, n);
            Vector b(n);
            bool possible = true;
            for (int i = 0, s = set; i < n; ++i, s /= 3) {
                if (s % 3 == 1) {
                    B.row(i) = whole.row(i);
                    b[i] = -q[i];
                } else
                    b[i] = s % 3 == 0 ? lower[i] : upper[i];
                possible = possible && std::isfinite(b[i]);
            }
            if (!possible) continue;
            const Vector y = B.partialPivLu().solve(b), w = whole * y + q;
            for (int i = 0, s = set; i < n && possible; ++i, s /= 3) {
                if (s % 3 == 0) possible = w[i] >= -1e-9;
                if (s % 3 == 1) possible = y[i] >= lower[i] - 1e-9 && y[i] <= upper[i] + 1e-9;
                if (s % 3 == 2) possible = w[i] <= 1e-9;
                if (lower[i] == upper[i]) possible = std::abs(y[i] - lower[i]) < 1e-9;
            }
            if (!possible) continue;
            ++matches;
            ASSERT_LT((x - y).cwiseAbs().maxCoeff(), 1e-7) << trial;
        }
        ASSERT_GE(matches, 1) << trial;
    }
}

TEST(GrowingCholesky, SurvivesRemovals) {
    std::mt19937 random(13);
    const std::size_t n = 12;
    const Matrix A = randomGram(random, n, n, false) + Matrix(Matrix::Identity(n, n));
    const Vector none = Vector::Zero(n);
    GrowingCholesky factor;
    factor.reset(n);
    for (std::size_t i = 0; i < n; ++i) factor.append(A.data(), n, none.data(), (5 * i) % n);
    for (const std::size_t gone : {3u, 0u, 9u, 4u}) {
        factor.remove(gone);
        const std::size_t m = factor.size();
        Vector x = Vector::LinSpaced(static_cast<int>(m), 1, 2), b(static_cast<int>(m));
        for (std::size_t i = 0; i < m; ++i) {
            b[static_cast<int>(i)] = 0;
            for (std::size_t j = 0; j < m; ++j)
                b[static_cast<int>(i)] +=
                    A(static_cast<int>(factor.member(i)), static_cast<int>(factor.member(j))) *
                    x[static_cast<int>(j)];
        }
        factor.solve(b.data());
        EXPECT_LT((b - x).cwiseAbs().maxCoeff(), 1e-11);
    }
}

}  // namespace
}  // namespace rigor::engine
