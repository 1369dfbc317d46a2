// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies that touch: resting, sides of the normal, impulses, momentum, coefficients per pair, filters.
#include <algorithm>
#include <cmath>

#include "adapters/conformance/kit.hpp"

namespace rigor::conformance {
namespace {

class Contact : public DynamicsTest {
  protected:
    void SetUp() override {
        if (!hasShape("box") || !hasShape(is2d() ? "circle" : "sphere"))
            GTEST_SKIP() << "no boxes and balls to touch";
    }
    const char* halfSpaceName() const { return is2d() ? "half_plane" : "half_space"; }
    /// A ground whose surface is y = 0: a half-space where there is one, else a large block.
    int addGround(Scenario& s) const {
        if (hasShape(halfSpaceName())) return addStatic(s, scenario::HalfSpace{});
        return addStatic(s, block({20, 1, 20}), {0, -1, 0});
    }
    int addCube(Scenario& s, const Vec3& position) const {
        return addBody(s, block({0.5, 0.5, 0.5}), position, 2.0, boxMoments(2.0, {0.5, 0.5, 0.5}));
    }
};
INSTANTIATE_TEST_SUITE_P(Kit, Contact, testing::ValuesIn(dynamicsArenas()), arenaName);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Contact);

TEST_P(Contact, ABoxRestsOnTheGroundWhereItWasPut) {
    for (const bool onBlock : {false, true}) {
        SCOPED_TRACE(onBlock ? "on a block" : "on a half-space");
        Scenario s = scene(0.5);
        s.gravity = {0, -9.81, 0};
        if (onBlock)
            addStatic(s, block({5, 1, 5}), {0, -1, 0});
        else
            addGround(s);
        const int cube = addCube(s, flat({0.3, 0.5, 0.2}));
        auto world = build(s, 1.0 / 120.0);
        run(*world, 240);
        const BodyState state = stateOf(*world, s, cube);
        within("rest_height", std::abs(state.position.y - 0.5), 1e-4);
        within("rest_creep", norm(flat({state.position.x - 0.3, 0.0, state.position.z - 0.2})), 1e-4);
        within("rest_speed", norm(state.velocity) + norm(state.angularVelocity), 1e-3);
        within("rest_tilt", angleBetween(state.orientation, Quat{}), 1e-3);
    }
}

TEST_P(Contact, NormalsPointFromTheLowerIndexWhateverWasBuiltFirst) {
    for (const bool groundFirst : {true, false}) {
        SCOPED_TRACE(groundFirst ? "ground first" : "box first");
        Scenario s = scene(0.5);
        s.gravity = {0, -9.81, 0};
        if (groundFirst) addGround(s);
        const int cube = addCube(s, {0, 0.4999, 0});
        if (!groundFirst) addGround(s);
        const double dt = 1.0 / 120.0;
        auto world = build(s, dt);
        run(*world, 48);  // shorter than the time before any engine lets a body sleep
        const auto contacts = contactsOf(*world);
        ASSERT_FALSE(contacts.empty());
        double pushed = 0.0;
        for (const ContactPoint& c : contacts) {
            EXPECT_EQ(c.bodyA, 0);
            EXPECT_EQ(c.bodyB, 1);
            const Vec3 up{0, groundFirst ? 1.0 : -1.0, 0};
            EXPECT_LE(norm(c.normal - up), 1e-3);
            // The points are depth apart along the normal, on the two surfaces.
            EXPECT_NEAR(dot(c.pointA - c.pointB, c.normal), c.depth, tol(1e-9, 1e-5));
            within("contact_points_aside", norm(c.pointA - c.pointB - c.depth * c.normal), tol(1e-9, 1e-5));
            const Vec3 onGround = groundFirst ? c.pointA : c.pointB,
                       onCube = groundFirst ? c.pointB : c.pointA;
            within("contact_on_ground", std::abs(onGround.y), 1e-3);
            const double bottom = stateOf(*world, s, cube).position.y - 0.5;
            within("contact_on_box", std::abs(onCube.y - bottom), 1e-3);
            within("contact_within_face", std::max(0.0, std::abs(onCube.x) - 0.5), 2e-3);
            if (c.hasImpulse) {
                EXPECT_GE(c.normalImpulse, 0.0);
                pushed += c.normalImpulse;
            }
        }
        EXPECT_EQ(engine().capabilities().contactImpulses, contacts.front().hasImpulse);
        if (engine().capabilities().contactImpulses)
            within("weight_carried", std::abs(pushed / (2.0 * 9.81 * dt) - 1.0), 2e-2);
    }
}

TEST_P(Contact, ContactsTellTheOverlapAtTheirInstant) {
    Scenario s = scene();
    addBody(s, ball(0.5), flat({0.1, 0.2, 0.3}));
    const Vec3 along = is2d() ? Vec3{0.6, 0.8, 0.0} : Vec3{2.0, 3.0, 6.0} / 7.0;
    addBody(s, ball(0.25), flat({0.1, 0.2, 0.3}) + 0.74 * along);
    auto world = build(s, 1e-3);
    const auto placeOf = [&](int ball) { return stateOf(*world, s, ball).position; };
    Vec3 a = placeOf(0), b = placeOf(1);
    world->step();
    if (world->contactInstant() == adapter::ContactInstant::StepEnd) {
        a = placeOf(0);
        b = placeOf(1);
    }
    const auto contacts = contactsOf(*world);
    within("ball_found", contacts.size() == 1 ? 0.0 : 1.0, 0.0);
    if (contacts.empty()) return;
    const ContactPoint& c = contacts.front();
    within("ball_depth", std::abs(c.depth - (0.75 - norm(b - a))), tol(1e-9, 1e-5));
    within("ball_normal", norm(c.normal - along), tol(1e-7, 1e-4));
    within("ball_point_a", norm(c.pointA - (a + 0.5 * along)), tol(1e-9, 1e-5));
    within("ball_point_b", norm(c.pointB - (b - 0.25 * along)), tol(1e-9, 1e-5));
}

TEST_P(Contact, CollisionsConserveMomentumAndRestitutionIsThatOfThePair) {
    for (const double e : {0.0, 0.5, 1.0}) {
        SCOPED_TRACE("restitution " + std::to_string(e));
        Scenario s = scene(0.0, 0.7);
        s.materials.push_back({"other", 0.0, 0.9, 1000.0});
        s.pairs.push_back({0, 1, 0.0, e});
        addBody(s, ball(0.5), {-1.0, 0, 0}, 1.0, {0.1, 0.1, 0.1});
        addBody(s, ball(0.5), {1.0, 0, 0}, 3.0, {0.3, 0.3, 0.3});
        s.bodies[1].shapes[0].material = 1;
        s.bodies[0].velocity = {4.0, 0, 0};
        s.bodies[1].velocity = {-1.0, 0, 0};
        auto world = build(s, 1.0 / 240.0);
        run(*world, 120);
        const double v0 = stateOf(*world, s, 0).velocity.x, v1 = stateOf(*world, s, 1).velocity.x;
        EXPECT_LT(v0, 1.0) << "the balls met";
        within("collision_momentum", std::abs(v0 + 3.0 * v1 - 1.0), tol(1e-11, 1e-5));
        if (matched()) within("pair_restitution", std::abs((v1 - v0) / 5.0 - e), 5e-3);
    }
}

TEST_P(Contact, FrictionIsThatOfThePair) {
    const std::vector<double> angles =
        is2d() || !matched() ? std::vector<double>{0.0} : std::vector<double>{0.0, kPi / 4, 2.0};
    for (const double angle : angles)
        for (const double mu : {0.25, 0.5}) {
            SCOPED_TRACE("angle " + std::to_string(angle) + ", friction " + std::to_string(mu));
            Scenario s = scene(0.9);
            s.gravity = {0, -9.81, 0};
            s.materials.push_back({"other", 0.1, 0.0, 1000.0});
            s.pairs.push_back({1, 0, mu, 0.0});
            addStatic(s, block({20, 1, 20}), {0, -1, 0});
            // Flat, so that the drag at its foot hardly tips it.
            const int slider =
                addBody(s, block({0.5, 0.1, 0.5}), {0, 0.1, 0}, 2.0, boxMoments(2.0, {0.5, 0.1, 0.5}));
            s.bodies.back().shapes[0].material = 1;
            const Vec3 direction{std::cos(angle), 0.0, std::sin(angle)};
            s.bodies.back().velocity = 3.0 * direction;
            auto world = build(s, 1.0 / 240.0);
            run(*world, 480);
            const BodyState state = stateOf(*world, s, slider);
            const double expected = 9.0 / (2.0 * mu * 9.81);
            within("pair_friction", std::abs(dot(state.position, direction) / expected - 1.0), 2e-2);
            const double aside = norm(cross(Vec3{state.position.x, 0, state.position.z}, direction));
            within("friction_straight", aside / expected, 2e-2);
            within("friction_stops", norm(state.velocity), 2e-2);
        }
}

TEST_P(Contact, ShapesStandTheWayTheScenarioSays) {
    using namespace scenario;
    struct SurfaceSample {
        const char* name;
        Geometry geometry;
        Quat orientation;
        double x, height;  ///< a sphere of radius 0.1 placed at x touches the surface at this height
    };
    const Quat lying = fromAxisAngle({0, 0, 1}, kPi / 2), upsideDown = fromAxisAngle({0, 0, 1}, kPi);
    std::vector<SurfaceSample> samples{{"capsule", Capsule{0.2, 0.6}, {}, 0.0, 0.8},
                                       {"capsule", Capsule{0.2, 0.6}, lying, 0.5, 0.2},
                                       {"box", block({0.2, 0.7, 0.3}), {}, 0.0, 0.7},
                                       {"box", block({0.2, 0.7, 0.3}), lying, 0.5, 0.2}};
    if (is2d()) {
        samples.push_back({"polygon",
                           ConvexHull{{{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.3, 0}, {-0.5, 0.3, 0}}},
                           {},
                           0.4,
                           0.3});
    } else {
        ConvexHull wedge;
        for (const double z : {-0.4, 0.4})
            for (const Vec3 v :
                 {Vec3{-0.5, -0.5, 0}, Vec3{0.5, -0.5, 0}, Vec3{0.5, 0.3, 0}, Vec3{-0.5, 0.3, 0}})
                wedge.vertices.push_back({v.x, v.y, z});
        samples.push_back({"hull", wedge, {}, 0.4, 0.3});
        samples.push_back({"cylinder", Cylinder{0.3, 0.6}, {}, 0.2, 0.6});
        samples.push_back({"cylinder", Cylinder{0.2, 0.6}, lying, 0.5, 0.2});
        samples.push_back({"cone", Cone{0.4, 0.5}, upsideDown, 0.2, 0.5});
    }
    for (const SurfaceSample& sample : samples) {
        if (!hasShape(sample.name)) continue;
        SCOPED_TRACE(std::string(sample.name) + " at height " + std::to_string(sample.height));
        Scenario s = scene(1.0);
        s.gravity = {0, -9.81, 0};
        addStatic(s, sample.geometry, {}, sample.orientation);
        const int b =
            addBody(s, ball(0.1), {sample.x, sample.height + 0.15, 0.0}, 1.0, {0.004, 0.004, 0.004});
        auto world = build(s, 1.0 / 240.0);
        run(*world, 96);
        // It falls 0.05 m; falling freely it would be 0.78 m lower.
        within(std::string("perch_") + sample.name,
               std::abs(stateOf(*world, s, b).position.y - sample.height - 0.1), 5e-3);
    }
}

/// Whichever way their vertices run. A body stands over an inner vertex and over the middle of a link.
TEST_P(Contact, SegmentsAndChainsBearFromBothSides) {
    if (!is2d()) GTEST_SKIP() << "lines are 2D shapes";
    using namespace scenario;
    const std::vector<Vec3> leftToRight{{-2, 0, 0}, {-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    for (const bool turned : {false, true})
        for (const double side : {1.0, -1.0}) {
            auto vertices = leftToRight;
            if (turned) std::reverse(vertices.begin(), vertices.end());
            for (const auto& [name, line] :
                 {std::pair<std::string, Geometry>{"chain", Chain{vertices, false}},
                  std::pair<std::string, Geometry>{"segment", Segment{vertices.front(), vertices.back()}}}) {
                if (!hasShape(name)) continue;
                SCOPED_TRACE(name + (turned ? ", turned" : "") + (side > 0 ? ", above" : ", below"));
                Scenario s = scene(0.5);
                s.gravity = {0, -9.81 * side, 0};
                addStatic(s, line);
                const int disc = addBody(s, ball(0.2), {-0.95, 0.22 * side, 0}, 1.0, {0.02, 0.02, 0.02});
                const int box = addBody(s, block({0.3, 0.2, 0.3}), {0.55, 0.22 * side, 0}, 1.0,
                                        boxMoments(1.0, {0.3, 0.2, 0.3}));
                auto world = build(s, 1.0 / 240.0);
                run(*world, 240);
                for (const int body : {disc, box}) {
                    const BodyState state = stateOf(*world, s, body);
                    within("line_height_" + std::string(body == box ? "box" : "circle"),
                           std::abs(state.position.y - 0.2 * side), 2e-3);
                    within("line_creep", std::abs(state.position.x - (body == box ? 0.55 : -0.95)), 2e-3);
                }
                // The normal points from the line to the body.
                for (const ContactPoint& c : contactsOf(*world))
                    within("line_normal", norm(c.normal - Vec3{0, side, 0}), 1e-3);
            }
        }
}

TEST_P(Contact, WhatMayNotCollideDoesNot) {
    Scenario s = scene();
    s.gravity = {0, -9.81, 0};
    addGround(s);
    const int ghost = addBody(s, ball(0.5), {0, 0.5, 0});
    s.bodies.back().collides = false;
    const int solid = addBody(s, ball(0.5), {3, 0.5, 0});
    auto world = build(s, 0.01);
    run(*world, 50);
    EXPECT_LT(stateOf(*world, s, ghost).position.y, -0.5);
    EXPECT_GT(stateOf(*world, s, solid).position.y, 0.4);
    for (const ContactPoint& c : contactsOf(*world)) EXPECT_NE(c.bodyB, ghost);
}

TEST_P(Contact, LayersAndGroupsDecideWhatCollides) {
    if (!engine().capabilities().contactFilters) GTEST_SKIP() << "no layers";
    // The cases: a mask without the other's layer on either side, layers that both want, a group that never collides,
    // another group, a group that always does, and the last of the bits.
    struct Case {
        scenario::ContactFilter ground, body;
        bool held;
    };
    const std::uint32_t all = scenario::kAllLayers;
    for (const Case& c : {Case{{1, all, 0}, {2, 2, 0}, false}, Case{{1, 1, 0}, {2, all, 0}, false},
                          Case{{1, 2, 0}, {2, 1, 0}, true}, Case{{1, all, -3}, {1, all, -3}, false},
                          Case{{1, all, -3}, {1, all, -4}, true}, Case{{1, 0, 5}, {2, 0, 5}, true},
                          Case{{1U << 15U, 2, 0}, {2, 1U << 15U, 0}, true}}) {
        Scenario s = scene();
        s.gravity = {0, -9.81, 0};
        addGround(s);
        s.bodies[0].shapes[0].filter = c.ground;
        const int body = addBody(s, ball(0.5), {0, 0.5, 0});
        s.bodies[body].shapes[0].filter = c.body;
        auto world = build(s, 0.01);
        run(*world, 50);
        EXPECT_EQ(stateOf(*world, s, body).position.y > 0.4, c.held);
        EXPECT_EQ(!contactsOf(*world).empty(), c.held);
        if (!c.held) {
            EXPECT_LT(stateOf(*world, s, body).position.y, -0.5);
        }
    }
}

TEST_P(Contact, EachShapeOfABodyHasItsOwnLayers) {
    if (!engine().capabilities().shapeFilters) GTEST_SKIP() << "no layers of shapes";
    // A ball on another, of which the ground holds only one; the ground alone and as one of two shapes.
    for (const bool lowerIsHeld : {false, true})
        for (const bool groundOfTwo : {false, true}) {
            Scenario s = scene();
            s.gravity = {0, -9.81, 0};
            addGround(s);
            if (groundOfTwo) s.bodies[0].shapes.push_back({ball(0.1), {{50, 0, 0}, {}}, 0});
            const int body = addBody(s, ball(0.5), {0, 1.5, 0});
            s.bodies[body].shapes[0].pose.position.y = -1.0;
            s.bodies[body].shapes.push_back({ball(0.5), {}, 0});
            s.bodies[body].shapes[lowerIsHeld ? 1 : 0].filter = {2, 2, 0};
            auto world = build(s, 0.01);
            run(*world, 100);
            within("filtered_shape_height",
                   std::abs(stateOf(*world, s, body).position.y - (lowerIsHeld ? 1.5 : 0.5)), 2e-2);
            for (const ContactPoint& c : contactsOf(*world)) EXPECT_EQ(c.shapeB, lowerIsHeld ? 0 : 1);
        }
}

TEST_P(Contact, JointedBodiesCollideOnlyWhenTheJointSaysSo) {
    if (!hasJoint("hinge")) GTEST_SKIP() << "no hinge";
    for (const bool collide : {false, true}) {
        SCOPED_TRACE(collide ? "collide" : "pass");
        Scenario s = scene();
        const int a = addBody(s, ball(0.5), {0, 0, 0}), b = addBody(s, ball(0.5), {0.8, 0, 0});
        Joint joint;
        joint.name = "pin";
        joint.type = JointType::Hinge;
        joint.bodyA = a;
        joint.bodyB = b;
        joint.anchorA = {0.4, 0, 0};
        joint.anchorB = {-0.4, 0, 0};
        joint.collideConnected = collide;
        s.joints.push_back(joint);
        auto world = build(s, 0.01);
        world->step();
        EXPECT_EQ(!contactsOf(*world).empty(), collide);
        if (!collide) {
            EXPECT_LE(norm(stateOf(*world, s, a).velocity), tol(1e-9, 1e-5));
        }
    }
}

}  // namespace
}  // namespace rigor::conformance
