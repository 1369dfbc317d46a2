// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ellipsoids of the oracle: as spheres where the half axes are equal, at a ball put over a known point of the surface,
// at a half-space, at known overlaps; and no direction is better than the one it gives.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "validation/oracle/oracle.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

struct Rng {
    std::mt19937 generator{7};
    double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(generator); }
    Vec3 direction() {
        std::normal_distribution<double> normal;
        const Vec3 v{normal(generator), normal(generator), normal(generator)};
        return v / norm(v);
    }
    Quat turn() { return fromAxisAngle(direction(), between(0, 3)); }
};

Vec3 times(Vec3 a, Vec3 b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

TEST(EllipsoidOracle, ABallOverAPointOfTheSurface) {
    Rng rng;
    for (int k = 0; k < 100; ++k) {
        const Ellipsoid e{{rng.between(0.2, 1), rng.between(0.2, 1), rng.between(0.2, 1)}};
        const Pose pose{{1, -2, 0.5}, rng.turn()};
        const Vec3 n = rng.direction(), en = times(e.halfAxes, n), foot = times(e.halfAxes, en) / norm(en);
        const double gap = rng.between(-0.05, 0.5);
        const Pose ball{pose * (foot + (gap + 0.1) * n), {}};
        const auto found = exactContact(Geometry(e), pose, Geometry(Sphere{0.1}), ball, 3);
        ASSERT_TRUE(found.has_value());
        EXPECT_NEAR(found->signedDistance, gap, 1e-14);
        EXPECT_LT(norm(found->normals[0] - rotate(pose.orientation, n)), 1e-8);
        EXPECT_LT(norm(found->witnessA - pose * foot), 1e-8);
    }
}

TEST(EllipsoidOracle, EqualHalfAxesAreASphere) {
    Rng rng;
    const Geometry sphere = Sphere{0.4}, ellipsoid = Ellipsoid{{0.4, 0.4, 0.4}};
    const Geometry others[] = {Box{{0.5, 0.3, 0.7}}, Capsule{0.2, 0.5},         Cylinder{0.4, 0.5},
                               Cone{0.5, 0.6},       HalfSpace{{0, 1, 0}, 0.1}, Ellipsoid{{0.3, 0.6, 0.5}}};
    for (const Geometry& other : others)
        for (int k = 0; k < 30; ++k) {
            const Pose a{rng.between(0.3, 1.6) * rng.direction(), rng.turn()}, b{{}, rng.turn()};
            const auto round = exactContact(sphere, a, other, b, 3),
                       same = exactContact(ellipsoid, a, other, b, 3);
            ASSERT_TRUE(round && same);
            // The search of one of 30 cones ends 2.6e-7 m from the best direction.
            const double bound = std::holds_alternative<Cone>(other) ? 1e-6 : 1e-12;
            EXPECT_NEAR(round->signedDistance, same->signedDistance, bound) << geometryName(other, 3) << k;
        }
}

TEST(EllipsoidOracle, NoDirectionIsBetter) {
    Rng rng;
    const Geometry others[] = {Ellipsoid{{0.3, 0.6, 0.5}}, Box{{0.5, 0.3, 0.7}}, Cone{0.5, 0.6}};
    for (const Geometry& other : others)
        for (int k = 0; k < 20; ++k) {
            const Geometry e = Ellipsoid{{rng.between(0.2, 1), rng.between(0.2, 1), rng.between(0.2, 1)}};
            const Pose a{rng.between(0, 2) * rng.direction(), rng.turn()}, b{{}, rng.turn()};
            const auto found = exactContact(e, a, other, b, 3);
            ASSERT_TRUE(found.has_value());
            EXPECT_NEAR(*separationAlong(e, a, other, b, 3, found->normals[0]), found->signedDistance, 1e-14);
            for (int i = 0; i < 2000; ++i)
                EXPECT_LE(*separationAlong(e, a, other, b, 3, rng.direction()),
                          found->signedDistance + 1e-14);
        }
}

}  // namespace
}  // namespace rigor::validation
