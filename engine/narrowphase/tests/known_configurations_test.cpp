// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Configurations whose manifold is known by hand: depth, normal, and the number of points that resting bodies
// need.
#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "engine/narrowphase/narrowphases.hpp"
#include "engine/narrowphase/tests/pair_table.hpp"

namespace rigor::engine::test {
namespace {

constexpr double kPi = std::numbers::pi;

template <class S>
void expectContact(const Manifold<S>& m, const typename S::Vec& normal, double separation, int count) {
    ASSERT_EQ(m.count, count);
    EXPECT_LE((m.normal - normal).norm(), tol<S>(1e-14, 2e-6));
    EXPECT_NEAR(leastSeparation(m), separation, tol<S>(1e-14, 1e-6));
}

template <class S>
class Known : public testing::Test {
  protected:
    using R = typename S::Real;
    const Shape<S> ball = Sphere<S>{R(0.5)};
    const Shape<S> cube = Box<S>{vec<S>(0.5, 0.5, 0.5)};
    const Shape<S> cubeHull = boxHull<S>(vec<S>(0.5, 0.5, 0.5));
    const Shape<S> capsule = Capsule<S>{R(0.25), R(0.5)};
    const Shape<S> floor = HalfSpace<S>{vec<S>(0, 1, 0), R(0)};
    static constexpr int kFace = S::dim == 2 ? 2 : 4;
    static typename S::Vec up() { return vec<S>(0, 1, 0); }
    static Pose<S> at(double x, double y, double z = 0, double angle = 0, double tilt = 0) {
        return pose<S>(vec<S>(x, y, z), turn<S>(angle, tilt));
    }
};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Known, Spaces);

TYPED_TEST(Known, TouchingWithinReach) {
    using S = TypeParam;
    expectContact<S>(collide<S>(this->ball, this->at(0, 0), this->ball, this->at(0, 1.01), 0.02), this->up(),
                     0.01, 1);
    EXPECT_EQ(collide<S>(this->ball, this->at(0, 0), this->ball, this->at(0, 1.03), 0.02).count, 0);
    expectContact<S>(collide<S>(this->floor, this->at(0, 0), this->cube, this->at(3, 0.51), 0.02), this->up(),
                     0.01, this->kFace);
    EXPECT_EQ(collide<S>(this->floor, this->at(0, 0), this->cube, this->at(3, 0.53), 0.02).count, 0);
}

TYPED_TEST(Known, FaceOnFaceHasAFullManifold) {
    using S = TypeParam;
    for (const Shape<S>& a : {this->cube, this->cubeHull})
        for (const Shape<S>& b : {this->cube, this->cubeHull}) {
            const auto m = collide<S>(a, this->at(0, 0), b, this->at(0.2, 0.9, 0.1));
            expectContact<S>(m, this->up(), -0.1, this->kFace);
            // The patch is [-0.3, 0.5] x [-0.4, 0.5]: its corners, on both faces.
            std::set<std::pair<int, int>> corners;
            for (int i = 0; i < m.count; ++i) {
                const auto& p = m.points[i];
                EXPECT_NEAR(p.pointA.y(), 0.5, tol<S>(1e-15, 1e-6));
                EXPECT_NEAR(p.pointB.y(), 0.4, tol<S>(1e-15, 1e-6));
                EXPECT_NEAR(p.separation, -0.1, tol<S>(1e-15, 1e-6));
                corners.insert({static_cast<int>(std::round(p.pointA.x() * 10)),
                                S::dim == 2 ? 0 : static_cast<int>(std::round(p.pointA[S::dim - 1] * 10))});
            }
            if (S::dim == 2)
                EXPECT_EQ(corners, (std::set<std::pair<int, int>>{{-3, 0}, {5, 0}}));
            else
                EXPECT_EQ(corners, (std::set<std::pair<int, int>>{{-3, -4}, {-3, 5}, {5, -4}, {5, 5}}));
        }
}

TYPED_TEST(Known, LyingCapsuleHasTwoPoints) {
    using S = TypeParam;
    const auto lying = this->at(0.1, 0.2, 0, kPi / 2);
    expectContact<S>(collide<S>(this->floor, this->at(0, 0), this->capsule, lying), this->up(), -0.05, 2);
    const auto onBox = this->at(0.1, 0.7, 0, kPi / 2);
    expectContact<S>(collide<S>(this->cube, this->at(0, 0), this->capsule, onBox), this->up(), -0.05, 2);
    expectContact<S>(collide<S>(this->capsule, onBox, this->cubeHull, this->at(0, 0)), -this->up(), -0.05, 2);
    // Two capsules side by side share the stretch from -0.2 to 0.5.
    const auto m = collide<S>(this->capsule, this->at(0, 0), this->capsule, this->at(0.45, 0.3));
    expectContact<S>(m, vec<S>(1, 0, 0), -0.05, 2);
    EXPECT_NEAR(std::abs(m.points[0].pointA.y() - m.points[1].pointA.y()), 0.7, tol<S>(1e-15, 1e-6));
    // Standing upright: one point.
    expectContact<S>(collide<S>(this->floor, this->at(0, 0), this->capsule, this->at(0, 0.7)), this->up(),
                     -0.05, 1);
}

TYPED_TEST(Known, BallInsideABoxLeavesByTheNearestFace) {
    using S = TypeParam;
    for (const Shape<S>& b : {this->cube, this->cubeHull}) {
        expectContact<S>(collide<S>(b, this->at(0, 0), this->ball, this->at(0.1, 0.3, -0.2)), this->up(),
                         -0.7, 1);
        // Centre exactly on the surface.
        expectContact<S>(collide<S>(b, this->at(0, 0), this->ball, this->at(0.1, 0.5, -0.2)), this->up(),
                         -0.5, 1);
        // The sphere is over a corner (an edge in 3D).
        const double s = std::sqrt(0.5), r = 0.5 + 0.3 * s;
        expectContact<S>(collide<S>(b, this->at(0, 0), this->ball, this->at(r, r, 0)), vec<S>(s, s, 0), -0.2,
                         1);
    }
}

TYPED_TEST(Known, CornerOnFace) {
    using S = TypeParam;
    // A square (in 3D a cube) on its corner (edge): reaches down by sqrt(1/2).
    const double s = std::sqrt(0.5);
    const int count = S::dim == 2 ? 1 : 2;
    for (const Shape<S>& b : {this->cube, this->cubeHull})
        expectContact<S>(collide<S>(this->cube, this->at(0, 0), b, this->at(0.05, 1.1, 0, kPi / 4)),
                         this->up(), 0.6 - s, count);
    expectContact<S>(collide<S>(this->floor, this->at(0, 0), this->cube, this->at(0, 0.6, 0, kPi / 4)),
                     this->up(), 0.6 - s, count);
}

/// A plate of 1 : 1000 on the floor and on a cube.
TYPED_TEST(Known, ThinPlate) {
    using S = TypeParam;
    const Shape<S> plate = Box<S>{vec<S>(0.5, 0.0005, 0.5)};
    const Shape<S> plateHull = boxHull<S>(vec<S>(0.5, 0.0005, 0.5));
    for (const Shape<S>& p : {plate, plateHull}) {
        expectContact<S>(collide<S>(this->floor, this->at(0, 0), p, this->at(0, 0.0004)), this->up(), -0.0001,
                         this->kFace);
        expectContact<S>(collide<S>(this->cube, this->at(0, 0), p, this->at(0.1, 0.5004, 0.1)), this->up(),
                         -0.0001, this->kFace);
    }
}

/// A stack that rocks by microradians keeps four points and the exact depth, whichever axis wins.
TEST(Known3d, RockingFacesKeepTheirManifold) {
    using S = Space3d;
    const Shape<S> cube = Box<S>{vec<S>(0.5, 0.5, 0.5)};
    Random<S> random{std::mt19937(8)};
    for (int i = 0; i < 500; ++i) {
        const double tilt = std::pow(10.0, random.uniform(-9, -3));
        const auto q = Eigen::Quaterniond(Eigen::AngleAxisd(tilt, random.direction())).normalized();
        const Pose<S> Xa = pose<S>(vec<S>(0, 0, 0)), Xb = pose<S>(vec<S>(0.01, 0.999, 0.02), q);
        const auto m = collide<S>(cube, Xa, cube, Xb, 0.01);
        EXPECT_EQ(m.count, 4) << tilt;
        EXPECT_NEAR(separationAlong<S>(cube, Xa, cube, Xb, m.normal), leastSeparation(m), 4e-7 * 1e-3);
        EXPECT_GE(leastSeparation(m), separationAlong<S>(cube, Xa, cube, Xb, vec<S>(0, 1, 0)) - 1e-9);
    }
}

/// The fifteen axes in closed form against the general search on the same boxes as hulls.
TEST(Known3d, BoxesAgreeWithTheirHulls) {
    using S = Space3d;
    Random<S> random{std::mt19937(6)};
    int edges = 0, touching = 0;
    for (int i = 0; i < 3000; ++i) {
        const auto extents = [&] {
            return vec<S>(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1));
        };
        const S::Vec ha = extents(), hb = extents();
        const Pose<S> Xa = pose<S>(vec<S>(0, 0, 0), random.rotation());
        const Pose<S> Xb = pose<S>(random.uniform(0, 1.6) * random.direction(), random.rotation());
        const auto m = collide<S>(Box<S>{ha}, Xa, Box<S>{hb}, Xb, 0.01);
        const auto h = collide<S>(boxHull<S>(ha), Xa, boxHull<S>(hb), Xb, 0.01);
        ASSERT_EQ(m.count, h.count);
        if (m.count == 0) continue;
        ++touching;
        edges += m.count == 1;
        EXPECT_LE((m.normal - h.normal).norm(), 1e-9);
        EXPECT_NEAR(leastSeparation(m), leastSeparation(h), 1e-14);
    }
    EXPECT_GT(touching, 1000);
    EXPECT_GT(edges, 100);
}

TEST(Known3d, CrossedEdges) {
    using S = Space3d;
    const Shape<S> cube = Box<S>{vec<S>(0.5, 0.5, 0.5)}, hull = boxHull<S>(vec<S>(0.5, 0.5, 0.5));
    const Pose<S> lower = pose<S>(vec<S>(0, 0, 0), turn<S>(0, kPi / 4));
    const Pose<S> upper = pose<S>(vec<S>(0.1, 1.3, 0.2), turn<S>(kPi / 4));
    for (const auto& a : {cube, hull})
        for (const auto& b : {cube, hull}) {
            const auto m = collide<S>(a, lower, b, upper);
            expectContact<S>(m, vec<S>(0, 1, 0), 1.3 - 2 * std::sqrt(0.5), 1);
            EXPECT_NEAR(m.points[0].pointA.x(), 0.1, 1e-14);
            EXPECT_NEAR(m.points[0].pointA.z(), 0.0, 1e-14);
        }
}

TEST(Known3d, CapsulesCrossingThroughEachOther) {
    using S = Space3d;
    const Shape<S> capsule = Capsule<S>{0.25, 0.5};
    const auto m = collide<S>(capsule, pose<S>(vec<S>(0, 0, 0)), capsule,
                              pose<S>(vec<S>(0.1, 0.2, 0), turn<S>(kPi / 2)));
    ASSERT_EQ(m.count, 1);
    EXPECT_NEAR(std::abs(m.normal.z()), 1.0, 1e-14);
    EXPECT_NEAR(leastSeparation(m), -0.5, 1e-14);
}

/// A regular 40-gon prism lies on the floor and on a cube: four points, the deepest among them, wide apart.
TEST(Known3d, ManyPointsReduceToFourThatSpanTheFace) {
    using S = Space3d;
    std::vector<S::Vec> rim;
    for (int i = 0; i < 40; ++i)
        for (double y : {-0.1, 0.1})
            rim.push_back({0.4 * std::cos(2 * kPi * i / 40), y, 0.4 * std::sin(2 * kPi * i / 40)});
    const Shape<S> prism = makeHull<S>(rim);
    const Shape<S> floor = HalfSpace<S>{vec<S>(0, 1, 0), 0}, table = Box<S>{vec<S>(1, 0.5, 1)};
    const auto slightly = Eigen::Quaterniond(Eigen::AngleAxisd(1e-3, Eigen::Vector3d(1, 0, 2).normalized()));
    for (const auto& m :
         {collide<S>(floor, pose<S>(vec<S>(0, 0, 0)), prism, pose<S>(vec<S>(0, 0.09, 0), slightly)),
          collide<S>(table, pose<S>(vec<S>(0, -0.5, 0)), prism, pose<S>(vec<S>(0, 0.09, 0), slightly))}) {
        ASSERT_EQ(m.count, 4);
        const Pose<S> X = pose<S>(vec<S>(0, 0.09, 0), slightly);
        double lowest = 1;
        for (const auto& v : rim) lowest = std::min(lowest, toWorld<S>(X, v).y());
        EXPECT_NEAR(leastSeparation(m), lowest, 1e-6);
        // The four span at least 80 % of the largest quadrilateral in the disc, 2 r^2.
        const auto& p = m.points;
        const double area = 0.5 * (p[1].pointB - p[0].pointB).cross(p[3].pointB - p[2].pointB).norm();
        EXPECT_GT(area, 0.8 * 2 * 0.16);
    }
}

TEST(NarrowPhases, TableAndLookUp) {
    ASSERT_FALSE(narrowPhases().empty());
    for (const NarrowPhaseEntry& entry : narrowPhases()) {
        EXPECT_NE(findNarrowPhase<Space2f>(entry.name), nullptr);
        EXPECT_NE(findNarrowPhase<Space3d>(entry.name), nullptr);
        EXPECT_GT(std::string(entry.summary).size(), 10u);
    }
    EXPECT_EQ(findNarrowPhase<Space3d>("no_such"), nullptr);
}

}  // namespace
}  // namespace rigor::engine::test
