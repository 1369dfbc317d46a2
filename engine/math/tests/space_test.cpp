// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rotations, poses and cross products by the identities that define them, in every space.
#include "engine/math/space.hpp"

#include <gtest/gtest.h>

#include "engine/math/tests/random_values.hpp"

namespace rigor::engine {
namespace {

template <class S>
class EverySpace : public testing::Test, public RandomValues<S> {
  public:
    using Vec = typename S::Vec;
    static constexpr int kTrials = 2000;
    static constexpr double kSize = 5;  ///< size of random vectors [m]
    /// Rounding of a few products of numbers up to kSize.
    static constexpr double kRounding = 32 * kSize * std::numeric_limits<typename S::Real>::epsilon();
    static double distance(const Vec& a, const Vec& b) { return static_cast<double>((a - b).norm()); }
};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(EverySpace, Spaces);

TYPED_TEST(EverySpace, RotationsKeepLengthsAnglesAndHandedness) {
    using S = TypeParam;
    for (int i = 0; i < this->kTrials; ++i) {
        const auto q = this->rotation();
        const auto a = this->vector(this->kSize), b = this->vector(this->kSize);
        const typename S::Vec u = rotate(q, a), v = rotate(q, b);
        ASSERT_NEAR(u.norm(), a.norm(), this->kRounding);
        ASSERT_NEAR(u.dot(v), a.dot(b), this->kSize * this->kRounding);
        const typename S::Mat M = toMatrix(q);
        ASSERT_NEAR(M.determinant(), 1, this->kRounding);
        ASSERT_LT((M * M.transpose() - S::Mat::Identity()).norm(), this->kRounding);
        ASSERT_LT(this->distance(M * a, u), this->kRounding) << "the matrix is that of rotate()";
        // A rotation commutes with the cross product, a reflection does not.
        if constexpr (S::dim == 2) {
            ASSERT_NEAR(cross(u, v), cross(a, b), this->kSize * this->kRounding);
        } else {
            ASSERT_LT(this->distance(cross(u, v), rotate(q, cross(a, b))), this->kSize * this->kRounding);
        }
    }
}

TYPED_TEST(EverySpace, ComposedRotationsActOneAfterTheOther) {
    using S = TypeParam;
    for (int i = 0; i < this->kTrials; ++i) {
        const auto q = this->rotation(), r = this->rotation();
        const auto v = this->vector(this->kSize);
        const typename S::Vec inTurn = rotate(q, rotate(r, v));
        ASSERT_LT(this->distance(rotate(compose(q, r), v), inTurn), this->kRounding);
        ASSERT_LT(this->distance(rotateInverse(q, rotate(q, v)), v), this->kRounding);
        ASSERT_LT(this->distance(rotate(inverse(q), v), rotateInverse(q, v)), this->kRounding);
        const typename S::Mat product = toMatrix(q) * toMatrix(r);
        ASSERT_LT((toMatrix(compose(q, r)) - product).norm(), this->kRounding);
    }
}

/// Right-handed and active: a quarter turn about +z takes x to y.
TYPED_TEST(EverySpace, PositiveTurnsGoFromXToY) {
    using S = TypeParam;
    using R = typename S::Real;
    typename S::Rot quarter;
    if constexpr (S::dim == 2)
        quarter = Rot2<R>::fromAngle(R(1.5707963267948966));
    else
        quarter = Eigen::Quaternion<R>(R(0.70710678118654752), 0, 0, R(0.70710678118654752));
    EXPECT_LT(this->distance(rotate(quarter, typename S::Vec(S::Vec::Unit(0))), S::Vec::Unit(1)),
              this->kRounding);
    EXPECT_LT(this->distance(rotate(quarter, typename S::Vec(S::Vec::Unit(1))), -S::Vec::Unit(0)),
              this->kRounding);
    EXPECT_LT(
        this->distance(rotate(Pose<S>::identityRot(), typename S::Vec(S::Vec::Unit(1))), S::Vec::Unit(1)),
        this->kRounding);
}

TYPED_TEST(EverySpace, PosesGoThereAndBackAndChain) {
    using S = TypeParam;
    for (int i = 0; i < this->kTrials; ++i) {
        const Pose<S> X = this->pose(this->kSize), Y = this->pose(this->kSize), Z = this->pose(this->kSize);
        const auto v = this->vector(this->kSize);
        const double rounding = 4 * this->kRounding;
        ASSERT_LT(this->distance(toLocal<S>(X, toWorld<S>(X, v)), v), rounding);
        ASSERT_LT(this->distance(toWorld<S>(compose<S>(X, Y), v), toWorld<S>(X, toWorld<S>(Y, v))), rounding);
        const Pose<S> left = compose<S>(compose<S>(X, Y), Z), right = compose<S>(X, compose<S>(Y, Z));
        ASSERT_LT(this->distance(toWorld<S>(left, v), toWorld<S>(right, v)), 2 * rounding);
        ASSERT_EQ(toWorld<S>(Pose<S>{}, v), v) << "a default pose is the identity";
        // A rigid motion keeps distances.
        const auto w = this->vector(this->kSize);
        ASSERT_NEAR(this->distance(toWorld<S>(X, v), toWorld<S>(X, w)), this->distance(v, w), rounding);
    }
}

/// The power of a force at r does not depend on whether it is counted there or by its moment: f . (w x r) =
/// (r x f) . w.
TYPED_TEST(EverySpace, MomentsAndVelocitiesAreDual) {
    for (int i = 0; i < this->kTrials; ++i) {
        const auto r = this->vector(this->kSize), f = this->vector(this->kSize);
        const auto w = this->angular(this->kSize);
        const double rounding = this->kSize * this->kSize * this->kRounding;
        ASSERT_NEAR(f.dot(cross(w, r)), dotAng(cross(r, f), w), rounding);
        ASSERT_NEAR(r.dot(cross(w, r)), 0, rounding) << "a turning point keeps its distance";
        ASSERT_NEAR(dotAng(cross(r, f), w), -dotAng(cross(f, r), w), rounding);
    }
}

TYPED_TEST(EverySpace, BoxesOverlapWhereEveryAxisDoes) {
    using S = TypeParam;
    using V = typename S::Vec;
    const Aabb<S> box{V::Zero(), V::Ones()};
    EXPECT_TRUE(box.overlaps(box));
    EXPECT_TRUE(box.contains(box));
    for (int axis = 0; axis < S::dim; ++axis) {
        for (const double sign : {-1.0, 1.0}) {
            const auto shifted = [&](double by) {
                const V d = static_cast<typename S::Real>(sign * by) * V::Unit(axis);
                return Aabb<S>{box.min + d, box.max + d};
            };
            EXPECT_TRUE(box.overlaps(shifted(0.5)));
            EXPECT_FALSE(box.contains(shifted(0.5)));
            EXPECT_TRUE(box.overlaps(shifted(1))) << "boxes that touch overlap";
            EXPECT_FALSE(box.overlaps(shifted(1.25)));
            EXPECT_FALSE(shifted(1.25).overlaps(box));
        }
    }
    const Aabb<S> inside{V::Constant(0.25), V::Constant(0.75)};
    EXPECT_TRUE(box.contains(inside));
    EXPECT_FALSE(inside.contains(box));
    EXPECT_TRUE(inside.overlaps(box));
}

}  // namespace
}  // namespace rigor::engine
