// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Impacts of bodies in flight at their own times, with steps from midpoint to midpoint.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class FlightImpact : public testing::Test {};
using FlightSpaces = testing::Types<Space2d, Space3d>;
TYPED_TEST_SUITE(FlightImpact, FlightSpaces);

/// A rod turns about its end and strikes a ball at rest: when its line is as far from the ball as their radii together.
/// The ball leaves with (1 + e) times the speed of the rod there. At every step size, wherever in the step that is.
TYPED_TEST(FlightImpact, ATurningRodStrikesABallWhenItReachesIt) {
    using S = TypeParam;
    using R = typename S::Real;
    constexpr double w = 10, x = 0.7, y = 0.5, apart = 0.15, e = 0.5;
    const double reach = std::hypot(x, y), when = (std::atan2(y, x) - std::asin(apart / reach)) / w;
    const double speed = (1 + e) * w * std::sqrt(reach * reach - apart * apart);
    for (int rate = 50; rate < 130; ++rate) {
        WorldDef<S> def;
        def.integrator = "moreau_midpoint";
        World<S> world(def);
        const std::uint32_t stuff = world.addMaterial(0, R(e));
        BodyDef<S> turning;
        turning.type = BodyType::Kinematic;
        turning.angularVelocity = spin<S>(w);
        ShapeDef<S> rod;
        rod.shape = Capsule<S>{R(0.05), R(0.5)};
        rod.pose.p = at<S>(0.5, 0);
        rod.pose.q = expMap(spin<S>(-std::numbers::pi / 2));
        rod.material = stuff;
        world.addShape(world.addBody(turning), rod);
        const BodyId ball = addBall<S>(world, x, y, 0.1, 0.5, stuff);
        std::vector<double> times;
        for (int i = 0; i * (1.0 / rate) < 0.06; ++i)
            for (const ImpactEvent<S>& impact : world.step(R(1.0 / rate)).impacts)
                times.push_back(i * (1.0 / rate) + double(impact.time));
        ASSERT_EQ(times.size(), 1u) << rate;
        EXPECT_NEAR(times[0], when, 1e-9) << rate;
        EXPECT_NEAR(world.velocity(ball).norm(), speed, 1e-7) << rate;
    }
}

/// Sum of the impulses of the contacts that are shown: along their normals, and of friction [N s].
template <class S>
struct Shown {
    std::vector<ContactView<S>> contacts;
    double normal = 0, friction = 0;

    explicit Shown(const World<S>& world) {
        world.readContacts(contacts);
        for (const ContactView<S>& contact : contacts) {
            normal += double(contact.normalImpulse);
            friction += double(contact.frictionImpulse.norm());
        }
    }
};

/// A ball that bounces while it slips. The step in which it does shows one contact: with the impulse (1 + e) m v and
/// mu times it as friction, at the closest points of ball and floor at the end of the step.
TYPED_TEST(FlightImpact, ABounceIsShownAsAContact) {
    using S = TypeParam;
    using R = typename S::Real;
    constexpr double radius = 0.2, mass = 0.7, e = 0.6, mu = 0.1, down = 3, height = 0.53, h = 1.0 / 60;
    WorldDef<S> def = earth<S>();
    def.integrator = "moreau_midpoint";
    World<S> world(def);
    const std::uint32_t stuff = world.addMaterial(R(mu), R(e));
    addGround<S>(world, stuff);
    const BodyId ball = addBall<S>(world, 0, height, radius, mass, stuff);
    world.setVelocity(ball, at<S>(5, -down), spin<S>(0));
    const double speed = std::sqrt(down * down + 2 * kGravity * (height - radius));
    int bounces = 0;
    for (int i = 0; i < 12; ++i) {
        const bool isHit = !world.step(R(h)).impacts.empty();
        const Shown<S> shown(world);
        ASSERT_EQ(shown.contacts.size(), isHit ? 1u : 0u) << i;
        if (!isHit) continue;
        ++bounces;
        const ContactView<S>& contact = shown.contacts[0];
        EXPECT_NEAR(shown.normal, (1 + e) * mass * speed, 1e-9);
        EXPECT_NEAR(shown.friction, mu * shown.normal, 1e-9);
        EXPECT_LT(contact.frictionImpulse.x(), 0) << "against the slip";
        EXPECT_NEAR(contact.separation, world.pose(ball).p.y() - radius, 1e-12);
        EXPECT_NEAR(contact.pointB.x(), world.pose(ball).p.x(), 1e-12);
        EXPECT_GT(contact.separation, 0) << "it has left the floor";
    }
    EXPECT_EQ(bounces, 1);
}

/// A ball that lands and stays has the impulse of the impact and that of the rest of the step at one contact.
TYPED_TEST(FlightImpact, ALandingIsShownOnce) {
    using S = TypeParam;
    using R = typename S::Real;
    constexpr double radius = 0.2, mass = 0.7, down = 3, height = 0.53, h = 1.0 / 60;
    WorldDef<S> def = earth<S>();
    def.integrator = "moreau_midpoint";
    World<S> world(def);
    addGround<S>(world, world.addMaterial(0, 0));
    const BodyId ball = addBall<S>(world, 0, height, radius, mass, 0);
    world.setVelocity(ball, at<S>(0, -down), spin<S>(0));
    for (int i = 0; i < 12; ++i) {
        const double before = double(world.velocity(ball).y());
        const bool isHit = !world.step(R(h)).impacts.empty();
        const Shown<S> shown(world);
        const double gained = double(world.velocity(ball).y()) - before + kGravity * h;
        EXPECT_NEAR(shown.normal, mass * gained, 1e-9)
            << i << ": what the contacts give is what the ball gets";
        if (isHit) {
            EXPECT_EQ(shown.contacts.size(), 1u);
        }
    }
    EXPECT_NEAR(world.velocity(ball).norm(), 0, 1e-9);
}

/// Bricks that fall on the ground at 8 m/s and turn fast, in all orientations, without restitution. One that lands on a
/// corner turns about it by up to half a radian in the rest of the step, and collides at the corners that come down next.
TYPED_TEST(FlightImpact, ABrickThatTurnsAboutACornerDoesNotSinkIn) {
    using S = TypeParam;
    using R = typename S::Real;
    typename S::Vec half = at<S>(0.25, 0.125), wide = at<S>(50, 0.5);
    if constexpr (S::dim == 3) {
        half.z() = R(0.125);
        wide.z() = R(50);
    }
    const Shape<S> brick = Box<S>{half}, ground = Box<S>{wide};
    double deepest = 0;
    for (int k = 0; k < 60; ++k) {
        World<S> world(WorldDef<S>{});
        const std::uint32_t stuff = world.addMaterial(R(0.6), 0);
        BodyDef<S> floor;
        floor.type = BodyType::Static;
        floor.pose.p = at<S>(0, -0.5);
        world.addShape(world.addBody(floor), {ground, {}, stuff});
        const MassProperties<S> m = massProperties<S>(brick, R(2000));
        BodyDef<S> body;
        body.mass = m.mass;
        body.inertia = m.inertia;
        body.pose.p = at<S>(0, 0.6 + 0.002 * k);
        body.velocity = at<S>(2, -8);
        if constexpr (S::dim == 3) {
            body.pose.q = expMap(typename S::Vec(R(0.3 * k), R(0.17 * k), R(-0.11 * k)));
            body.angularVelocity =
                typename S::Vec(R(8 * std::sin(k)), R(8 * std::cos(2 * k)), R(8 * std::cos(k)));
        } else {
            body.pose.q = expMap(R(0.3 * k));
            body.angularVelocity = R(10 * std::sin(k));
        }
        const BodyId id = world.addBody(body);
        world.addShape(id, {brick, {}, stuff});
        for (int step = 0; step < 12; ++step) {
            world.step(R(1) / 60);
            const Pose<S> under{at<S>(0, -0.5), Pose<S>::identityRot()};
            deepest =
                std::max(deepest, -double(closestPoints<S>(ground, under, brick, world.pose(id)).distance));
        }
    }
    EXPECT_LT(deepest, S::dim == 2 ? 0.04 : 0.02);
}

/// A ball flies at a cube that rests on ice, which is not in flight. Wherever in a step they meet, and where a step stops
/// the ball at a gap that it would close in the next one, what one of them loses the other one gets.
TYPED_TEST(FlightImpact, MomentumGoesToABodyThatRests) {
    using S = TypeParam;
    using R = typename S::Real;
    constexpr double speed = 5, radius = 0.2, half = 0.25, ballMass = 2, cubeMass = 3, apart = 0.31;
    for (const double e : {0.0, 0.5})
        for (int rate = 50; rate < 90; ++rate) {
            WorldDef<S> def = earth<S>();
            def.integrator = "moreau_midpoint";
            World<S> world(def);
            const std::uint32_t stuff = world.addMaterial(0, R(e));
            addGround<S>(world, world.addMaterial(0, 0));
            const BodyId cube = addCube<S>(world, 0, half, half, cubeMass, stuff);
            const BodyId ball = addBall<S>(world, -half - radius - apart, half, radius, ballMass, stuff);
            for (int i = 0; i < 10; ++i) world.step(R(1e-3));  // the cube comes to rest
            world.setVelocity(ball, at<S>(speed, 0.4), spin<S>(0));
            for (int i = 0; i * (1.0 / rate) < 0.12; ++i) {
                world.step(R(1.0 / rate));
                const double momentum =
                    ballMass * double(world.velocity(ball)[0]) + cubeMass * double(world.velocity(cube)[0]);
                ASSERT_NEAR(momentum, ballMass * speed, 1e-11) << rate << ' ' << e;
            }
        }
}

}  // namespace
}  // namespace rigor::engine::test
