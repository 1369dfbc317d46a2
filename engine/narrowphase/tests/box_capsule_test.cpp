// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Box against capsule in 3D: what the closed form says of a box is what the search over all features says of
// the hull of its corners. Two programs with nothing in common but the problem.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "engine/narrowphase/tests/pair_table.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class BoxCapsule : public testing::Test {
  protected:
    using R = typename S::Real;
    const Shape<S> box = Box<S>{vec<S>(0.5, 0.3, 0.8)}, hull = boxHull<S>(vec<S>(0.5, 0.3, 0.8));

    static Shape<S> capsule(double radius, double halfLength) { return Capsule<S>{R(radius), R(halfLength)}; }
};
using BoxCapsuleSpaces = testing::Types<Space3f, Space3d>;
TYPED_TEST_SUITE(BoxCapsule, BoxCapsuleSpaces);

template <class S>
void expectSame(const Manifold<S>& m, const Manifold<S>& oracle, double eps, double normalEps) {
    ASSERT_EQ(m.count > 0, oracle.count > 0);
    if (m.count == 0) return;
    EXPECT_NEAR(leastSeparation(m), leastSeparation(oracle), eps);
    EXPECT_LE((m.normal - oracle.normal).norm(), normalEps);
}

/// Deep, touching and apart; thin capsules too, whose cores are hardly apart. If two axes are equally deep
/// either is right: normals are compared where the same depth is not had along the other's normal.
TYPED_TEST(BoxCapsule, IsWhatTheHullOfItsCornersGives) {
    using S = TypeParam;
    const double eps = tol<S>(1e-12, 2e-6);
    Random<S> random{std::mt19937(7)};
    int overlapping = 0, apart = 0, two = 0, sameCount = 0, touching = 0;
    for (int i = 0; i < 20000; ++i) {
        const Shape<S> capsule = this->capsule(i % 3 == 0 ? 0.01 : 0.2, i % 5 == 0 ? 1.5 : 0.4);
        const auto far = static_cast<typename S::Real>(random.uniform(0, 1.4));
        const Pose<S> Xa = pose<S>(vec<S>(0.5, -0.2, 0.3), random.rotation());
        Pose<S> Xb = pose<S>(vec<S>(0.5, -0.2, 0.3) + far * random.direction(), random.rotation());
        // One in four along a face, or nearly so.
        if (i % 4 == 0) Xb.q = compose(Xa.q, turn<S>(i % 8 == 0 ? 0.0 : 0.02));
        SCOPED_TRACE(i);
        const Manifold<S> m = collide<S>(this->box, Xa, capsule, Xb, 0.1);
        const Manifold<S> oracle = collide<S>(this->hull, Xa, capsule, Xb, 0.1);
        const double along =
            oracle.count == 0 ? -1e9 : separationAlong<S>(this->box, Xa, capsule, Xb, oracle.normal);
        const bool tie = m.count > 0 && (m.normal - oracle.normal).norm() > 0.01 &&
                         std::abs(along - leastSeparation(m)) < eps;
        expectSame<S>(m, oracle, eps, tie ? 2 : tol<S>(1e-8, 1e-2));
        if (m.count == 0) continue;
        ++touching;
        sameCount += m.count == oracle.count;
        two += m.count == 2;
        const double core = leastSeparation(m) + std::get<Capsule<S>>(capsule).radius;
        overlapping += core < -0.01;
        apart += core > 0.01;
    }
    EXPECT_GT(overlapping, 3000);
    EXPECT_GT(apart, 3000);
    EXPECT_GT(two, 1000);
    EXPECT_GE(sameCount, touching - touching / 100);
}

/// A core that is next to an edge, a face and a corner: closed forms.
TYPED_TEST(BoxCapsule, ClosestFeatureOfTheBox) {
    using S = TypeParam;
    const double eps = tol<S>(1e-14, 1e-6), r2 = std::sqrt(0.5);
    const Shape<S> capsule = this->capsule(0.2, 1);
    const Pose<S> origin = pose<S>(vec<S>(0, 0, 0));
    const auto at = [&](const typename S::Vec& p, const typename S::Rot& q) {
        return collide<S>(this->box, origin, capsule, pose<S>(p, q), 0.1);
    };
    // The core lies across the edge x = 0.5, y = 0.3 along z, from (1.5, -0.7) to (-0.5, 1.3), 0.1 m off it.
    const typename S::Real off = static_cast<typename S::Real>(r2 * 0.1);
    const auto edge = at(vec<S>(0.5, 0.3, 0.1) + vec<S>(off, off, 0), turn<S>(std::atan(1.0)));
    ASSERT_EQ(edge.count, 1);
    EXPECT_NEAR(leastSeparation(edge), -0.1, eps);
    EXPECT_LE((edge.normal - vec<S>(r2, r2, 0)).norm(), 10 * eps);
    EXPECT_LE((edge.points[0].pointA - vec<S>(0.5, 0.3, 0.1)).norm(), 10 * eps);
    // Upright over the face y = 0.3: its end.
    const auto face = at(vec<S>(0.1, 1.4, 0.2), turn<S>(0));
    ASSERT_EQ(face.count, 1);
    EXPECT_NEAR(leastSeparation(face), -0.1, eps);
    EXPECT_LE((face.points[0].pointA - vec<S>(0.1, 0.3, 0.2)).norm(), 10 * eps);
    // Lying along the face y = 0.3 and over its side x = 0.5: from there to its end.
    const auto lying = at(vec<S>(0.9, 0.45, 0), turn<S>(std::acos(0.0)));
    ASSERT_EQ(lying.count, 2);
    double left = 1e9, right = -1e9;
    for (int i = 0; i < 2; ++i) {
        const auto& p = lying.points[i];
        EXPECT_NEAR(p.separation, -0.05, eps);
        left = std::min(left, static_cast<double>(p.pointA.x()));
        right = std::max(right, static_cast<double>(p.pointA.x()));
    }
    EXPECT_NEAR(left, -0.1, 10 * eps);
    EXPECT_NEAR(right, 0.5, 10 * eps);
    // Its middle nearest to the corner (0.5, 0.3, 0.8), across the diagonal.
    const double r3 = 0.1 / std::sqrt(3.0);
    const auto corner = at(vec<S>(0.5 + r3, 0.3 + r3, 0.8 + r3), turn<S>(std::atan(1.0)));
    ASSERT_EQ(corner.count, 1);
    EXPECT_NEAR(leastSeparation(corner), -0.1, eps);
    EXPECT_LE((corner.points[0].pointA - vec<S>(0.5, 0.3, 0.8)).norm(), 10 * eps);
}

/// Cores that hardly miss each other: the difference of the closest points is all rounding, and the normal
/// is that of the two edges all the same.
TYPED_TEST(BoxCapsule, CrossingEdgesFixTheNormal) {
    using S = TypeParam;
    const auto off = static_cast<typename S::Real>(tol<S>(1e-12, 1e-5));
    const typename S::Vec n = vec<S>(std::cos(0.6), std::sin(0.6)), edge = vec<S>(0.5, 0.3, 0.1);
    const auto m = collide<S>(this->box, pose<S>(vec<S>(0, 0, 0)), this->capsule(0.2, 1),
                              pose<S>(edge + off * n, turn<S>(0.6)));
    ASSERT_EQ(m.count, 1);
    EXPECT_LE((m.normal - n).norm(), tol<S>(1e-14, 1e-6));
}

/// The twelve edges have twelve names, the same from either side of touching.
TYPED_TEST(BoxCapsule, EdgesHaveNames) {
    using S = TypeParam;
    std::set<std::uint32_t> names;
    for (int k = 0; k < 3; ++k)
        for (unsigned sides = 0; sides < 4; ++sides) {
            // `out` points out of the edge along axis k; the core lies across the edge.
            typename S::Vec out = S::Vec::Zero(), edge = S::Vec::Zero();
            const typename S::Vec half = vec<S>(0.5, 0.3, 0.8);
            for (int i = 0; i < 2; ++i) {
                const int axis = (k + 1 + i) % 3;
                out[axis] = (sides >> i & 1) != 0 ? 1 : -1;
                edge[axis] = out[axis] * half[axis];
            }
            const typename S::Vec across = out.cross(S::Vec::Unit(k)).normalized();
            const auto q = S::Rot::FromTwoVectors(S::Vec::UnitY(), across);
            std::uint32_t name[2];
            for (const int apart : {0, 1}) {
                const auto by = static_cast<typename S::Real>(apart != 0 ? 0.05 : -0.05);
                const auto m = collide<S>(this->box, pose<S>(vec<S>(0, 0, 0)), this->capsule(0.1, 0.4),
                                          pose<S>(edge + by * out, q));
                ASSERT_EQ(m.count, 1);
                name[apart] = m.points[0].feature;
            }
            EXPECT_EQ(name[0], name[1]);
            names.insert(name[0]);
        }
    EXPECT_EQ(names.size(), 12u);
}

/// The separation bound of a pair that does not touch is a lower bound of its distance.
TYPED_TEST(BoxCapsule, ApartIsABound) {
    using S = TypeParam;
    Random<S> random{std::mt19937(8)};
    int known = 0;
    for (int i = 0; i < 2000; ++i) {
        const Pose<S> Xa = pose<S>(vec<S>(0, 0, 0), random.rotation());
        const Pose<S> Xb = pose<S>(typename S::Vec(2 * random.direction()), random.rotation());
        const Shape<S> capsule = this->capsule(0.2, 0.4);
        for (const Shape<S>& solid : {this->box, this->hull}) {
            const Manifold<S> m = collide<S>(solid, Xa, capsule, Xb);
            if (m.count > 0) continue;
            known += m.separationLowerBound > 0;
            const Manifold<S> wide = collide<S>(solid, Xa, capsule, Xb, 10);
            EXPECT_GE(leastSeparation(wide), m.separationLowerBound - tol<S>(1e-14, 1e-6));
        }
    }
    EXPECT_GT(known, 2000);
}

}  // namespace
}  // namespace rigor::engine::test
