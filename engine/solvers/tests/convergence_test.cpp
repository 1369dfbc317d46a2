// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Convergence: every solver of the table comes nearer to the law with more iterations, measured for all by
// the natural map.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/solvers/impulses.hpp"
#include "engine/solvers/methods/contact_interior.hpp"
#include "engine/solvers/tests/row_problem.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Convergence : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Convergence, Spaces);

/// The natural map after so many iterations: the median over problems with friction, and with joints in every
/// other one.
template <class S>
double medianResidual(const char* solver, int iterations) {
    std::vector<double> all;
    for (unsigned seed = 0; seed < 41; ++seed) {
        // Pyramids are other laws than the cone: without friction they have to agree.
        const bool pyramid = std::strcmp(solver, "dantzig") == 0 || std::strcmp(solver, "lemke") == 0;
        RowProblem<S> p = randomRowProblem<S>(seed, 4, 5, pyramid ? 0 : 0.3, seed % 2 == 1);
        p.solve(*findAlgorithm(solverTable<S>(), "solver", solver).make(), iterations);
        EXPECT_TRUE(p.finite()) << solver << " " << seed;
        all.push_back(static_cast<double>(p.residual()));
    }
    std::nth_element(all.begin(), all.begin() + 20, all.end());
    return all[20];
}

TYPED_TEST(Convergence, MoreIterationsComeNearerToTheLaw) {
    using S = TypeParam;
    const double rounding = sizeof(typename S::Real) == 8 ? 1e-9 : 5e-5;
    for (const auto& solver : solverTable<S>()) {
        // One pass is all there is to single_pass (its passes forget their predecessors), and xpbd iterates
        // on positions, which a problem of rows has not.
        if (std::strcmp(solver.name, "single_pass") == 0 || std::strcmp(solver.name, "xpbd") == 0) {
            EXPECT_GT(medianResidual<S>(solver.name, 256), 1e-3) << solver.name << " has learnt";
            continue;
        }
        double last = medianResidual<S>(solver.name, 1);
        for (const int iterations : {4, 16, 64, 256}) {
            const double now = medianResidual<S>(solver.name, iterations);
            EXPECT_LT(now, std::max(0.6 * last, rounding)) << solver.name << ", " << iterations;
            last = now;
        }
        EXPECT_LT(last, 1e-3) << solver.name;
    }
}

/// The interior-point method alone, from zero impulses, reaches the square root of the precision in a few
/// steps.
TYPED_TEST(Convergence, InteriorPointsEndNearTheLaw) {
    using S = TypeParam;
    int near = 0, all = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        RowProblem<S> p = randomRowProblem<S>(seed, 5, 6, 0.3 * (seed % 4), seed % 2 == 1);
        AssembledProblem problem;
        problem.assemble<S>(p.rows, p.velocities.size());
        problem.readVelocities<S>(p.rows, p.velocities);
        problem.findOffsets();
        ASSERT_TRUE(ContactInterior::fits(problem));
        ContactInterior interior;
        std::vector<double> impulses;
        ASSERT_TRUE(interior.solve(problem, 1, impulses));
        QuietMonitor<S> monitor;
        setImpulses(SolverInput<S>{p.rows, p.velocities, nullptr, monitor}, impulses);
        ASSERT_TRUE(p.finite());
        ++all;
        near += p.residual() < 1e-4;
    }
    EXPECT_GE(near, all - 3);
}

}  // namespace
}  // namespace rigor::engine::test
