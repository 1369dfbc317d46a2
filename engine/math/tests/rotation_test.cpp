// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/math/tests/random_values.hpp"

namespace rigor::engine {
namespace {

TEST(ExpMap, AgreesWithTheMathLibraryInThePlane) {
    for (double angle = -20; angle < 20; angle += 0.0137) {
        const Rot2<double> q = expMap(angle);
        EXPECT_NEAR(q.c, std::cos(angle), 3e-14) << angle;
        EXPECT_NEAR(q.s, std::sin(angle), 3e-14) << angle;
        const Rot2<float> f = expMap(static_cast<float>(angle));
        EXPECT_NEAR(f.c, std::cos(angle), 2e-5) << angle;
        EXPECT_NEAR(f.s, std::sin(angle), 2e-5) << angle;
    }
}

TEST(ExpMap, AgreesWithAxisAngleInSpaceAndLogInvertsIt) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 5000; ++i) {
        Eigen::Vector3d axis(normal(random), normal(random), normal(random));
        axis.normalize();
        const double angle = std::pow(10.0, -8 + 8.49 * (i / 5000.0));  // angles up to 3.09 rad
        const Eigen::Quaterniond q = expMap(Eigen::Vector3d(angle * axis));
        const Eigen::Quaterniond expected(Eigen::AngleAxisd(angle, axis));
        ASSERT_NEAR((q.coeffs() - expected.coeffs()).norm(), 0, 2e-15);
        const Eigen::Vector3d back = logMap(q);
        ASSERT_NEAR((back - angle * axis).norm(), 0, 1e-13) << angle;
        const Eigen::Vector3d vector = rotationVector(q);
        ASSERT_NEAR((vector - angle * axis).norm() / angle, 0, 2e-15) << angle;
        const Eigen::Quaterniond opposite(-q.w(), -q.x(), -q.y(), -q.z());  // the same rotation
        ASSERT_EQ(rotationVector(opposite), vector);
        const Eigen::Vector3f single = rotationVector(Eigen::Quaternionf(q.cast<float>()));
        ASSERT_NEAR((single.cast<double>() - angle * axis).norm() / angle, 0, 1e-6) << angle;
    }
    EXPECT_EQ(rotationVector(Eigen::Quaterniond::Identity()), Eigen::Vector3d(0, 0, 0));
}

TEST(ExpMap, SeriesAreExactToRoundingUpToAQuarter) {
    for (double x = 1e-9; x <= 0.25; x *= 1.01) {
        double cosine = 0, sinc = 0;
        cosSinc(x * x, cosine, sinc);
        ASSERT_NEAR(cosine, std::cos(x), 2.3e-16) << x;
        ASSERT_NEAR(sinc, std::sin(x) / x, 2.3e-16) << x;
    }
}

/// An angle whose turns cannot be counted gives no rotation, and never a NaN.
TEST(ExpMap, OfHugeAnglesIsARotation) {
    for (const double size : {1e3, 1e6, 1e12, 1e30, 1e300, std::numeric_limits<double>::infinity()}) {
        const Rot2<double> q = expMap(size);
        EXPECT_NEAR(q.c * q.c + q.s * q.s, 1, 1e-3) << size;
        const Eigen::Quaterniond r = expMap(Eigen::Vector3d(size, -size, 0.5 * size));
        EXPECT_NEAR(r.norm(), 1, 1e-3) << size;
    }
}

template <class S>
class RotationsOf : public testing::Test, public RandomValues<S> {
  public:
    using Real = typename S::Real;
    static constexpr double kEpsilon = std::numeric_limits<Real>::epsilon();
};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(RotationsOf, Spaces);

template <class S>
double distance(const typename S::Rot& a, const typename S::Rot& b) {
    return static_cast<double>((toMatrix(a) - toMatrix(b)).norm());
}

/// exp((s + t) v) = exp(s v) exp(t v), exp(-v) = exp(v)^-1, and R exp(v) R^-1 = exp(R v).
TYPED_TEST(RotationsOf, ExpTurnsSumsAboutOneAxisIntoProducts) {
    using S = TypeParam;
    for (int i = 0; i < 2000; ++i) {
        const typename S::Ang v = this->angular(2);
        const auto s = this->uniform(1), t = this->uniform(1);
        const auto both = expMap(typename S::Ang((s + t) * v));
        const auto inTurn = compose(expMap(typename S::Ang(s * v)), expMap(typename S::Ang(t * v)));
        ASSERT_LT(distance<S>(both, inTurn), 64 * this->kEpsilon);
        ASSERT_LT(distance<S>(expMap(typename S::Ang(-v)), inverse(expMap(v))), 64 * this->kEpsilon);
        if constexpr (S::dim == 3) {
            const auto R = this->rotation();
            const auto moved = compose(compose(R, expMap(v)), inverse(R));
            ASSERT_LT(distance<S>(expMap(typename S::Ang(rotate(R, v))), moved), 64 * this->kEpsilon);
        }
    }
}

/// d/dt exp(t w) r = w x r at t = 0: an angular velocity means the same as in cross().
TYPED_TEST(RotationsOf, ExpIsTheMotionThatAnAngularVelocityStarts) {
    using S = TypeParam;
    const double h = std::cbrt(this->kEpsilon);
    for (int i = 0; i < 500; ++i) {
        const typename S::Ang w = this->angular(2);
        const auto r = this->vector(1);
        const auto step = static_cast<typename S::Real>(h);
        const typename S::Vec ahead = rotate(expMap(typename S::Ang(step * w)), r);
        const typename S::Vec behind = rotate(expMap(typename S::Ang(-step * w)), r);
        const typename S::Vec rate = (ahead - behind) / (2 * step);
        ASSERT_LT((rate - cross(w, r)).norm(), 30 * h * h);
    }
}

TYPED_TEST(RotationsOf, LogGivesTheSmallestRotationVector) {
    using S = TypeParam;
    for (int i = 0; i < 2000; ++i) {
        const auto q = this->rotation();
        const typename S::Ang v = logMap(q);
        ASSERT_LE(std::sqrt(dotAng(v, v)), 3.141592653589793 + 8 * this->kEpsilon);
        ASSERT_LT(distance<S>(expMap(v), q), 64 * this->kEpsilon);
    }
}

/// Rounding does not add up: after 100 000 small turns a rotation is still one.
TYPED_TEST(RotationsOf, StayUnitOverManySteps) {
    using S = TypeParam;
    typename S::Rot q = this->rotation();
    for (int i = 0; i < 100000; ++i) q = rotatedBy(q, typename S::Ang(this->angular(0.05)));
    const typename S::Mat M = toMatrix(q);
    EXPECT_LT((M * M.transpose() - S::Mat::Identity()).norm(), 16 * this->kEpsilon);
}

/// The kinetic energy of a turning body is the same in its own axes and in the world's, and a turn changes no
/// principal moment.
TYPED_TEST(RotationsOf, WorldInertiaHasTheEnergyOfTheBodys) {
    using S = TypeParam;
    for (int i = 0; i < 1000; ++i) {
        const auto q = this->rotation();
        const typename S::Inertia body = this->inertia(), world = worldInertia<S>(q, body);
        const typename S::Ang w = this->angular(2);
        const double rounding = 256 * this->kEpsilon;
        if constexpr (S::dim == 2) {
            ASSERT_EQ(world, body);
            ASSERT_NEAR(inverseInertia<S>(body) * body, 1, rounding);
        } else {
            const typename S::Vec local = rotateInverse(q, w);
            ASSERT_NEAR(w.dot(world * w), local.dot(body * local), rounding);
            ASSERT_NEAR(world.trace(), body.trace(), rounding);
            ASSERT_NEAR(world.determinant(), body.determinant(), rounding * 8);
            ASSERT_LT((inverseInertia<S>(body) * body - S::Mat::Identity()).norm(), rounding);
            // The inverse turns likewise: (R I R^T)^-1 = R I^-1 R^T.
            const typename S::Inertia turned = worldInertia<S>(q, inverseInertia<S>(body));
            ASSERT_LT((turned * world - S::Mat::Identity()).norm(), rounding);
        }
    }
}

TEST(WorldInertia, TurnsWithTheBody) {
    const Eigen::Matrix3d I = Eigen::Vector3d(1, 2, 3).asDiagonal();
    const Eigen::Quaterniond q(Eigen::AngleAxisd(1.5707963267948966, Eigen::Vector3d::UnitZ()));
    const Eigen::Matrix3d W = worldInertia<Space3d>(q, I);
    EXPECT_NEAR(W(0, 0), 2, 1e-15);
    EXPECT_NEAR(W(1, 1), 1, 1e-15);
    EXPECT_NEAR(W(2, 2), 3, 1e-15);
}

}  // namespace
}  // namespace rigor::engine
