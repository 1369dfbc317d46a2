// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Changes of a world that runs: shapes removed, types, masses, materials, gravity, continuous collision of one body.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/core/error.hpp"
#include "engine/embedding/tests/tick.hpp"
#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class WorldChanges : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(WorldChanges, Spaces);

/// A tower of cubes of 1 m on a static slab, asleep or at rest.
template <class S>
struct Tower {
    World<S> world;
    BodyId slab;
    ShapeId slabShape;
    std::vector<BodyId> cubes;
    explicit Tower(bool sleeps, int count = 3) : world(defOf(sleeps)) {
        BodyDef<S> fixed;
        fixed.type = BodyType::Static;
        fixed.pose.p = at<S>(0, -1);
        slab = world.addBody(fixed);
        slabShape = attach<S>(world, slab, Box<S>{S::Vec::Constant(typename S::Real(1)) + at<S>(20, 0)},
                              kUsualMaterial);
        for (int i = 0; i < count; ++i)
            cubes.push_back(addCube<S>(world, 0, 0.5 + i, 0.5, 1, kUsualMaterial));
        step(120);
    }
    static WorldDef<S> defOf(bool sleeps) {
        WorldDef<S> def = earthByEuler<S>();
        if (sleeps) def.sleeping = "islands";
        return def;
    }
    void step(int n) {
        for (int i = 0; i < n; ++i) world.step(static_cast<typename S::Real>(kTick));
    }
    double height(int i) const { return double(world.pose(cubes[std::size_t(i)]).p[1]); }
    ShapeId shapeOf(BodyId body) const {
        for (const ShapeRecord<S>& shape : world.shapes())
            if (world.bodyOf(shape) == body) return shape.id;
        return {};
    }
};
constexpr double fallen(int steps) {
    return kGravity * kTick * kTick * steps * (steps + 1) / 2;
}
TYPED_TEST(WorldChanges, ARemovedShapeCarriesNothing) {
    using S = TypeParam;
    for (const bool sleeps : {false, true}) {
        Tower<S> tower(sleeps);
        ASSERT_EQ(tower.world.isAsleep(tower.cubes[0]), sleeps);
        const ShapeId shape = tower.shapeOf(tower.cubes[0]);
        tower.world.removeShape(shape);
        EXPECT_FALSE(tower.world.contains(shape));
        const double h = tower.height(1);
        const StepResult<S>& step = tower.world.step(typename S::Real(kTick));
        int ends = 0;
        for (const Event<S>& event : step.events) {
            EXPECT_EQ(event.kind, EventKind::ContactEnds);
            const bool ofRemoved = event.shapeA == shape || event.shapeB == shape;
            // The two above fall together and need not press each other.
            EXPECT_TRUE(ofRemoved || (event.shapeA != tower.slabShape && event.shapeB != tower.slabShape));
            ends += ofRemoved;
        }
        EXPECT_EQ(ends, 2) << "with the slab and with the cube above";
        tower.step(11);
        EXPECT_NEAR(tower.height(1), h - fallen(12), 1e-3);
        EXPECT_NEAR(tower.height(0), 0.5 - fallen(12), 1e-3) << "through the slab";
        tower.step(120);
        EXPECT_NEAR(tower.height(1), 0.5, 2e-3);
        EXPECT_NEAR(tower.height(2), 1.5, 3e-3);
    }
}

/// Bodies get other dense indices when one goes: the contacts of the rest go on, with their impulses.
TYPED_TEST(WorldChanges, ContactsGoOnWhenAnotherBodyIsRemoved) {
    using S = TypeParam;
    for (const char* solver : {"by_island", "wide", "pgs"}) {
        WorldDef<S> def = earth<S>();
        def.solver = solver;
        World<S> world(def);
        const BodyId first = addBall<S>(world, 9, 30, 0.1, 1, 0),
                     second = addBall<S>(world, 8, 30, 0.1, 1, 0);
        addGround<S>(world, kUsualMaterial);
        std::vector<BodyId> cubes;
        for (int i = 0; i < 4; ++i) cubes.push_back(addCube<S>(world, 0, 0.5 + i, 0.5, 1, kUsualMaterial));
        for (int i = 0; i < 60; ++i) world.step(typename S::Real(kTick));
        const auto load = [&] {
            double sum = 0;
            std::vector<ContactView<S>> contacts;
            world.readContacts(contacts);
            for (const auto& c : contacts) sum += double(c.normalImpulse);
            return sum;
        };
        const double before = load();
        for (const BodyId body : {first, second}) {
            world.removeBody(body);  // the last cube takes its place
            const StepResult<S>& step = world.step(typename S::Real(kTick));
            EXPECT_TRUE(step.events.empty()) << solver << ": " << describe(step.events[0]);
            EXPECT_NEAR(load(), before, 2e-2 * before) << solver;
        }
        for (int i = 0; i < 4; ++i)
            EXPECT_NEAR(double(world.pose(cubes[std::size_t(i)]).p[1]), 0.5 + i, 1e-2);
        World<S> copy = world;
        std::vector<unsigned char> saved;
        world.saveSnapshot(saved);
        copy.restoreSnapshot(saved);
        for (int i = 0; i < 10; ++i) {
            world.step(typename S::Real(kTick));
            copy.step(typename S::Real(kTick));
        }
        EXPECT_EQ(world.stateHash(), copy.stateHash());
    }
}

TYPED_TEST(WorldChanges, TypesChangeWhatMoves) {
    using S = TypeParam;
    for (const bool sleeps : {false, true}) {
        Tower<S> tower(sleeps);
        World<S>& world = tower.world;
        world.setType(tower.slab, BodyType::Dynamic);
        const double volume = S::dim == 2 ? 42 * 2 : 42 * 2 * 2;
        EXPECT_NEAR(double(world.constants(tower.slab).mass), 1000 * volume, 1e-3 * volume);
        EXPECT_FALSE(world.isAsleep(tower.cubes[2]));
        tower.step(12);
        EXPECT_NEAR(tower.height(2), 2.5 - fallen(12), 2e-3) << "all of it falls";
        world.setType(tower.slab, BodyType::Static);
        EXPECT_EQ(world.velocity(tower.slab).norm(), 0);
        const double slab = double(world.pose(tower.slab).p[1]);
        tower.step(180);
        EXPECT_EQ(double(world.pose(tower.slab).p[1]), slab);
        EXPECT_NEAR(tower.height(2), slab + 3.5, 5e-3);

        world.setType(tower.slab, BodyType::Kinematic);
        world.setVelocity(tower.slab, at<S>(0, 1), spin<S>(0));
        tower.step(60);
        EXPECT_NEAR(double(world.pose(tower.slab).p[1]), slab + 1, 1e-3);
        EXPECT_NEAR(tower.height(2), slab + 4.5, 1e-2);
        world.setType(tower.cubes[1], BodyType::Static);
        tower.step(12);
        EXPECT_NEAR(double(world.velocity(tower.cubes[1]).norm()), 0, 0);
    }
}

TYPED_TEST(WorldChanges, TypesThatShapesForbidAreRefused) {
    using S = TypeParam;
    World<S> world(earth<S>());
    const BodyId ground = addGround<S>(world, 0);
    EXPECT_EQ(refusal([&] { world.setType(ground, BodyType::Dynamic); }), "half_space_body");
    EXPECT_EQ(world.constants(ground).type, BodyType::Static);
    const BodyId ball = addBall<S>(world, 0, 3, 0.5, 1, 0);
    EXPECT_EQ(refusal([&] { world.setMass(ground, {1, S::Vec::Zero(), isotropic<S>(1)}); }), "body_mass");
    EXPECT_EQ(refusal([&] { world.setMass(ball, {0, S::Vec::Zero(), isotropic<S>(1)}); }), "body_mass");
    EXPECT_EQ(refusal([&] { world.setMass(ball, {1, S::Vec::Zero(), isotropic<S>(-1)}); }), "body_inertia");
    EXPECT_EQ(refusal([&] { world.setMaterial(world.shapes()[0].id, 9); }), "shape_material");
    EXPECT_EQ(refusal([&] { world.setDensity(world.shapes()[0].id, -1); }), "shape_density");
    EXPECT_EQ(refusal([&] { world.setGravity(at<S>(std::nan(""), 0)); }), "gravity");
    world.beginStep(typename S::Real(kTick));
    EXPECT_EQ(refusal([&] { world.setType(ball, BodyType::Static); }), "step_in_progress");
    EXPECT_EQ(refusal([&] { world.removeShape(world.shapes()[0].id); }), "step_in_progress");
    EXPECT_EQ(refusal([&] { world.setGravity(at<S>(0, 1)); }), "step_in_progress");
}

/// A hammer that spins: its head goes, and every point of it keeps its velocity; momentum is that of what is left.
TYPED_TEST(WorldChanges, MassesComeFromShapesAndGoWithThem) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world{WorldDef<S>{}};
    BodyDef<S> def;
    def.pose.p = at<S>(1, 2);
    def.pose.q = rotatedBy(def.pose.q, spin<S>(0.4));
    def.angularVelocity = spin<S>(3);
    const BodyId body = world.addBody(def);
    EXPECT_EQ(world.constants(body).mass, R(1)) << "without shapes";
    ShapeDef<S> ball;
    ball.shape = Sphere<S>{R(0.1)};
    ball.density = 500;
    world.addShape(body, ball);
    const double one = double(world.constants(body).mass);
    EXPECT_NEAR(one, S::dim == 2 ? 500 * 3.14159265 * 0.01 : 500 * 4.18879020 * 0.001, 1e-5);
    ball.pose.p = at<S>(2, 0);
    ball.density = 1500;
    const auto pointVelocity = [&](double x) {
        const typename S::Vec r = toWorld<S>(world.pose(body), at<S>(x, 0)) -
                                  toWorld<S>(world.pose(body), world.constants(body).centerOfMass);
        return typename S::Vec(world.velocity(body) + cross(world.angularVelocity(body), r));
    };
    const typename S::Vec before = pointVelocity(0.7);
    const Pose<S> place = world.pose(body);
    const ShapeId second = world.addShape(body, ball);
    EXPECT_NEAR(double(world.constants(body).mass), 4 * one, 1e-4);
    EXPECT_NEAR(double(world.constants(body).centerOfMass[0]), 1.5, 1e-6);
    // Own inertias, and those of two points about the centre: m (1.5)^2 + 3 m (0.5)^2 = 3 m.
    const double own = (S::dim == 2 ? 0.5 : 0.4) * 0.01 * 4 * one;
    double axial;
    if constexpr (S::dim == 2)
        axial = double(world.constants(body).inertia);
    else
        axial = double(world.constants(body).inertia(2, 2));
    EXPECT_NEAR(axial, own + 3 * one, 1e-4);
    EXPECT_LT((pointVelocity(0.7) - before).norm(), R(1e-5));
    EXPECT_LT((world.pose(body).p - place.p).norm(), R(1e-6)) << "the body frame stays";
    world.setDensity(second, 500);
    EXPECT_NEAR(double(world.constants(body).centerOfMass[0]), 1, 1e-6);
    world.removeShape(second);
    EXPECT_NEAR(double(world.constants(body).mass), one, 1e-5);
    EXPECT_NEAR(double(world.constants(body).centerOfMass.norm()), 0, 1e-6);
    EXPECT_LT((pointVelocity(0.7) - before).norm(), R(1e-5));
    world.setMassOfShapes(body, 10);
    EXPECT_NEAR(double(world.constants(body).mass), 10, 1e-5);
    world.setMass(body, {2, at<S>(0.5, 0), isotropic<S>(3)});
    world.addShape(body, ball);
    EXPECT_EQ(world.constants(body).mass, R(2)) << "by hand";
    EXPECT_LT((pointVelocity(0.7) - before).norm(), R(1e-5));
}

/// A free body of two balls turns about its centre, which the shapes have put elsewhere; joints hold where they did.
TYPED_TEST(WorldChanges, JointsAndContactsFollowTheCentreOfMass) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    BodyDef<S> def;
    def.pose.p = at<S>(0, 5);
    const BodyId body = world.addBody(def);
    ShapeDef<S> part;
    part.shape = Box<S>{S::Vec::Constant(R(0.2))};
    world.addShape(body, part);
    JointDef<S> joint;
    joint.type = S::dim == 2 ? JointType::Hinge : JointType::Ball;
    joint.bodyB = body;
    joint.anchorA = at<S>(0, 5);
    world.addJoint(joint);
    part.pose.p = at<S>(1, 0);
    const ShapeId arm = world.addShape(body, part);
    EXPECT_NEAR(double(world.constants(body).centerOfMass[0]), 0.5, 1e-6);
    for (int i = 0; i < 120; ++i) world.step(R(kTick));
    EXPECT_LT((world.pose(body).p - at<S>(0, 5)).norm(), R(2e-3)) << "it swings about its anchor";
    world.removeShape(arm);
    for (int i = 0; i < 30; ++i) world.step(R(kTick));
    EXPECT_LT((world.pose(body).p - at<S>(0, 5)).norm(), R(2e-3));
}

TYPED_TEST(WorldChanges, MaterialsAndGravityActAtOnce) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const bool sleeps : {false, true}) {
        Tower<S> tower(sleeps, 1);
        World<S>& world = tower.world;
        // Gravity on a slope of 20 degrees: friction 0.6 holds, 0 does not.
        const double a = std::sin(0.35) * kGravity;
        world.setGravity(at<S>(a, -std::cos(0.35) * kGravity));
        EXPECT_FALSE(world.isAsleep(tower.cubes[0]));
        tower.step(120);
        EXPECT_NEAR(double(world.pose(tower.cubes[0]).p[0]), 0, 2e-3);
        EXPECT_EQ(world.isAsleep(tower.cubes[0]), sleeps);
        world.setMaterial(tower.slabShape, kFrictionless);
        EXPECT_FALSE(world.isAsleep(tower.cubes[0]));
        tower.step(30);
        EXPECT_NEAR(double(world.velocity(tower.cubes[0])[0]), a * 0.5, 2e-2);
        std::vector<unsigned char> saved;
        world.saveSnapshot(saved);
        const std::uint64_t hash = world.stateHash();
        world.setGravity(at<S>(0, 0));
        EXPECT_NE(world.stateHash(), hash) << "gravity set is part of the state";
        world.restoreSnapshot(saved);
        EXPECT_EQ(world.stateHash(), hash);
        EXPECT_NEAR(double(world.def().gravity[0]), a, 1e-6);
        world.setGravity(at<S>(0, -1));
        world.setGravityScale(tower.cubes[0], -1);
        const double v = double(world.velocity(tower.cubes[0])[1]);
        tower.step(30);
        EXPECT_NEAR(double(world.velocity(tower.cubes[0])[1]) - v, 0.5, 1e-2) << "it rises";
        EXPECT_EQ(refusal([&] { world.restoreSnapshot(saved); }), "snapshot_world")
            << "another gravity scale";
        (void)R(0);
    }
}

/// Two bullets and a plate of 2 cm: which one is stopped is what its body says.
TYPED_TEST(WorldChanges, ContinuousCollisionIsABodysOwn) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const char* ccd : {"none", "conservative_advancement", "speculative"})
        for (const ContinuousMode mode : {ContinuousMode::World, ContinuousMode::On, ContinuousMode::Off}) {
            WorldDef<S> def;
            def.integrator = "symplectic_euler";  // the midpoint rule locates impacts of bodies in flight
            def.continuousCollision = ccd;
            World<S> world(def);
            BodyDef<S> fixed;
            fixed.type = BodyType::Static;
            fixed.pose.p = at<S>(2.1, 0);
            typename S::Vec half = S::Vec::Constant(R(2));
            half[0] = R(0.01);
            attach<S>(world, world.addBody(fixed), Box<S>{half}, 0);
            BodyDef<S> bullet;
            bullet.velocity = at<S>(300, 0);
            bullet.continuous = mode;
            const BodyId a = world.addBody(bullet);
            attach<S>(world, a, Sphere<S>{R(0.05)}, 0);
            bullet.pose.p = at<S>(0, 1);
            bullet.continuous = ContinuousMode::World;
            const BodyId b = world.addBody(bullet);
            attach<S>(world, b, Sphere<S>{R(0.05)}, 0);
            for (int i = 0; i < 3; ++i) world.step(R(kTick));
            const bool always = def.continuousCollision != "none";
            const bool stops = mode == ContinuousMode::On || (mode == ContinuousMode::World && always);
            EXPECT_EQ(world.pose(a).p[0] < R(2.1), stops) << ccd << ' ' << int(mode);
            EXPECT_EQ(world.pose(b).p[0] < R(2.1), always) << ccd << ' ' << int(mode);
        }
    World<S> world{WorldDef<S>{}};
    const BodyId body = addBall<S>(world, 0, 0, 0.05, 1, 0, 300);
    BodyDef<S> fixed;
    fixed.type = BodyType::Static;
    fixed.pose.p = at<S>(2.1, 0);
    attach<S>(world, world.addBody(fixed), Box<S>{S::Vec::Constant(R(0.02))}, 0);
    world.setContinuous(body, ContinuousMode::On);
    for (int i = 0; i < 3; ++i) world.step(R(kTick));
    EXPECT_LT(world.pose(body).p[0], R(2.1)) << "set at run time";
}

}  // namespace
}  // namespace rigor::engine::test
