// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The k-th order of a scenario lists the same objects in another order, and the results are reported for the
// bodies and shapes as they were written.
#include "validation/symmetry/listing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenarios/loader/loader.hpp"

namespace rigor::validation {
namespace {

using scenario::Body;
using scenario::BodyType;
using scenario::Scenario;
using scenario::Vec3;

Body ball(const std::string& name, std::size_t shapes = 1) {
    Body b;
    b.name = name;
    b.massProperties.mass = 1.0;
    for (std::size_t i = 0; i < shapes; ++i) {
        scenario::Shape shape;
        shape.geometry = scenario::Sphere{1.0 + i};
        b.shapes.push_back(shape);
    }
    return b;
}

/// A compound of three shapes, two balls on rods, a floor.
Scenario rods() {
    Scenario s;
    s.name = "rods";
    s.bodies = {ball("floor"), ball("compound", 3), ball("left"), ball("right")};
    s.bodies[0].type = BodyType::Static;
    for (const int body : {2, 3}) {
        scenario::Joint j;
        j.name = body == 2 ? "rod_left" : "rod_right";
        j.bodyA = 1;
        j.bodyB = body;
        s.joints.push_back(j);
        s.forces.emplace_back(scenario::ConstantForce{body, {1.0 * body, 0, 0}, {}});
    }
    s.events.push_back({0.5, 3, {0, 1, 0}, {}});
    s.observed = {1, 3};
    return s;
}

std::string nameOf(const Scenario& s, int body) {
    return s.bodies[body].name;
}

/// Expects that indices name the same bodies and joints.
void expectSameConnections(const Scenario& a, const Scenario& b) {
    ASSERT_EQ(a.bodies.size(), b.bodies.size());
    for (const auto& joint : b.joints) {
        const auto it = std::find_if(a.joints.begin(), a.joints.end(),
                                     [&](const auto& j) { return j.name == joint.name; });
        ASSERT_NE(it, a.joints.end());
        EXPECT_EQ(nameOf(a, it->bodyA), nameOf(b, joint.bodyA));
        EXPECT_EQ(nameOf(a, it->bodyB), nameOf(b, joint.bodyB));
    }
    for (const auto& force : b.forces) {
        const auto& f = std::get<scenario::ConstantForce>(force);
        EXPECT_EQ(nameOf(b, f.body), f.force.x == 2.0 ? "left" : "right");
    }
    EXPECT_EQ(nameOf(b, b.events[0].body), "right");
    EXPECT_EQ(nameOf(b, b.observed[0]), "compound");
    EXPECT_EQ(nameOf(b, b.observed[1]), "right");
}

TEST(Listing, EveryOrderIsAnotherOneOfTheSameThings) {
    const Scenario s = rods();
    const auto orders = otherListings(s, 400);
    ASSERT_EQ(orders.size(), 400u) << "of 576";
    EXPECT_EQ(orders[0], reversed(s));
    for (std::size_t i = 0; i < orders.size(); ++i) {
        EXPECT_FALSE(orders[i] == asWritten(s));
        for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(orders[i] == orders[k]) << i << " and " << k;
        expectSameConnections(s, listed(s, orders[i]).scenario);
    }
    bool floorMoves = false, jointsMove = false, shapesMove = false, forcesMove = false;
    for (const Listing& order : orders) {
        floorMoves = floorMoves || order.bodies[0] != 0;
        jointsMove = jointsMove || order.joints[0] != 0;
        forcesMove = forcesMove || order.forces[0] != 0;
        shapesMove = shapesMove || order.shapes[1] != asWritten(s).shapes[1];
    }
    EXPECT_TRUE(floorMoves && jointsMove && forcesMove && shapesMove);
}

TEST(Listing, TheKthIsTheSameForEveryCount) {
    const Scenario s = rods();
    const auto few = otherListings(s, 3), many = otherListings(s, 20);
    for (std::size_t k = 0; k < few.size(); ++k) EXPECT_EQ(few[k], many[k]);
}

/// Two bodies can be listed in two ways; one body in one.
TEST(Listing, ThereAreNoMoreOrdersThanThereAre) {
    Scenario s;
    s.bodies = {ball("a")};
    EXPECT_EQ(listingCount(s, 100), 1u);
    EXPECT_TRUE(otherListings(s, 9).empty());
    s.bodies = {ball("a"), ball("b")};
    EXPECT_EQ(listingCount(s, 100), 2u);
    EXPECT_EQ(otherListings(s, 9), std::vector<Listing>{reversed(s)});
    s.bodies = {ball("a", 2), ball("b")};
    EXPECT_EQ(listingCount(s, 100), 4u);
    const auto others = otherListings(s, 9);
    ASSERT_EQ(others.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_FALSE(others[i] == asWritten(s));
        for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(others[i] == others[k]) << i << " and " << k;
    }
    EXPECT_EQ(listingCount(rods(), 1000000), 24u * 6u * 2u * 2u);
    EXPECT_EQ(listingCount(rods(), 100), 100u);
}

/// States and contacts of a run in another order, seen back, are of the bodies and shapes as written.
TEST(Listing, BringsStatesAndContactsBack) {
    const Scenario s = rods();
    for (const Listing& order : otherListings(s, 12)) {
        const Transformed other = listed(s, order);
        const auto indexOf = [&](const std::string& name) { return findBody(other.scenario, name); };
        Trajectory t;
        t.dt = 1.0;
        t.bodyCount = s.bodies.size();
        t.times = {0.0};
        for (const Body& b : other.scenario.bodies) {
            BodyState state;
            state.position.x = b.name.size();
            t.states.push_back(state);
        }
        // The compound's sphere of radius 3 touches the ball "left" in the direction of y.
        ContactPoint c;
        c.bodyA = std::min(indexOf("compound"), indexOf("left"));
        c.bodyB = std::max(indexOf("compound"), indexOf("left"));
        const bool compoundFirst = c.bodyA == indexOf("compound");
        c.normal = {0, compoundFirst ? 1.0 : -1.0, 0};
        const auto& shapes = other.scenario.bodies[indexOf("compound")].shapes;
        for (std::size_t k = 0; k < shapes.size(); ++k)
            if (std::get<scenario::Sphere>(shapes[k].geometry).radius == 3.0)
                (compoundFirst ? c.shapeA : c.shapeB) = k;
        t.contacts = {{c}};

        const Trajectory back = other.back(t);
        for (std::size_t i = 0; i < s.bodies.size(); ++i)
            EXPECT_EQ(back.states[i].position.x, static_cast<double>(s.bodies[i].name.size()));
        const ContactPoint& seen = back.contacts[0][0];
        EXPECT_EQ(nameOf(s, seen.bodyA), "compound");
        EXPECT_EQ(nameOf(s, seen.bodyB), "left");
        EXPECT_EQ(seen.shapeA, 2);
        EXPECT_EQ(seen.shapeB, 0);
        EXPECT_EQ(seen.normal.y, 1.0);
    }
}

}  // namespace
}  // namespace rigor::validation
