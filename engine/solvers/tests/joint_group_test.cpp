// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// All joints of a step: equality rows are satisfied in one pass, bounded rows keep their
// bounds, warm starts change velocities as the rows say, and a pass in a steady state does not allocate.
#include <gtest/gtest.h>

#include <algorithm>

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
    /// Largest violation of the law of a bounded row, as a velocity.
    double boundedResidual() const {
        double largest = 0;
        for (const Block<S>& block : problem.rows.blocks) {
            if (block.kind != BlockKind::Bounded) continue;
            const Row<S>& row = problem.rows.rows[block.first];
            const Real error = rowVelocity<S>(row, problem.velocities[block.a], problem.velocities[block.b]) +
                               row.bias + row.softness * row.impulse;
            const Real next = std::clamp(row.impulse - row.invK * error, row.lower, row.upper);
            largest = std::max(largest, static_cast<double>(std::abs(next - row.impulse) / row.invK));
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

/// Limits along the chain that all act: one pass solves them together with the equality rows.
TYPED_TEST(JointGroups, OneVisitSatisfiesTheBoundedRowsThatAct) {
    using V = typename TypeParam::Vec;
    for (const int limits : {1, 7, 20, 32}) {  // less and more than the lanes of a batch
        this->problem = {};
        this->chain(40);
        for (int i = 0; i < limits; ++i)
            this->problem.addBounded(0, static_cast<std::uint32_t>(40 - i), V(-V::Unit(1)), V::Zero(),
                                     V::Zero(), 0, 1e9, 0.1 * (i % 3), 0);
        JointGroup<TypeParam> group;
        group.begin(this->problem.rows);
        EXPECT_GT(group.solve(this->problem.rows, this->problem.velocities), 1);
        EXPECT_LT(this->residual(), 20 * this->tolerance());
        EXPECT_LT(this->boundedResidual(), 0.01) << limits;
        for (int i = 0; i < 3; ++i) group.solve(this->problem.rows, this->problem.velocities);
        EXPECT_LT(this->boundedResidual(), 20 * this->tolerance()) << limits;
    }
}

/// More acting rows than there is room for are solved in turn with the equality rows.
TYPED_TEST(JointGroups, AnyNumberOfBoundedRowsMayAct) {
    using V = typename TypeParam::Vec;
    this->chain(40);
    for (std::uint32_t i = 1; i <= 40; ++i)
        this->problem.addBounded(0, i, V(-V::Unit(1)), V::Zero(), V::Zero(), 0, 1e9, 0.2, 0);
    JointGroup<TypeParam> group;
    group.begin(this->problem.rows);
    const double before = this->boundedResidual();
    for (int i = 0; i < 20; ++i) group.solve(this->problem.rows, this->problem.velocities);
    EXPECT_LT(this->residual(), 20 * this->tolerance());
    EXPECT_LT(this->boundedResidual(), 0.1 * before);
}

/// A part moves to the bit as it would alone, with any number of threads.
TYPED_TEST(JointGroups, PartsDoNotDependOnEachOther) {
    using V = typename TypeParam::Vec;
    const auto addPart = [this](double push) {
        const auto first = static_cast<std::uint32_t>(this->problem.velocities.size());
        for (std::uint32_t i = 0; i < 4; ++i) {
            this->problem.addBody(1 + 0.3 * i, 0.2,
                                  V(V::Unit(1) * static_cast<typename TypeParam::Real>(push)));
            this->problem.addBall(i == 0 ? 0 : first + i - 1, first + i, V(V::Unit(0) * 0.5F),
                                  V(V::Unit(0) * -0.5F));
        }
        this->problem.addBounded(0, first + 3, V(-V::Unit(1)), V::Zero(), V::Zero(), 0, 1e9, 0.1, 0);
    };
    addPart(2);
    JointGroup<TypeParam> alone;
    alone.begin(this->problem.rows);
    alone.solve(this->problem.rows, this->problem.velocities);
    const auto expected = this->problem.velocities;
    const Tasks three(3);
    for (const Tasks* tasks : {&Tasks::one(), &three}) {
        this->problem = {};
        for (int i = 0; i < 40; ++i) addPart(i == 0 ? 2 : -3 + 0.2 * i);
        JointGroup<TypeParam> group;
        group.useThreads(*tasks);
        group.begin(this->problem.rows);
        EXPECT_NE(group.unitOf(0),
                  group.unitOf(static_cast<std::uint32_t>(this->problem.rows.blocks.size() - 1)));
        group.solve(this->problem.rows, this->problem.velocities);
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_EQ(this->problem.velocities[i].v, expected[i].v);
    }
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
