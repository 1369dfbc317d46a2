// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Calls with values out of range: each is refused by its own error, and the world is to the bit as it was, also one that
// sleeps.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/embedding/solid_body.hpp"
#include "engine/embedding/tests/tick.hpp"
#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class RefusedCalls : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(RefusedCalls, Spaces);

template <class S>
constexpr typename S::Real kNan = std::numeric_limits<typename S::Real>::quiet_NaN();

/// Two boxes on the ground that a joint connects, asleep.
template <class S>
struct Sleepers {
    using R = typename S::Real;
    World<S> world;
    BodyId ground, a, b;
    JointId joint;
    ShapeId shape;

    Sleepers() : world(definition()) {
        const std::uint32_t stone = world.addMaterial(R(0.5), R(0));
        ground = addGround<S>(world, stone);
        a = addCube<S>(world, 0, 0.5, 0.5, 1, stone);
        b = addCube<S>(world, 2, 0.5, 0.5, 1, stone);
        JointDef<S> rod;
        rod.type = JointType::Distance;
        rod.bodyA = a;
        rod.bodyB = b;
        rod.length = R(2);
        joint = world.addJoint(rod);
        shape = world.shapes().back().id;
        for (int i = 0; i < 120 && !world.isAsleep(b); ++i) world.step(R(kTick));
    }
    static WorldDef<S> definition() {
        WorldDef<S> def = earth<S>();
        def.sleeping = "islands";
        return def;
    }
};

/// An error and a call that is to throw it.
using Refused = std::pair<std::string, std::function<void()>>;

template <class S>
std::vector<Refused> badDefinitions(Sleepers<S>& s) {
    using R = typename S::Real;
    World<S>& w = s.world;
    ShapeDef<S> flat{Sphere<S>{R(0)}, {}}, unknown{Sphere<S>{R(1)}, {}},
        plane{HalfSpace<S>{at<S>(0, 1), R(0)}, {}};
    unknown.material = 99;
    BodyDef<S> heavy, nowhere;
    heavy.mass = R(-1);
    nowhere.pose.p[0] = kNan<S>;
    JointDef<S> rod;
    rod.type = JointType::Distance;
    rod.bodyA = s.a;
    rod.bodyB = s.b;
    rod.length = R(-1);
    JointDef<S> broken = rod;
    broken.length = R(1);
    broken.breakForce = R(0);
    JointDef<S> between = broken;
    between.bodyA = s.ground;
    between.bodyB = {};
    const Shape<S> ball = Sphere<S>{R(1)};
    return {{"shape_size", [=, &w] { w.addShape(s.a, flat); }},
            {"shape_material", [=, &w] { w.addShape(s.a, unknown); }},
            {"half_space_body", [=, &w] { w.addShape(s.a, plane); }},
            {"body_mass", [=, &w] { w.addBody(heavy); }},
            {"body_pose", [=, &w] { w.addBody(nowhere); }},
            {"joint_length", [=, &w] { w.addJoint(rod); }},
            {"joint_break", [=, &w] { w.addJoint(broken); }},
            {"joint_bodies", [=, &w] { w.addJoint(between); }},
            {"shape_size",
             [=, &w] {
                 addSolid<S>(w, {{ball}, {Sphere<S>{R(-1)}}});
             }},
            {"shape_material",
             [=, &w] {
                 addSolid<S>(w, {{ball}, {ball, R(1), 99}});
             }},
            {"half_space_body", [=, &w] {
                 addSolid<S>(w, {{HalfSpace<S>{at<S>(0, 1), R(0)}}});
             }}};
}

template <class S>
std::vector<Refused> badValues(Sleepers<S>& s) {
    using R = typename S::Real;
    using Vec = typename S::Vec;
    World<S>& w = s.world;
    const Vec nan = Vec::Constant(kNan<S>);
    const auto zero = zeroAng<S>();
    Pose<S> nowhere;
    nowhere.p = nan;
    Velocity<S> surface;
    surface.v = nan;
    JointAxis<R> stops;
    stops.mode = AxisMode::Limited;
    stops.lower = R(2);
    stops.upper = R(1);
    return {{"force", [=, &w] { w.applyForce(s.a, nan, zero); }},
            {"impulse", [=, &w] { w.applyImpulse(s.a, nan, zero); }},
            {"impulse", [=, &w] { w.applyImpulse(s.ground, Vec::Zero(), zero); }},
            {"body_velocity", [=, &w] { w.setVelocity(s.a, nan, zero); }},
            {"static_body", [=, &w] { w.setVelocity(s.ground, Vec::Zero(), zero); }},
            {"body_pose", [=, &w] { w.setPose(s.a, nowhere); }},
            {"body_mass",
             [=, &w] {
                 w.setMass(s.a, {R(-1), Vec::Zero(), isotropic<S>(1)});
             }},
            {"body_mass",
             [=, &w] {
                 w.setMass(s.ground, {R(1), Vec::Zero(), isotropic<S>(1)});
             }},
            {"body_mass", [=, &w] { w.setMassOfShapes(s.a, R(-1)); }},
            {"shape_density", [=, &w] { w.setDensity(s.shape, R(-1)); }},
            {"shape_material", [=, &w] { w.setMaterial(s.shape, 99); }},
            {"shape_surface_velocity", [=, &w] { w.setSurfaceVelocity(s.shape, surface); }},
            {"gravity", [=, &w] { w.setGravity(nan); }},
            {"body_gravity_scale", [=, &w] { w.setGravityScale(s.a, kNan<S>); }},
            {"joint_limits", [=, &w] { w.setJointAxis(s.joint, 0, stops); }},
            {"joint_motor", [=, &w] { w.setJointMotor(s.joint, 0, R(1), R(-1)); }},
            {"time_step", [=, &w] { w.step(R(0)); }}};
}

template <class S>
void expectRefused(Sleepers<S>& s, const std::vector<Refused>& calls) {
    const std::uint64_t before = s.world.stateHash();
    for (std::size_t i = 0; i < calls.size(); ++i) {
        EXPECT_EQ(refusal(calls[i].second), calls[i].first) << i;
        EXPECT_EQ(s.world.stateHash(), before) << i << ": " << calls[i].first;
        EXPECT_TRUE(s.world.isAsleep(s.a)) << i << ": " << calls[i].first;
    }
}

TYPED_TEST(RefusedCalls, LeaveASleepingWorldAsItWas) {
    using S = TypeParam;
    Sleepers<S> definitions, values;
    ASSERT_TRUE(definitions.world.isAsleep(definitions.a));
    expectRefused<S>(definitions, badDefinitions<S>(definitions));
    expectRefused<S>(values, badValues<S>(values));
}

TYPED_TEST(RefusedCalls, AJointOfBodiesAsleepIsNoneAndWakesThem) {
    using S = TypeParam;
    Sleepers<S> s;
    ASSERT_TRUE(s.world.isAsleep(s.a) && s.world.isAsleep(s.b));
    JointDef<S> rod;
    rod.type = JointType::Distance;
    rod.bodyA = s.a;
    rod.bodyB = s.b;
    rod.length = typename S::Real(2);
    EXPECT_TRUE(s.world.contains(s.world.addJoint(rod)));
    EXPECT_FALSE(s.world.isAsleep(s.a) || s.world.isAsleep(s.b));
}

/// Message of the EngineError that a call throws, or "none".
template <class Call>
std::string complaint(Call call) {
    try {
        call();
    } catch (const EngineError& e) {
        return e.what();
    }
    return "none";
}

TYPED_TEST(RefusedCalls, SayWhatWasFoundAndWhatIsExpected) {
    using S = TypeParam;
    using R = typename S::Real;
    const auto build = [](auto change) {
        return complaint([&] {
            WorldDef<S> def;
            change(def);
            World<S> world(def);
        });
    };
    EXPECT_EQ(build([](WorldDef<S>& def) { def.substeps = -3; }),
              "substeps: found -3, expected a number in 0..1000");
    EXPECT_EQ(build([](WorldDef<S>& def) { def.slop = R(2.5); }),
              "slop: found 2.5, expected a number in 0..1");
    EXPECT_EQ(complaint([] { WorldDef<S>::preset("quick"); }),
              "preset: found \"quick\", expected one of: accurate, default, fast");
    World<S> world{WorldDef<S>{}};
    EXPECT_EQ(complaint([&] { world.step(R(-0.5)); }),
              "time_step: found -0.500000, expected a finite number above 0 [s]");
}

}  // namespace
}  // namespace rigor::engine::test
