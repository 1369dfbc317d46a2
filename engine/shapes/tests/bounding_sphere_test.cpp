// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bounding spheres contain their shapes, touch them, and are the smallest.
#include "engine/shapes/bounding_sphere.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/shapes/surface.hpp"

namespace rigor::engine {
namespace {

template <class S>
class BoundingSphereTest : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(BoundingSphereTest, Spaces);

template <class S>
typename S::Vec randomVec(std::mt19937& random, double size) {
    std::uniform_real_distribution<double> component(-size, size);
    typename S::Vec v;
    for (int i = 0; i < S::dim; ++i) v[i] = static_cast<typename S::Real>(component(random));
    return v;
}

/// A ball contains a shape if the support points in the directions from its centre are inside; and no smaller one does if
/// no half of it is free of touching points, that is, if no direction leads away from all of them.
template <class S>
void expectSmallest(const Shape<S>& shape, const char* name) {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    const BoundingSphere<S> sphere = boundingSphere<S>(shape);
    const Real rounding = 64 * std::numeric_limits<Real>::epsilon() * sphere.radius;
    std::mt19937 random(7);
    std::vector<Vec> touching;
    for (int i = 0; i < 4000; ++i) {
        const Vec direction = randomVec<S>(random, 1).normalized();
        const Vec point = support<S>(shape, direction);
        EXPECT_LE((point - sphere.center).norm(), sphere.radius + rounding) << name;
        if ((point - sphere.center).norm() > Real(0.9999) * sphere.radius) touching.push_back(point);
    }
    for (int i = 0; i < 200; ++i) {
        const Vec away = randomVec<S>(random, 1).normalized();
        Real furthest = -1;
        for (const Vec& point : touching) furthest = std::max(furthest, away.dot(point - sphere.center));
        EXPECT_GE(furthest, Real(-0.02) * sphere.radius) << name;
    }
}

TYPED_TEST(BoundingSphereTest, IsTheSmallestAroundEachShape) {
    using S = TypeParam;
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    expectSmallest<S>(Sphere<S>{Real(0.7)}, "sphere");
    Vec half = Vec::Constant(Real(0.2));
    half[0] = Real(1.5);
    expectSmallest<S>(Box<S>{half}, "box");
    expectSmallest<S>(Capsule<S>{Real(0.2), Real(0.9)}, "capsule");
    std::mt19937 random(3);
    for (int i = 0; i < 20; ++i) {
        std::vector<Vec> points;
        for (int k = 0; k < 4 + 3 * i; ++k)
            points.push_back(randomVec<S>(random, 2) + Vec::Constant(Real(5)));
        expectSmallest<S>(makeHull<S>(points), "hull");
    }
    if constexpr (S::dim == 3) {
        expectSmallest<S>(Cylinder<S>{Real(0.4), Real(0.3)}, "cylinder");
        expectSmallest<S>(Ellipsoid<S>{{Real(0.3), Real(0.8), Real(0.5)}}, "ellipsoid");
        expectSmallest<S>(Cone<S>{Real(0.3), Real(0.8)}, "tall cone");
        expectSmallest<S>(Cone<S>{Real(0.9), Real(0.2)}, "flat cone");
    }
}

TYPED_TEST(BoundingSphereTest, ShapesOfStaticBodiesHaveNone) {
    using S = TypeParam;
    typename S::Vec up = S::Vec::Zero();
    up[1] = 1;
    EXPECT_TRUE(std::isinf(boundingSphere<S>(HalfSpace<S>{up, 0}).radius));
}

/// A cone of height H and base radius r < H: R = (r^2 + H^2) / (2 H).
TEST(BoundingSphere, ClosedFormOfACone) {
    const BoundingSphere<Space3d> sphere = boundingSphere<Space3d>(Cone<Space3d>{3, 2});
    EXPECT_NEAR(sphere.radius, 25.0 / 8, 1e-13);
    EXPECT_NEAR(sphere.center[1], 2 - 25.0 / 8, 1e-13);
}

/// All spheres through two to four of the points, by enumeration: none that holds all points is smaller.
TEST(BoundingSphere, PointsOnASphereAndCopiesOfThem) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<Eigen::Vector3d> points;
        const Eigen::Vector3d center(normal(random), normal(random), normal(random));
        for (int i = 0; i < 30; ++i) {
            const Eigen::Vector3d on =
                Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
            points.push_back(center + 2 * on);
            points.push_back(center - 2 * on);
            points.push_back(points.front());
        }
        const auto sphere = smallestSphere<3>(points);
        EXPECT_NEAR(sphere.radius, 2, 1e-10);
        EXPECT_LT((sphere.center - center).norm(), 1e-9);
    }
}

}  // namespace
}  // namespace rigor::engine
