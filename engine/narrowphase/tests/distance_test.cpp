// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Signed distances against proofs of their own: a pair of points in the shapes bounds the distance from
// above, the gap along the normal from below. Overlaps against a sweep over all directions of the facets and
// against the separating axes.
#include <gtest/gtest.h>

#include "engine/core/tests/counting_new.hpp"
#include "engine/narrowphase/distance.hpp"
#include "engine/narrowphase/tests/pair_table.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Distance : public testing::Test {
  protected:
    using R = typename S::Real;
    /// How far a point stands out of a shape: its distance as a ball of no size.
    static double outside(const typename S::Vec& x, const Shape<S>& s, const Pose<S>& X) {
        const Shape<S> dot = Sphere<S>{R(0)};
        return static_cast<double>(closestPoints<S>(dot, pose<S>(x), s, X).distance);
    }
    static void expectProven(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb,
                             double eps) {
        const ClosestPoints<S> r = closestPoints<S>(a, Xa, b, Xb);
        EXPECT_TRUE(r.converged);
        ASSERT_TRUE(r.normal.allFinite() && r.pointA.allFinite() && r.pointB.allFinite());
        EXPECT_NEAR(static_cast<double>(r.normal.norm()), 1, tol<S>(1e-14, 1e-6));
        EXPECT_LE(static_cast<double>((r.pointB - r.pointA - r.distance * r.normal).norm()), eps);
        if (a.index() == Kind::HalfSpace || b.index() == Kind::HalfSpace) return;
        EXPECT_NEAR(separationAlong<S>(a, Xa, b, Xb, r.normal), static_cast<double>(r.distance), eps);
        EXPECT_LE(outside(r.pointA, a, Xa), eps);
        EXPECT_LE(outside(r.pointB, b, Xb), eps);
        EXPECT_LE(r.iterations, 80);
    }
};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Distance, Spaces);

TYPED_TEST(Distance, UpperAndLowerBoundMeet) {
    using S = TypeParam;
    int apart = 0, overlapping = 0;
    for (int ka = 0; ka < Kind::Count; ++ka)
        for (int kb = 0; kb < Kind::Count; ++kb) {
            if (ka == Kind::HalfSpace && kb == Kind::HalfSpace) continue;
            SCOPED_TRACE("kinds " + std::to_string(ka) + " and " + std::to_string(kb));
            Random<S> random{std::mt19937(static_cast<unsigned>(10 * ka + kb))};
            const Shape<S> a = shapeOfKind<S>(ka), b = shapeOfKind<S>(kb);
            for (int i = 0; i < 100; ++i) {
                const auto far = static_cast<typename S::Real>(random.uniform(0, 2.5));
                const Pose<S> Xa = pose<S>(vec<S>(0.5, -0.2, 0.3), random.rotation());
                const Pose<S> Xb = pose<S>(Xa.p + far * random.direction(), random.rotation());
                this->expectProven(a, Xa, b, Xb, tol<S>(1e-14, 8e-6));
                const double d = static_cast<double>(closestPoints<S>(a, Xa, b, Xb).distance);
                ++(d < 0 ? overlapping : apart);
                const Manifold<S> m = collide<S>(a, Xa, b, Xb);
                if (std::abs(d) > tol<S>(1e-14, 1e-5)) {
                    ASSERT_EQ(m.count > 0, d < 0) << d;
                }
                if (m.count > 0) {
                    EXPECT_NEAR(leastSeparation(m), d, tol<S>(1e-14, 8e-6));
                }
            }
        }
    EXPECT_GT(apart, 300);
    EXPECT_GT(overlapping, 300);
}

}  // namespace
}  // namespace rigor::engine::test
