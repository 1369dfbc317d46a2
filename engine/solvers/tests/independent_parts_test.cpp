// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Parts of a problem that share no body: they are found, and `block` solves each as if it were alone.
#include "engine/solvers/independent_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/solvers/tests/row_problem.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class IndependentPartsTest : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(IndependentPartsTest, Spaces);

/// Ends where the velocity errors are below a tolerance.
template <class S>
class ToleranceMonitor final : public IterationMonitor<S> {
  public:
    using Real = typename S::Real;
    explicit ToleranceMonitor(double tolerance) : tolerance_(static_cast<Real>(tolerance)) {}
    void before(std::span<const Velocity<S>>) override {}
    bool after(std::span<const Velocity<S>>, Real change) override {
        ++iterations;
        return change < tolerance_;
    }
    Real tolerance() const override { return tolerance_; }
    int iterations = 0;

  private:
    Real tolerance_;
};

template <class S>
int solveBlock(RowProblem<S>& problem, double tolerance) {
    ToleranceMonitor<S> monitor(tolerance);
    const auto solver = findAlgorithm(solverTable<S>(), "solver", "block").make();
    const typename S::Real none = 0;
    solver->solve({problem.rows, problem.velocities,
                   findAlgorithm(frictionTable<S>(), "friction", "cone").make, monitor, 50, none, false, none,
                   4});
    return monitor.iterations;
}

/// `second` beside `first`; the world is a body of both.
template <class S>
RowProblem<S> sideBySide(const RowProblem<S>& first, const RowProblem<S>& second) {
    RowProblem<S> both = first;
    const auto bodies = static_cast<std::uint32_t>(first.velocities.size() - 1);
    const auto rows = static_cast<std::uint32_t>(first.rows.rows.size());
    both.invMass.insert(both.invMass.end(), second.invMass.begin() + 1, second.invMass.end());
    both.velocities.insert(both.velocities.end(), second.velocities.begin() + 1, second.velocities.end());
    both.rows.rows.insert(both.rows.rows.end(), second.rows.rows.begin(), second.rows.rows.end());
    for (Block<S> block : second.rows.blocks) {
        if (block.a != 0) block.a += bodies;
        if (block.b != 0) block.b += bodies;
        block.first += rows;
        both.rows.blocks.push_back(block);
    }
    return both;
}

TYPED_TEST(IndependentPartsTest, BlocksThatShareAMovingBodyAreOnePart) {
    using S = TypeParam;
    RowProblem<S> p;
    for (int i = 0; i < 5; ++i) p.addBody(1, 1, S::Vec::Zero());
    const auto touch = [&](std::uint32_t a, std::uint32_t b) {
        p.addContact(a, b, S::Vec::Unit(1), S::Vec::Zero(), S::Vec::Zero(), 0.5);
    };
    touch(0, 1);
    touch(0, 2);
    touch(3, 4);
    touch(1, 5);
    touch(4, 2);
    const std::vector<std::uint32_t> units{0, 1, 2, 3, 4, 5};
    IndependentParts parts;
    parts.find<S>(p.rows.blocks, units, p.velocities.size());
    ASSERT_EQ(parts.count(), 2u);
    const auto of = [&](std::size_t part) {
        return std::vector<std::uint32_t>(parts.units(part).begin(), parts.units(part).end());
    };
    EXPECT_EQ(of(0), (std::vector<std::uint32_t>{0, 3}));
    EXPECT_EQ(of(1), (std::vector<std::uint32_t>{1, 2, 4}));
    for (std::uint32_t u = 0; u < 5; ++u) EXPECT_EQ(parts.partOf(u), u == 0 || u == 3 ? 0u : 1u);

    // A unit of several blocks joins what they touch; one that moves nothing is alone.
    p.rows.blocks[0].invMassB = 0;
    parts.find<S>(p.rows.blocks, std::vector<std::uint32_t>{0, 1, 3, 5}, p.velocities.size());
    ASSERT_EQ(parts.count(), 2u);
    EXPECT_EQ(of(0), (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(of(1), (std::vector<std::uint32_t>{1, 2}));
}

TYPED_TEST(IndependentPartsTest, EachIsSolvedAsIfItWereAlone) {
    using S = TypeParam;
    const double tolerance = sizeof(typename S::Real) == 4 ? 1e-5 : 1e-12;
    int differ = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        // The second needs Newton's method now and then; the first converges quickly. The other way round, too.
        RowProblem<S> easy = randomRowProblem<S>(seed, 3, 3, 0.2, false);
        RowProblem<S> hard = randomRowProblem<S>(seed + 100, 6, 14, 0.8, false);
        if (seed % 2 == 0) std::swap(easy, hard);
        RowProblem<S> both = sideBySide(easy, hard);
        const int first = solveBlock(easy, tolerance), second = solveBlock(hard, tolerance);
        solveBlock(both, tolerance);
        differ += first != second;
        for (std::size_t i = 0; i < both.rows.rows.size(); ++i) {
            const std::size_t n = easy.rows.rows.size();
            const auto alone = i < n ? easy.rows.rows[i].impulse : hard.rows.rows[i - n].impulse;
            ASSERT_EQ(both.rows.rows[i].impulse, alone) << "seed " << seed << ", row " << i;
        }
        for (std::size_t i = 1; i < both.velocities.size(); ++i) {
            const std::size_t n = easy.velocities.size();
            const Velocity<S>& alone = i < n ? easy.velocities[i] : hard.velocities[i - n + 1];
            ASSERT_EQ(both.velocities[i].v, alone.v) << "seed " << seed << ", body " << i;
            ASSERT_EQ(both.velocities[i].w, alone.w) << "seed " << seed << ", body " << i;
        }
    }
    EXPECT_GT(differ, 5) << "the parts need different numbers of iterations";
}

}  // namespace
}  // namespace rigor::engine::test
