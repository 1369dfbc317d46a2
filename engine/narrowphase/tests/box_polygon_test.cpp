// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Box against box in 2D: the closed form against the loops over the sides of the same boxes as
// polygons.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "engine/narrowphase/tests/pair_table.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class BoxPolygon : public testing::Test {
  protected:
    typename S::Vec halfA = vec<S>(0.5, 0.3), halfB = vec<S>(0.2, 0.4), halfPlate = vec<S>(2, 0.005);
};
using BoxPolygonSpaces = testing::Types<Space2f, Space2d>;
TYPED_TEST_SUITE(BoxPolygon, BoxPolygonSpaces);

/// The points of one are those of the other, in any order.
template <class S>
double distanceOfPoints(const Manifold<S>& m, const Manifold<S>& oracle) {
    double worst = 0;
    for (int i = 0; i < m.count; ++i) {
        double nearest = 1e9;
        for (int k = 0; k < oracle.count; ++k) {
            const auto &p = m.points[i], &q = oracle.points[k];
            nearest = std::min(
                nearest, static_cast<double>((p.pointA - q.pointA).norm() + (p.pointB - q.pointB).norm() +
                                             std::abs(p.separation - q.separation)));
        }
        worst = std::max(worst, nearest);
    }
    return worst;
}

TYPED_TEST(BoxPolygon, IsWhatThePolygonsOfItsCornersGive) {
    using S = TypeParam;
    const double eps = tol<S>(1e-12, 4e-6);
    Random<S> random{std::mt19937(3)};
    int touching = 0, two = 0, same = 0;
    for (int i = 0; i < 20000; ++i) {
        const typename S::Vec half = i % 3 == 0 ? this->halfPlate : this->halfB;
        const Shape<S> a = Box<S>{this->halfA}, b = Box<S>{half};
        const auto far = static_cast<typename S::Real>(random.uniform(0, 1));
        const Pose<S> Xa = pose<S>(vec<S>(0.5, -0.2), random.rotation());
        Pose<S> Xb = pose<S>(vec<S>(0.5, -0.2) + far * random.direction(), random.rotation());
        if (i % 4 == 0) Xb.q = compose(Xa.q, turn<S>(i % 8 == 0 ? 0.0 : 0.02));
        SCOPED_TRACE(i);
        const Manifold<S> m = collide<S>(a, Xa, b, Xb, 0.05);
        const Manifold<S> oracle = collide<S>(boxHull<S>(this->halfA), Xa, boxHull<S>(half), Xb, 0.05);
        ASSERT_EQ(m.count > 0, oracle.count > 0);
        EXPECT_NEAR(m.separationLowerBound, oracle.separationLowerBound, eps);
        if (m.count == 0) continue;
        EXPECT_NEAR(leastSeparation(m), leastSeparation(oracle), eps);
        ++touching;
        two += m.count == 2;
        // Either of two equally deep sides may be the reference.
        same += m.count == oracle.count && (m.normal - oracle.normal).norm() < eps &&
                distanceOfPoints<S>(m, oracle) < 4 * eps;
    }
    EXPECT_GT(touching, 5000);
    EXPECT_GT(two, 2000);
    EXPECT_GE(same, touching - touching / 100);
}

/// Corners and sides have names of their own, and they are the corners' of the right box.
TYPED_TEST(BoxPolygon, PointsAreNamedByCorners) {
    using S = TypeParam;
    const Shape<S> large = Box<S>{vec<S>(1, 1)}, small = Box<S>{vec<S>(0.25, 0.25)};
    std::set<std::uint32_t> names, swapped;
    for (int i = 0; i < 4; ++i) {
        // The small one at rest on each side of the large one.
        const auto q = turn<S>(i * std::acos(0.0));
        const typename S::Vec at = rotate(q, vec<S>(0.1, 1.24));
        const auto m = collide<S>(large, pose<S>(vec<S>(0, 0)), small, pose<S>(at));
        const auto n = collide<S>(small, pose<S>(at), large, pose<S>(vec<S>(0, 0)));
        ASSERT_EQ(m.count, 2);
        ASSERT_EQ(n.count, 2);
        for (std::size_t k = 0; k < 2; ++k) {
            names.insert(m.points[k].feature);
            swapped.insert(n.points[k].feature);
        }
        EXPECT_LE((m.normal - rotate(q, vec<S>(0, 1))).norm(), tol<S>(1e-15, 1e-6));
        EXPECT_LE((m.normal + n.normal).norm(), tol<S>(1e-15, 1e-6));
    }
    EXPECT_EQ(names.size(), 4u);
    EXPECT_EQ(swapped.size(), 4u);
    for (const std::uint32_t name : names) EXPECT_EQ(name >> 30, 2u);  // the names are those of B's features
    for (const std::uint32_t name : swapped) EXPECT_EQ(name >> 30, 1u);
}

}  // namespace
}  // namespace rigor::engine::test
