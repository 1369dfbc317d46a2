// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/math/rotation.hpp"

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
        const double angle = std::pow(10.0, -8 + 8.49 * (i / 5000.0));  // up to 3.09 rad
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
