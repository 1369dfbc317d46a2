// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Poisson's law by itself: two solutions, compression and expansion, of which the rows beside the contact
// must see one impact: their bounds and their softness hold for the sum of both.
#include <gtest/gtest.h>

#include "engine/solvers/restitution.hpp"
#include "engine/solvers/tests/row_problem.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class PoissonImpact : public testing::Test {
  protected:
    using R = typename S::Real;
    using Vec = typename S::Vec;
    RowProblem<S> problem;

    /// A body of 1 kg comes down at 2 m/s, e = 0.5; row 1 acts on it along x.
    void SetUp() override {
        Vec v = Vec::Zero();
        v[1] = -2;
        const std::uint32_t body = problem.addBody(1, 1, v);
        problem.addContact(0, body, Vec::Unit(1), Vec::Zero(), Vec::Zero(), 0, 0.5 * -2).restitution = R(0.5);
    }
    void impact() {
        const auto law = findAlgorithm(restitutionTable<S>(), "restitution", "poisson").make();
        const auto solver = findAlgorithm(solverTable<S>(), "solver", "pgs").make();
        law->impact(problem.rows, problem.velocities, [&] { problem.solve(*solver, 50); });
        EXPECT_NEAR(problem.velocities[1].v[1], 1, 1e-5) << "e times 2 m/s, upwards";
        EXPECT_NEAR(problem.rows.rows[0].impulse, 3, 1e-5) << "all of it in the row";
    }
};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(PoissonImpact, Spaces);

TYPED_TEST(PoissonImpact, ABoundedRowHasItsBoundsOnce) {
    using S = TypeParam;
    for (const double sign : {1.0, -1.0}) {
        this->problem = {};
        this->SetUp();
        // A motor with the target 1 m/s and at most 0.3 Ns.
        this->problem.addBounded(0, 1, S::Vec::Unit(0), S::Vec::Zero(), S::Vec::Zero(), -0.3, 0.3, -sign, 0);
        this->impact();
        const Row<S>& motor = this->problem.rows.rows[1];
        EXPECT_NEAR(motor.impulse, sign * 0.3, 1e-6);
        EXPECT_NEAR(this->problem.velocities[1].v[0], sign * 0.3, 1e-6);
        EXPECT_NEAR(motor.upper, 0.3, 1e-7) << "bounds and bias are as they were";
        EXPECT_NEAR(motor.lower, -0.3, 1e-7);
        EXPECT_NEAR(motor.bias, -sign, 1e-7);
    }
}

TYPED_TEST(PoissonImpact, ASoftRowIsSolvedForItsWholeImpulse) {
    using S = TypeParam;
    const double infinity = std::numeric_limits<double>::infinity();
    this->problem.addBounded(0, 1, S::Vec::Unit(0), S::Vec::Zero(), S::Vec::Zero(), -infinity, infinity, -1.7,
                             0.7);
    this->impact();
    // v + bias + gamma lambda = 0 with v = lambda
    EXPECT_NEAR(this->problem.rows.rows[1].impulse, 1, 1e-5);
    EXPECT_NEAR(this->problem.velocities[1].v[0], 1, 1e-5);
}

}  // namespace
}  // namespace rigor::engine::test
