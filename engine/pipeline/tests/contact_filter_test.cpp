// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shapes that do not collide: by layers and masks, by groups, each shape of a body by itself; changed while the
// world runs; with every choice of continuous collision; saved and restored.
#include <gtest/gtest.h>

#include "engine/core/error.hpp"
#include "engine/pipeline/algorithms.hpp"
#include "engine/pipeline/tests/scene.hpp"
#include "engine/queries/world_queries.hpp"
#include "engine/shapes/surface.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class ContactFilters : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(ContactFilters, Spaces);

constexpr double kTick = 1.0 / 60;
constexpr ShapeFilter kNormal, kGhost{2, 2, 0};

template <class S>
ShapeId attachFiltered(World<S>& world, BodyId body, const Shape<S>& shape, const ShapeFilter& filter,
                       double x = 0, double y = 0) {
    ShapeDef<S> def;
    def.shape = shape;
    def.pose.p = at<S>(x, y);
    def.filter = filter;
    return world.addShape(body, def);
}
template <class S>
BodyId addFiltered(World<S>& world, double x, double y, const ShapeFilter& filter, double vy = 0) {
    using R = typename S::Real;
    BodyDef<S> def;
    def.mass = 1;
    def.inertia = isotropic<S>(0.1);
    def.pose.p = at<S>(x, y);
    def.velocity = at<S>(0, vy);
    const BodyId body = world.addBody(def);
    attachFiltered<S>(world, body, Box<S>{S::Vec::Constant(R(0.5))}, filter);
    return body;
}
template <class S>
BodyId addFloor(World<S>& world, const Shape<S>& shape, const ShapeFilter& filter = {}) {
    BodyDef<S> def;
    def.type = BodyType::Static;
    const BodyId body = world.addBody(def);
    attachFiltered<S>(world, body, shape, filter);
    return body;
}
/// y = 0, without thickness, 8 m wide.
template <class S>
Shape<S> thinFloor() {
    if constexpr (S::dim == 2) {
        const std::vector<typename S::Vec> v{at<S>(-4, 0), at<S>(0.3, 0), at<S>(4, 0)};
        return makeChain<S>(v, false);
    } else {
        const std::vector<typename S::Vec> v{{-4, 0, -4}, {4, 0, -4}, {4, 0, 4}, {-4, 0, 4}};
        const std::vector<std::array<std::uint32_t, 3>> t{{0, 2, 1}, {0, 3, 2}};
        return makeTriangleMesh<S>(v, t);
    }
}
template <class S>
double height(const World<S>& world, BodyId body) {
    return static_cast<double>(world.pose(body).p[1]);
}
template <class S>
void run(World<S>& world, int steps) {
    for (int i = 0; i < steps; ++i) world.step(static_cast<typename S::Real>(kTick));
}
/// Height that n steps of symplectic Euler fall from rest [m].
double fallen(int n) {
    return kGravity * kTick * kTick * n * (n + 1) / 2;
}

TEST(ShapeFilters, AgreeOnlyIfBothDo) {
    const ShapeFilter all, ghost{2, 2, 0}, debris{4, 1, 0}, picky{1, 3, 0};
    EXPECT_TRUE(lets(all, all));
    EXPECT_TRUE(lets(all, debris)) << "debris collides with layer 1, and all with everything";
    EXPECT_FALSE(lets(debris, debris));
    EXPECT_FALSE(lets(all, ghost)) << "one side does not want it";
    EXPECT_FALSE(lets(picky, ghost)) << "the other side does not want it";
    EXPECT_TRUE(lets(ghost, ghost));
    EXPECT_FALSE(lets({0, ~0ull, 0}, all)) << "in no layer";
    const ShapeFilter left{1, ~0ull, -3}, right{1, ~0ull, -4}, ally{1, 0, 5}, friendly{8, 0, 5};
    EXPECT_FALSE(lets(left, left));
    EXPECT_TRUE(lets(left, right)) << "of different groups: by layers";
    EXPECT_TRUE(lets(left, all));
    EXPECT_TRUE(lets(ally, friendly)) << "a positive group overrules masks";
    EXPECT_FALSE(lets(ally, all));
    for (const ShapeFilter& a : {all, ghost, debris, picky, left, right, ally, friendly})
        for (const ShapeFilter& b : {all, ghost, debris, picky, left, right, ally, friendly})
            EXPECT_EQ(lets(a, b), lets(b, a));
}

TYPED_TEST(ContactFilters, OneFallsThroughWhatCarriesTheOther) {
    using S = TypeParam;
    using R = typename S::Real;
    const std::vector<Shape<S>> floors{Shape<S>(HalfSpace<S>{S::Vec::Unit(1), R(0)}), thinFloor<S>()};
    for (const Shape<S>& floor : floors)
        for (const char* ccd : {"none", "speculative", "conservative_advancement"}) {
            WorldDef<S> def = earthByEuler<S>();
            def.continuousCollision = ccd;
            World<S> world(def);
            addFloor<S>(world, floor);
            const BodyId solid = addFiltered<S>(world, -1.5, 1, kNormal);
            const BodyId ghost = addFiltered<S>(world, 1.5, 1, kGhost);
            run(world, 60);
            EXPECT_NEAR(height(world, solid), 0.5, 2e-3) << ccd;
            EXPECT_NEAR(height(world, ghost), 1 - fallen(60), tol<S>(1e-10, 1e-4))
                << ccd << shapeName<S>(floor);
        }
}

TYPED_TEST(ContactFilters, BodiesThatFlyPassEachOther) {
    using S = TypeParam;
    for (const char* integrator : {"symplectic_euler", "moreau_midpoint"})
        for (const bool meets : {false, true}) {
            WorldDef<S> def;
            def.integrator = integrator;
            World<S> world(def);
            const BodyId up = addFiltered<S>(world, 0, -2, meets ? kNormal : kGhost, 5);
            const BodyId down = addFiltered<S>(world, 0, 2, kNormal, -5);
            run(world, 60);
            EXPECT_EQ(height(world, up) > height(world, down), !meets) << integrator;
        }
}

TYPED_TEST(ContactFilters, TwoInterleavedStacksStandInOneAnother) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const bool fast : {false, true}) {
        WorldDef<S> def = earth<S>();
        if (fast) preferSpeed<S>(def);
        World<S> world(def);
        addFloor<S>(world, HalfSpace<S>{S::Vec::Unit(1), R(0)}, {4, 3, 0});
        std::vector<BodyId> red, blue;
        for (int i = 0; i < 4; ++i) {
            red.push_back(addFiltered<S>(world, 0, 0.5 + i, {1, 5, 0}));
            blue.push_back(addFiltered<S>(world, 0.1, 1 + i, {2, 6, 0}));
        }
        run(world, 240);
        for (std::size_t i = 0; i < red.size(); ++i) {
            EXPECT_NEAR(height(world, red[i]), 0.5 + static_cast<double>(i), 2e-2) << fast;
            EXPECT_NEAR(height(world, blue[i]), 0.5 + static_cast<double>(i), 2e-2) << fast;
        }
        for (const auto& contact : world.manifolds())
            EXPECT_TRUE(lets(world.shapes()[contact.shapeA].filter, world.shapes()[contact.shapeB].filter));
    }
}

TYPED_TEST(ContactFilters, EachShapeOfABodyHasItsOwn) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    addFloor<S>(world, HalfSpace<S>{S::Vec::Unit(1), R(0)});
    const BodyId body = addFiltered<S>(world, 0, 2, kNormal);
    // A skirt under the box, which does not touch the floor.
    attachFiltered<S>(world, body, Box<S>{S::Vec::Constant(R(0.5))}, kGhost, 0, -1);
    run(world, 120);
    EXPECT_NEAR(height(world, body), 0.5, 2e-3);
}

TYPED_TEST(ContactFilters, AChangeWakesAndEndsContacts) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const bool sleeps : {false, true}) {
        WorldDef<S> def = earthByEuler<S>();
        if (sleeps) def.sleeping = "islands";
        World<S> world(def);
        const BodyId floor = addFloor<S>(world, HalfSpace<S>{S::Vec::Unit(1), R(0)});
        const BodyId lower = addFiltered<S>(world, 0, 0.5, kNormal),
                     upper = addFiltered<S>(world, 0, 1.5, kNormal);
        run(world, 90);
        ASSERT_EQ(world.isAsleep(lower), sleeps);
        const ShapeId lowerShape = world.shapes()[1].id;
        ASSERT_EQ(world.bodyOf(world.shapes()[1]), lower);
        world.setFilter(lowerShape, {1, 1, -7});
        world.setFilter(world.shapes()[0].id, {1, 1, -7});
        EXPECT_EQ(world.filter(lowerShape).group, -7);
        EXPECT_FALSE(world.isAsleep(lower));
        EXPECT_FALSE(world.isAsleep(upper)) << "it rests on what moves";
        run(world, 1);
        std::size_t ended = 0;
        for (const auto& event : world.lastStep().events)
            ended += event.kind == EventKind::ContactEnds && event.bodyA == floor && event.bodyB == lower;
        EXPECT_EQ(ended, 1u);
        run(world, 39);
        EXPECT_NEAR(height(world, lower), 0.5 - fallen(40), 2e-3);
        EXPECT_NEAR(height(world, upper), 0.5, 2e-2);
        world.beginStep(R(kTick));
        EXPECT_THROW(world.setFilter(lowerShape, {}), EngineError);
    }
}

TYPED_TEST(ContactFilters, AFilterIsPartOfTheStateWhereItIsNotTheDefault) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    addFloor<S>(world, HalfSpace<S>{S::Vec::Unit(1), R(0)});
    addFiltered<S>(world, 0, 0.5, kNormal);
    run(world, 30);
    const std::uint64_t before = world.stateHash();
    World<S> other = world;
    std::vector<unsigned char> bytes;
    world.setFilter(world.shapes()[1].id, kGhost);
    EXPECT_NE(world.stateHash(), before);
    world.saveSnapshot(bytes);
    other.restoreSnapshot(bytes);
    EXPECT_EQ(other.shapes()[1].filter, kGhost);
    run(world, 20);
    run(other, 20);
    EXPECT_EQ(world.stateHash(), other.stateHash());
    EXPECT_LT(static_cast<double>(other.pose(other.bodies()[1]).p[1]), 0.4);
    world.restoreSnapshot(bytes);
    world.setFilter(world.shapes()[1].id, {});
    EXPECT_EQ(world.stateHash(), before) << "as it was";
}

TYPED_TEST(ContactFilters, QueriesAskAsAShapeOfAFilter) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    addFloor<S>(world, HalfSpace<S>{S::Vec::Unit(1), R(0)});
    const BodyId solid = addFiltered<S>(world, 0, 1, kNormal), ghost = addFiltered<S>(world, 0, 3, kGhost);
    const WorldQueries<S> queries(world);
    const typename S::Vec from = at<S>(0, 9), down = at<S>(0, -10);
    EXPECT_EQ(queries.castRay(from, down)->body, ghost);
    EXPECT_EQ(queries.castRay(from, down, kNormal)->body, solid);
    EXPECT_EQ(queries.castRay(from, down, kGhost)->body, ghost);
    EXPECT_EQ(queries.castRayAll(from, down, kNormal).size(), 2u);
    const auto notSolid = [&](BodyId body) { return !(body == solid); };
    EXPECT_EQ(queries.castRayAll(from, down, notSolid).size(), 2u);
    EXPECT_EQ(queries.castRayAll(from, down, QueryFilter(kNormal, notSolid)).size(), 1u);
}

}  // namespace
}  // namespace rigor::engine::test
