// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The narrow phase and the broad phases by themselves.
#include <algorithm>
#include <cmath>
#include <random>

#include "adapters/interface/tests/scenes.hpp"
#include "adapters/interface/timed.hpp"

namespace rigor::test {
namespace {

using adapter::Aabb;
using adapter::CollisionAnswer;
using adapter::Pair;

CollisionAnswer runQuery(const Geometry& a, const scenario::Pose& poseA, const Geometry& b,
                         const scenario::Pose& poseB, int dimension = 3) {
    adapter::CollisionQuery query;
    query.a = {&a, poseA};
    query.b = {&b, poseB};
    query.dimension = dimension;
    return engine().collision()->collide(query);
}

struct Case {
    const char* name;
    Geometry a, b;
    Vec3 at;      ///< position of b; a is at the origin
    Vec3 normal;  ///< normal from a to b
    double depth;
    std::size_t contacts;  ///< least number
};
void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}

class BulletCollision : public testing::TestWithParam<Case> {};

TEST_P(BulletCollision, FindsNormalAndDepthInBothOrders) {
    const Case& c = GetParam();
    for (const bool swapped : {false, true}) {
        const auto answer = swapped ? runQuery(c.b, {c.at, {}}, c.a, {}) : runQuery(c.a, {}, c.b, {c.at, {}});
        ASSERT_TRUE(answer.overlap);
        ASSERT_GE(answer.contacts.size(), c.contacts);
        const Vec3 normal = (swapped ? -1.0 : 1.0) * c.normal;
        for (const auto& contact : answer.contacts) {
            EXPECT_NEAR(norm(contact.normal - normal), 0.0, tol(1e-6, 1e-3));
            EXPECT_NEAR(dot(contact.pointA - contact.pointB, contact.normal), contact.depth, tol(1e-9, 1e-5));
        }
        EXPECT_NEAR(answer.contacts[0].depth, c.depth, tol(1e-6, 1e-4));
        EXPECT_NEAR(answer.signedDistance.value(), -c.depth, tol(1e-6, 1e-4));
    }
}

const double kDiagonal = std::sqrt(1.0 / 3.0);
INSTANTIATE_TEST_SUITE_P(
    Pairs, BulletCollision,
    testing::Values(
        Case{"spheres", Sphere{0.5}, Sphere{0.5}, {0, 0.9, 0}, {0, 1, 0}, 0.1, 1},
        Case{"boxes", Box{{0.5, 0.5, 0.5}}, Box{{0.5, 0.5, 0.5}}, {0.9, 0.2, 0.1}, {1, 0, 0}, 0.1, 4},
        // GJK/EPA gives .0577 along the diagonal for aligned hulls, and .18 with the library's margin.
        Case{"hulls", boxHull({0.5, 0.5, 0.5}), boxHull({0.5, 0.5, 0.5}), {0.9, 0, 0}, {1, 0, 0}, 0.1, 4},
        Case{"hull_on_box", Box{{0.5, 0.5, 0.5}}, boxHull({0.5, 0.5, 0.5}), {0, 0.9, 0}, {0, 1, 0}, 0.1, 4},
        Case{"hull_sphere", boxHull({0.5, 0.5, 0.5}), Sphere{0.5}, {0, 0.9, 0}, {0, 1, 0}, 0.1, 1},
        // The library's margin rounds the corner: .0707.
        Case{"sphere_on_corner", Box{{0.5, 0.5, 0.5}}, Sphere{0.5},
             (0.4 * kDiagonal) * Vec3{1, 1, 1} + Vec3{0.5, 0.5, 0.5}, kDiagonal* Vec3{1, 1, 1}, 0.1, 1},
        Case{"sphere_capsule", Capsule{0.25, 0.5}, Sphere{0.5}, {0.65, 0.3, 0}, {1, 0, 0}, 0.1, 1},
        Case{"box_on_plane", HalfSpace{{0, 1, 0}, 0.2}, Box{{0.5, 0.5, 0.5}}, {0, 0.6, 0}, {0, 1, 0}, 0.1, 4},
        Case{"hull_on_plane",
             HalfSpace{{0, 1, 0}, 0.2},
             boxHull({0.5, 0.5, 0.5}),
             {0, 0.6, 0},
             {0, 1, 0},
             0.1,
             4},
        Case{"cylinder_on_plane",
             HalfSpace{{0, 1, 0}, 0.0},
             Cylinder{0.3, 0.5},
             {0, 0.4, 0},
             {0, 1, 0},
             0.1,
             1}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(BulletCollisionDistance, IsExactForSeparatedShapes) {
    const auto gap = [](const Geometry& a, const Geometry& b, Vec3 at) {
        const auto answer = runQuery(a, {}, b, {at, {}});
        EXPECT_FALSE(answer.overlap);
        EXPECT_TRUE(answer.contacts.empty());
        EXPECT_NEAR(norm(*answer.witnessB - *answer.witnessA), *answer.signedDistance, tol(1e-6, 1e-4));
        return *answer.signedDistance;
    };
    const Box cube{{0.5, 0.5, 0.5}};
    EXPECT_NEAR(gap(Sphere{0.5}, Sphere{0.25}, {2, 0, 0}), 1.25, tol(1e-9, 1e-5));
    EXPECT_NEAR(gap(cube, cube, {2, 2, 0}), std::sqrt(2.0), tol(1e-6, 1e-4));
    EXPECT_NEAR(gap(boxHull({0.5, 0.5, 0.5}), Capsule{0.2, 0.5}, {1.5, 0, 0}), 0.8, tol(1e-6, 1e-4));
    EXPECT_NEAR(gap(HalfSpace{{0, 1, 0}, 0.0}, cube, {0, 0.75, 0}), 0.25, tol(1e-9, 1e-5));
    // the gap is within the margins
    EXPECT_NEAR(gap(cube, Sphere{0.1}, {0.5001 + 0.1, 0, 0}), 0.0001, tol(1e-6, 1e-4));
}

TEST(BulletCollisionPlanar, PrismsAnswerInThePlaneHoweverDeep) {
    scenario::ConvexHull square;
    square.vertices = {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}};
    const auto answer = runQuery(Box{{2, 2, 0}}, {}, square, {{2.5, 0, 0}, {}}, 2);
    ASSERT_TRUE(answer.overlap);
    EXPECT_EQ(answer.contacts.size(), 2u);
    EXPECT_NEAR(norm(answer.contacts[0].normal - Vec3{1, 0, 0}), 0.0, tol(1e-6, 1e-4));
    EXPECT_NEAR(answer.contacts[0].depth, 1.5, tol(1e-6, 1e-4));
    EXPECT_EQ(answer.contacts[0].pointA.z, 0.0);
}

/// A strip of triangles over the segment.
TEST(BulletPlanar, ASegmentIsTouchedFromBothSides) {
    for (const double side : {0.4, -0.4}) {
        const auto answer =
            runQuery(scenario::Segment{{-1, 0, 0}, {1, 0, 0}}, {}, Sphere{0.5}, {{0.2, side, 0}, {}}, 2);
        ASSERT_EQ(answer.contacts.size(), 1u);
        EXPECT_NEAR(answer.contacts[0].depth, 0.1, tol(1e-9, 1e-6));
        EXPECT_NEAR(answer.contacts[0].normal.y, side > 0 ? 1.0 : -1.0, 1e-6);
    }
}

TEST(BulletCollisionInput, BadQueriesAreRefused) {
    EXPECT_THROW(runQuery(Sphere{-1}, {}, Sphere{1}, {}), adapter::BadInput);
    EXPECT_THROW(runQuery(HalfSpace{}, {}, HalfSpace{}, {}), adapter::Unsupported);
    const scenario::HeightField flat{2, 2, 1.0, 1.0, {0, 0, 0, 0}, 1.0};
    EXPECT_THROW(runQuery(flat, {}, flat, {}), adapter::Unsupported);
    EXPECT_THROW(runQuery(flat, {}, Sphere{1}, {}, 2), adapter::Unsupported);
}

TEST(BulletBroadPhase, AgreesWithBruteForceWhileBoxesMove) {
    for (const auto& name : engine().broadPhase()->algorithms())
        for (const int dimension : {2, 3}) {
            const auto broadPhase = engine().broadPhase()->create(name, dimension);
            std::mt19937 random(7);
            std::uniform_real_distribution<double> place(-10, 10), size(0.1, 1.5), move(-0.7, 0.7);
            std::vector<Aabb> boxes(150);
            for (auto& box : boxes) {
                box.min = {place(random), place(random), dimension == 3 ? place(random) : 0.0};
                box.max = box.min + Vec3{size(random), size(random), dimension == 3 ? 3 * size(random) : 0.0};
            }
            std::vector<Pair> pairs;
            std::size_t total = 0;
            for (int frame = 0; frame < 30; ++frame) {
                broadPhase->update(boxes, pairs);
                ASSERT_EQ(pairs, adapter::bruteForcePairs(boxes)) << name << " frame " << frame;
                total += pairs.size();
                for (auto& box : boxes) {
                    const Vec3 by{move(random), move(random), dimension == 3 ? move(random) : 0.0};
                    box.min += by;
                    box.max += by;
                }
                if (frame == 20) boxes.resize(90);
            }
            EXPECT_GT(total, 300u);
        }
}

TEST(BulletBroadPhase, UnknownNamesAndBadBoxesAreRefused) {
    EXPECT_THROW(engine().broadPhase()->create("octree", 3), adapter::Unsupported);
    const auto broadPhase = engine().broadPhase()->create("dbvt", 3);
    std::vector<Pair> pairs;
    const std::vector<Aabb> bad{{{0, 0, 0}, {1, std::nan(""), 1}}};
    EXPECT_THROW(broadPhase->update(bad, pairs), adapter::BadInput);
}

}  // namespace
}  // namespace rigor::test
