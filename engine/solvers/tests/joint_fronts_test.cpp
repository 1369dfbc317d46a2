// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The factor by fronts against a dense one: random patterns and block sizes, unknowns that are left out, the
// same bits on every instruction set.
#include <gtest/gtest.h>

#include <hwy/targets.h>
#include <cstring>
#include <random>
#include <set>

#include "engine/math/decompositions.hpp"
#include "engine/solvers/joints/elimination.hpp"
#include "engine/solvers/joints/joint_fronts.hpp"

namespace rigor::engine {
namespace {

/// A random symmetric matrix of blocks, diagonally dominant, and its factor.
template <class R>
struct Problem {
    std::size_t size, nodes;
    Elimination order;
    Eigen::MatrixXd K;
    JointFronts<R> fronts;
    std::vector<R> floor;

    Problem(std::size_t blockSize, std::size_t count, double degree, unsigned seed)
        : size(blockSize), nodes(count) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> number(-1, 1);
        std::vector<std::set<std::uint32_t>> near(nodes);
        for (std::size_t e = 0; e < static_cast<std::size_t>(degree * double(nodes)); ++e) {
            const auto a = static_cast<std::uint32_t>(random() % nodes);
            // Neighbours are near ones, so that there is a band with some order in it.
            const auto b = static_cast<std::uint32_t>((a + 1 + random() % (2 + nodes / 8)) % nodes);
            if (a != b) {
                near[a].insert(b);
                near[b].insert(a);
            }
        }
        std::vector<std::vector<std::uint32_t>> lists;
        for (const auto& set : near) lists.emplace_back(set.begin(), set.end());
        EXPECT_TRUE(findElimination(lists, nodes * nodes, order));
        std::vector<std::uint32_t> position(nodes);
        for (std::uint32_t k = 0; k < nodes; ++k) position[order.order[k]] = k;
        const auto n = static_cast<Eigen::Index>(nodes * size);
        K = Eigen::MatrixXd::Zero(n, n);
        for (std::uint32_t i = 0; i < nodes; ++i)
            for (const std::uint32_t j : near[i])
                for (std::size_t r = 0; r < size; ++r)
                    for (std::size_t c = 0; c < size; ++c) {
                        const auto row = static_cast<Eigen::Index>(position[i] * size + r);
                        const auto column = static_cast<Eigen::Index>(position[j] * size + c);
                        if (row > column) K(row, column) = K(column, row) = double(R(number(random)));
                    }
        for (Eigen::Index i = 0; i < n; ++i) K(i, i) = double(R(1 + K.row(i).cwiseAbs().sum()));
        fronts.analyse(order.start, order.row, 0, static_cast<int>(size));
        floor.assign(nodes * size, R(0));
    }
    void factor() {
        fronts.clear();
        const auto put = [&](std::uint32_t row, std::uint32_t column) {
            R* const block = fronts.numbers() + fronts.placeOf(row, column);
            for (std::size_t c = 0; c < size; ++c)
                for (std::size_t r = row == column ? c : 0; r < size; ++r)
                    block[c * fronts.stride(column) + r] =
                        static_cast<R>(K(static_cast<Eigen::Index>(row * size + r),
                                         static_cast<Eigen::Index>(column * size + c)));
        };
        for (std::uint32_t k = 0; k < nodes; ++k) {
            put(k, k);
            for (std::size_t e = order.start[k]; e < order.start[k + 1]; ++e) put(order.row[e], k);
        }
        fronts.factor(floor.data());
    }
    std::vector<R> solve(const Eigen::VectorXd& right) {
        std::vector<R> x(nodes * size);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<R>(right[static_cast<Eigen::Index>(i)]);
        fronts.solve(x.data());
        return x;
    }
};

template <class R>
class JointFrontsOf : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(JointFrontsOf, Precisions);

TYPED_TEST(JointFrontsOf, RandomPatternsAreTheDenseSolution) {
    const double small = std::is_same_v<TypeParam, double> ? 1e-13 : 1e-5;
    for (const std::size_t size : {1u, 2u, 3u, 5u, 6u})
        for (const std::size_t nodes : {1u, 2u, 7u, 40u, 90u})
            for (const double degree : {0.5, 1.5, 4.0}) {
                Problem<TypeParam> p(size, nodes, degree, static_cast<unsigned>(nodes + size));
                const auto n = static_cast<Eigen::Index>(nodes * size);
                const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(n, -1, 2);
                for (int round = 0; round < 2; ++round) {  // the content from before does not matter
                    p.factor();
                    const std::vector<TypeParam> x = p.solve(right);
                    Eigen::VectorXd found(n);
                    for (Eigen::Index i = 0; i < n; ++i) found[i] = double(x[i]);
                    EXPECT_LT((p.K * found - right).cwiseAbs().maxCoeff(), small)
                        << size << " " << nodes << " " << degree;
                }
            }
}

/// Unknowns at or below their floor get zero, the others the solution without them.
TYPED_TEST(JointFrontsOf, UnknownsBelowTheirFloorAreLeftOut) {
    Problem<TypeParam> p(3, 30, 2, 8);
    const Eigen::Index n = 90;
    for (const std::size_t out : {0u, 31u, 32u, 89u}) {
        const auto i = static_cast<Eigen::Index>(out);
        p.K.row(i).setZero();
        p.K.col(i).setZero();
        p.floor[out] = TypeParam(1e-3);
    }
    p.factor();
    const std::vector<TypeParam> x = p.solve(Eigen::VectorXd::Ones(n));
    for (Eigen::Index i = 0; i < n; ++i) {
        double left = -1;
        for (Eigen::Index j = 0; j < n; ++j) left += p.K(i, j) * double(x[j]);
        const bool out = p.floor[i] > 0;
        EXPECT_NEAR(out ? double(x[i]) : left, 0, 1e-5) << i;
    }
}

TYPED_TEST(JointFrontsOf, SameBitsOnEveryInstructionSet) {
    std::vector<std::vector<TypeParam>> results;
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
        hwy::SetSupportedTargetsForTest(left & -left);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        Problem<TypeParam> p(3, 150, 4, 2);
        p.factor();
        results.push_back(p.solve(Eigen::VectorXd::LinSpaced(450, -1, 3)));
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_GT(results.size(), 1u) << "nothing was compared";
    for (const auto& result : results)
        EXPECT_EQ(std::memcmp(result.data(), results.front().data(), result.size() * sizeof(TypeParam)), 0);
}

}  // namespace
}  // namespace rigor::engine
