// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Balls in hollow cylinders: catalogued values, and as a second method Newton's and Euler's laws with one
// force at the point where ball and wall touch, which must be at rest there and inside the friction cone.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "validation/references/tests/newton_euler.hpp"

namespace rigor::validation::testing {
namespace {

using std::numbers::pi;

/// A mesh or chain on a cylinder of radius R about the z axis (gravity along -y) or along gravity.
Scenario hollow(int dimension, double radius, double facet, double from, double to, Vec3 gravity) {
    Scenario s = emptyScene(dimension, gravity, 3);
    s.materials[0].friction = 2;
    const int n = std::lround((to - from) / facet);
    if (dimension == 2) {
        Chain chain;
        for (int i = 0; i <= n; ++i)
            chain.vertices.push_back(
                {radius * std::sin(from + i * facet), -radius * std::cos(from + i * facet), 0});
        addBody(s, "wall", BodyType::Static, chain, {});
        return s;
    }
    TriangleMesh mesh;
    for (int i = 0; i <= n; ++i)
        for (const double z : {-2.0, 2.0})
            mesh.vertices.push_back(
                {radius * std::sin(from + i * facet), -radius * std::cos(from + i * facet), z});
    for (int i = 0; i < n; ++i) {
        mesh.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 2});
        mesh.triangles.push_back({2 * i + 1, 2 * i + 3, 2 * i + 2});
    }
    addBody(s, "wall", BodyType::Static, mesh, {});
    return s;
}

Scenario trough(int dimension, double angle, double friction = 2) {
    const double facet = pi / 3600, reach = std::cos(facet / 2) - 0.1;
    Scenario s = hollow(dimension, 1, facet, -1.4, 1.4, {0, -9.81, 0});
    s.materials[0].friction = friction;
    addBall(s, "ball", 0.1, 1, 0.4, {reach * std::sin(angle), -reach * std::cos(angle), 0});
    setReference(s, "ball_in_trough", {{"ball", std::string("ball")}, {"trough", std::string("wall")}});
    return s;
}

TEST(BallInTrough, CatalogueValues) {
    for (const int dimension : {2, 3}) {
        const Scenario s = trough(dimension, 1);
        const auto r = makeReference(s);
        const auto e = r->exact(1, 1);
        EXPECT_NEAR(std::atan2(e.position->x, -e.position->y), -0.8701216771, 2e-6);
        const auto all = r->quantities(0.01, adapter::Scheme::Unknown);
        EXPECT_TRUE(all.empty());  // one swing and a passage take 3.001 s
        Scenario longer = s;
        longer.duration = 5;
        const auto again = makeReference(longer);
        const auto more = again->quantities(0.01, adapter::Scheme::Unknown);
        const Quantity* period = findQuantity(more, "period");
        ASSERT_NE(period, nullptr);
        EXPECT_NEAR(period->exact, 2.401176001, 2e-6);
        EXPECT_NEAR(period->measure(exactRun(longer, *again, 0.002, 2500)).value(), period->exact, 1e-6);
    }
}

TEST(BallInTrough, OneForceAtTheTouchingPointMovesIt) {
    Scenario s = trough(3, 0.6);
    s.bodies[1].velocity = 0.7 * Vec3{std::cos(0.6), std::sin(0.6), 0};
    s.bodies[1].angularVelocity = {0, 0, -7};
    const auto r = makeReference(s);
    const double reach = norm(s.bodies[1].pose.position);
    for (const double t : {0.0, 0.4, 1.3}) {
        const auto e = r->exact(1, t + 0.01);
        const Vec3 out = unit(*e.position);
        const Wrench w = wrenchOn(s, *r, 1, t + 0.01);
        EXPECT_NEAR(norm(*e.position), reach, 1e-12);
        EXPECT_LT(norm(w.remainder(*e.position + 0.1 * out)), 1e-7);
        EXPECT_LT(norm(*e.velocity + cross(*e.angularVelocity, 0.1 * out)), 1e-12);
        EXPECT_LT(norm(cross(w.force, out)), -2 * dot(w.force, out));
        expectConsistent(s, *r, 1, t + 0.01, 1e-8);
        EXPECT_NEAR(energyOf(s, *r, t), energyOf(s, *r, 0), 1e-12);
    }
}

TEST(BallInTrough, WithoutFrictionItSlidesAndDoesNotTurn) {
    const Scenario s = trough(2, 0.8, 0.0);
    const auto r = makeReference(s);
    const auto e = r->exact(1, 0.9);
    EXPECT_EQ(e.angularVelocity->z, 0.0);
    EXPECT_NEAR(energyOf(s, *r, 0.9), energyOf(s, *r, 0), 1e-12);
    EXPECT_NEAR(cross(wrenchOn(s, *r, 1, 0.9).force, unit(*e.position)).z, 0.0, 1e-8);
}

TEST(BallInTrough, RefusesWhatItDoesNotKnow) {
    EXPECT_THROW(makeReference(trough(3, 1, 0.3)), AssumptionViolated);  // slips: 2/7 tan(1) = 0.44
    Scenario s = trough(3, 1);
    s.bodies[1].angularVelocity = {0, 0, 1};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = trough(3, 1);
    s.bodies[1].pose.position.y += 0.01;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = trough(3, 1);
    s.gravity = {0, -9, 1};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = trough(2, 1);
    std::get<Chain>(s.bodies[0].shapes[0].geometry).vertices[7].x += 0.01;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = hollow(2, 1, pi / 60, -1.4, 1.4, {0, -9.81, 0});
    addBall(s, "ball", 0.1, 1, 0.5, {0, -0.9, 0});
    setReference(s, "ball_in_trough");
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

Scenario pipe() {
    const double facet = pi / 1800, reach = 0.3 * std::cos(facet / 2) - 0.05, rate = 12;
    Scenario s = hollow(3, 0.3, facet, 0, 2 * pi, {0, 0, -9.81});
    s.duration = 1;
    const Vec3 out{std::sin(facet / 2), -std::cos(facet / 2), 0}, along = cross({0, 0, 1}, out);
    addBall(s, "ball", 0.05, 1, 0.4, reach * out + Vec3{0, 0, 1}, reach * rate * along,
            {0, 0, -reach * rate / 0.05});
    setReference(s, "ball_in_cylinder", {{"ball", std::string("ball")}, {"cylinder", std::string("wall")}});
    return s;
}

TEST(BallInCylinder, CatalogueValues) {
    const Scenario s = pipe();
    const auto r = makeReference(s);
    for (const auto& [t, z, climb, spin] : {std::tuple{0.5, 0.6597406821, 0.07154908857, -81.66223629},
                                            std::tuple{1.0, 0.9985388418, -0.1427909275, -0.3506779648}}) {
        const auto e = r->exact(1, t);
        EXPECT_NEAR(e.position->z, z, 1e-9);
        EXPECT_NEAR(e.velocity->z, climb, 1e-9);
        EXPECT_NEAR(dot(*e.angularVelocity, unit({e.position->x, e.position->y, 0})), spin, 1e-7);
    }
    const auto all = r->quantities(0.01, adapter::Scheme::Unknown);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_NEAR(all[0].measure(exactRun(s, *r, 0.001, 1000)).value(), all[0].exact, 1e-6);
}

TEST(BallInCylinder, OneForceAtTheTouchingPointMovesIt) {
    Scenario s = pipe();
    s.bodies[1].velocity.z = 0.4;
    const Vec3 out0 = unit({s.bodies[1].pose.position.x, s.bodies[1].pose.position.y, 0});
    s.bodies[1].angularVelocity += 3.0 * out0 + 8.0 * cross({0, 0, 1}, out0);
    const auto r = makeReference(s);
    for (const double t : {0.11, 0.43, 0.9}) {
        const auto e = r->exact(1, t);
        const Vec3 out = unit({e.position->x, e.position->y, 0});
        const Wrench w = wrenchOn(s, *r, 1, t, 2e-4);
        EXPECT_LT(norm(w.remainder(*e.position + 0.05 * out)), 1e-6);
        EXPECT_LT(norm(*e.velocity + cross(*e.angularVelocity, 0.05 * out)), 1e-9);
        EXPECT_LT(norm(cross(w.force, out)), -2 * dot(w.force, out));
        expectConsistent(s, *r, 1, t, 1e-6, 2e-4);
        EXPECT_NEAR(energyOf(s, *r, t), energyOf(s, *r, 0), 1e-9);
    }
}

TEST(BallInCylinder, RefusesWhatItDoesNotKnow) {
    Scenario s = pipe();
    s.materials[0].friction = 0.2;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = pipe();
    s.bodies[1].angularVelocity = {};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = pipe();
    s.gravity = {0, 1, -9.81};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = pipe();
    s.bodies[1].pose.position.z = -1.9;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

}  // namespace
}  // namespace rigor::validation::testing
