// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts as Box2D solves and reports them: each known trap has a test that fails without its workaround.
#include <algorithm>
#include <cmath>

#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

constexpr double kWeight = 9.81;

Scenario onGround(const Geometry& geometry, double height, double friction, double restitution) {
    Scenario s = scene(friction, restitution, 2);
    addStatic(s, HalfSpace{{0, 1, 0}, 0.0});
    addBody(s, geometry, {0, height, 0}, 1.0, even(0.1));
    return s;
}

/// Speed after over speed before the first impact of a disc dropped from 1 m, under an upward force too.
double bounceRatio(double restitution, double dt, const std::string& options, double lift = 0.0) {
    Simulation run(onGround(Sphere{0.5}, 1.5, 0.0, restitution), dt, options);
    for (int i = 0; i < static_cast<int>(2.0 / dt); ++i) {
        const double before = run.state(1).velocity.y;
        run.world->applyForce(1, {0, lift, 0}, {});
        run.steps(1);
        if (run.state(1).velocity.y > before + 0.5) return -run.state(1).velocity.y / before;
    }
    return -1.0;
}

TEST(Box2dRestitution, RatioIsExactlyThePairsCoefficientInMatched) {
    for (const double e : {0.3, 0.7, 1.0})
        for (const double dt : {1.0 / 60, 1.0 / 240})
            for (const double lift : {0.0, 4.0})
                EXPECT_NEAR(bounceRatio(e, dt, "preset=matched", lift), e, 2e-5) << e << " " << dt;
}

TEST(Box2dRestitution, UncorrectedItGainsWhatGravityAddsInTheStep) {
    const double dt = 1.0 / 60, v = 4.4;  // impact speed of the 1 m drop, to a step
    EXPECT_NEAR(bounceRatio(1.0, dt, "preset=matched,restitution=library"), 1.0 + kWeight * dt / v, 3e-3);
}

TEST(Box2dRestitution, NoVelocityThresholdInMatched) {
    for (const bool matched : {true, false}) {
        Scenario s = scene(0.0, 1.0, 2);
        s.gravity = {};
        addBody(s, Sphere{0.5}, {0, 0, 0}, 1.0, even(0.1));
        addBody(s, Sphere{0.5}, {1.0, 0, 0}, 1.0, even(0.1));
        s.bodies[0].velocity = {0.5, 0, 0};
        Simulation run(s, 1.0 / 240, matched ? "preset=matched" : "preset=matched,restitution_threshold=1");
        run.steps(5);
        EXPECT_NEAR(run.state(1).velocity.x, matched ? 0.5 : 0.25, 1e-5);
    }
}

/// The pair's value and not Box2D's max(e_a, e_b) and sqrt(mu_a mu_b).
TEST(Box2dReadBack, PairsAreWhatBox2dWillUse) {
    for (const char* options : {"", "preset=matched"}) {
        Scenario s = onGround(Sphere{0.5}, 1.0, 0.9, 0.9);
        s.materials.push_back({"other", 0.1, 0.1, 1000.0});
        s.pairs.push_back({0, 1, 0.25, 0.75});
        s.bodies[1].shapes[0].material = 1;
        const auto pairs = Simulation(s, 1.0 / 60, options).world->readBack().pairs;
        ASSERT_EQ(pairs.size(), 1u);
        EXPECT_NEAR(pairs[0].friction, 0.25, 1e-6) << options;
        EXPECT_NEAR(pairs[0].restitution, 0.75, 1e-6) << options;
    }
}

TEST(Box2dFriction, SlidingStopsWhereTheSchemeSays) {
    const double mu = 0.5, dt = 1.0 / 240;
    double expected = 0.0;
    for (double v = 4.0 - mu * kWeight * dt; v > 0.0; v -= mu * kWeight * dt) expected += v * dt;
    Scenario s = onGround(Box{{0.5, 0.25, 0}}, 0.25, mu, 0.0);
    s.bodies[1].velocity = {4, 0, 0};
    Simulation run(s, dt);
    run.seconds(1.5);
    EXPECT_NEAR(run.state(1).position.x, expected, 1e-4);
}

TEST(Box2dFriction, FeetOfOneBodyHaveTheirOwnMaterials) {
    Scenario s = onGround(Box{{0.1, 0.1, 0}}, 0.1, 0.0, 0.0);
    s.materials.push_back({"slippery", 0.0, 0.0, 1000.0});
    s.materials.push_back({"rough", 0.0, 0.0, 1000.0});
    s.pairs = {{0, 1, 0.0, 0.0}, {0, 2, 0.6, 0.0}};
    auto& shapes = s.bodies[1].shapes;
    shapes[0].pose.position = {-1, 0, 0};
    shapes[0].material = 1;
    shapes.push_back(shapeOf(Box{{0.1, 0.1, 0}}, 2, {{1, 0, 0}, {}}));
    s.bodies[1].velocity = {3, 0, 0};
    Simulation run(s, 1.0 / 240);
    run.steps(3);
    double normal[2] = {0, 0}, friction[2] = {0, 0};
    for (const auto& c : run.contacts()) {
        normal[c.shapeB] += c.normalImpulse;
        friction[c.shapeB] += c.frictionImpulse.x;
    }
    ASSERT_GT(normal[0], 0.0);
    ASSERT_GT(normal[1], 0.0);
    EXPECT_NEAR(friction[0], 0.0, 1e-7);
    EXPECT_NEAR(friction[1], -0.6 * normal[1], 1e-3 * normal[1]);
}

/// A slipping ball with the 3D inertia ends at 5/7 of its speed.
TEST(Box2dFriction, SlippingBallEndsWithFiveSevenths) {
    Scenario s = onGround(Sphere{0.5}, 0.5, 0.3, 0.0);
    s.bodies[1].massProperties.inertia = Mat3::diagonal(0.1, 0.1, sphereMoment(1.0, 0.5));
    s.bodies[1].velocity = {2, 0, 0};
    Simulation run(s, 1.0 / 240);
    run.seconds(1.5);
    EXPECT_NEAR(run.state(1).velocity.x, 2.0 * 5.0 / 7.0, 1e-3);
    EXPECT_NEAR(run.state(1).angularVelocity.z, -4.0 * 5.0 / 7.0, 2e-3);
}

ConvexHull triangle() {
    ConvexHull hull;
    hull.vertices = {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0, 0.6, 0}};
    return hull;
}

/// The library's skin holds a box 15 mm above the ground, a disc 5 mm.
TEST(Box2dSkin, ShapesRestOnTheirSurfacesInMatched) {
    const std::pair<Geometry, double> cases[] = {
        {Box{{0.5, 0.5, 0}}, 0.015}, {triangle(), 0.015}, {Sphere{0.5}, 0.005}, {Capsule{0.2, 0.3}, 0.005}};
    for (const auto& [geometry, gap] : cases) {
        Simulation matched(onGround(geometry, 0.5, 0.5, 0.0), 1.0 / 240);
        Simulation byDefault(onGround(geometry, 0.5, 0.5, 0.0), 1.0 / 240, "");
        matched.seconds(2);
        byDefault.seconds(2);
        EXPECT_NEAR(matched.state(1).position.y, 0.5, 1e-5);
        EXPECT_NEAR(byDefault.state(1).position.y, 0.5 + gap, 1e-3);
        double sum = 0.0;
        for (const auto& c : matched.contacts()) {
            EXPECT_NEAR(c.depth, 0.0, 1e-5);  // depth of the surfaces, not of the skins
            sum += c.normalImpulse;
        }
        EXPECT_NEAR(sum, kWeight / 240, 1e-4 * kWeight / 240);
    }
}

TEST(Box2dContacts, PointFromAToBWhicheverBodyComesFirst) {
    for (const char* options : {"", "preset=matched"})
        for (const bool discFirst : {true, false}) {
            Scenario s = scene(0.5, 0.0, 2);
            s.gravity = {};
            const auto addDisc = [&] { addBody(s, Sphere{0.5}, {0, 0.45, 0}, 1.0, even(0.1)); };
            if (discFirst) addDisc();
            addStatic(s, Box{{2, 0.5, 0}}, {0, -0.5, 0});
            if (!discFirst) addDisc();
            s.bodies[discFirst ? 0 : 1].velocity = {1, -2, 0};
            Simulation run(s, 1.0 / 240, options);
            EXPECT_TRUE(run.contacts().empty());
            run.steps(1);
            const auto contacts = run.contacts();
            ASSERT_EQ(contacts.size(), 1u);
            const ContactPoint& c = contacts[0];
            EXPECT_EQ(c.bodyA, 0);
            EXPECT_EQ(c.bodyB, 1);
            EXPECT_NEAR(norm(c.normal - Vec3{0, discFirst ? -1.0 : 1.0, 0}), 0.0, 1e-6);
            EXPECT_NEAR(c.depth, 0.05, 1e-6);  // depth at the pose the step began with
            EXPECT_NEAR(dot(c.pointA - c.pointB, c.normal), c.depth, 1e-6);
            EXPECT_NEAR((discFirst ? c.pointA : c.pointB).y, -0.05, 1e-6);
            EXPECT_NEAR(c.normalImpulse, 2.0, 1e-5);
            const double onDisc = discFirst ? -c.frictionImpulse.x : c.frictionImpulse.x;
            EXPECT_LT(onDisc, -0.05);
            EXPECT_NEAR(run.state(discFirst ? 0 : 1).velocity.x, 1.0 + onDisc, 1e-5);
        }
}

TEST(Box2dContacts, BeltDragsABoxToItsSpeed) {
    Scenario s = scene(0.5, 0.0, 2);
    addStatic(s, Box{{50, 0.5, 0}}, {0, -0.5, 0});
    s.bodies[0].type = BodyType::Kinematic;
    s.bodies[0].velocity = {1, 0, 0};
    addBody(s, Box{{0.5, 0.25, 0}}, {0, 0.25, 0}, 1.0, even(0.1));
    Simulation run(s, 1.0 / 240);
    run.seconds(0.1);
    EXPECT_NEAR(run.state(1).velocity.x, 0.5 * kWeight * 0.1, 1e-3);
    run.seconds(1);
    EXPECT_NEAR(run.state(1).velocity.x, 1.0, 1e-5);
}

TEST(Box2dContacts, SegmentsAreTwoSided) {
    for (const double side : {1.0, -1.0}) {
        Scenario s = scene(0.5, 0.0, 2);
        s.gravity = {0, -side * kWeight, 0};
        addStatic(s, scenario::Segment{{-3, 0, 0}, {3, 0, 0}});
        addBody(s, Box{{0.5, 0.5, 0}}, {0, side * 0.52, 0}, 1.0, even(1.0 / 6));
        Simulation run(s, 1.0 / 240);
        run.seconds(1);
        EXPECT_NEAR(run.state(1).position.y, side * 0.5, 2e-3);
    }
}

TEST(Box2dContacts, TiltedHalfPlaneIsWhereTheScenarioPutsIt) {
    const Vec3 normal{-0.6, 0.8, 0};
    Scenario s = scene(0.0, 0.0, 2);
    s.gravity = -kWeight * normal;
    addStatic(s, HalfSpace{{0, 1, 0}, 0.3}, {1, 2, 0});
    s.bodies[0].pose.orientation = scenario::fromAxisAngle({0, 0, 1}, std::atan2(0.6, 0.8));
    const Vec3 onPlane = s.bodies[0].pose * Vec3{0.4, 0.3, 0};
    addBody(s, Sphere{0.25}, onPlane + 0.27 * normal, 1.0, even(0.025));
    Simulation run(s, 1.0 / 240);
    run.seconds(1);
    EXPECT_NEAR(norm(run.state(1).position - (onPlane + 0.25 * normal)), 0.0, 1e-4);
    ASSERT_EQ(run.contacts().size(), 1u);
    EXPECT_NEAR(norm(run.contacts()[0].normal - normal), 0.0, 1e-5);
}

}  // namespace
}  // namespace rigor::test
