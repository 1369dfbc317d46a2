// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The algebra of rows: an impulse along a row obeys the laws of mechanics, K is J M^-1 J^T, and inverses are inverses.
#include "engine/constraints/row.hpp"

#include <gtest/gtest.h>

#include "engine/math/tests/random_values.hpp"

namespace rigor::engine {
namespace {

template <class S>
class RowsOf : public testing::Test, public RandomValues<S> {
  public:
    using Real = typename S::Real;
    static constexpr double kEpsilon = std::numeric_limits<Real>::epsilon();

    Real massA = 0, massB = 0;
    typename S::Inertia inertiaA = zeroInertia<S>(), inertiaB = zeroInertia<S>();
    std::vector<typename S::Inertia> invInertia{zeroInertia<S>(), zeroInertia<S>()};
    Block<S> block;

    /// Two bodies of random masses and inertias; B moves, A too if `bothMove`.
    void makeBodies(bool bothMove, int rows) {
        block = {};
        block.kind = BlockKind::Joint;
        block.rows = static_cast<std::uint8_t>(rows);
        block.a = 0;
        block.b = 1;
        massB = Real(1.25) + this->uniform(0.75);
        block.invMassB = 1 / massB;
        inertiaB = this->inertia();
        invInertia[1] = inverseInertia<S>(inertiaB);
        block.invMassA = 0;
        invInertia[0] = zeroInertia<S>();
        if (!bothMove) return;
        massA = Real(1.25) + this->uniform(0.75);
        block.invMassA = 1 / massA;
        inertiaA = this->inertia();
        invInertia[0] = inverseInertia<S>(inertiaA);
    }
    /// The row of a force along n that acts at the points rA and rB from the centres of mass.
    Row<S> row(const typename S::Vec& n, const typename S::Vec& rA, const typename S::Vec& rB) {
        Row<S> result;
        result.lin = n;
        result.angA = -cross(rA, n);
        result.angB = cross(rB, n);
        completeRow<S>(result, block, invInertia);
        return result;
    }
    Row<S> randomRow() { return row(this->direction(), this->vector(1), this->vector(1)); }
    Velocity<S> velocity() { return {this->vector(2), this->angular(2)}; }
    double energy(const Velocity<S>& a, const Velocity<S>& b) const {
        const typename S::Ang momentumA = inertiaA * a.w, momentumB = inertiaB * b.w;
        return static_cast<double>(Real(0.5) * (massA * a.v.squaredNorm() + massB * b.v.squaredNorm() +
                                                dotAng(a.w, momentumA) + dotAng(b.w, momentumB)));
    }
};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(RowsOf, Spaces);

/// The velocity along the row changes by K lambda, the energy by lambda times the mean of it before and after.
TYPED_TEST(RowsOf, ImpulsesChangeVelocityByKAndEnergyByTheirWork) {
    using S = TypeParam;
    for (int trial = 0; trial < 1000; ++trial) {
        this->makeBodies(true, 1);
        const Row<S> row = this->randomRow();
        Velocity<S> a = this->velocity(), b = this->velocity();
        const double energyBefore = this->energy(a, b);
        const auto before = rowVelocity<S>(row, a, b);
        const auto lambda = this->uniform(2);
        applyRowImpulse<S>(row, this->block, lambda, a, b);
        const auto after = rowVelocity<S>(row, a, b);
        const double rounding = 500 * this->kEpsilon;
        ASSERT_NEAR(after - before, rowK<S>(row, this->block) * lambda, rounding);
        ASSERT_NEAR(this->energy(a, b) - energyBefore, 0.5 * lambda * (before + after), rounding);
    }
}

/// Equal and opposite forces on one line: no change of linear momentum, nor of angular momentum about any point.
TYPED_TEST(RowsOf, ImpulsesKeepTheMomentumOfThePair) {
    using S = TypeParam;
    for (int trial = 0; trial < 1000; ++trial) {
        this->makeBodies(true, 1);
        const auto centerA = this->vector(2), centerB = this->vector(2), point = this->vector(2);
        const Row<S> row = this->row(this->direction(), point - centerA, point - centerB);
        Velocity<S> a, b;
        applyRowImpulse<S>(row, this->block, typename S::Real(1.5), a, b);
        const typename S::Vec pA = this->massA * a.v, pB = this->massB * b.v;
        const double rounding = 100 * this->kEpsilon;
        ASSERT_LT((pA + pB).norm(), rounding);
        const typename S::Ang spin = this->inertiaA * a.w + this->inertiaB * b.w;
        const typename S::Ang momentum = spin + cross(centerA, pA) + cross(centerB, pB);
        ASSERT_LT(dotAng(momentum, momentum), rounding * rounding);
    }
}

TYPED_TEST(RowsOf, ImpulsesLeaveBodiesThatDoNotMoveUntouched) {
    using S = TypeParam;
    this->makeBodies(false, 1);
    const Row<S> row = this->randomRow();
    const Velocity<S> moving = this->velocity();
    Velocity<S> a = moving, b = moving;
    applyRowImpulse<S>(row, this->block, typename S::Real(3), a, b);
    EXPECT_EQ(a.v, moving.v);
    EXPECT_EQ(a.w, moving.w);
    EXPECT_NE(b.v, moving.v);
}

/// |J v| is at most the sum of its terms' sizes, which rowMotion() is.
TYPED_TEST(RowsOf, MotionBoundsTheVelocity) {
    using S = TypeParam;
    for (int trial = 0; trial < 1000; ++trial) {
        this->makeBodies(true, 1);
        const Row<S> row = this->randomRow();
        const Velocity<S> a = this->velocity(), b = this->velocity();
        ASSERT_LE(std::abs(rowVelocity<S>(row, a, b)), rowMotion<S>(row, a, b) * (1 + 8 * this->kEpsilon));
        ASSERT_EQ(rowMotion<S>(row, {}, {}), 0);
    }
}

/// All bodies as one matrix equation: K = J M^-1 J^T + softness on the diagonal, by dense matrices in double.
template <class S>
Eigen::MatrixXd denseK(const std::vector<Row<S>>& rows, const Block<S>& block,
                       const std::vector<typename S::Inertia>& invInertia) {
    constexpr int spin = S::dim == 3 ? 3 : 1, each = S::dim + spin;
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), 2 * each);
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(2 * each, 2 * each);
    for (int body = 0; body < 2; ++body) {
        const double invMass = static_cast<double>(body == 0 ? block.invMassA : block.invMassB);
        M.block(body * each, body * each, S::dim, S::dim) =
            invMass * Eigen::MatrixXd::Identity(S::dim, S::dim);
        const auto& inertia = invInertia[body];
        if constexpr (S::dim == 2)
            M(body * each + 2, body * each + 2) = static_cast<double>(inertia);
        else
            M.block(body * each + 3, body * each + 3, 3, 3) = inertia.template cast<double>();
    }
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const auto r = static_cast<Eigen::Index>(k);
        J.block(r, 0, 1, S::dim) = -rows[k].lin.template cast<double>().transpose();
        J.block(r, each, 1, S::dim) = rows[k].lin.template cast<double>().transpose();
        if constexpr (S::dim == 2) {
            J(r, 2) = static_cast<double>(rows[k].angA);
            J(r, each + 2) = static_cast<double>(rows[k].angB);
        } else {
            J.block(r, 3, 1, 3) = rows[k].angA.template cast<double>().transpose();
            J.block(r, each + 3, 1, 3) = rows[k].angB.template cast<double>().transpose();
        }
    }
    Eigen::MatrixXd K = J * M * J.transpose();
    for (std::size_t k = 0; k < rows.size(); ++k)
        K(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k)) +=
            static_cast<double>(rows[k].softness);
    return K;
}

TYPED_TEST(RowsOf, BlocksAreInvertedAsTheDenseMatrixIs) {
    using S = TypeParam;
    constexpr int most = S::dim == 3 ? 6 : 3;
    for (int trial = 0; trial < 300; ++trial)
        for (int n = 1; n <= most; ++n) {
            this->makeBodies(trial % 2 == 0, n);
            std::vector<Row<S>> rows;
            for (int k = 0; k < n; ++k) {
                rows.push_back(this->randomRow());
                rows.back().softness = trial % 3 == 0 ? typename S::Real(0.1 * k) : typename S::Real(0);
            }
            const Eigen::MatrixXd K = denseK<S>(rows, this->block, this->invInertia);
            for (int k = 0; k < n; ++k)
                ASSERT_NEAR(rowK<S>(rows[k], this->block), K(k, k), 64 * this->kEpsilon);
            const Eigen::JacobiSVD<Eigen::MatrixXd> svd(K);
            const double condition = svd.singularValues()(0) / svd.singularValues()(n - 1);
            if (condition > 1e3) continue;  // random rows may be nearly dependent
            BlockMatrix<S> inverse;
            invertBlock<S>(rows.data(), this->block, inverse);
            const Eigen::MatrixXd product = inverse.template cast<double>() * K;
            ASSERT_LT((product - Eigen::MatrixXd::Identity(n, n)).norm(), 64 * condition * this->kEpsilon);
        }
}

/// Two bodies that nothing moves, and a row that no body can follow beside rows that they can.
TYPED_TEST(RowsOf, DirectionsThatNothingCanFollowGetFiniteInverses) {
    using S = TypeParam;
    this->makeBodies(false, 2);
    std::vector<Row<S>> rows{this->randomRow(), Row<S>{}};  // the second has no direction at all
    BlockMatrix<S> inverse;
    invertBlock<S>(rows.data(), this->block, inverse);
    ASSERT_TRUE(inverse.allFinite());
    const auto K = rowK<S>(rows[0], this->block);
    EXPECT_NEAR(inverse(0, 0) * K, 1, 64 * this->kEpsilon);
    EXPECT_NEAR(inverse(0, 1), 0, 64 * this->kEpsilon) << "the other row is not disturbed";
    this->block.invMassB = 0;
    this->invInertia[1] = zeroInertia<S>();
    for (Row<S>& row : rows) completeRow<S>(row, this->block, this->invInertia);
    invertBlock<S>(rows.data(), this->block, inverse);
    EXPECT_TRUE(inverse.allFinite());
}

TYPED_TEST(RowsOf, RelaxingTakesTheRelaxedBiasAndSoftnessAndTheirInverses) {
    using S = TypeParam;
    using R = typename S::Real;
    this->makeBodies(true, 2);
    ConstraintRows<S> all;
    all.rows = {this->randomRow(), this->randomRow()};
    all.blocks = {this->block};
    all.matrices.resize(1);
    for (Row<S>& row : all.rows) {
        row.bias = R(0.7);
        row.softness = R(0.4);
        row.relaxedBias = R(-0.1);
        row.relaxedSoftness = 0;
        row.invK = 1 / rowK<S>(row, this->block);
    }
    invertBlock<S>(all.rows.data(), this->block, all.matrices[0]);
    all.relax();
    for (const Row<S>& row : all.rows) {
        EXPECT_EQ(row.bias, R(-0.1));
        EXPECT_EQ(row.softness, 0);
        EXPECT_NEAR(row.invK * rowK<S>(row, this->block), 1, 8 * this->kEpsilon);
    }
    const Eigen::MatrixXd K = denseK<S>(all.rows, this->block, this->invInertia);
    const Eigen::MatrixXd product = all.matrices[0].template cast<double>() * K;
    EXPECT_LT((product - Eigen::MatrixXd::Identity(2, 2)).norm(), 1e4 * this->kEpsilon);
}

}  // namespace
}  // namespace rigor::engine
