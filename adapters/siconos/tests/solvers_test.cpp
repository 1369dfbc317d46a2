// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Siconos' solvers on problems whose solutions are known by hand, in the order and the units of the interface.
#include <gtest/gtest.h>

#include <cmath>

#include "validation/contact_problems/residual.hpp"
#include "validation/contact_problems/tests/small_problems.hpp"

namespace rigor::validation::testing {
namespace {

const adapter::LoadedEngine& siconos() {
    static const adapter::LoadedEngine engine{RIGOR_MODULE};
    return engine;
}
std::string specOf(const std::string& solver) {
    return "siconos:solver=" + solver;
}

/// A point of 2 kg at (-3, 2, 1) m/s that slides with mu 0.3: r_N = 6, |r_T| = 1.8 against the velocity.
TEST(Siconos, ASlidingPointStopsAsFarAsItsConeAllows) {
    const ExportedProblem point = massPoint(2.0, 0.3, {-3.0, 2.0, 1.0});
    for (const char* solver : {"nsgs", "nsn_ac", "nsn_fb", "nsn_nm", "admm", "proximal", "vi_eg"}) {
        SCOPED_TRACE(solver);
        const auto solve = take(siconos(), specOf(solver), point.problem);
        EXPECT_EQ(solve->friction().kind, adapter::FrictionModel::Kind::Cone);
        const auto found = solve->run(2000, 1e-12);
        EXPECT_FALSE(found.gaveUp);
        EXPECT_GE(found.iterations, 1);
        EXPECT_NEAR(found.r[0], 6.0, 1e-8);
        EXPECT_NEAR(found.r[1], -1.8 * 2.0 / std::sqrt(5.0), 1e-8);
        EXPECT_NEAR(found.r[2], -1.8 * 1.0 / std::sqrt(5.0), 1e-8);
        // Again from r = 0, whatever came before.
        EXPECT_EQ(solve->run(2000, 1e-12).r, found.r);
    }
}

TEST(Siconos, InTwoDimensionsItHasOtherSolvers) {
    const ExportedProblem point = massPoint(2.0, 0.3, {-3.0, 2.0});
    for (const char* solver : {"nsgs", "lemke"}) {
        SCOPED_TRACE(solver);
        const auto found = take(siconos(), specOf(solver), point.problem)->run(1000, 1e-12);
        EXPECT_NEAR(found.r[0], 6.0, 1e-8);
        EXPECT_NEAR(found.r[1], -1.8, 1e-8);
    }
    EXPECT_THROW(take(siconos(), specOf("admm"), point.problem), adapter::Unsupported);
    EXPECT_THROW(take(siconos(), specOf("lemke"), massPoint(2.0, 0.3, {-3.0, 2.0, 1.0}).problem),
                 adapter::Unsupported);
}

/// W is given by rows and is not symmetric here: a transposed matrix would solve another problem.
TEST(Siconos, TheMatrixIsNotTransposed) {
    ExportedProblem problem = massPoint(1.0, 0.2, {-1.0, 0.3, 0.0});
    problem.problem.W = {1.0, 0.3, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    const auto found = take(siconos(), specOf("nsgs"), problem.problem)->run(1000, 1e-13);
    EXPECT_LT(contactResidual(problem.problem, found.r).relative, 1e-10);
    EXPECT_GT(found.r[0], 1.01);
}

}  // namespace
}  // namespace rigor::validation::testing
