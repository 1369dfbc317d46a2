// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The narrow phase and the broad phase by themselves.
#include <cmath>
#include <random>

#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

using adapter::Aabb;
using adapter::CollisionAnswer;
using adapter::Pair;
using scenario::Pose;
using scenario::Segment;

CollisionAnswer runQuery(const Geometry& a, const Pose& poseA, const Geometry& b, const Pose& poseB) {
    adapter::CollisionQuery query;
    query.a = {&a, poseA};
    query.b = {&b, poseB};
    query.dimension = 2;
    return engine().collision()->collide(query);
}

ConvexHull square(double h) {
    ConvexHull hull;
    hull.vertices = {{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}};
    return hull;
}

struct Case {
    const char* name;
    Geometry a, b;
    Vec3 at;
    Vec3 normal;
    double depth;
    std::size_t contacts;
};
void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}

class Box2dCollision : public testing::TestWithParam<Case> {};

/// Far from the origin, turned and small or large: floats must not show.
TEST_P(Box2dCollision, FindsNormalAndDepthInBothOrdersAnywhere) {
    const Case& c = GetParam();
    const Pose places[] = {{}, {{120, -75, 0}, scenario::fromAxisAngle({0, 0, 1}, 0.8)}};
    for (const Pose& place : places)
        for (const bool swapped : {false, true}) {
            const Pose second = place * Pose{c.at, {}};
            const auto answer =
                swapped ? runQuery(c.b, second, c.a, place) : runQuery(c.a, place, c.b, second);
            ASSERT_TRUE(answer.overlap);
            ASSERT_EQ(answer.contacts.size(), c.contacts);
            const Vec3 normal = (swapped ? -1.0 : 1.0) * rotate(place.orientation, c.normal);
            for (const auto& contact : answer.contacts) {
                EXPECT_NEAR(norm(contact.normal - normal), 0.0, 1e-5);
                EXPECT_NEAR(dot(contact.pointA - contact.pointB, contact.normal), contact.depth, 1e-6);
            }
            EXPECT_NEAR(answer.contacts[0].depth, c.depth, 2e-6);  // a skin would read 0.12 for 0.1
            EXPECT_NEAR(answer.signedDistance.value(), -c.depth, 2e-6);
        }
}

INSTANTIATE_TEST_SUITE_P(
    Pairs, Box2dCollision,
    testing::Values(
        Case{"circles", Sphere{0.5}, Sphere{0.5}, {0, 0.9, 0}, {0, 1, 0}, 0.1, 1},
        Case{"boxes", Box{{0.5, 0.5, 0}}, Box{{0.5, 0.5, 0}}, {0.9, 0.2, 0}, {1, 0, 0}, 0.1, 2},
        Case{"polygon_box", square(0.5), Box{{0.5, 0.5, 0}}, {0, 0.9, 0}, {0, 1, 0}, 0.1, 2},
        Case{"box_circle", Box{{0.5, 0.5, 0}}, Sphere{0.5}, {0.9, 0, 0}, {1, 0, 0}, 0.1, 1},
        Case{"corner", Box{{0.5, 0.5, 0}}, Sphere{0.5}, {0.5 + 0.32, 0.5 + 0.24, 0}, {0.8, 0.6, 0}, 0.1, 1},
        Case{"half_plane_box", HalfSpace{{0, 1, 0}, 0.2}, Box{{0.5, 0.5, 0}}, {3, 0.6, 0}, {0, 1, 0}, 0.1, 2},
        Case{"capsule_circle", Capsule{0.25, 0.5}, Sphere{0.5}, {0.65, 0.3, 0}, {1, 0, 0}, 0.1, 1},
        Case{"capsule_box", Capsule{0.25, 0.5}, Box{{0.5, 0.1, 0}}, {0, 0.75, 0}, {0, 1, 0}, 0.1, 1},
        Case{"segment_circle", Segment{{-1, 0, 0}, {1, 0, 0}}, Sphere{0.5}, {0, 0.4, 0}, {0, 1, 0}, 0.1, 1}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(Box2dCollisionDistance, IsExactForSeparatedShapes) {
    const auto gap = [](const Geometry& a, const Geometry& b, Vec3 at) {
        const auto answer = runQuery(a, {}, b, {at, {}});
        EXPECT_FALSE(answer.overlap);
        EXPECT_TRUE(answer.contacts.empty());
        EXPECT_NEAR(norm(*answer.witnessB - *answer.witnessA), *answer.signedDistance, 1e-5);
        return *answer.signedDistance;
    };
    EXPECT_NEAR(gap(Sphere{0.5}, Sphere{0.25}, {2, 0, 0}), 1.25, 1e-5);
    EXPECT_NEAR(gap(Box{{0.5, 0.5, 0}}, square(0.5), {2, 2, 0}), std::sqrt(2.0), 1e-5);
    EXPECT_NEAR(gap(Capsule{0.2, 0.5}, Box{{0.5, 0.5, 0}}, {1, 0, 0}), 0.3, 1e-5);
    // the gap is within the skins
    EXPECT_NEAR(gap(HalfSpace{{0, 1, 0}, 0}, Sphere{0.5}, {0, 0.505, 0}), 0.005, 1e-5);
}

TEST(Box2dCollisionInput, WhatItCanNotAnswerIsRefused) {
    EXPECT_THROW(runQuery(Sphere{-1}, {}, Sphere{1}, {}), adapter::BadInput);
    // The circle's centre on the capsule's core: Box2D has no depth for that.
    EXPECT_THROW(runQuery(Capsule{0.2, 0.5}, {}, Sphere{0.5}, {}), adapter::Unsupported);
    adapter::CollisionQuery query;
    const Geometry ball = Sphere{1};
    query.a = query.b = {&ball, {}};
    EXPECT_THROW(engine().collision()->collide(query), adapter::Unsupported);
}

TEST(Box2dBroadPhase, AgreesWithBruteForceWhileBoxesMove) {
    const auto broadPhase = engine().broadPhase()->create("dynamic_tree", 2);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-10, 10), size(0.1, 1.5), move(-0.7, 0.7);
    std::vector<Aabb> boxes(200);
    for (auto& box : boxes) {
        box.min = {place(random), place(random), 0};
        box.max = box.min + Vec3{size(random), size(random), 0};
    }
    std::vector<Pair> pairs;
    std::size_t total = 0;
    for (int frame = 0; frame < 30; ++frame) {
        broadPhase->update(boxes, pairs);
        std::vector<Pair> expected;
        for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
            for (int j = i + 1; j < static_cast<int>(boxes.size()); ++j) {
                const Aabb &a = boxes[i], &b = boxes[j];
                if (a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y)
                    expected.push_back({i, j});
            }
        ASSERT_EQ(pairs, expected) << frame;
        total += pairs.size();
        for (auto& box : boxes) {
            const Vec3 by{move(random), move(random), 0};
            box.min += by;
            box.max += by;
        }
        if (frame == 20) boxes.resize(90);
    }
    EXPECT_GT(total, 500u);
    EXPECT_THROW(engine().broadPhase()->create("dynamic_tree", 3), adapter::Unsupported);
    EXPECT_THROW(engine().broadPhase()->create("grid", 2), adapter::Unsupported);
}

}  // namespace
}  // namespace rigor::test
