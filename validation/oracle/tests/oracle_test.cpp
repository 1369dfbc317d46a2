// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The oracle against closed forms, against its own definition (the largest separation over directions), and
// under changes that must not matter.
#include "validation/oracle/oracle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace rigor::validation {
namespace {

using namespace scenario;

Geometry ball(double r) {
    return Sphere{r};
}
Geometry cube(double h) {
    return Box{{h, h, h}};
}
Pose at(double x, double y, double z, Quat q = {}) {
    return {{x, y, z}, q};
}
double distanceOf(const Geometry& a, const Pose& Xa, const Geometry& b, const Pose& Xb, int dimension = 3) {
    return exactContact(a, Xa, b, Xb, dimension)->signedDistance;
}
void expectNear(Vec3 a, Vec3 b, double tolerance) {
    EXPECT_LE(norm(a - b), tolerance)
        << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

const double kSqrtHalf = std::sqrt(0.5);
const Quat kTurnX45 = fromAxisAngle({1, 0, 0}, std::numbers::pi / 4);
const Quat kTurnZ45 = fromAxisAngle({0, 0, 1}, std::numbers::pi / 4);
const Quat kTurnZ90 = fromAxisAngle({0, 0, 1}, std::numbers::pi / 2);

TEST(Oracle, Balls) {
    const auto answer = exactContact(ball(1.0), at(0, 0, 0), ball(0.5), at(0, 1.2, 0), 3);
    EXPECT_NEAR(answer->signedDistance, -0.3, 1e-15);
    ASSERT_EQ(answer->normals.size(), 1u);
    expectNear(answer->normals[0], {0, 1, 0}, 1e-15);
    expectNear(answer->witnessA, {0, 1.0, 0}, 1e-15);
    expectNear(answer->witnessB, {0, 0.7, 0}, 1e-15);
}

TEST(Oracle, ConcentricBallsHaveEveryNormal) {
    const auto answer = exactContact(ball(1.0), at(1, 2, 3), ball(0.5), at(1, 2, 3), 3);
    EXPECT_NEAR(answer->signedDistance, -1.5, 1e-15);
    EXPECT_TRUE(answer->continuum);
    for (const Vec3& n : answer->normals) EXPECT_NEAR(norm(n), 1.0, 1e-15);
    const Vec3 any = Vec3{1, 2, 2} / 3.0;
    EXPECT_NEAR(*separationAlong(ball(1.0), at(1, 2, 3), ball(0.5), at(1, 2, 3), 3, any), -1.5, 1e-15);
}

TEST(Oracle, BallAndBox) {
    // Outside a corner, outside a face, inside.
    EXPECT_NEAR(distanceOf(ball(0.1), at(2, 2, 2), cube(1), at(0, 0, 0)), std::sqrt(3.0) - 0.1, 1e-15);
    EXPECT_NEAR(distanceOf(ball(0.1), at(0.3, 2, 0.2), cube(1), at(0, 0, 0)), 0.9, 1e-15);
    const auto inside = exactContact(ball(0.1), at(0.2, 0.7, -0.3), cube(1), at(0, 0, 0), 3);
    EXPECT_NEAR(inside->signedDistance, -0.4, 1e-15);
    ASSERT_EQ(inside->normals.size(), 1u);
    expectNear(inside->normals[0], {0, -1, 0}, 1e-15);  // the box moves down
}

TEST(Oracle, CubesFaceEdgeAndCorner) {
    EXPECT_NEAR(distanceOf(cube(0.5), at(0, 0, 0), cube(0.5), at(0.2, 0.9, 0.1)), -0.1, 1e-15);
    // Edge on face: the turned cube reaches down by sqrt(1/2).
    EXPECT_NEAR(distanceOf(cube(0.5), at(0, 0, 0), cube(0.5), at(0, 1.1, 0, kTurnZ45)), 0.6 - kSqrtHalf,
                1e-15);
    // Crossed edges.
    EXPECT_NEAR(distanceOf(cube(0.5), at(0, 0, 0, kTurnX45), cube(0.5), at(0, 1.3, 0, kTurnZ45)),
                1.3 - 2 * kSqrtHalf, 1e-15);
    // Corner to corner.
    EXPECT_NEAR(distanceOf(cube(0.5), at(0, 0, 0), cube(0.5), at(1.1, 1.2, 1.3)),
                std::sqrt(0.01 + 0.04 + 0.09), 1e-15);
}

TEST(Oracle, ConcentricCubesHaveSixNormals) {
    const auto answer = exactContact(cube(0.5), at(0, 0, 0), cube(0.5), at(0, 0, 0), 3);
    EXPECT_NEAR(answer->signedDistance, -1.0, 1e-15);
    EXPECT_EQ(answer->normals.size(), 6u);
    EXPECT_FALSE(answer->continuum);
    // Turned any way rounding picks one of the six; the points belong to the first.
    for (int i = 0; i < 50; ++i) {
        const Pose X = at(0.3, 0.1, -0.2, fromAxisAngle(Vec3{0.36, 0.48, 0.8}, 0.1 * i));
        const auto turned = exactContact(cube(0.5), X, cube(0.5), X, 3);
        EXPECT_EQ(turned->normals.size(), 6u);
        expectNear(turned->witnessB - turned->witnessA, turned->signedDistance * turned->normals[0], 1e-15);
    }
}

TEST(Oracle, Capsules) {
    const Geometry capsule = Capsule{0.25, 1.0};
    // Side by side, crossed without touching, crossing through each other, end to end.
    EXPECT_NEAR(distanceOf(capsule, at(0, 0, 0), capsule, at(0.4, 0.3, 0)), -0.1, 1e-15);
    EXPECT_NEAR(distanceOf(capsule, at(0, 0, 0), capsule, at(0, 0.2, 0.7, kTurnZ90)), 0.2, 1e-15);
    const auto crossing = exactContact(capsule, at(0, 0, 0), capsule, at(0, 0.2, 0, kTurnZ90), 3);
    EXPECT_NEAR(crossing->signedDistance, -0.5, 1e-15);
    ASSERT_EQ(crossing->normals.size(), 2u);
    EXPECT_NEAR(std::abs(crossing->normals[0].z), 1.0, 1e-15);
    EXPECT_NEAR(distanceOf(capsule, at(0, 0, 0), capsule, at(0, 3, 0)), 0.5, 1e-15);
}

TEST(Oracle, CapsuleThroughBox) {
    // A slanted segment through an edge region: the depth is along the edge's cross product or a face.
    const Geometry capsule = Capsule{0.1, 2.0};
    const double d = distanceOf(capsule, at(0.9, 0.9, 0, kTurnZ45), cube(1), at(0, 0, 0));
    // The segment runs along (-1, 1): its distance along (1, 1)/sqrt 2 from the edge at (1, 1).
    EXPECT_NEAR(d, 1.8 * kSqrtHalf - 2 * kSqrtHalf - 0.1, 1e-15);
}

TEST(Oracle, HalfSpaces) {
    const Geometry floor = HalfSpace{{0, 1, 0}, 0.25};
    const auto answer = exactContact(floor, at(0, 1, 0), cube(0.5), at(3, 1.6, 0), 3);
    EXPECT_NEAR(answer->signedDistance, -0.15, 1e-15);
    expectNear(answer->normals[0], {0, 1, 0}, 0);
    const auto swapped = exactContact(cube(0.5), at(3, 1.6, 0), floor, at(0, 1, 0), 3);
    EXPECT_NEAR(swapped->signedDistance, -0.15, 1e-15);
    expectNear(swapped->normals[0], {0, -1, 0}, 0);
    EXPECT_NEAR(distanceOf(Capsule{0.2, 0.5}, at(0, 2.0, 0, kTurnZ90), floor, at(0, 0, 0)), 1.55, 1e-15);
    EXPECT_FALSE(exactContact(floor, {}, floor, {}, 3).has_value());
}

TEST(Oracle, Plane2d) {
    const Geometry square = Box{{0.5, 0.5, 0}}, segment = Segment{{-2, 0, 0}, {2, 0, 0}};
    EXPECT_NEAR(distanceOf(square, at(0, 0, 0), square, at(0.2, 0.9, 0), 2), -0.1, 1e-15);
    EXPECT_NEAR(distanceOf(square, at(0, 0.6, 0), segment, {}, 2), 0.1, 1e-15);
    // Two crossing capsules in 2D can only be separated as a whole: 2 capsules like plus signs.
    const Geometry capsule = Capsule{0.1, 1.0};
    EXPECT_NEAR(distanceOf(capsule, {}, capsule, at(0, 0, 0, kTurnZ90), 2), -1.2, 1e-15);
    EXPECT_NEAR(distanceOf(ball(0.3), at(2.3, 0.4, 0), segment, {}, 2), 0.2, 1e-15);
}

TEST(Oracle, RefusesCurvedSolidsInThePlane) {
    EXPECT_FALSE(exactContact(Cylinder{1, 1}, {}, ball(1), {}, 2).has_value());
    EXPECT_FALSE(exactContact(ball(1), {}, Cone{1, 1}, {}, 2).has_value());
}

// ------------------------------------------------------------------------------------------ random pairs
struct Random {
    std::mt19937 generator;
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(generator);
    }
    Vec3 direction(int dimension) {
        std::normal_distribution<double> normal;
        Vec3 v{normal(generator), normal(generator), dimension == 2 ? 0.0 : normal(generator)};
        return v / norm(v);
    }
    Quat rotation(int dimension) {
        if (dimension == 2) return fromAxisAngle({0, 0, 1}, uniform(-3, 3));
        std::normal_distribution<double> n;
        return normalized(Quat{n(generator), n(generator), n(generator), n(generator)});
    }
    Geometry shape(int dimension) {
        const auto length = [&] { return uniform(0.3, 1.0); };
        switch (std::uniform_int_distribution<int>(0, 3)(generator)) {
            case 0:
                return Sphere{length()};
            case 1:
                return Box{{length(), length(), dimension == 2 ? 0.0 : length()}};
            case 2:
                return Capsule{0.5 * length(), length()};
            default: {
                ConvexHull hull;
                const int count = dimension == 2 ? 7 : 10;
                for (int i = 0; i < count; ++i) hull.vertices.push_back(length() * direction(dimension));
                return hull;
            }
        }
    }
};

class OracleRandom : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, OracleRandom, testing::Values(2, 3));

/// Every direction bounds the signed distance from below, the reported normals attain it, and the witness
/// points lie that far apart along the normal.
TEST_P(OracleRandom, IsTheLargestSeparation) {
    const int dimension = GetParam();
    Random random{std::mt19937(7)};
    int overlapping = 0, apart = 0;
    for (int i = 0; i < 300; ++i) {
        const Geometry a = random.shape(dimension), b = random.shape(dimension);
        const Pose Xa{{3, -2, dimension == 2 ? 0.0 : 1.0}, random.rotation(dimension)};
        const Pose Xb{Xa.position + random.uniform(0.0, 2.0) * random.direction(dimension),
                      random.rotation(dimension)};
        const auto answer = exactContact(a, Xa, b, Xb, dimension);
        ASSERT_TRUE(answer);
        (answer->signedDistance < 0 ? overlapping : apart)++;
        ASSERT_FALSE(answer->normals.empty());
        for (const Vec3& n : answer->normals)
            EXPECT_NEAR(*separationAlong(a, Xa, b, Xb, dimension, n), answer->signedDistance, 3e-9);
        EXPECT_NEAR(*separationAlong(a, Xa, b, Xb, dimension, answer->normals[0]), answer->signedDistance,
                    1e-14);
        double best = -1e300;
        for (int k = 0; k < 500; ++k)
            best = std::max(best, *separationAlong(a, Xa, b, Xb, dimension, random.direction(dimension)));
        EXPECT_LE(best, answer->signedDistance + 1e-13);
        EXPECT_GE(best, answer->signedDistance - 0.3);  // 500 directions come near
        const Vec3 gap = answer->witnessB - answer->witnessA;
        EXPECT_NEAR(norm(gap), std::abs(answer->signedDistance), 1e-13);
        EXPECT_LE(norm(gap - answer->signedDistance * answer->normals[0]), 1e-13);
    }
    EXPECT_GT(overlapping, 50);
    EXPECT_GT(apart, 50);
}

TEST_P(OracleRandom, DoesNotDependOnFrameOrOrder) {
    const int dimension = GetParam();
    Random random{std::mt19937(11)};
    for (int i = 0; i < 60; ++i) {
        const Geometry a = random.shape(dimension), b = random.shape(dimension);
        const Pose Xa{{0, 0, 0}, random.rotation(dimension)};
        const Pose Xb{random.uniform(0.0, 1.5) * random.direction(dimension), random.rotation(dimension)};
        const double d = distanceOf(a, Xa, b, Xb, dimension);
        EXPECT_NEAR(distanceOf(b, Xb, a, Xa, dimension), d, 1e-15);
        const Pose moved{{50, -20, 0}, random.rotation(dimension)};
        EXPECT_NEAR(distanceOf(a, moved * Xa, b, moved * Xb, dimension), d, 1e-13);
    }
}

}  // namespace
}  // namespace rigor::validation
