// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cylinder and cone in configurations whose manifold is known by hand, and against many-sided hulls.
#include <gtest/gtest.h>

#include <numbers>

#include "engine/narrowphase/narrowphases.hpp"
#include "engine/narrowphase/tests/pair_table.hpp"

namespace rigor::engine::test {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

template <class S>
class Round : public testing::Test {
  protected:
    using R = typename S::Real;
    const Shape<S> cylinder = Cylinder<S>{R(0.5), R(1)};
    const Shape<S> cone = Cone<S>{R(0.5), R(1)};
    const Shape<S> floor = HalfSpace<S>{vec<S>(0, 1, 0), R(0)};
    const Shape<S> table = Box<S>{vec<S>(3, 1, 3)};
    const Shape<S> ball = Sphere<S>{R(0.5)};
    static Pose<S> at(double x, double y, double z = 0, double angle = 0, double tilt = 0) {
        return pose<S>(vec<S>(x, y, z), turn<S>(angle, tilt));
    }
    static Manifold<S> by(const char* narrowPhase, const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b,
                          const Pose<S>& Xb) {
        Manifold<S> m;
        findNarrowPhase<S>(narrowPhase)(a, Xa, b, Xb, R(0), m);
        return m;
    }
    static void expectContact(const Manifold<S>& m, const typename S::Vec& normal, double separation,
                              int count) {
        ASSERT_EQ(m.count, count);
        EXPECT_LE((m.normal - normal).norm(), tol<S>(1e-12, 3e-6));
        EXPECT_NEAR(leastSeparation(m), separation, tol<S>(1e-12, 2e-6));
    }
    /// Four points: how far the weight may shift in any direction before one of them lifts [m].
    static double spread(const Manifold<S>& m) {
        double least = 1e9;
        for (int k = 0; k < 16; ++k) {
            const typename S::Vec d = vec<S>(std::cos(k * kHalfTurn / 8), 0, std::sin(k * kHalfTurn / 8));
            double furthest = -1e9;
            for (int i = 0; i < m.count; ++i)
                furthest = std::max(furthest, static_cast<double>(d.dot(m.points[i].pointA)));
            least = std::min(least, furthest);
        }
        return least;
    }
};
using RoundSpaces = testing::Types<Space3f, Space3d>;
TYPED_TEST_SUITE(Round, RoundSpaces);

TYPED_TEST(Round, StandingOnACapHasFourSpreadPoints) {
    using S = TypeParam;
    for (const NarrowPhaseEntry& entry : narrowPhases()) {
        SCOPED_TRACE(entry.name);
        const auto up = vec<S>(0, 1, 0);
        const std::array<Shape<S>, 2> grounds{this->floor, this->table};
        for (std::size_t g = 0; g < 2; ++g)
            for (const Shape<S>& round : {this->cylinder, this->cone}) {
                const auto m =
                    this->by(entry.name, grounds[g], this->at(0, g == 0 ? 0 : -1), round, this->at(0, 0.99));
                this->expectContact(m, up, -0.01, 4);
                EXPECT_GT(this->spread(m), 0.5 * std::sqrt(0.5) - 1e-5) << g;
            }
        // A cylinder on another one, beside its middle: the points bound the common part of the caps.
        const auto m =
            this->by(entry.name, this->cylinder, this->at(0, -1), this->cylinder, this->at(0.3, 0.99, 0.1));
        this->expectContact(m, up, -0.01, 4);
        for (int i = 0; i < 4; ++i) {
            const auto& p = m.points[i].pointA;
            EXPECT_LE(std::hypot(p.x(), p.z()), 0.5 + 1e-5);
            EXPECT_LE(std::hypot(p.x() - 0.3, p.z() - 0.1), 0.5 + 1e-5);
        }
    }
}

TYPED_TEST(Round, LyingCylinderHasItsLine) {
    using S = TypeParam;
    for (const NarrowPhaseEntry& entry : narrowPhases()) {
        SCOPED_TRACE(entry.name);
        const auto up = vec<S>(0, 1, 0);
        const auto lying = this->at(0.2, 0.49, 0, kHalfTurn / 2);
        for (const bool onTable : {false, true}) {
            const auto m = onTable ? this->by(entry.name, this->table, this->at(0, -1), this->cylinder, lying)
                                   : this->by(entry.name, this->floor, this->at(0, 0), this->cylinder, lying);
            this->expectContact(m, up, -0.01, 2);
            EXPECT_NEAR(std::abs(m.points[0].pointA.x() - m.points[1].pointA.x()), 2, 1e-5);
        }
        // Two cylinders side by side share a line of 1.5.
        const auto m =
            this->by(entry.name, this->cylinder, this->at(0, 0), this->cylinder, this->at(0.6, 0.5, 0.78));
        ASSERT_EQ(m.count, 2);
        const double d = std::hypot(0.6, 0.78);
        EXPECT_LE((m.normal - vec<S>(0.6 / d, 0, 0.78 / d)).norm(), tol<S>(1e-6, 3e-3));
        EXPECT_NEAR(leastSeparation(m), d - 1, tol<S>(1e-12, 4e-6));
        EXPECT_NEAR(std::abs(m.points[0].pointA.y() - m.points[1].pointA.y()), 1.5, 1e-5);
        // Crossed: one point.
        EXPECT_EQ(this->by(entry.name, this->cylinder, this->at(0, 0), this->cylinder,
                           this->at(0.1, 0.2, 0.95, kHalfTurn / 2))
                      .count,
                  1);
    }
}

TYPED_TEST(Round, ConeOnItsSideHasItsLineAndOnItsApexAPoint) {
    using S = TypeParam;
    for (const NarrowPhaseEntry& entry : narrowPhases()) {
        SCOPED_TRACE(entry.name);
        const auto up = vec<S>(0, 1, 0);
        // Its side makes the angle atan(r / 2h) with the axis; lying on it the axis rises by as much.
        const double half = std::atan(0.25), middle = 0.5 * 0.5 * std::cos(half);
        const auto side = this->at(0, middle - 0.01, 0, kHalfTurn / 2 + half);
        for (const bool onTable : {false, true}) {
            const auto m = onTable ? this->by(entry.name, this->table, this->at(0, -1), this->cone, side)
                                   : this->by(entry.name, this->floor, this->at(0, 0), this->cone, side);
            this->expectContact(m, up, -0.01, 2);
            EXPECT_NEAR((m.points[0].pointA - m.points[1].pointA).norm(), std::hypot(2, 0.5), 1e-5);
        }
        this->expectContact(
            this->by(entry.name, this->floor, this->at(0, 0), this->cone, this->at(0, 0.98, 0, kHalfTurn)),
            up, -0.02, 1);
        this->expectContact(
            this->by(entry.name, this->table, this->at(0, -1), this->cone, this->at(0, 0.98, 0, kHalfTurn)),
            up, -0.02, 1);
    }
}

/// The lowest rim point of a tilted cylinder is exact, whichever way it tilts.
TYPED_TEST(Round, TiltedRimIsExact) {
    using S = TypeParam;
    Random<S> random{std::mt19937(5)};
    for (int i = 0; i < 200; ++i) {
        const double tilt = std::pow(10, random.uniform(-6, 0));
        const auto q = compose(turn<S>(0, tilt), turn<S>(0));
        Pose<S> X = pose<S>(vec<S>(0, 0, 0), q);
        X.q = compose(typename S::Rot(Eigen::AngleAxis<typename S::Real>(
                          static_cast<typename S::Real>(random.uniform(-3, 3)), S::Vec::UnitY())),
                      X.q);
        X.q.normalize();
        const double lowest = std::cos(tilt) + 0.5 * std::sin(tilt);
        X.p.y() = static_cast<typename S::Real>(lowest - 0.003);
        for (const bool onTable : {false, true}) {
            const auto m = onTable ? collide<S>(this->table, this->at(0, -1), this->cylinder, X, 0.01)
                                   : collide<S>(this->floor, this->at(0, 0), this->cylinder, X, 0.01);
            ASSERT_GT(m.count, 0);
            EXPECT_NEAR(leastSeparation(m), -0.003, tol<S>(4e-6, 6e-6)) << tilt << " " << onTable;
            EXPECT_GT(m.normal.y(), 0.999999);
        }
    }
}

/// A sphere against the solid: the nearest point of a sweep over the surface.
TYPED_TEST(Round, BallAgainstASweptSurface) {
    using S = TypeParam;
    Random<S> random{std::mt19937(9)};
    for (int i = 0; i < 200; ++i) {
        const double x = random.uniform(-1.2, 1.2), y = random.uniform(-1.7, 1.7),
                     angle = random.uniform(-3, 3);
        const auto c = vec<S>(x * std::cos(angle), y, x * std::sin(angle));
        const double rho = std::abs(x);
        for (const bool pointed : {false, true}) {
            double nearest = 1e9;  // least distance over the profile
            const int n = 20000;
            for (int k = 0; k <= n; ++k) {
                const double t = static_cast<double>(k) / n, sideR = pointed ? 0.5 * (1 - t) : 0.5;
                nearest = std::min({nearest, std::hypot(rho - sideR, y - (2 * t - 1)),
                                    std::hypot(rho - 0.5 * t, y + 1),
                                    pointed ? 1e9 : std::hypot(rho - 0.5 * t, y - 1)});
            }
            const bool inside = std::abs(y) < 1 && rho < (pointed ? 0.25 * (1 - y) : 0.5);
            const auto m = collide<S>(pointed ? this->cone : this->cylinder, this->at(0, 0), this->ball,
                                      pose<S>(c), 10.0);
            ASSERT_EQ(m.count, 1);
            EXPECT_NEAR(m.points[0].separation, (inside ? -nearest : nearest) - 0.5, 2e-4);
            const auto back = c - m.normal * (m.points[0].separation + typename S::Real(0.5));
            EXPECT_LE((back - m.points[0].pointA).norm(), tol<S>(1e-12, 1e-5));
        }
    }
}

}  // namespace
}  // namespace rigor::engine::test
