// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The parts of the solver `block`: sweeps over the contacts of two bodies, conjugate gradients over sweeps, the
// order of elimination, and the narrow matrices that it leads to.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "engine/solvers/elimination_order.hpp"
#include "engine/solvers/lcp/dense.hpp"
#include "engine/solvers/methods/conjugate_sweeps.hpp"
#include "engine/solvers/methods/contact_group.hpp"
#include "engine/solvers/sequential_impulses.hpp"
#include "engine/solvers/tests/row_problem.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class BlockParts : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(BlockParts, Spaces);

template <class S>
SolverInput<S> inputOf(RowProblem<S>& problem, QuietMonitor<S>& monitor) {
    const typename S::Real none = 0;
    return {problem.rows,
            problem.velocities,
            findAlgorithm(frictionTable<S>(), "friction", "cone").make,
            monitor,
            1,
            none,
            false,
            none,
            4};
}

template <class S>
void sweepAll(const SolverInput<S>& input) {
    for (const Block<S>& block : input.constraints.blocks) {
        Velocity<S>&a = input.velocities[block.a], &b = input.velocities[block.b];
        solveNormal(input, block, a, b);
        solveFriction(input, block, a, b);
    }
}

/// Two bodies with four contacts, of which one is soft.
template <class S>
RowProblem<S> pairProblem(unsigned seed) {
    std::mt19937 random(seed);
    RowProblem<S> p;
    p.addBody(2, 0.3, randomVec<S>(random));
    p.addBody(0.7, 0.2, randomVec<S>(random));
    const typename S::Vec n = S::Vec::Unit(1);
    for (int i = 0; i < 4; ++i)
        p.addContact(1, 2, n, typename S::Vec(typename S::Real(0.5) * randomVec<S>(random)),
                     typename S::Vec(typename S::Real(0.5) * randomVec<S>(random)), 0.4);
    p.rows.rows[p.rows.blocks[2].first].softness = typename S::Real(0.1);
    p.velocities[2].v -= typename S::Real(3) * n;
    return p;
}

/// Columns of boxes that lean on each other and fall at 5 m/s, each with two or four corners on the next.
template <class S>
RowProblem<S> fallingColumns(unsigned seed) {
    using Real = typename S::Real;
    std::mt19937 random(seed);
    RowProblem<S> p;
    const typename S::Vec up = S::Vec::Unit(1);
    const auto corner = [&](int i, double y) {
        typename S::Vec arm = typename S::Vec(Real(0.1) * randomVec<S>(random));
        arm[0] += Real(i % 2 == 0 ? 0.5 : -0.5);
        arm[1] = Real(y);
        if constexpr (S::dim == 3) arm[2] += Real(i < 2 ? 0.5 : -0.5);
        return arm;
    };
    for (int k = 0; k < 12; ++k) {
        const std::uint32_t body =
            p.addBody(1 + k % 3, 0.2, typename S::Vec(Real(0.5) * randomVec<S>(random) - Real(5) * up));
        for (int i = 0; i < (S::dim == 2 ? 2 : 4); ++i)
            p.addContact(k % 6 == 0 ? 0 : body - 1, body, up, corner(i, 0.5), corner(i, -0.5), 0.5);
        if (k >= 6) p.addContact(body - 6, body, S::Vec::Unit(0), corner(0, 0), corner(1, 0), 0.5);
    }
    return p;
}

/// In an impact, groups are swept once, as long as the part is far from solved. Twenty sweeps then leave some twice as
/// much as with groups that are swept until each is nearly solved; with a tolerance of 1e-5 this is no impact.
TYPED_TEST(BlockParts, ImpactsComeAsNearBySingleSweeps) {
    using S = TypeParam;
    const auto solver = findAlgorithm(solverTable<S>(), "solver", "block").make();
    double once = 0, often = 0;
    constexpr unsigned kSeeds = 40;
    for (unsigned seed = 0; seed < kSeeds; ++seed)
        for (const double tolerance : {1e-7, 1e-5}) {
            RowProblem<S> p = fallingColumns<S>(seed);
            QuietMonitor<S> monitor;
            monitor.tolerated = static_cast<typename S::Real>(tolerance);
            constexpr int kSweeps = 20;  // too few for Newton's method
            solver->solve({p.rows, p.velocities, findAlgorithm(frictionTable<S>(), "friction", "cone").make,
                           monitor, kSweeps, typename S::Real(0.01), false, 0, 4});
            (tolerance < 1e-6 ? once : often) += std::log10(double(p.residual())) / kSeeds;
        }
    EXPECT_LT(once, 0) << "some tenths of a metre a second are left of ten";
    EXPECT_LT(once, often + 0.5);
    EXPECT_NE(once, often) << "the tolerance decides";
}

TYPED_TEST(BlockParts, SweepsOfAGroupAreThoseOfItsRows) {
    using S = TypeParam;
    using Real = typename S::Real;
    const double tolerance = sizeof(Real) == 4 ? 2e-5 : 1e-13;
    for (unsigned seed = 0; seed < 20; ++seed) {
        RowProblem<S> rows = pairProblem<S>(seed), group = rows;
        QuietMonitor<S> quiet;
        const SolverInput<S> byRows = inputOf(rows, quiet), byGroup = inputOf(group, quiet);
        for (int k = 0; k < 7; ++k) sweepAll<S>(byRows);
        ContactGroups<S> groups;
        const std::vector<std::uint32_t> starts{0, 4};
        groups.begin(group.rows, starts);
        ASSERT_TRUE(groups.takes(0));
        groups.sweep(byGroup, 0, group.rows.blocks, 4, Real(0));
        groups.sweep(byGroup, 0, group.rows.blocks, 3, Real(0));
        for (std::size_t i = 0; i < rows.rows.rows.size(); ++i)
            EXPECT_NEAR(group.rows.rows[i].impulse, rows.rows.rows[i].impulse, tolerance) << "row " << i;
        for (std::size_t b = 1; b < rows.velocities.size(); ++b) {
            EXPECT_LT((group.velocities[b].v - rows.velocities[b].v).norm(), tolerance);
            const typename S::Ang turn = group.velocities[b].w - rows.velocities[b].w;
            EXPECT_LT(std::sqrt(dotAng(turn, turn)), tolerance);
        }
    }
}

TYPED_TEST(BlockParts, AGroupIsTwoContactsAtLeast) {
    using S = TypeParam;
    RowProblem<S> p = pairProblem<S>(1);
    ContactGroups<S> groups;
    const std::vector<std::uint32_t> starts{0, 1, 4};
    groups.begin(p.rows, starts);
    EXPECT_FALSE(groups.takes(0));
    EXPECT_TRUE(groups.takes(1));
}

/// A stack of `count` bodies, each on two contacts at its ends (3D: on four), that falls with the speed of a step.
template <class S>
RowProblem<S> stackProblem(int count) {
    using Real = typename S::Real;
    RowProblem<S> p;
    const typename S::Vec up = S::Vec::Unit(1);
    for (int i = 0; i < count; ++i) {
        const std::uint32_t b = p.addBody(1, 1.0 / 6, typename S::Vec(Real(-0.16) * up));
        for (int corner = 0; corner < (S::dim == 3 ? 4 : 2); ++corner) {
            typename S::Vec arm = S::Vec::Zero();
            arm[0] = corner % 2 == 0 ? Real(0.5) : Real(-0.5);
            if (S::dim == 3) arm[2] = corner / 2 == 0 ? Real(0.5) : Real(-0.5);
            const typename S::Vec rA = b == 1 ? arm : typename S::Vec(arm + Real(0.5) * up);
            p.addContact(b - 1, b, up, rA, typename S::Vec(arm - Real(0.5) * up), 0.5);
        }
    }
    return p;
}

template <class S>
typename S::Real sweepThereAndBack(const SolverInput<S>& input) {
    sweepAll<S>(input);
    for (auto block = input.constraints.blocks.rbegin(); block != input.constraints.blocks.rend(); ++block) {
        Velocity<S>&a = input.velocities[block->a], &b = input.velocities[block->b];
        solveNormal(input, *block, a, b);
        solveFriction(input, *block, a, b);
    }
    return naturalMapResidual<S>(input.constraints, std::span<const Velocity<S>>(input.velocities));
}

TYPED_TEST(BlockParts, ConjugateGradientsSolveStacksInFewerSweeps) {
    using S = TypeParam;
    using Real = typename S::Real;
    RowProblem<S> plain = stackProblem<S>(20), fast = plain;
    const RowProblem<S> start = plain;
    std::vector<std::uint32_t> blocks(plain.rows.blocks.size());
    std::iota(blocks.begin(), blocks.end(), 0u);
    QuietMonitor<S> quiet;
    const SolverInput<S> plainInput = inputOf(plain, quiet), fastInput = inputOf(fast, quiet);
    ConjugateSweeps<S> conjugate;
    conjugate.begin(fastInput, 1);
    Real plainLeft = 0, fastLeft = 0;
    for (int k = 0; k < 60; ++k) {
        plainLeft = sweepThereAndBack<S>(plainInput);
        conjugate.remember(fastInput, blocks);
        fastLeft = sweepThereAndBack<S>(fastInput);
        conjugate.advance(fastInput, 0, blocks);
    }
    EXPECT_LT(fastLeft, Real(0.1) * plainLeft);
    // Velocities are still those that the impulses lead to.
    std::vector<Velocity<S>> led = start.velocities;
    for (const Block<S>& block : fast.rows.blocks)
        for (std::uint32_t i = block.first; i < block.first + block.rows; ++i)
            applyRowImpulse<S>(fast.rows.rows[i], block, fast.rows.rows[i].impulse, led[block.a],
                               led[block.b]);
    const double tolerance = sizeof(Real) == 4 ? 1e-4 : 1e-13;
    for (std::size_t b = 1; b < led.size(); ++b)
        EXPECT_LT((led[b].v - fast.velocities[b].v).norm(), tolerance) << "body " << b;
}

TYPED_TEST(BlockParts, AStackIsOrderedFromEndToEnd) {
    using S = TypeParam;
    RowProblem<S> p = stackProblem<S>(30);
    std::vector<std::uint32_t> inOrder(p.rows.blocks.size());
    std::iota(inOrder.begin(), inOrder.end(), 0u);
    // The same stack in any order of its pairs; blocks of a pair stay together.
    const std::size_t corners = inOrder.size() / 30;
    std::vector<std::size_t> pairs(30);
    std::iota(pairs.begin(), pairs.end(), std::size_t(0));
    std::mt19937 random(3);
    std::shuffle(pairs.begin(), pairs.end(), random);
    std::vector<std::uint32_t> shuffled;
    for (const std::size_t pair : pairs)
        for (std::size_t c = 0; c < corners; ++c)
            shuffled.push_back(static_cast<std::uint32_t>(pair * corners + c));
    EliminationOrder order;
    order.apply<S>(p.rows.blocks, p.velocities.size(), shuffled);
    std::vector<std::uint32_t> sorted = shuffled;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(sorted, inOrder) << "no block is lost";
    const double width = 2.0 * static_cast<double>(corners) * (1 + S::tangents);
    EXPECT_LE(order.cost(), 30 * width / 2 * width * width) << "a row meets its pair and the next";
    EXPECT_GT(order.cost(), 0);
}

TEST(DenseLu, NarrowMatricesAreSolvedAsOthers) {
    std::mt19937 random(7);
    std::normal_distribution<double> g;
    constexpr std::size_t n = 60, band = 5;
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i > band ? i - band : 0; j < std::min(n, i + band); ++j)
            A(Eigen::Index(i), Eigen::Index(j)) =
                g(random);  // without a dominant diagonal: rows are exchanged
    const Eigen::VectorXd b = Eigen::VectorXd::Random(n);
    DenseLu lu;
    double* to = lu.reset(n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) to[i * n + j] = A(Eigen::Index(i), Eigen::Index(j));
    ASSERT_TRUE(lu.factor());
    Eigen::VectorXd x = b;
    lu.solve(x.data());
    EXPECT_LT((A * x - b).norm(), 1e-9);
}

/// Rows that begin and end anywhere, in any order: exchanged rows bring others of other widths to their places.
TEST(DenseLu, RowsOfAnyWidthAreSolvedAsByEigen) {
    std::mt19937 random(8);
    std::normal_distribution<double> g;
    DenseLu lu;
    for (int round = 0; round < 50; ++round) {
        const std::size_t n = 1 + random() % 40;
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(Eigen::Index(n), Eigen::Index(n));
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t first = random() % (i + 1), end = i + 1 + random() % (n - i);
            for (std::size_t j = first; j < end; ++j)
                A(Eigen::Index(i), Eigen::Index(j)) = random() % 3 == 0 && j != i ? 0.0 : g(random);
        }
        const Eigen::VectorXd b = Eigen::VectorXd::Random(Eigen::Index(n));
        double* to = lu.reset(n);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) to[i * n + j] = A(Eigen::Index(i), Eigen::Index(j));
        ASSERT_TRUE(lu.factor()) << round;
        Eigen::VectorXd x = b;
        lu.solve(x.data());
        EXPECT_LT((A * x - b).norm(), 1e-9 * (1 + A.norm() * x.norm())) << round;
    }
}

}  // namespace
}  // namespace rigor::engine::test
