// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The direct solution of all joints against a dense one: chains, trees, loops, redundant rows, too many at
// once.
#include <gtest/gtest.h>

#include <random>

#include "engine/core/tests/counting_new.hpp"
#include "engine/math/decompositions.hpp"
#include "engine/solvers/joints/joint_system.hpp"

namespace rigor::engine {
namespace {

template <class S>
class JointSystems : public testing::Test {
  public:
    using Real = typename S::Real;
    using Dense = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;
    std::mt19937 random{3};
    std::vector<Block<S>> blocks;
    std::vector<std::vector<Row<S>>> rows;
    std::vector<double> invMass{0};  ///< body 0 is fixed

    Real uniform() { return static_cast<Real>(std::uniform_real_distribution<double>(-1, 1)(random)); }
    typename S::Ang ang() {
        if constexpr (S::dim == 2)
            return uniform();
        else
            return typename S::Ang(uniform(), uniform(), uniform());
    }
    void bodies(int n) {
        for (int i = 0; i < n; ++i) invMass.push_back(0.5 + 0.4 * static_cast<double>(uniform()));
    }
    /// Random rows between two bodies; the inertia of a body is a multiple of its mass.
    void join(std::uint32_t a, std::uint32_t b, int count) {
        Block<S> block;
        block.kind = BlockKind::Joint;
        block.a = a;
        block.b = b;
        block.rows = static_cast<std::uint8_t>(count);
        block.invMassA = static_cast<Real>(invMass[a]);
        block.invMassB = static_cast<Real>(invMass[b]);
        std::vector<Row<S>> made(static_cast<std::size_t>(count));
        for (Row<S>& row : made) {
            for (int i = 0; i < S::dim; ++i) row.lin[i] = uniform();
            row.angA = ang();
            row.angB = ang();
            row.invIAngA = Real(3) * block.invMassA * row.angA;
            row.invIAngB = Real(3) * block.invMassB * row.angB;
        }
        blocks.push_back(block);
        rows.push_back(made);
    }
    /// A joint of as many rows as there are dimensions that holds two points together, at `arm` from A and at
    /// `-arm` from B, with unit masses and the inertia of small spheres.
    void ball(std::uint32_t a, std::uint32_t b, const typename S::Vec& arm) {
        join(a, b, S::dim);
        Block<S>& block = blocks.back();
        for (int i = 0; i < S::dim; ++i) {
            Row<S>& row = rows.back()[i];
            row.lin = S::Vec::Unit(i);
            row.angA = -cross(arm, row.lin);
            row.angB = cross(typename S::Vec(-arm), row.lin);
            row.invIAngA = Real(3) * block.invMassA * row.angA;
            row.invIAngB = Real(3) * block.invMassB * row.angB;
        }
    }
    /// A flat net of side x side bodies that hangs from body 0 by its first row.
    void flatNet(std::uint32_t side) {
        invMass.assign(side * side + 1, 1);
        invMass[0] = 0;
        const typename S::Vec right = S::Vec::Unit(0) * Real(0.25), down = S::Vec::Unit(1) * Real(-0.25);
        for (std::uint32_t i = 0; i < side * side; ++i) {
            ball(i < side ? 0 : i + 1 - side, i + 1, down);
            if (i % side > 0) ball(i, i + 1, right);
        }
    }
    /// K by its definition, over all bodies' velocities.
    Dense dense() const {
        const int angular = S::dim == 2 ? 1 : 3, size = S::dim + angular;
        Eigen::Index total = 0;
        for (const auto& r : rows) total += static_cast<Eigen::Index>(r.size());
        Dense J = Dense::Zero(total, size * static_cast<Eigen::Index>(invMass.size()));
        Dense W = Dense::Zero(J.cols(), J.cols());
        for (std::size_t b = 0; b < invMass.size(); ++b)
            for (int i = 0; i < size; ++i) {
                const auto at = static_cast<Eigen::Index>(b) * size + i;
                W(at, at) = invMass[b] * (i < S::dim ? 1 : 3);
            }
        Eigen::Index r = 0;
        for (std::size_t k = 0; k < blocks.size(); ++k)
            for (const Row<S>& row : rows[k]) {
                const Eigen::Index a = blocks[k].a * size, b = blocks[k].b * size;
                for (int i = 0; i < S::dim; ++i) {
                    J(r, a + i) = -row.lin[i];
                    J(r, b + i) = row.lin[i];
                }
                for (int i = 0; i < angular; ++i) {
                    if constexpr (S::dim == 2) {
                        J(r, a + 2) = row.angA;
                        J(r, b + 2) = row.angB;
                    } else {
                        J(r, a + 3 + i) = row.angA[i];
                        J(r, b + 3 + i) = row.angB[i];
                    }
                }
                ++r;
            }
        return J * W * J.transpose();
    }
    std::vector<typename JointSystem<S>::Item> items() const {
        std::vector<typename JointSystem<S>::Item> all;
        for (std::size_t k = 0; k < blocks.size(); ++k) all.push_back({&blocks[k], rows[k].data()});
        return all;
    }
    /// Largest |K x - r| of repeated solves for what is left, relative to |r|.
    double residual(JointSystem<S>& system, int solves) {
        const Dense K = dense();
        Eigen::VectorXd right = K * Eigen::VectorXd::LinSpaced(K.rows(), -1, 1), left = right;
        EXPECT_TRUE(system.factor(items()));
        for (int n = 0; n < solves; ++n) {
            Eigen::Index r = 0;
            for (std::size_t k = 0; k < blocks.size(); ++k)
                for (Eigen::Index i = 0; i < blocks[k].rows; ++i)
                    system.at(k)[i] = static_cast<Real>(left[r++]);
            system.solve();
            Eigen::VectorXd x(K.rows());
            r = 0;
            for (std::size_t k = 0; k < blocks.size(); ++k)
                for (Eigen::Index i = 0; i < blocks[k].rows; ++i) x[r++] = system.at(k)[i];
            left -= K * x;
        }
        return left.cwiseAbs().maxCoeff() / right.cwiseAbs().maxCoeff();
    }
};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(JointSystems, Spaces);

constexpr bool isDouble(double) {
    return true;
}
constexpr bool isDouble(float) {
    return false;
}

TYPED_TEST(JointSystems, ChainsTreesAndLoopsAreTheDenseSolution) {
    const double small = isDouble(typename TypeParam::Real()) ? 1e-11 : 1e-4;
    this->bodies(12);
    JointSystem<TypeParam> system;
    for (std::uint32_t i = 1; i < 8; ++i) this->join(i - 1, i, TypeParam::dim);  // a chain from the world
    EXPECT_LT(this->residual(system, 3), small);
    for (std::uint32_t i = 8; i < 13; ++i) this->join(i, i / 2, 1);  // branches
    EXPECT_LT(this->residual(system, 3), small);
    this->join(7, 0, 1);
    this->join(12, 9, 1);
    this->join(3, 4, 1);  // loops, and two joints at a pair
    EXPECT_LT(this->residual(system, 3), small);
}

TYPED_TEST(JointSystems, RedundantRowsAreNoTrouble) {
    this->bodies(2);
    this->join(0, 1, 2);
    this->join(1, 2, 2);
    this->join(2, 0, 2);
    // The same joint twice, and a row that no body can follow.
    this->blocks.push_back(this->blocks[1]);
    this->rows.push_back(this->rows[1]);
    this->join(0, 1, 1);
    Row<TypeParam>& dead = this->rows.back()[0];
    dead = {};
    JointSystem<TypeParam> system;
    EXPECT_LT(this->residual(system, 4), isDouble(typename TypeParam::Real()) ? 1e-10 : 1e-4);
}

/// A flat net has more rows than motions in its plane.
TYPED_TEST(JointSystems, FlatNetsAreNoTrouble) {
    for (const std::uint32_t side : {3u, 5u, 9u, 14u}) {
        this->blocks.clear();
        this->rows.clear();
        this->flatNet(side);
        JointSystem<TypeParam> system;
        EXPECT_LT(this->residual(system, 4), isDouble(typename TypeParam::Real()) ? 1e-9 : 1e-3) << side;
    }
}

/// Nets as no joints are in reality, with blocks of different sizes, beside chains: long columns and short
/// ones, fronts and blocks.
TYPED_TEST(JointSystems, NetsBesideChainsAreTheDenseSolution) {
    constexpr std::uint32_t side = 11, links = 20;
    const bool planar = TypeParam::dim == 2;
    this->bodies(static_cast<int>(side * side + links));
    JointSystem<TypeParam> system;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        if (i % side > 0) this->join(i, i + 1, 1 + static_cast<int>(i % 2));
        if (i >= side) this->join(i + 1 - side, i + 1, planar ? 1 : 2 + static_cast<int>(i % 3) / 2);
        if (i < links) this->join(i == 0 ? 0 : side * side + i, side * side + i + 1, TypeParam::dim);
    }
    EXPECT_LT(this->residual(system, 4), isDouble(typename TypeParam::Real()) ? 1e-9 : 1e-3);
    const auto items = this->items();
    const long before = test::allocationCount();
    EXPECT_TRUE(system.factor(items));
    system.solve();
    EXPECT_EQ(test::allocationCount(), before);
}

TYPED_TEST(JointSystems, TooManyJointsAtOneBodyAreRefused) {
    this->bodies(201);
    for (std::uint32_t i = 2; i < 202; ++i) this->join(1, i, 1);
    JointSystem<TypeParam> system;
    const auto items = this->items();
    EXPECT_FALSE(system.factor(items));
    EXPECT_FALSE(system.factor(items)) << "and again, from what was kept";
}

}  // namespace
}  // namespace rigor::engine
