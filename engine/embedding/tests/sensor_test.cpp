// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Sensors: what is in them, when it comes and goes, and that they push nothing.
#include <gtest/gtest.h>

#include <vector>

#include "engine/core/error.hpp"
#include "engine/embedding/tests/tick.hpp"
#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Sensor : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Sensor, Spaces);

template <class S>
ShapeId addSensor(World<S>& world, BodyId body, const Shape<S>& shape, const ShapeFilter& filter = {}) {
    ShapeDef<S> def;
    def.shape = shape;
    def.sensor = true;
    def.filter = filter;
    return world.addShape(body, def);
}

template <class S>
BodyId addBodyAt(World<S>& world, BodyType type, double x, double y, double vx = 0) {
    BodyDef<S> def;
    def.type = type;
    def.pose.p = at<S>(x, y);
    def.velocity = at<S>(vx, 0);
    return world.addBody(def);
}

template <class S>
Shape<S> cube(double half) {
    return Box<S>{S::Vec::Constant(static_cast<typename S::Real>(half))};
}

template <class S>
int count(const StepResult<S>& step, EventKind kind) {
    int n = 0;
    for (const Event<S>& event : step.events) n += event.kind == kind;
    return n;
}

/// A ball flies through a gate of 1 m at 6 m/s: 0.1 m per step, radius 0.1 m, in it from |x| <= 0.6 on.
TYPED_TEST(Sensor, ReportsWhatFliesThroughAndDoesNotTouchIt) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const BodyType type : {BodyType::Static, BodyType::Kinematic, BodyType::Dynamic}) {
        World<S> world{WorldDef<S>{}};
        const BodyId gateBody = addBodyAt<S>(world, type, 0, 0);
        const ShapeId gate = addSensor<S>(world, gateBody, cube<S>(0.5));
        const BodyId ball = addBall<S>(world, -1.05, 0, 0.1, 1, 0, 6);
        int begins = 0, ends = 0;
        for (int i = 1; i <= 25; ++i) {
            const StepResult<S>& step = world.step(R(kTick));
            for (const Event<S>& event : step.events) {
                EXPECT_EQ(event.shapeA, gate);
                EXPECT_EQ(event.bodyA, gateBody);
                EXPECT_EQ(event.bodyB, ball);
                if (event.kind == EventKind::SensorBegins) {
                    ++begins;
                    EXPECT_EQ(i, 5) << "at x = -0.55";
                }
                if (event.kind == EventKind::SensorEnds) {
                    ++ends;
                    EXPECT_EQ(i, 17) << "at x = 0.65";
                }
            }
            const double x = double(world.pose(ball).p[0]);
            ASSERT_EQ(world.sensorOverlaps(gate).size(), std::abs(x) <= 0.6 ? 1u : 0u) << x;
            EXPECT_EQ(step.contacts, 0u);
        }
        EXPECT_EQ(begins, 1);
        EXPECT_EQ(ends, 1);
        EXPECT_NEAR(double(world.velocity(ball)[0]), 6, 1e-6);
        EXPECT_EQ(world.velocity(gateBody).norm(), R(0));
    }
}

TYPED_TEST(Sensor, FindsKinematicAndStaticBodiesAndNoSensors) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world{WorldDef<S>{}};
    const ShapeId fixed = addSensor<S>(world, addBodyAt<S>(world, BodyType::Static, 0, 0), cube<S>(1));
    const ShapeId moving = addSensor<S>(world, addBodyAt<S>(world, BodyType::Kinematic, 0.5, 0), cube<S>(1));
    const BodyId lift = addBodyAt<S>(world, BodyType::Kinematic, 0, 0);
    attach<S>(world, lift, cube<S>(0.1), 0);
    const BodyId wall = addBodyAt<S>(world, BodyType::Static, 0.5, 0);
    attach<S>(world, wall, cube<S>(0.1), 0);
    world.step(R(kTick));
    ASSERT_EQ(world.sensorOverlaps(fixed).size(), 1u) << "not what is static as itself, nor the other sensor";
    EXPECT_EQ(world.sensorOverlaps(fixed)[0].body, lift);
    ASSERT_EQ(world.sensorOverlaps(moving).size(), 2u);
}

TYPED_TEST(Sensor, HeedsFiltersAndBodiesThatDoNotCollide) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world{WorldDef<S>{}};
    const BodyId place = addBodyAt<S>(world, BodyType::Static, 0, 0);
    const ShapeId sensor = addSensor<S>(world, place, cube<S>(1), {.mask = 2});
    addBall<S>(world, 0, 0, 0.1, 1, 0);
    BodyDef<S> ghost;
    ghost.collides = false;
    const BodyId none = world.addBody(ghost);
    attach<S>(world, none, cube<S>(0.1), 0);
    const BodyId seen = world.addBody(BodyDef<S>{});
    ShapeDef<S> def;
    def.shape = cube<S>(0.1);
    def.filter.layers = 2;
    world.addShape(seen, def);
    world.step(R(kTick));
    ASSERT_EQ(world.sensorOverlaps(sensor).size(), 1u);
    EXPECT_EQ(world.sensorOverlaps(sensor)[0].body, seen);
}

/// A cube sleeps on the ground, in a sensor: it stays in it, and a snapshot knows it.
TYPED_TEST(Sensor, KeepsWhatSleepsAndGoesThroughSnapshots) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldDef<S> def = earth<S>();
    def.sleeping = "islands";
    World<S> world(def);
    addGround<S>(world, kUsualMaterial);
    const ShapeId sensor = addSensor<S>(world, addBodyAt<S>(world, BodyType::Static, 0, 0.5), cube<S>(0.4));
    const BodyId box = addCube<S>(world, 0, 0.5, 0.5, 1, kUsualMaterial);
    int begins = 0, ends = 0;
    for (int i = 0; i < 90; ++i) {
        const StepResult<S>& step = world.step(R(kTick));
        begins += count(step, EventKind::SensorBegins);
        ends += count(step, EventKind::SensorEnds);
    }
    ASSERT_TRUE(world.isAsleep(box));
    EXPECT_EQ(begins, 1);
    EXPECT_EQ(ends, 0);
    ASSERT_EQ(world.sensorOverlaps(sensor).size(), 1u);
    std::vector<unsigned char> saved;
    world.saveSnapshot(saved);
    const std::uint64_t hash = world.stateHash();

    Pose<S> away;
    away.p = at<S>(5, 0.5);
    world.setPose(box, away);
    EXPECT_EQ(count(world.step(R(kTick)), EventKind::SensorEnds), 1);
    EXPECT_TRUE(world.sensorOverlaps(sensor).empty());
    EXPECT_NE(world.stateHash(), hash);
    world.restoreSnapshot(saved);
    EXPECT_EQ(world.stateHash(), hash);
    EXPECT_EQ(world.sensorOverlaps(sensor).size(), 1u);
    const StepResult<S>& again = world.step(R(kTick));
    EXPECT_EQ(count(again, EventKind::SensorBegins), 0) << "it was in it when saved";
    EXPECT_TRUE(world.isAsleep(box)) << "sensors wake nothing";
}

TYPED_TEST(Sensor, EndsForWhatIsRemovedAndRefusesOtherShapes) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world{WorldDef<S>{}};
    const BodyId place = addBodyAt<S>(world, BodyType::Static, 0, 0);
    const ShapeId sensor = addSensor<S>(world, place, cube<S>(1));
    const BodyId a = addBall<S>(world, 0.2, 0, 0.1, 1, 0), b = addBall<S>(world, -0.5, 0, 0.1, 1, 0);
    world.step(R(kTick));
    EXPECT_EQ(world.sensorOverlaps(sensor).size(), 2u);
    world.removeBody(a);
    const StepResult<S>& step = world.step(R(kTick));
    ASSERT_EQ(step.events.size(), 1u);
    EXPECT_EQ(step.events[0].kind, EventKind::SensorEnds);
    EXPECT_EQ(step.events[0].bodyB, a);
    EXPECT_EQ(describe(step.events[0]), "sensor_ends a=body_1 b=body_2");
    world.removeShape(sensor);
    EXPECT_EQ(count(world.step(R(kTick)), EventKind::SensorEnds), 1);
    EXPECT_THROW(world.sensorOverlaps(world.shapes()[0].id), EngineError);
    EXPECT_EQ(world.bodyOf(world.shapes()[0]), b);
}

/// A hundred balls in a hundred sensors, compared with distances.
TYPED_TEST(Sensor, AgreesWithDistancesForAnyThreads) {
    using S = TypeParam;
    using R = typename S::Real;
    std::uint64_t hashes[2];
    for (const int threads : {1, 3}) {
        WorldDef<S> def;
        def.threads = threads;
        World<S> world(def);
        std::vector<ShapeId> sensors;
        std::vector<BodyId> balls;
        for (int i = 0; i < 100; ++i) {
            const BodyId place = addBodyAt<S>(world, BodyType::Static, 0.37 * (i % 10), 0.41 * (i / 10));
            sensors.push_back(addSensor<S>(world, place, Sphere<S>{R(0.15)}));
            BodyDef<S> flying;
            flying.pose.p = at<S>(0.29 * (i % 10), 0.53 * (i / 10));
            flying.velocity = at<S>(1 + 0.1 * i, 2 - 0.03 * i);
            balls.push_back(world.addBody(flying));
            ShapeDef<S> ball;
            ball.shape = Sphere<S>{R(0.05)};
            ball.filter = {.layers = 1, .mask = 1, .group = -1};
            world.addShape(balls.back(), ball);
        }
        std::size_t all = 0;
        for (int step = 0; step < 20; ++step) {
            world.step(R(kTick));
            for (int i = 0; i < 100; ++i) {
                std::vector<BodyId> expected;
                for (const BodyId ball : balls)
                    if ((world.pose(ball).p - at<S>(0.37 * (i % 10), 0.41 * (i / 10))).norm() <= R(0.2))
                        expected.push_back(ball);
                const auto found = world.sensorOverlaps(sensors[std::size_t(i)]);
                ASSERT_EQ(found.size(), expected.size());
                for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k].body, expected[k]);
                all += found.size();
            }
        }
        EXPECT_GT(all, 100u);
        hashes[threads > 1] = world.stateHash();
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace rigor::engine::test
