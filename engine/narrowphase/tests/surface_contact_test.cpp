// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Convex shapes on chains, meshes and height fields: a flat surface in pieces is a half-space wherever the
// shape stands, its inner edges never show in a normal, convex and open edges do.
#include "engine/narrowphase/surface_contact.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "engine/narrowphase/narrowphases.hpp"
#include "engine/narrowphase/tests/pair_table.hpp"

namespace rigor::engine::test {
namespace {

/// y = 0 in pieces, several metres wide.
template <class S>
std::vector<Shape<S>> flatSurfaces() {
    using R = typename S::Real;
    if constexpr (S::dim == 2) {
        std::vector<typename S::Vec> v;
        for (int i = 0; i <= 16; ++i) v.push_back(vec<S>(0.37 * (i - 8), 0));
        std::vector<typename S::Vec> back(v.rbegin(), v.rend());
        return {makeChain<S>(v, false), makeChain<S>(back, false)};
    } else {
        const int n = 12;
        std::vector<typename S::Vec> v;
        std::vector<std::array<std::uint32_t, 3>> t;
        for (int k = 0; k <= n; ++k)
            for (int i = 0; i <= n; ++i) v.push_back(vec<S>(0.5 * (i - n / 2), 0, 0.45 * (k - n / 2)));
        for (std::uint32_t k = 0; k < 12; ++k)
            for (std::uint32_t i = 0; i < 12; ++i) {
                const std::uint32_t a = 13 * k + i;
                // Windings mixed: a two-sided mesh has no outside.
                t.push_back({a, a + 13, a + 1});
                t.push_back({a + 14, a + 13, a + 1});
            }
        const std::vector<R> heights(13 * 13, R(0));
        return {makeTriangleMesh<S>(v, t), makeHeightField<S>(13, 13, R(0.5), R(0.45), heights, R(1))};
    }
}

template <class S>
std::vector<Manifold<S>> allPieces(const Shape<S>& surface, const Shape<S>& convex, const Pose<S>& X,
                                   double speculative) {
    std::vector<Manifold<S>> found;
    const Pose<S> here;
    const auto narrowPhase = makeNarrowPhase<S>("sat");
    withSurface<S>(surface, [&](const auto& data) {
        for (std::uint32_t i = 0; i < data.pieceCount(); ++i) {
            Manifold<S> m;
            collidePiece<S>(*narrowPhase, surface, i, false, here, convex, X,
                            static_cast<typename S::Real>(speculative), m);
            if (m.count > 0) found.push_back(m);
        }
    });
    return found;
}

template <class S>
class Surface : public testing::Test {};
using SurfaceSpaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Surface, SurfaceSpaces);

/// Every kind, standing anywhere and turned any way, a little in the ground or just over it: all normals up,
/// the least separation that of the half-space.
TYPED_TEST(Surface, FlatPiecesAreAHalfSpace) {
    using S = TypeParam;
    using R = typename S::Real;
    Random<S> random{std::mt19937(12)};
    const auto up = vec<S>(0, 1, 0);
    int contacts = 0;
    for (const Shape<S>& surface : flatSurfaces<S>())
        for (int kind = 0; kind < kKinds<S>; ++kind) {
            const Shape<S> convex = shapeOfKind<S>(kind);
            if (isStaticOnly<S>(convex)) continue;
            SCOPED_TRACE(std::string(shapeName<S>(convex)) + " on " + shapeName<S>(surface));
            for (int i = 0; i < 60; ++i) {
                Pose<S> X =
                    pose<S>(vec<S>(random.uniform(-1, 1), 0, random.uniform(-1, 1)), random.rotation());
                if (i % 3 == 0) X.q = turn<S>(0);
                if (i % 3 == 1) X.q = turn<S>(std::numbers::pi / 2);
                const double depth = i % 2 ? 1e-3 : random.uniform(-0.01, 0.02);
                const double low = static_cast<double>(boundingBox<S>(convex, X).min.y());
                X.p.y() = static_cast<R>(-low - depth);
                double least = 1e9;
                for (const Manifold<S>& m : allPieces<S>(surface, convex, X, 0.015)) {
                    ++contacts;
                    EXPECT_LE((m.normal - up).norm(), tol<S>(2e-7, 3e-3));
                    least = std::min(least, leastSeparation(m));
                }
                EXPECT_NEAR(least, -depth, tol<S>(1e-7, 1e-5)) << i;
            }
        }
    EXPECT_GT(contacts, 200);
}

/// All contacts that a surface has with a shape, as the step finds them: per facet.
template <class S>
std::vector<Manifold<S>> allFacets(const Shape<S>& surface, const Shape<S>& convex, const Pose<S>& X,
                                   double speculative) {
    const auto distance = static_cast<typename S::Real>(speculative);
    std::vector<Manifold<S>> found;
    std::vector<std::uint32_t> names;
    addFacetNames<S>(surface, boxOnSurface<S>({}, convex, X, distance), names);
    const auto narrowPhase = makeNarrowPhase<S>("sat");
    for (const std::uint32_t name : names) {
        Manifold<S> m;
        collideFacet<S>(*narrowPhase, surface, name, false, {}, convex, X, distance, m);
        if (m.count > 0) found.push_back(m);
    }
    return found;
}

/// A flat surface in pieces is one facet: one manifold, with the points that the shape has with a half-space.
/// Shapes with discs, and hulls, which a half-space meets at all corners in reach, have their lowest point.
TYPED_TEST(Surface, AFacetHasTheManifoldOfAHalfSpace) {
    using S = TypeParam;
    using R = typename S::Real;
    Random<S> random{std::mt19937(21)};
    const Shape<S> plane = HalfSpace<S>{vec<S>(0, 1, 0), R(0)};
    std::vector<Shape<S>> shapes{Sphere<S>{R(0.4)}, Capsule<S>{R(0.2), R(0.5)},
                                 Box<S>{S::Vec::Constant(R(0.45))}};
    if constexpr (S::dim == 3) shapes.push_back(Cylinder<S>{R(0.3), R(0.4)});
    for (const Shape<S>& surface : flatSurfaces<S>())
        for (std::size_t kind = 0; kind < shapes.size(); ++kind)
            for (int i = 0; i < 60; ++i) {
                const Shape<S>& convex = shapes[kind];
                Pose<S> X = pose<S>(vec<S>(random.uniform(-1, 1), 0, random.uniform(-1, 1)), turn<S>(0));
                if (i % 3 == 1) X.q = turn<S>(std::numbers::pi / 2);
                if (i % 3 == 2) X.q = random.rotation();
                const double low = static_cast<double>(boundingBox<S>(convex, X).min.y());
                X.p.y() = static_cast<R>(-low - 1e-3);
                const auto all = allFacets<S>(surface, convex, X, 2e-3);
                ASSERT_EQ(all.size(), 1u) << shapeName<S>(convex) << " on " << shapeName<S>(surface);
                Manifold<S> smooth;
                makeNarrowPhase<S>("sat")->collide(plane, {}, convex, X, R(2e-3), smooth);
                EXPECT_LE((all[0].normal - vec<S>(0, 1, 0)).norm(), tol<S>(1e-12, 1e-5));
                EXPECT_NEAR(leastSeparation(all[0]), leastSeparation(smooth), tol<S>(1e-9, 1e-5));
                if (kind == 3) continue;
                ASSERT_EQ(all[0].count, smooth.count) << shapeName<S>(convex);
                for (int k = 0; k < smooth.count; ++k) {
                    double nearest = 1;
                    for (int j = 0; j < all[0].count; ++j)
                        nearest = std::min(
                            nearest,
                            static_cast<double>((all[0].points[j].pointB - smooth.points[k].pointB).norm()));
                    EXPECT_LE(nearest, tol<S>(1e-9, 1e-5)) << shapeName<S>(convex) << " point " << k;
                }
            }
}

/// A box on the border of the surface stands on the crossings of its edges with the border.
TYPED_TEST(Surface, AFacetEndsAtItsBorder) {
    using S = TypeParam;
    using R = typename S::Real;
    const Shape<S> box = Box<S>{S::Vec::Constant(R(0.3))};
    for (const Shape<S>& surface : flatSurfaces<S>()) {
        const double edge = static_cast<double>(boundingBox<S>(surface, Pose<S>{}).max.x());
        double least = 1e9, most = -1e9;
        for (const Manifold<S>& m :
             allFacets<S>(surface, box, pose<S>(vec<S>(edge - 0.1, 0.3 - 1e-3, 0.07)), 0)) {
            EXPECT_LE((m.normal - vec<S>(0, 1, 0)).norm(), tol<S>(1e-12, 1e-5));
            for (int i = 0; i < m.count; ++i) {
                least = std::min(least, static_cast<double>(m.points[i].pointB.x()));
                most = std::max(most, static_cast<double>(m.points[i].pointB.x()));
            }
        }
        EXPECT_NEAR(least, edge - 0.4, 1e-5) << shapeName<S>(surface);
        EXPECT_NEAR(most, edge, 1e-5) << shapeName<S>(surface);
    }
}

/// The border of the surface is an edge like any other: what hangs over it by its side gets a normal of the
/// edge, and beyond reach of it there is nothing.
TYPED_TEST(Surface, OpenBordersAreFelt) {
    using S = TypeParam;
    using R = typename S::Real;
    const Shape<S> ball = Sphere<S>{R(0.5)};
    for (const Shape<S>& surface : flatSurfaces<S>()) {
        const double edge = static_cast<double>(boundingBox<S>(surface, Pose<S>{}).max.x());
        const Pose<S> X = pose<S>(vec<S>(edge + 0.3, 0.3));
        Manifold<S> m;
        collideDeepestPiece<S>(findNarrowPhase<S>("sat"), surface, Pose<S>{}, ball, X, 0, m);
        ASSERT_EQ(m.count, 1);
        const double s = std::sqrt(0.5);
        EXPECT_LE((m.normal - vec<S>(s, s)).norm(), tol<S>(1e-12, 2e-6));
        EXPECT_NEAR(leastSeparation(m), 0.6 * s - 0.5, tol<S>(1e-12, 1e-6));
        collideDeepestPiece<S>(findNarrowPhase<S>("sat"), surface, Pose<S>{}, ball,
                               pose<S>(vec<S>(edge + 0.6, 0.3)), 0, m);
        EXPECT_EQ(m.count, 0);
    }
}

/// A ridge and a valley with slopes of 45 degrees: over the ridge any normal between the two of the slopes,
/// in the valley only those.
TYPED_TEST(Surface, RidgesTurnTheNormalValleysDoNot) {
    using S = TypeParam;
    using R = typename S::Real;
    const auto fold = [](double middle) -> Shape<S> {
        if constexpr (S::dim == 2) {
            const typename S::Vec v[] = {vec<S>(-1, 0), vec<S>(0, middle), vec<S>(1, 0)};
            return makeChain<S>(v, false);
        } else {
            const typename S::Vec v[] = {vec<S>(-1, 0, -2), vec<S>(0, middle, -2), vec<S>(1, 0, -2),
                                         vec<S>(-1, 0, 2),  vec<S>(0, middle, 2),  vec<S>(1, 0, 2)};
            const std::array<std::uint32_t, 3> t[] = {{0, 3, 1}, {1, 3, 4}, {1, 4, 2}, {2, 4, 5}};
            return makeTriangleMesh<S>(v, t);
        }
    };
    const Shape<S> ball = Sphere<S>{R(0.25)};
    const double s = std::sqrt(0.5);
    for (const double tilt : {-0.6, -0.2, 0.0, 0.3, 0.7}) {
        const Pose<S> X = pose<S>(vec<S>(0.24 * std::sin(tilt), 1 + 0.24 * std::cos(tilt), 0.1));
        double least = 1e9;
        for (const auto& m : allPieces<S>(fold(1), ball, X, 0)) {
            EXPECT_LE((m.normal - vec<S>(std::sin(tilt), std::cos(tilt))).norm(), tol<S>(1e-12, 1e-5));
            least = std::min(least, leastSeparation(m));
        }
        EXPECT_NEAR(least, -0.01, tol<S>(1e-12, 1e-6));
    }
    for (const double x : {-0.02, 0.0, 0.01}) {
        const Pose<S> X = pose<S>(vec<S>(x, -1 + 0.25 / s - 0.02, 0.1));
        int touching = 0;
        for (const auto& m : allPieces<S>(fold(-1), ball, X, 0)) {
            ++touching;
            EXPECT_NEAR(std::abs(static_cast<double>(m.normal.x())), s, tol<S>(1e-12, 1e-5));
            EXPECT_NEAR(static_cast<double>(m.normal.y()), s, tol<S>(1e-12, 1e-5));
        }
        EXPECT_GE(touching, x == 0.0 ? 2 : 1);
    }
}

/// Seen from below a two-sided surface pushes down; a field that is solid below pushes up.
TYPED_TEST(Surface, SidesAreReported) {
    using S = TypeParam;
    using R = typename S::Real;
    const Shape<S> ball = Sphere<S>{R(0.5)};
    for (const Shape<S>& surface : flatSurfaces<S>()) {
        const bool solid = std::string(shapeName<S>(surface)) == "height_field";
        Manifold<S> m;
        collideDeepestPiece<S>(findNarrowPhase<S>("sat"), surface, Pose<S>{}, ball,
                               pose<S>(vec<S>(0.1, -0.4, 0.1)), 0, m);
        ASSERT_EQ(m.count, 1);
        EXPECT_LE((m.normal - vec<S>(0, solid ? 1 : -1)).norm(), tol<S>(1e-12, 1e-6));
        EXPECT_NEAR(leastSeparation(m), solid ? -0.9 : -0.1, tol<S>(1e-12, 1e-6));
    }
}

/// Carried through the world, and queried in the other order.
TYPED_TEST(Surface, RigidMotionAndOrder) {
    using S = TypeParam;
    Random<S> random{std::mt19937(31)};
    int touching = 0;
    for (int surfaceKind = 5; surfaceKind < kKinds<S>; ++surfaceKind) {
        const Shape<S> surface = shapeOfKind<S>(surfaceKind);
        if (!isComposite<S>(surface)) continue;
        for (int kind = 0; kind < kKinds<S>; ++kind) {
            const Shape<S> convex = shapeOfKind<S>(kind);
            if (isStaticOnly<S>(convex)) continue;
            SCOPED_TRACE(std::string(shapeName<S>(convex)) + " on " + shapeName<S>(surface));
            for (int i = 0; i < 30; ++i) {
                const Pose<S> X =
                    pose<S>(typename S::Vec(random.direction() * typename S::Real(0.6)), random.rotation());
                const Pose<S> by = pose<S>(vec<S>(3, -2, 1), random.rotation());
                const Manifold<S> m = collide<S>(surface, Pose<S>{}, convex, X);
                const Manifold<S> moved = collide<S>(surface, by, convex, compose<S>(by, X));
                const Manifold<S> other = collide<S>(convex, X, surface, Pose<S>{});
                ASSERT_EQ(m.count > 0, other.count > 0);
                if (m.count == 0) continue;
                ++touching;
                EXPECT_NEAR(m.normal.norm(), 1, tol<S>(1e-12, 1e-6));
                EXPECT_LE((m.normal + other.normal).norm(), tol<S>(1e-12, 1e-6));
                EXPECT_EQ(leastSeparation(m), leastSeparation(other));
                if (moved.count > 0) {
                    EXPECT_NEAR(leastSeparation(m), leastSeparation(moved), tol<S>(1e-6, 1e-4));
                }
            }
        }
    }
    EXPECT_GT(touching, 50);
}

}  // namespace
}  // namespace rigor::engine::test
