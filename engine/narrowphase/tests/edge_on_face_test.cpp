// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A body that rests on an edge needs contact points at both ends: an edge that lies along a face meets it in
// an interval, whether an edge or a face makes the axis. With one point, piles of boxes never come to rest.
#include <gtest/gtest.h>

#include <random>

#include "engine/narrowphase/manifold.hpp"
#include "engine/shapes/hull.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class EdgeOnFace : public testing::Test {};
using EdgeOnFaceSpaces = testing::Types<Space3f, Space3d>;
TYPED_TEST_SUITE(EdgeOnFace, EdgeOnFaceSpaces);

template <class S>
Shape<S> hullOfBox(const typename S::Vec& half) {
    std::vector<typename S::Vec> corners;
    for (int i = 0; i < 8; ++i)
        corners.push_back(half.cwiseProduct(typename S::Vec(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
    return makeHull<S>(corners);
}

/// A small box stands on one of its edges, turned about it by 30 degrees, on the top of a large one, and
/// both are tilted against each other by `tilt` about the horizontal across the edge.
template <class S>
Manifold<S> standOnEdge(const char* narrowPhase, bool hull, bool swapped, double tilt, double yaw) {
    using R = typename S::Real;
    using Vec = typename S::Vec;
    const Vec large(R(2), R(0.5), R(2)), small(R(0.3), R(0.4), R(0.5));
    const Shape<S> table = Box<S>{large};
    const Shape<S> leaning = hull ? hullOfBox<S>(small) : Shape<S>(Box<S>{small});
    const auto about = [](double angle, const Vec& axis) {
        return typename S::Rot(Eigen::AngleAxis<R>(static_cast<R>(angle), axis));
    };
    const typename S::Rot q =
        about(yaw, Vec::UnitY()) * about(tilt, Vec::UnitX()) * about(0.5236, Vec::UnitZ());
    R lowest = 0;
    for (int i = 0; i < 8; ++i)
        lowest = std::min(
            lowest, R((q * small.cwiseProduct(Vec(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1))).y()));
    Pose<S> X, Y;
    Y.q = q;
    Y.p = Vec(R(0.1), R(0.5) - lowest - R(1e-3), R(-0.2));  // 1 mm deep
    Manifold<S> out;
    const CollideFunction<S> collide = findNarrowPhase<S>(narrowPhase);
    if (swapped)
        collide(leaning, Y, table, X, R(5e-3), out);
    else
        collide(table, X, leaning, Y, R(5e-3), out);
    return out;
}

TYPED_TEST(EdgeOnFace, HasTheEndsOfTheEdge) {
    using S = TypeParam;
    for (const char* narrowPhase : {"sat", "gjk_epa"})
        for (const bool hull : {false, true})
            for (const bool swapped : {false, true})
                for (const double tilt : {-2e-3, -1e-4, 0.0, 1e-4, 2e-3})
                    for (const double yaw : {0.0, 1e-3, 0.3, 1.2}) {
                        const Manifold<S> m = standOnEdge<S>(narrowPhase, hull, swapped, tilt, yaw);
                        SCOPED_TRACE(testing::Message() << narrowPhase << (hull ? " hull" : " box")
                                                        << (swapped ? " first" : " second") << ", tilt "
                                                        << tilt << ", yaw " << yaw);
                        ASSERT_EQ(m.count, 2);
                        EXPECT_NEAR((m.points[0].pointB - m.points[1].pointB).norm(), 1.0, 1e-4);
                        EXPECT_NEAR(std::min(m.points[0].separation, m.points[1].separation), -1e-3, 1e-5);
                        EXPECT_NEAR(std::abs(m.points[0].separation - m.points[1].separation), std::abs(tilt),
                                    1e-5);
                        EXPECT_GT(std::abs(m.normal[1]), 0.999);
                    }
}

/// Two cubes of 0.5 m that fell 0.14 m into each other, turned by 8 degrees against each other, so that two edges make
/// the axis of least overlap: the points span the overlap. With one point they turn about it and sink further in.
TYPED_TEST(EdgeOnFace, OverlapAlongAnEdgeAxisHasTheCornersOfItsRegion) {
    using S = TypeParam;
    using R = typename S::Real;
    using Vec = typename S::Vec;
    const Vec half = Vec::Constant(R(0.25));
    Pose<S> X, Y;
    X.q = typename S::Rot(R(0.99849928), R(0.02682913), R(0.04751544), R(-0.00465545));
    Y.q = typename S::Rot(R(0.99680416), R(-0.01653697), R(0.03901638), R(0.06771793));
    Y.p = Vec(R(0.006), R(0.36), R(-0.046));
    const auto outside = [&](const Pose<S>& pose, const Vec& x) {
        return (Vec(pose.q.conjugate() * (x - pose.p)).cwiseAbs() - half).maxCoeff();
    };
    for (const bool hull : {false, true})
        for (const bool swapped : {false, true}) {
            SCOPED_TRACE(testing::Message() << (hull ? "hull" : "box") << (swapped ? " swapped" : ""));
            const Shape<S> cube = hull ? hullOfBox<S>(half) : Shape<S>(Box<S>{half});
            const Pose<S>&first = swapped ? Y : X, &second = swapped ? X : Y;
            Manifold<S> m;
            findNarrowPhase<S>("sat")(cube, first, cube, second, R(1e-3), m);
            EXPECT_EQ(m.memory.axis, ManifoldMemory<S>::kEdges);
            ASSERT_EQ(m.count, 4);
            R least = 0, span = 0;
            for (const ManifoldPoint<S>& x : m.points) {
                EXPECT_LT(x.separation, R(-0.05));
                EXPECT_LT(outside(first, x.pointA), 1e-5);
                EXPECT_LT(outside(second, x.pointB), 1e-5);
                EXPECT_NEAR((x.pointB - x.pointA).dot(m.normal), x.separation, 1e-5);
                least = std::min(least, x.separation);
                span = std::max(span, (x.pointA - m.points[0].pointA).norm());
            }
            EXPECT_GT(span, 0.6);
            Manifold<S> exact;
            findNarrowPhase<S>("gjk_epa")(cube, first, cube, second, R(1e-3), exact);
            EXPECT_NEAR(least, exact.points[0].separation, 1e-4);
            EXPECT_GT(m.normal.dot(exact.normal), 0.9999);
        }
}

/// Boxes that nearly lie on each other: as many points by either narrow phase.
TYPED_TEST(EdgeOnFace, AsManyPointsByAxesAsByDistance) {
    using S = TypeParam;
    using R = typename S::Real;
    using Vec = typename S::Vec;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-1, 1), half(0.4, 0.6);
    const auto vec = [&] {
        return Vec(static_cast<R>(number(random)), static_cast<R>(number(random)),
                   static_cast<R>(number(random)));
    };
    const auto sat = findNarrowPhase<S>("sat"), gjk = findNarrowPhase<S>("gjk_epa");
    int compared = 0, different = 0, edges = 0;
    for (int i = 0; i < 3000; ++i) {
        const Shape<S> a = Box<S>{Vec(R(half(random)), R(half(random)), R(half(random)))};
        const Shape<S> b = Box<S>{Vec(R(half(random)), R(half(random)), R(half(random)))};
        const Vec small = R(3e-3) * vec();
        const typename S::Rot tilt = typename S::Rot(R(1), small.x(), small.y(), small.z()).normalized(),
                              yaw(Eigen::AngleAxis<R>(R(3 * number(random)), Vec::Unit(i % 3)));
        Pose<S> A, B;
        B.q = tilt * yaw;
        B.p = vec().normalized();
        Manifold<S> apart;
        gjk(a, A, b, B, R(10), apart);
        if (apart.count == 0) continue;
        R least = R(10);
        for (int k = 0; k < apart.count; ++k) least = std::min(least, apart.points[k].separation);
        B.p += (R(-1e-3) - least) * apart.normal;
        Manifold<S> byAxes, byDistance;
        sat(a, A, b, B, R(5e-3), byAxes);
        gjk(a, A, b, B, R(5e-3), byDistance);
        if (byDistance.normal.dot(byAxes.normal) < R(0.9999)) continue;  // two ways out, equally deep
        ++compared;
        different += byAxes.count != byDistance.count;
        edges += byAxes.memory.axis == ManifoldMemory<S>::kEdges && byAxes.count == 2;
    }
    EXPECT_GT(compared, 2000);
    EXPECT_GT(edges, 300);
    EXPECT_LE(different, compared / 100);
}

}  // namespace
}  // namespace rigor::engine::test
