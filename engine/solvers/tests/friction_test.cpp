// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The local friction laws against their own definitions.
#include <gtest/gtest.h>

#include <random>

#include "engine/solvers/solver.hpp"

namespace rigor::engine {
namespace {

template <class R>
class Friction : public testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(Friction, Reals);

TYPED_TEST(Friction, ConeSticksOrOpposesSlipOnTheRim) {
    using R = TypeParam;
    using S = Space<R, 3>;
    using Vec2 = Eigen::Matrix<R, 2, 1>;
    const auto cone = findAlgorithm(frictionTable<S>(), "friction", "cone").make;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(-1, 1);
    const double eps = sizeof(R) == 8 ? 1e-11 : 2e-4;
    int sticking = 0, sliding = 0;
    for (int i = 0; i < 20000; ++i) {
        // K = A A^T + small, over several orders of anisotropy
        const double a = u(random), b = u(random), c = std::pow(10, 2 * u(random)) * u(random);
        const R k11 = R(a * a + b * b + 0.05), k12 = R(b * c), k22 = R(c * c + 0.05);
        const Vec2 impulse(R(u(random)), R(u(random))), velocity(R(3 * u(random)), R(3 * u(random)));
        const R limit = R(std::abs(u(random)) * 2);
        const Vec2 next = cone(k11, k12, k22, impulse, velocity, limit);
        const Vec2 step = next - impulse;
        const Vec2 slip(velocity[0] + k11 * step[0] + k12 * step[1],
                        velocity[1] + k12 * step[0] + k22 * step[1]);
        const double scale = 1 + double(k11 + k22) * (double(next.norm()) + double(impulse.norm())) + 4;
        ASSERT_LE(next.norm(), limit * R(1 + 1e-6));
        if (slip.norm() < eps * scale) {
            ++sticking;
            continue;
        }
        ++sliding;
        // Maximal dissipation: on the rim, exactly against the slip.
        ASSERT_NEAR(next.norm(), limit, eps * scale) << i;
        ASSERT_NEAR(next.dot(slip), -limit * slip.norm(), eps * scale * double(limit)) << i;
    }
    EXPECT_GT(sticking, 500);
    EXPECT_GT(sliding, 500);
}

/// Limits that square below the smallest number, as redundant contacts have: on the rim against b, never NaN.
TYPED_TEST(Friction, ConeWithAVanishingLimit) {
    using R = TypeParam;
    using Vec2 = Eigen::Matrix<R, 2, 1>;
    const auto cone = findAlgorithm(frictionTable<Space<R, 3>>(), "friction", "cone").make;
    for (int exponent = std::numeric_limits<R>::min_exponent10; exponent < -4; exponent += 2) {
        const R limit = std::pow(R(10), R(exponent));
        const Vec2 lambda = cone(R(2), R(0.3), R(1), Vec2(0, 0), Vec2(3, 4), limit);
        ASSERT_TRUE(lambda.allFinite()) << exponent;
        EXPECT_LE(lambda.norm(), limit * R(1.001)) << exponent;
        EXPECT_LE(lambda[0], 0);
        EXPECT_LE(lambda[1], 0);
    }
}

TYPED_TEST(Friction, PyramidClampsEachTangent) {
    using R = TypeParam;
    using Vec2 = Eigen::Matrix<R, 2, 1>;
    const auto pyramid = findAlgorithm(frictionTable<Space<R, 3>>(), "friction", "pyramid").make;
    const Vec2 next = pyramid(1, 0, 1, Vec2(0, 0), Vec2(-5, 5), R(0.5));
    EXPECT_EQ(next, Vec2(R(0.5), R(-0.5)));
    EXPECT_EQ(pyramid(2, 0, 4, Vec2(0, 0), Vec2(R(0.2), R(-0.4)), R(0.5)), Vec2(R(-0.1), R(0.1)));
}

/// The limit is the same on both sides of both tangents; the second tangent sees the effect of the first.
TYPED_TEST(Friction, PyramidIsTheSameOnEverySideAndCouplesItsTangents) {
    using R = TypeParam;
    using Vec2 = Eigen::Matrix<R, 2, 1>;
    const auto pyramid = findAlgorithm(frictionTable<Space<R, 3>>(), "friction", "pyramid").make;
    for (const R x : {R(-1), R(1)})
        for (const R y : {R(-1), R(1)})
            EXPECT_EQ(pyramid(1, 0, 1, Vec2(0, 0), Vec2(-5 * x, -5 * y), R(0.5)),
                      Vec2(R(0.5) * x, R(0.5) * y));
    // Sticking: v1 + 2 l1 = 0 gives l1 = -0.1; then v2 + 0.5 l1 + 4 l2 = 0.
    const Vec2 coupled = pyramid(2, R(0.5), 4, Vec2(0, 0), Vec2(R(0.2), R(0.45)), 1);
    EXPECT_NEAR(coupled[0], -0.1, 1e-6);
    EXPECT_NEAR(coupled[1], -0.1, 1e-6);
    // The same from impulses that are there already.
    const Vec2 warm = pyramid(2, R(0.5), 4, Vec2(R(-0.1), R(-0.1)), Vec2(R(-0.05), 0), 1);
    EXPECT_NEAR(warm[0], -0.1 + 0.025, 1e-6);
    EXPECT_NEAR(warm[1], -0.1 - 0.5 * 0.025 / 4, 1e-6);
}

/// One direction, against the slip that there would be without friction: stopped along it, or at the limit.
TYPED_TEST(Friction, TheOneDirectionOfPyramid2IsAgainstTheSlip) {
    using R = TypeParam;
    using Vec2 = Eigen::Matrix<R, 2, 1>;
    const auto law = findAlgorithm(frictionTable<Space<R, 3>>(), "friction", "pyramid_2").make;
    std::mt19937 random(4);
    std::uniform_real_distribution<double> u(-1, 1);
    int sticking = 0, sliding = 0;
    for (int i = 0; i < 2000; ++i) {
        const double a = u(random), b = u(random), c = u(random);
        const R k11 = R(a * a + b * b + 0.1), k12 = R(b * c), k22 = R(c * c + 0.1);
        const Vec2 impulse(R(u(random)), R(u(random))), velocity(R(3 * u(random)), R(3 * u(random)));
        const R limit = R(std::abs(u(random)) * 4);
        const Vec2 free(velocity[0] - k11 * impulse[0] - k12 * impulse[1],
                        velocity[1] - k12 * impulse[0] - k22 * impulse[1]);
        const Vec2 next = law(k11, k12, k22, impulse, velocity, limit);
        const double eps = sizeof(R) == 8 ? 1e-12 : 1e-4;
        ASSERT_NEAR(next.normalized().dot(free.normalized()), -1, eps);
        const Vec2 slip(free[0] + k11 * next[0] + k12 * next[1], free[1] + k12 * next[0] + k22 * next[1]);
        const double along = slip.dot(free.normalized());
        if (std::abs(along) < eps * 100) {
            ++sticking;
            ASSERT_LE(next.norm(), limit * (1 + eps));
        } else {
            ++sliding;
            ASSERT_NEAR(next.norm(), limit, eps * 100);
            ASSERT_GT(along, 0);
        }
    }
    EXPECT_GT(sticking, 200);
    EXPECT_GT(sliding, 200);
}

TYPED_TEST(Friction, NothingWithoutNormalImpulse) {
    using R = TypeParam;
    using Vec2 = Eigen::Matrix<R, 2, 1>;
    for (const auto& law : frictionTable<Space<R, 3>>())
        EXPECT_EQ(law.make(1, 0, 1, Vec2(R(0.3), R(0.1)), Vec2(1, 1), 0), Vec2(0, 0)) << law.name;
}

}  // namespace
}  // namespace rigor::engine
