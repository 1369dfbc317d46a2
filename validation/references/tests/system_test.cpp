// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Mass properties by their closed forms against random sampling of the shapes; what an isolated system keeps.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "validation/references/tests/newton_euler.hpp"

namespace rigor::validation::testing {
namespace {

using adapter::Scheme;

bool inside(const Geometry& g, Vec3 p, int dimension) {
    if (const auto* s = std::get_if<Sphere>(&g)) return norm(p) <= s->radius;
    if (const auto* b = std::get_if<Box>(&g))
        return std::abs(p.x) <= b->halfExtents.x && std::abs(p.y) <= b->halfExtents.y &&
               (dimension == 2 || std::abs(p.z) <= b->halfExtents.z);
    if (const auto* c = std::get_if<Capsule>(&g)) {
        const double y = std::max(std::abs(p.y) - c->halfLength, 0.0);
        return p.x * p.x + p.z * p.z + y * y <= c->radius * c->radius;
    }
    if (const auto* c = std::get_if<Cylinder>(&g))
        return std::abs(p.y) <= c->halfLength && std::hypot(p.x, p.z) <= c->radius;
    if (const auto* c = std::get_if<Cone>(&g)) {
        const double down = (c->halfLength - p.y) / (2 * c->halfLength);
        return down >= 0 && down <= 1 && std::hypot(p.x, p.z) <= c->radius * down;
    }
    // The hulls below: a right-angled corner cut off by a plane.
    return p.x >= 0 && p.y >= 0 && p.z >= -1e-12 &&
           p.x / 0.6 + p.y / 0.4 + (dimension == 3 ? p.z / 0.5 : 0.0) <= 1;
}

/// Mass properties by a regular grid of points: a second method with an error of the grid's size.
MassProperties sampled(const Geometry& g, int dimension, double density) {
    const int n = 160;
    const double reach = 0.8, cell = 2 * reach / n;
    MassProperties m;
    Mat3 second;
    Vec3 first;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < (dimension == 2 ? 1 : n); ++k) {
                const Vec3 p{-reach + (i + 0.5) * cell, -reach + (j + 0.5) * cell,
                             dimension == 2 ? 0.0 : -reach + (k + 0.5) * cell};
                if (!inside(g, p, dimension)) continue;
                const double dm = density * (dimension == 2 ? cell * cell : cell * cell * cell);
                m.mass += dm;
                first += dm * p;
                const double x[3] = {p.x, p.y, p.z};
                for (int a = 0; a < 3; ++a)
                    for (int b = 0; b < 3; ++b)
                        second(a, b) += dm * ((a == b ? dot(p, p) : 0.0) - x[a] * x[b]);
            }
    m.centerOfMass = first / m.mass;
    const double c[3] = {m.centerOfMass.x, m.centerOfMass.y, m.centerOfMass.z};
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            m.inertia(a, b) =
                second(a, b) - m.mass * ((a == b ? dot(m.centerOfMass, m.centerOfMass) : 0.0) - c[a] * c[b]);
    return m;
}

TEST(StruckBodies, BlowsShowTheMassPropertiesOfEveryShape) {
    struct Case {
        int dimension;
        Geometry shape;
    };
    const Case cases[] = {
        {3, Sphere{0.5}},        {3, Box{{0.5, 0.3, 0.2}}},
        {3, Capsule{0.25, 0.4}}, {3, Cylinder{0.4, 0.3}},
        {3, Cone{0.5, 0.4}},     {3, ConvexHull{{{0, 0, 0}, {0.6, 0, 0}, {0, 0.4, 0}, {0, 0, 0.5}}}},
        {2, Sphere{0.5}},        {2, Box{{0.5, 0.3, 0}}},
        {2, Capsule{0.25, 0.4}}, {2, ConvexHull{{{0, 0, 0}, {0.6, 0, 0}, {0, 0.4, 0}}}}};
    for (const Case& c : cases) {
        Scenario s = emptyScene(c.dimension, {}, 1);
        addBody(s, "body", BodyType::Dynamic, c.shape, {});
        s.bodies[0].massProperties = massPropertiesFromShapes(s.bodies[0].shapes, s.materials, c.dimension);
        const Vec3 blow = c.dimension == 2 ? Vec3{0, 0, 5} : Vec3{3, -4, 5};
        s.events.push_back({0.0, 0, {7, -2, 0}, blow});
        setReference(s, "struck_bodies");
        const auto r = makeReference(s);
        const MassProperties m = sampled(c.shape, c.dimension, 1000);
        const auto after = r->exact(0, 1e-9);
        const double tolerance = c.dimension == 2 ? 0.02 : 0.03;
        EXPECT_NEAR(after.velocity->x, 7 / m.mass, tolerance * 7 / m.mass);
        // I w = L with the sampled tensor.
        const Vec3 l =
            c.dimension == 2 ? m.inertia(2, 2) * *after.angularVelocity : m.inertia * *after.angularVelocity;
        EXPECT_LT(norm(l - blow), tolerance * norm(blow)) << geometryName(c.shape, c.dimension);
        const Vec3 center = *r->exact(0, 0.5).position +
                            rotate(*r->exact(0, 0.5).orientation, s.bodies[0].massProperties.centerOfMass);
        EXPECT_NEAR(norm(center - 0.5 * *after.velocity - m.centerOfMass), 0.0, 0.01);
        // Afterwards the angular momentum stays.
        const Vec3 kept = spinMomentum(s, *r, 0, 0.9);
        EXPECT_LT(norm(kept - blow), 1e-9 * norm(blow));
        const auto all = r->quantities(0.01, Scheme::Unknown);
        ASSERT_EQ(all.size(), 1U);
        EXPECT_NEAR(all[0].measure(exactRun(s, *r, 1e-4, 20)).value(), all[0].exact, 1e-2 * all[0].exact);
    }
}

TEST(StruckBodies, RefusesAnotherTensorAndTwoBlows) {
    Scenario s = emptyScene(3, {}, 1);
    addBox(s, "box", {0.5, 0.3, 0.2}, 2, {});
    s.events.push_back({0.0, 0, {7, -2, 0}, {1, 0, 0}});
    setReference(s, "struck_bodies");
    EXPECT_NO_THROW(makeReference(s));
    s.bodies[0].massProperties.inertia(1, 1) *= 1.001;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s.bodies[0].massProperties.inertia(1, 1) /= 1.001;
    s.events.push_back(s.events[0]);
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

TEST(IsolatedSystem, QuantitiesSeeADriftOfTheCentreAndOfSpins) {
    Scenario s = emptyScene(3, {}, 2);
    addBall(s, "a", 0.1, 1, 0.4, {-1, 0, 0}, {1, 0.2, 0}, {0, 0, 3});
    addBall(s, "b", 0.2, 3, 0.4, {1, 0, 0}, {-0.5, 0, 0.1});
    setReference(s, "isolated_system");
    const auto r = makeReference(s);
    EXPECT_TRUE(r->bodies().empty());
    // A run by hand: elastic exchange along x at t = 1, which keeps momentum (masses 1 and 3).
    Trajectory run = exactRun(s, *r, 1.0, 2);
    const double u = 1.5, va = 1 - 2 * 3.0 / 4 * u, vb = -0.5 + 2 * 1.0 / 4 * u;
    for (const int k : {1, 2}) {
        const double before = 1, after = k - 1;
        run.states[2 * k].position = {-1 + before * 1 + after * va, 0.2 * k, 0};
        run.states[2 * k + 1].position = {1 - before * 0.5 + after * vb, 0, 0.1 * k};
    }
    auto all = r->quantities(0.01, Scheme::Unknown);
    ASSERT_EQ(all.size(), 2U);
    EXPECT_NEAR(all[0].measure(run).value(), 0.0, 1e-12);
    EXPECT_EQ(all[1].measure(run).value(), 0.0);
    run.states[4].position.y += 0.04;
    EXPECT_NEAR(all[0].measure(run).value(), 0.01, 1e-12);
    run.states[4].angularVelocity.z += 0.5;
    EXPECT_NEAR(all[1].measure(run).value(), 0.5, 1e-12);
    s.materials[0].friction = 0.2;
    EXPECT_EQ(makeReference(s)->quantities(0.01, Scheme::Unknown).size(), 1U);
    s.gravity = {0, -1, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s.gravity = {};
    addFloor(s);
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

}  // namespace
}  // namespace rigor::validation::testing
