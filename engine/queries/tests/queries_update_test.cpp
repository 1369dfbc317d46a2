// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Queries that follow a world that moves, loses bodies and gets new ones: the answers are those of new queries, which
// world_queries_test compares with a search of everything.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "engine/pipeline/tests/scene.hpp"
#include "engine/queries/world_queries.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class QueriesUpdate : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(QueriesUpdate, Spaces);

template <class S>
struct Crowd {
    using R = typename S::Real;
    std::mt19937 random{7};
    World<S> world{earth<S>()};
    std::vector<BodyId> bodies;

    double number(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    }
    typename S::Vec point(double size) {
        typename S::Vec p;
        for (int k = 0; k < S::dim; ++k) p[k] = static_cast<R>(number(-size, size));
        return p;
    }
    void add() {
        BodyDef<S> def;
        def.pose.p = point(10);
        def.velocity = point(5);
        bodies.push_back(world.addBody(def));
        const auto size = static_cast<R>(number(0.1, 0.6));
        if (bodies.size() % 2 == 0)
            attach<S>(world, bodies.back(), Sphere<S>{size}, 0);
        else
            attach<S>(world, bodies.back(), Box<S>{S::Vec::Constant(size)}, 0);
    }
    void remove() {
        const auto k = static_cast<std::size_t>(number(0, double(bodies.size()) - 0.01));
        world.removeBody(bodies[k]);
        bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(k));
    }
};

bool same(const ShapeRef& a, const ShapeRef& b) {
    return a.body == b.body && a.shape == b.shape && a.piece == b.piece;
}
template <class Hit>
bool same(const std::optional<Hit>& a, const std::optional<Hit>& b) {
    if (!a || !b) return !a && !b;
    if constexpr (requires { a->fraction; })
        return same(ShapeRef(*a), ShapeRef(*b)) && a->fraction == b->fraction && a->point == b->point;
    else
        return same(ShapeRef(*a), ShapeRef(*b)) && a->distance == b->distance && a->point == b->point;
}
bool same(const std::vector<ShapeRef>& a, const std::vector<ShapeRef>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const ShapeRef& x, const ShapeRef& y) { return same(x, y); });
}

template <class S>
void expectSame(Crowd<S>& crowd, const WorldQueries<S>& queries) {
    using R = typename S::Real;
    const WorldQueries<S> fresh(crowd.world);
    for (int i = 0; i < 30; ++i) {
        const typename S::Vec from = crowd.point(12), way = crowd.point(20);
        Pose<S> X;
        X.p = from;
        const Sphere<S> ball{R(0.5)};
        EXPECT_TRUE(same(queries.castRay(from, way), fresh.castRay(from, way)));
        EXPECT_EQ(queries.castRayAll(from, way).size(), fresh.castRayAll(from, way).size());
        EXPECT_TRUE(same(queries.castShape(ball, X, way), fresh.castShape(ball, X, way)));
        EXPECT_TRUE(same(queries.nearest(from, R(5)), fresh.nearest(from, R(5))));
        EXPECT_TRUE(same(queries.overlapping(ball, X), fresh.overlapping(ball, X)));
        EXPECT_TRUE(same(queries.inBox(boundingBox<S>(ball, X)), fresh.inBox(boundingBox<S>(ball, X))));
    }
}

TYPED_TEST(QueriesUpdate, AnswersAreThoseOfNewQueries) {
    using S = TypeParam;
    using R = typename S::Real;
    Crowd<S> crowd;
    addGround<S>(crowd.world, 0);
    BodyDef<S> fixed;
    fixed.type = BodyType::Static;
    ShapeDef<S> sensor;
    sensor.shape = Sphere<S>{R(3)};
    sensor.sensor = true;
    crowd.world.addShape(crowd.world.addBody(fixed), sensor);
    for (int i = 0; i < 150; ++i) crowd.add();
    WorldQueries<S> queries(crowd.world);
    EXPECT_EQ(queries.builds(), 1);
    expectSame<S>(crowd, queries);
    for (int step = 0; step < 40; ++step) {
        crowd.world.step(R(1.0 / 60));
        for (int k = 0; k < 3; ++k) crowd.remove();
        for (int k = 0; k < 2 + step % 3; ++k) crowd.add();
        queries.update();
        expectSame<S>(crowd, queries);
    }
    EXPECT_GT(queries.builds(), 2) << "bodies have come and gone";
    EXPECT_LT(queries.builds(), 25) << "and not a tree for each step";
    const auto& found = queries.overlapping(Sphere<S>{R(0.1)}, Pose<S>{});
    for (const ShapeRef& ref : found) EXPECT_NE(ref.body.index, 2u) << "no sensors";
}

/// Removing a body gives the shapes after it other indices; those that stand still are found where they are.
TYPED_TEST(QueriesUpdate, WhatStandsStillIsFoundAfterOthersAreRemoved) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world{WorldDef<S>{}};
    std::vector<BodyId> bodies;
    for (int i = 0; i < 12; ++i) {
        BodyDef<S> def;
        def.type = BodyType::Static;
        def.pose.p = at<S>(3 * i, 0);
        bodies.push_back(world.addBody(def));
        attach<S>(world, bodies.back(), Box<S>{S::Vec::Constant(R(0.5))}, 0);
    }
    WorldQueries<S> queries(world);
    world.removeBody(bodies[2]);
    queries.update();
    for (int i = 0; i < 12; ++i) {
        const auto hit = queries.castRay(at<S>(3 * i, 5), at<S>(0, -10));
        ASSERT_EQ(hit.has_value(), i != 2) << i;
        if (hit) {
            EXPECT_EQ(hit->body, bodies[static_cast<std::size_t>(i)]) << i;
        }
    }
}

/// A thousand bodies that fly apart: the tree is built again when its boxes have grown, not before.
TYPED_TEST(QueriesUpdate, TheTreeIsBuiltAgainWhenBodiesHaveMovedApart) {
    using S = TypeParam;
    using R = typename S::Real;
    Crowd<S> crowd;
    for (int i = 0; i < 300; ++i) crowd.add();
    WorldQueries<S> queries(crowd.world);
    crowd.world.step(R(1e-4));
    queries.update();
    EXPECT_EQ(queries.builds(), 1);
    for (const BodyId body : crowd.bodies) {
        Pose<S> there;
        there.p = crowd.point(10);
        crowd.world.setPose(body, there);
    }
    queries.update();
    EXPECT_EQ(queries.builds(), 2);
    expectSame<S>(crowd, queries);
    for (const BodyId body : crowd.bodies) crowd.world.removeBody(body);
    queries.update();
    EXPECT_FALSE(queries.castRay(S::Vec::Zero(), S::Vec::Unit(0)).has_value());
}

}  // namespace
}  // namespace rigor::engine::test
