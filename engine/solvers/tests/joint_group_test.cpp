// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// All joints of a step as one unit: equality rows are satisfied in one pass, bounded rows keep their
// bounds, warm starts change velocities as the rows say, and a pass in a steady state does not allocate.
#include <gtest/gtest.h>

#include "engine/core/tests/counting_new.hpp"
#include "engine/solvers/joints/joint_group.hpp"
#include "engine/solvers/tests/row_problem.hpp"

namespace rigor::engine {
namespace {

template <class S>
class JointGroups : public testing::Test {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    test::RowProblem<S> problem;

    /// The factors shift pivots by 3.7e-11 (f32: 2.4e-5) of themselves.
    static double tolerance() { return std::is_same_v<Real, double> ? 1e-9 : 3e-4; }
    /// A chain of spheres from the world; the last link moves sideways.
    void chain(int links) {
        const Vec half = Vec::Unit(0) * Real(0.5);
        for (int i = 0; i < links; ++i) {
            const std::uint32_t body = problem.addBody(
                1 + 0.1 * i, 0.2, i + 1 == links ? Vec(Vec::Unit(1) * Real(3)) : Vec(Vec::Zero()));
            problem.addBall(body - 1, body, i == 0 ? Vec(Vec::Zero()) : half, -half);
        }
    }
    /// Largest |J v + bias + softness lambda| of the equality rows.
    double residual() const {
        double largest = 0;
        for (const Block<S>& block : problem.rows.blocks) {
            if (block.kind != BlockKind::Joint) continue;
            for (std::uint32_t i = block.first; i < block.first + block.rows; ++i) {
                const Row<S>& row = problem.rows.rows[i];
                const Real error =
                    rowVelocity<S>(row, problem.velocities[block.a], problem.velocities[block.b]) + row.bias +
                    row.softness * row.impulse;
                largest = std::max(largest, std::abs(static_cast<double>(error)));
            }
        }
        return largest;
    }
};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(JointGroups, Spaces);

TYPED_TEST(JointGroups, OneVisitSatisfiesAllRowsThatHold) {
    for (const int links : {1, 2, 40}) {
        this->problem = {};
        this->chain(links);
        JointGroup<TypeParam> group;
        group.begin(this->problem.rows);
        EXPECT_FALSE(group.empty());
        const double before = this->residual();
        EXPECT_NEAR(group.solve(this->problem.rows, this->problem.velocities), before, 1e-5);
        EXPECT_GT(before, 1);
        EXPECT_LT(this->residual(), this->tolerance());
    }
}

TYPED_TEST(JointGroups, BoundedRowsKeepTheirBoundsAndHoldingRowsHold) {
    using V = typename TypeParam::Vec;
    this->chain(6);
    // A motor that may push the last link by at most 0.25 N s, and a stop that holds the first.
    this->problem.addBounded(0, 6, V::Unit(1), V::Zero(), V::Zero(), -0.25, 0.25, -100, 0);
    this->problem.addBounded(0, 1, -V::Unit(1), V::Zero(), V::Zero(), 0, 1e9, 0, 0);
    JointGroup<TypeParam> group;
    group.begin(this->problem.rows);
    for (int i = 0; i < 3; ++i) group.solve(this->problem.rows, this->problem.velocities);
    const auto& rows = this->problem.rows.rows;
    EXPECT_FLOAT_EQ(static_cast<float>(rows[rows.size() - 2].impulse), 0.25F);
    EXPECT_GE(rows.back().impulse, 0);
    EXPECT_LT(this->residual(), this->tolerance());
    EXPECT_GE(-this->problem.velocities[1].v[1], -0.02);
}

TYPED_TEST(JointGroups, WarmStartIsTheRowsImpulsesOnTheVelocities) {
    this->chain(5);
    const auto still = this->problem.velocities;
    JointGroup<TypeParam> group;
    group.begin(this->problem.rows);
    group.solve(this->problem.rows, this->problem.velocities);
    auto again = still;
    group.warmStart(this->problem.rows, again);
    for (std::size_t i = 0; i < again.size(); ++i)
        EXPECT_LT((again[i].v - this->problem.velocities[i].v).norm(), 1e-5);
}

TYPED_TEST(JointGroups, ContactsAreNotItsBusiness) {
    using V = typename TypeParam::Vec;
    const std::uint32_t body = this->problem.addBody(1, 1, -V::Unit(1));
    this->problem.addContact(0, body, V::Unit(1), V::Zero(), V::Zero(), 0.5);
    JointGroup<TypeParam> group;
    group.begin(this->problem.rows);
    EXPECT_TRUE(group.empty());
    EXPECT_EQ(group.solve(this->problem.rows, this->problem.velocities), 0);
    EXPECT_EQ(this->problem.velocities[body].v[1], -1);
}

TYPED_TEST(JointGroups, TheSameJointsAgainDoNotAllocate) {
    this->chain(30);
    JointGroup<TypeParam> group;
    group.begin(this->problem.rows);
    group.solve(this->problem.rows, this->problem.velocities);
    const long before = test::allocationCount();
    for (int i = 0; i < 3; ++i) {
        group.begin(this->problem.rows);
        group.solve(this->problem.rows, this->problem.velocities);
    }
    EXPECT_EQ(test::allocationCount(), before);
}

}  // namespace
}  // namespace rigor::engine
