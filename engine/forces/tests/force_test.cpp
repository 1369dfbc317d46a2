// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Force elements against hand computations and conservation laws, through the world.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Forces : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Forces, Spaces);

template <class S>
BodyId addFree(World<S>& world, double x, double y, double mass = 1) {
    BodyDef<S> def;
    def.mass = static_cast<typename S::Real>(mass);
    def.inertia = isotropic<S>(0.5);
    def.pose.p = at<S>(x, y);
    return world.addBody(def);
}

TYPED_TEST(Forces, AForceWithABeginningAndAnEndGivesItsImpulseInEveryIntegrator) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& integrator : integratorTable<S>())
        for (const double h : {0.1, 0.05, 0.003}) {
            WorldDef<S> worldDef;
            worldDef.integrator = integrator.name;
            World<S> world(worldDef);
            const BodyId body = addFree<S>(world, 0, 0, 2);
            ConstantForce<S> force;
            force.body = body;
            force.force = at<S>(3, -1);
            force.torque = spin<S>(2);
            force.start = 0.137;
            force.end = 0.4711;
            world.addForce(force);
            while (world.time() < 0.6) world.step(static_cast<R>(h));
            const double T = force.end - force.start;
            EXPECT_NEAR(world.velocity(body)[0], 3 * T / 2, tol<S>(1e-13, 1e-5))
                << integrator.name << " " << h;
            EXPECT_NEAR(world.velocity(body)[1], -1 * T / 2, tol<S>(1e-13, 1e-5)) << integrator.name;
            EXPECT_NEAR(spinOf<S>(world.angularVelocity(body)), 2 * T / 0.5, tol<S>(1e-12, 1e-5));
            if (integrator.make().advance) {  // splits its steps at the edges: the path is exact as well
                const double after = world.time() - force.end;
                EXPECT_NEAR(world.pose(body).p[0], 1.5 * T * (T / 2 + after), tol<S>(1e-13, 1e-5))
                    << integrator.name << " " << h;
            }
        }
}

TYPED_TEST(Forces, SpringAgainstAHandComputation) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world{euler<S>()};
    const BodyId a = addFree<S>(world, 0, 0);
    BodyDef<S> def;
    def.mass = 1;
    def.inertia = isotropic<S>(0.5);
    def.centerOfMass = at<S>(0, 0.1);
    def.pose.p = at<S>(3, 0.75);
    def.velocity = at<S>(0.5, 7);
    def.angularVelocity = spin<S>(2);
    const BodyId b = world.addBody(def);
    LinearSpring<S> spring;
    spring.bodyA = a;
    spring.bodyB = b;
    spring.anchorA = at<S>(0, 0.5);
    spring.anchorB = at<S>(0, -0.25);  // both anchors are at height 0.5, 3 apart
    spring.stiffness = 10;
    spring.damping = 2;
    spring.restLength = 1;
    world.addForce(spring);
    // The anchor of B moves with v + w x (0, -0.35): 0.5 + 2 * 0.35 along x.
    const double tension = 10.0 * (3 - 1) + 2.0 * (0.5 + 2 * 0.35);
    const double h = 1.0 / 1024;
    world.step(static_cast<R>(h));
    EXPECT_NEAR(world.velocity(b)[0], 0.5 - h * tension, tol<S>(1e-14, 1e-6));
    EXPECT_NEAR(world.velocity(a)[0], h * tension, tol<S>(1e-14, 1e-6));
    EXPECT_NEAR(spinOf<S>(world.angularVelocity(a)), h * -0.5 * tension / 0.5, tol<S>(1e-14, 1e-6));
    EXPECT_NEAR(spinOf<S>(world.angularVelocity(b)), 2 + h * -0.35 * tension / 0.5, tol<S>(1e-14, 1e-6));
}

TYPED_TEST(Forces, QuadraticDragSlowsABodyAsOneOverTime) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldDef<S> def;
    def.integrator = "rk4";
    World<S> world(def);
    const BodyId body = addFree<S>(world, 0, 0, 2);
    world.setVelocity(body, at<S>(3, 4), spin<S>(0));
    world.addForce(QuadraticDrag<S>{body, R(0.6)});
    for (int k = 0; k < 128; ++k) world.step(R(1.0 / 128));
    // v' = -(c/m) v^2: v = v0/(1 + c v0 t/m), along the start.
    const double speed = 5 / (1 + 0.3 * 5);
    EXPECT_NEAR(world.velocity(body)[0], 0.6 * speed, tol<S>(1e-8, 1e-5));
    EXPECT_NEAR(world.velocity(body)[1], 0.8 * speed, tol<S>(1e-8, 1e-5));
    EXPECT_NEAR(world.pose(body).p[0], 0.6 * std::log(1 + 0.3 * 5) / 0.3, tol<S>(1e-8, 1e-5));
}

TYPED_TEST(Forces, CoincidentAnchorsPullNowhere) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& integrator : integratorTable<S>()) {
        WorldDef<S> def;
        def.integrator = integrator.name;
        World<S> world(def);
        LinearSpring<S> spring;
        spring.bodyB = addFree<S>(world, 0, 0);
        spring.stiffness = 10;
        spring.damping = 1;
        spring.restLength = 1;
        world.addForce(spring);
        EXPECT_FALSE(world.step(R(0.01)).nonFinite);
        EXPECT_EQ(world.velocity(spring.bodyB).norm(), R(0));
    }
}

TYPED_TEST(Forces, SpringsBetweenBodiesKeepBothMomentaInEveryIntegrator) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& integrator : integratorTable<S>()) {
        WorldDef<S> def;
        def.integrator = integrator.name;
        World<S> world(def);
        const BodyId a = addFree<S>(world, 0, 0, 1), b = addFree<S>(world, 2, 0.5, 3);
        LinearSpring<S> spring;
        spring.bodyA = a;
        spring.bodyB = b;
        spring.anchorA = at<S>(0.2, 0.3);
        spring.anchorB = at<S>(-0.1, 0.4);
        spring.stiffness = 20;
        spring.damping = R(0.5);
        spring.restLength = 1;
        world.addForce(spring);
        for (int i = 0; i < 256; ++i) world.step(R(1.0 / 256));
        const typename S::Vec P = world.velocity(a) * R(1) + world.velocity(b) * R(3);
        EXPECT_GT(world.velocity(a).norm(), R(0.1)) << "something moves";
        EXPECT_NEAR(P.norm(), 0, tol<S>(1e-13, 1e-4)) << integrator.name;
        double L = 0;
        for (const auto& [id, m] : {std::pair{a, 1.0}, std::pair{b, 3.0}}) {
            const auto p = world.pose(id).p;
            const auto v = world.velocity(id);
            L += m * (double(p[0]) * double(v[1]) - double(p[1]) * double(v[0])) +
                 0.5 * spinOf<S>(world.angularVelocity(id));
        }
        // Kept exactly where forces and positions belong to the same moment; else to the order of the scheme.
        const std::string name = integrator.name;
        const double bound = name == "explicit_euler" ? 0.1 : name == "rk4" ? 1e-6 : tol<S>(1e-12, 1e-4);
        EXPECT_NEAR(L, 0, std::max(bound, tol<S>(0, 1e-4))) << name;
    }
}

TYPED_TEST(Forces, BadOnesAreRefusedByName) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world{WorldDef<S>{}};
    const BodyId body = addFree<S>(world, 0, 0), ground = addGround<S>(world, 0);
    const auto refused = [&](const ForceDef<S>& def) -> std::string {
        try {
            world.addForce(def);
        } catch (const EngineError& error) {
            return error.id();
        }
        return "";
    };
    const R nan = std::numeric_limits<R>::quiet_NaN();
    EXPECT_EQ(refused(LinearDrag<S>{body, R(-1)}), "drag_coefficient");
    EXPECT_EQ(refused(LinearDrag<S>{body, nan}), "drag_coefficient");
    EXPECT_EQ(refused(QuadraticDrag<S>{body, R(-1)}), "drag_coefficient");
    EXPECT_EQ(refused(LinearDrag<S>{ground, R(1)}), "force_body");
    EXPECT_EQ(refused(LinearDrag<S>{BodyId{}, R(1)}), "force_body");
    EXPECT_EQ(refused(LinearDrag<S>{BodyId{77, 0}, R(1)}), "stale_handle");
    ConstantForce<S> force;
    force.body = body;
    force.force = at<S>(nan, 0);
    EXPECT_EQ(refused(force), "force");
    force.force = at<S>(1, 0);
    force.start = 2;
    force.end = 1;
    EXPECT_EQ(refused(force), "force_time");
    LinearSpring<S> spring;
    spring.bodyA = ground;
    EXPECT_EQ(refused(spring), "force_body") << "neither end moves";
    spring.bodyB = body;
    spring.stiffness = R(-1);
    EXPECT_EQ(refused(spring), "spring");
    spring.stiffness = 1;
    spring.bodyA = body;
    EXPECT_EQ(refused(spring), "force_body") << "both ends on one body";
    spring.bodyA = ground;
    spring.anchorB = at<S>(nan, 0);
    EXPECT_EQ(refused(spring), "force_anchor");
}

TYPED_TEST(Forces, LeaveWithTheirBodiesAndByName) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world{WorldDef<S>{}};
    const BodyId a = addFree<S>(world, 0, 0), b = addFree<S>(world, 2, 0), c = addFree<S>(world, 5, 0);
    const auto push = [&](BodyId body, double f) {
        ConstantForce<S> force;
        force.body = body;
        force.force = at<S>(f, 0);
        return world.addForce(force);
    };
    const ForceId onA = push(a, 1), onB = push(b, 2), onC = push(c, 4), more = push(c, 8);
    world.removeBody(a);  // c takes its place
    EXPECT_FALSE(world.contains(onA));
    world.removeForce(onC);
    EXPECT_TRUE(world.contains(onB));
    EXPECT_TRUE(world.contains(more));
    EXPECT_FALSE(world.contains(onC));
    world.step(R(0.5));
    EXPECT_EQ(world.velocity(b)[0], R(1));
    EXPECT_EQ(world.velocity(c)[0], R(4));
}

}  // namespace
}  // namespace rigor::engine::test
