// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rays against every kind of shape. Oracle: walking along the ray by the distance to the shape (sphere
// tracing with closestPoints), which has nothing in common with the closed forms; for composites, the nearest
// of all pieces.
#include "engine/shapes/ray_cast.hpp"

#include <gtest/gtest.h>

#include "engine/narrowphase/distance.hpp"
#include "engine/narrowphase/tests/pair_table.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Rays : public testing::Test {};
using RaysSpaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Rays, RaysSpaces);

/// Signed distance of a point from a convex shape.
template <class S>
double distanceOf(const typename S::Vec& x, const Shape<S>& shape, const Pose<S>& X) {
    const Shape<S> dot = Sphere<S>{typename S::Real(0)};
    return static_cast<double>(closestPoints<S>(dot, pose<S>(x), shape, X).distance);
}

/// Fraction of the first point of the ray that is on the shape, 2: none. The ray comes from outside.
template <class S>
double marched(const Shape<S>& shape, const Pose<S>& X, const typename S::Vec& o, const typename S::Vec& d,
               double eps) {
    const double length = static_cast<double>(d.norm());
    double t = 0;
    for (int i = 0; i < 20000 && t <= 1; ++i) {
        const double gap = distanceOf<S>(o + static_cast<typename S::Real>(t) * d, shape, X);
        if (gap < eps) return t;
        t += gap / length;
    }
    return 2;
}

TYPED_TEST(Rays, MeetWhereTheDistanceEnds) {
    using S = TypeParam;
    using R = typename S::Real;
    const double eps = tol<S>(1e-7, 1e-4);
    for (int kind = 0; kind < kKinds<S>; ++kind) {
        const Shape<S> shape = shapeOfKind<S>(kind);
        if (isComposite<S>(shape)) continue;
        SCOPED_TRACE(shapeName<S>(shape));
        Random<S> random{std::mt19937(static_cast<unsigned>(kind))};
        int hits = 0, misses = 0, inside = 0;
        for (int i = 0; i < 300; ++i) {
            const Pose<S> X = pose<S>(vec<S>(0.3, -0.2, 0.1), random.rotation());
            const typename S::Vec o = X.p + static_cast<R>(random.uniform(0.2, 3)) * random.direction();
            const typename S::Vec aim = X.p + static_cast<R>(random.uniform(0, 0.8)) * random.direction();
            const typename S::Vec d = static_cast<R>(random.uniform(0.3, 2)) * (aim - o);
            RayHit<S> hit;
            const bool met = castRay<S>(shape, X, o, d, hit);
            const double start = distanceOf<S>(o, shape, X);
            if (start < -eps) {
                ++inside;
                ASSERT_TRUE(met && hit.startsInside);
                EXPECT_EQ(hit.fraction, 0);
                continue;
            }
            if (start < eps) continue;
            const double t = marched<S>(shape, X, o, d, eps);
            // Either result is right near the ray's end and for a tangent.
            if (met != (t <= 1)) {
                const double gap = distanceOf<S>(o + R(met ? hit.fraction : t) * d, shape, X);
                EXPECT_NEAR(gap, 0, 3 * eps) << i;
                continue;
            }
            if (!met) {
                ++misses;
                continue;
            }
            ++hits;
            EXPECT_FALSE(hit.startsInside);
            EXPECT_GE(hit.fraction, t - eps) << i;
            EXPECT_NEAR(distanceOf<S>(hit.point, shape, X), 0, tol<S>(1e-12, 1e-5)) << i;
            EXPECT_LE((o + hit.fraction * d - hit.point).norm(), tol<S>(1e-14, 1e-6));
            EXPECT_NEAR(hit.normal.norm(), 1, tol<S>(1e-14, 1e-6));
            EXPECT_LE(hit.normal.dot(d), tol<S>(1e-12, 1e-5));
            // Nothing of the ray before the hit is in the shape.
            for (const double part : {0.25, 0.5, 0.75, 0.95})
                EXPECT_GE(distanceOf<S>(o + R(part) * hit.fraction * d, shape, X), -eps);
            // The normal is that of the surface: the point just outside along it is as far as we went.
            if (std::holds_alternative<HalfSpace<S>>(shape)) continue;
            const double out = distanceOf<S>(hit.point + R(1e-3) * hit.normal, shape, X);
            EXPECT_NEAR(out, 1e-3, tol<S>(1e-9, 2e-5)) << i;
        }
        EXPECT_GT(hits, 60);
        EXPECT_GT(misses, 10);
        if (!isStaticOnly<S>(shape)) {
            EXPECT_GT(inside, 1);
        }
    }
}

TYPED_TEST(Rays, CompositesAreTheNearestOfTheirPieces) {
    using S = TypeParam;
    using R = typename S::Real;
    Random<S> random{std::mt19937(17)};
    int hits = 0;
    for (int kind = 0; kind < kKinds<S>; ++kind) {
        const Shape<S> shape = shapeOfKind<S>(kind);
        withSurface<S>(shape, [&](const auto& data) {
            for (int i = 0; i < 1000; ++i) {
                const Pose<S> X = pose<S>(vec<S>(0.3, -0.2, 0.1), random.rotation());
                const typename S::Vec o = X.p + R(2) * random.direction();
                const typename S::Vec d = R(3) * random.direction() + R(1) * (X.p - o);
                RayHit<S> hit, one;
                const bool met = castRay<S>(shape, X, o, d, hit);
                R best = 2;
                for (std::uint32_t k = 0; k < data.pieceCount(); ++k)
                    if (castRay<S>(Shape<S>(data.piece(k)), X, o, d, one))
                        best = std::min(best, one.fraction);
                ASSERT_EQ(met, best <= 1);
                if (!met) continue;
                ++hits;
                EXPECT_EQ(hit.fraction, best);
                ASSERT_TRUE(castRay<S>(Shape<S>(data.piece(hit.piece)), X, o, d, one));
                EXPECT_EQ(one.fraction, best);
            }
        });
    }
    EXPECT_GT(hits, 100);
}

/// Straight down on every vertex and along every edge of a mesh and a field: nothing slips through.
TEST(RaysThrough, NoCracksBetweenTriangles) {
    const auto check = [](auto space) {
        using S = decltype(space);
        using R = typename S::Real;
        for (const Shape<S>& shape : {roof<S>(), bumps<S>()})
            withSurface<S>(shape, [&](const auto& data) {
                for (std::uint32_t k = 0; k < data.pieceCount(); ++k)
                    for (const double t : {0.0, 0.3, 0.5, 1.0}) {
                        const auto c = data.corners(k);
                        const typename S::Vec a = data.point(c[0]), b = data.point(c[1]);
                        const typename S::Vec o = a + R(t) * (b - a) + typename S::Vec(0, 2, 0);
                        RayHit<S> hit;
                        ASSERT_TRUE(castRay<S>(shape, Pose<S>{}, o, vec<S>(0, -4, 0), hit)) << k << " " << t;
                        EXPECT_NEAR(hit.fraction, 0.5, 1e-5);
                    }
            });
    };
    check(Space3d{});
    check(Space3f{});
}

/// Short rays in any direction through a grid of slivers of 1 : 1000, at their edges and corners.
TEST(RaysThrough, NoCracksBetweenSlivers) {
    const auto check = [](auto space) {
        using S = decltype(space);
        using R = typename S::Real;
        constexpr int kColumns = 4, kRows = 400;
        constexpr R kDx = R(0.7), kDz = R(0.0007);
        std::mt19937 random(3);
        std::uniform_real_distribution<double> any(-1, 1);
        std::vector<R> heights;
        std::vector<typename S::Vec> vertices;
        std::vector<std::array<std::uint32_t, 3>> triangles;
        for (int k = 0; k < kRows; ++k)
            for (int i = 0; i < kColumns; ++i) {
                heights.push_back(static_cast<R>(1e-4 * any(random)));
                vertices.push_back({static_cast<R>(i) * kDx - R(1.5) * kDx, heights.back(),
                                    static_cast<R>(k) * kDz - R(0.5 * (kRows - 1)) * kDz});
            }
        for (std::uint32_t a = 0; a + kColumns + 1 < vertices.size(); ++a) {
            if (a % kColumns == kColumns - 1) continue;
            triangles.push_back({a, a + kColumns, a + 1});
            triangles.push_back({a + 1, a + kColumns, a + kColumns + 1});
        }
        const std::vector<Shape<S>> shapes{makeTriangleMesh<S>(vertices, triangles),
                                           makeHeightField<S>(kColumns, kRows, kDx, kDz, heights, R(1))};
        for (const Shape<S>& shape : shapes)
            for (int n = 0; n < 20000; ++n) {
                const auto& t = triangles[random() % triangles.size()];
                const R share = n % 2 == 0 ? static_cast<R>(0.5 + 0.5 * any(random)) : R(0);
                const typename S::Vec a = vertices[t[0]], b = vertices[t[1 + random() % 2]];
                const typename S::Vec on = a + share * (b - a);
                if (std::abs(on.x()) > kDx || std::abs(on.z()) > R(0.1)) continue;
                const auto length = static_cast<R>(0.01 + 0.009 * any(random));
                const typename S::Vec d =
                    length * typename S::Vec(static_cast<R>(any(random)), R(-1), static_cast<R>(any(random)));
                RayHit<S> hit;
                ASSERT_TRUE(castRay<S>(shape, Pose<S>{}, on - R(0.5) * d, d, hit)) << n;
            }
    };
    check(Space3d{});
    check(Space3f{});
}

}  // namespace
}  // namespace rigor::engine::test
