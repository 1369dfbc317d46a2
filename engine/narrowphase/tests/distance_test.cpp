// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Signed distances against proofs of their own: a pair of points in the shapes bounds the distance from
// above, the gap along the normal from below. Overlaps against a sweep over all directions of the facets and
// against the separating axes.
#include <gtest/gtest.h>

#include <string_view>

#include "engine/core/tests/counting_new.hpp"
#include "engine/narrowphase/distance.hpp"
#include "engine/narrowphase/tests/pair_table.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Distance : public testing::Test {
  protected:
    /// Distance of a point from a shape, computed for a sphere of radius zero.
    static double outside(const typename S::Vec& x, const Shape<S>& s, const Pose<S>& X) {
        const Shape<S> dot = Sphere<S>{typename S::Real(0)};
        return static_cast<double>(closestPoints<S>(dot, pose<S>(x), s, X).distance);
    }
    static bool isEllipsoid(const Shape<S>& s) { return std::string_view(shapeName<S>(s)) == "ellipsoid"; }
    static void expectProven(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb,
                             double eps) {
        const ClosestPoints<S> r = closestPoints<S>(a, Xa, b, Xb);
        const bool round = isRound<S>(a) || isRound<S>(b);  // curved: slower, and an honest flag at the limit
        EXPECT_TRUE(r.converged || round);
        ASSERT_TRUE(r.normal.allFinite() && r.pointA.allFinite() && r.pointB.allFinite());
        EXPECT_NEAR(static_cast<double>(r.normal.norm()), 1, tol<S>(1e-14, 1e-6));
        EXPECT_LE(static_cast<double>((r.pointB - r.pointA - r.distance * r.normal).norm()), eps);
        if (a.index() == Kind::HalfSpace || b.index() == Kind::HalfSpace) return;
        EXPECT_NEAR(separationAlong<S>(a, Xa, b, Xb, r.normal), static_cast<double>(r.distance), eps);
        EXPECT_LE(outside(r.pointA, a, Xa), eps);
        EXPECT_LE(outside(r.pointB, b, Xb), eps);
        // Round: a full EPA of 128 points and four descents after it. An ellipsoid is as slow where Newton's
        // method does not end the search before.
        EXPECT_LE(r.iterations, round ? 8000 : (isEllipsoid(a) || isEllipsoid(b) ? 8000 : 80));
    }
};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Distance, Spaces);

TYPED_TEST(Distance, UpperAndLowerBoundMeet) {
    using S = TypeParam;
    int apart = 0, overlapping = 0;
    for (int ka = 0; ka < kKinds<S>; ++ka)
        for (int kb = 0; kb < kKinds<S>; ++kb) {
            const Shape<S> a = shapeOfKind<S>(ka), b = shapeOfKind<S>(kb);
            if (!isConvexPair<S>(a, b)) continue;
            SCOPED_TRACE(std::string(shapeName<S>(a)) + " and " + shapeName<S>(b));
            Random<S> random{std::mt19937(static_cast<unsigned>(10 * ka + kb))};
            for (int i = 0; i < 100; ++i) {
                const auto far = static_cast<typename S::Real>(random.uniform(0, 2.5));
                const Pose<S> Xa = pose<S>(vec<S>(0.5, -0.2, 0.3), random.rotation());
                const Pose<S> Xb = pose<S>(Xa.p + far * random.direction(), random.rotation());
                const double curved = curvedTolerance<S>(a, b);
                this->expectProven(a, Xa, b, Xb, std::max(curved, tol<S>(1e-14, 8e-6)));
                const double d = static_cast<double>(closestPoints<S>(a, Xa, b, Xb).distance);
                ++(d < 0 ? overlapping : apart);
                const Manifold<S> m = collide<S>(a, Xa, b, Xb);
                if (std::abs(d) > std::max(curved, tol<S>(1e-14, 1e-5))) {
                    ASSERT_EQ(m.count > 0, d < 0) << d;
                }
                if (m.count > 0) {
                    EXPECT_NEAR(leastSeparation(m), d, std::max(curved, tol<S>(1e-14, 8e-6)));
                }
            }
        }
    EXPECT_GT(apart, 300);
    EXPECT_GT(overlapping, 300);
}

/// Hulls of 8 to 20 vertices, boxes among them, as plates of 1 : 1000 when `flat`.
template <class S>
Shape<S> anyHull(Random<S>& random, double size, bool flat) {
    using R = typename S::Real;
    const typename S::Vec scale = static_cast<R>(size) * vec<S>(1, flat ? 1e-3 : 1, 1);
    if (random.uniform(0, 1) < 0.3)
        return boxHull<S>(typename S::Vec(scale.cwiseProduct(
            vec<S>(random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1)))));
    std::vector<typename S::Vec> points;
    for (int n = 8 + static_cast<int>(random.uniform(0, 12.99)); n > 0; --n)
        points.push_back(scale.cwiseProduct(random.direction()));
    return makeHull<S>(points);
}

struct Hard {
    const char* name;
    double size = 1;
    bool flat = false;   ///< 1 : 1000
    double turned = 10;  ///< relative rotation [rad]; 10: any
    double reach = 2;    ///< distance of the origins over the size
    bool same = false;   ///< twice the same shape
    double place = 0;    ///< distance from the world's origin [m]
};
constexpr Hard kHard[] = {
    {"generic"},
    {"thin", 1, true},
    {"tiny", 1e-3},
    {"huge", 1e3},
    {"parallel", 1, false, 0},
    {"nearly parallel", 1, false, 1e-6},
    {"concentric", 1, false, 10, 0},
    {"identical", 1, false, 0, 0, true},
    {"far from the origin", 1, false, 10, 2, false, 1e4},
};

/// The bounds meet wherever the shapes stand, and so does their verdict with that of the separating axes.
TYPED_TEST(Distance, HardCasesAreProven) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const Hard& hard : kHard) {
        SCOPED_TRACE(hard.name);
        Random<S> random{std::mt19937(5)};
        int overlapping = 0;
        for (int i = 0; i < 300; ++i) {
            const Shape<S> a = anyHull<S>(random, hard.size, hard.flat);
            const Shape<S> b = hard.same ? a : anyHull<S>(random, hard.size, hard.flat && i % 2 == 0);
            const Pose<S> Xa = pose<S>(static_cast<R>(hard.place) * random.direction(), random.rotation());
            Pose<S> Xb = pose<S>(
                Xa.p + static_cast<R>(random.uniform(0, hard.reach) * hard.size) * random.direction(), Xa.q);
            Xb.q = hard.turned < 10 ? compose(Xa.q, turn<S>(hard.turned, hard.turned)) : random.rotation();
            this->expectProven(a, Xa, b, Xb,
                               hard.size * tol<S>(2e-14, 2e-5) + hard.place * tol<S>(1e-15, 1e-6));
            overlapping += closestPoints<S>(a, Xa, b, Xb).distance < 0;
        }
        EXPECT_GT(overlapping, 100);
    }
}

/// Moved to touch, then apart or together by as little as rounding resolves: no wrong verdict.
TYPED_TEST(Distance, GrazingIsDistinguished) {
    using S = TypeParam;
    using R = typename S::Real;
    Random<S> random{std::mt19937(8)};
    for (int i = 0; i < 300; ++i) {
        const Shape<S> a = anyHull<S>(random, 1, false), b = anyHull<S>(random, 1, false);
        const Pose<S> Xa = pose<S>(vec<S>(0, 0, 0), random.rotation());
        Pose<S> Xb = pose<S>(random.direction(), random.rotation());
        const ClosestPoints<S> first = closestPoints<S>(a, Xa, b, Xb);
        const R gap =
            static_cast<R>((i % 2 ? 1 : -1) * tol<S>(1e-13, 1e-5) * std::pow(10, random.uniform(0, 2)));
        Xb.p += (gap - first.distance) * first.normal;
        const ClosestPoints<S> second = closestPoints<S>(a, Xa, b, Xb);
        EXPECT_EQ(second.distance < 0, gap < 0) << gap << " reported as " << second.distance;
        // Parted along the normal of the shortest way out the shapes may still slide: never further apart.
        EXPECT_NEAR(static_cast<double>(second.distance), static_cast<double>(gap), tol<S>(5e-15, 3e-6));
    }
}

/// Cores whose difference has no volume: crossing and collinear segments, coinciding points.
TYPED_TEST(Distance, CoresWithoutVolumeStillHaveANormal) {
    using S = TypeParam;
    using R = typename S::Real;
    const Shape<S> ball = Sphere<S>{R(0.5)}, capsule = Capsule<S>{R(0.25), R(0.5)};
    const auto depth = [&](const Shape<S>& a, const Shape<S>& b, const typename S::Rot& q, double y) {
        const Pose<S> Xa = pose<S>(vec<S>(1, 2, 3)), Xb = pose<S>(vec<S>(1, 2 + y, 3), q);
        this->expectProven(a, Xa, b, Xb, tol<S>(1e-14, 1e-6));
        return -static_cast<double>(closestPoints<S>(a, Xa, b, Xb).distance);
    };
    const double eps = tol<S>(1e-15, 1e-6);
    EXPECT_NEAR(depth(ball, ball, turn<S>(0), 0), 1, eps);
    EXPECT_NEAR(depth(ball, capsule, turn<S>(0.3), 0), 0.75, eps);
    EXPECT_NEAR(depth(capsule, capsule, turn<S>(0), 0), 0.5, eps);
    EXPECT_NEAR(depth(capsule, capsule, turn<S>(0), 0.7), 0.5, eps);
    // Crossing at right angles: in 2D the way out is along one of them, in 3D across both.
    EXPECT_NEAR(depth(capsule, capsule, turn<S>(std::acos(0.0)), 0), S::dim == 2 ? 1 : 0.5, eps);
}

TYPED_TEST(Distance, AllocatesNothing) {
    using S = TypeParam;
    Random<S> random{std::mt19937(4)};
    long counted = 0;
    for (int i = 0; i < 50; ++i) {
        const Shape<S> a = anyHull<S>(random, 1, false), b = anyHull<S>(random, 1, false);
        const Pose<S> Xa, Xb = pose<S>(vec<S>(0.3 * (i % 9), 0.1, 0.2), random.rotation());
        const long before = allocationCount();
        counted += closestPoints<S>(a, Xa, b, Xb).iterations < 0;
        counted += allocationCount() - before;
    }
    EXPECT_EQ(counted, 0);
}

}  // namespace
}  // namespace rigor::engine::test
