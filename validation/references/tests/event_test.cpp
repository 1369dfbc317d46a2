// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Impacts followed through the touch, pushes at the threshold of friction, a rod that strikes a ball, the
// first domino: catalogued values and, as a second method, small steps of the same law, brute force over time
// or an elliptic integral.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "validation/references/numerics/elliptic.hpp"
#include "validation/references/tests/newton_euler.hpp"

namespace rigor::validation::testing {
namespace {

using std::numbers::pi;

// --------------------------------------------------------------------------------------- incremental impact
struct Hit {
    double inertia, rx, ry, vx, vy, mu, e;
};
Scenario cornerHit(const Hit& h, const char* law) {
    Scenario s = emptyScene(2, {}, 0.4);
    s.materials[0].friction = h.mu;
    s.materials[0].restitution = h.e;
    addFloor(s);
    addBody(s, "body", BodyType::Dynamic, ConvexHull{{{h.rx, h.ry, 0}, {1, 0.5, 0}, {-1, 0.5, 0}}},
            {0, 0.3 - h.ry, 0});
    s.bodies[1].massProperties = {1, {}, Mat3::diagonal(1, 1, h.inertia)};
    s.bodies[1].velocity = {h.vx, h.vy, 0};
    setReference(s, law, {{"body", std::string("body")}, {"floor", std::string("floor")}});
    return s;
}

TEST(IncrementalImpact, CatalogueValues) {
    const Hit reversal{1.0 / 12, -0.25, -0.4330127019, 0.6, -2, 0.3, 0.5},
        sticks{0.1, -0.2, -0.4, 0.2, -2, 0.8, 0.5}, slips{0.1, 0.2, -0.4, 1, -2, 0.2, 0.5};
    const std::tuple<Hit, const char*, double, double, double> cases[] = {
        {reversal, "impact_newton", 1.057961496, 0.0542339623, -3.783064151},
        {reversal, "impact_poisson", 1.03528443, -0.02135625777, -3.674126982},
        {reversal, "impact_stronge", 1.037539532, -0.01383925116, -3.684960148},
        {sticks, "impact_newton", 0.9066666667, 0.5466666667, -2.266666667},
        {sticks, "impact_poisson", 0.8984615385, 0.52, -2.246153846},
        {sticks, "impact_stronge", 0.8986310664, 0.5205509657, -2.246577666},
        {slips, "impact_newton", 0.5161290323, 0.4193548387, 2.903225806},
        {slips, "impact_poisson", 0.5161290323, 0.4193548387, 2.903225806},
        {slips, "impact_stronge", 0.5161290323, 0.4193548387, 2.903225806}};
    for (const auto& [hit, law, x, y, w] : cases) {
        const Scenario s = cornerHit(hit, law);
        const auto r = makeReference(s);
        const auto e = r->exact(1, 0.16);
        EXPECT_NEAR(e.velocity->x, x, 1e-8) << law;
        EXPECT_NEAR(e.velocity->y, y, 1e-8) << law;
        EXPECT_NEAR(e.angularVelocity->z, w, 1e-8) << law;
        EXPECT_EQ(r->exact(1, 0.1).velocity->x, hit.vx);
    }
}

/// The touch in 200000 equal steps of the normal impulse.
Vec3 stepped(const Hit& h, const std::string& law) {
    double u = h.vx, v = h.vy, w = 0, work = 0, least = 0, atRest = 0, p = 0;
    const double dp = 4.0 / 200000;
    const auto slip = [&] { return u - w * h.ry; };
    const auto gap = [&] { return v + w * h.rx; };
    const double start = gap();
    for (int k = 0; k < 2000000; ++k) {
        const double m11 = 1 + h.ry * h.ry / h.inertia, m12 = -h.rx * h.ry / h.inertia;
        double t = -h.mu * (slip() > 0 ? 1 : -1);
        // A step that would carry the slip past zero: the force that ends it, as far as friction can.
        const double hold = (-slip() / dp - m12) / m11;
        if (std::abs(hold) <= h.mu) t = hold;
        const double before = gap();
        u += t * dp;
        v += dp;
        w += (h.rx - h.ry * t) * dp / h.inertia;
        p += dp;
        work += 0.5 * (before + gap()) * dp;
        if (gap() < 0) {
            least = work;
            atRest = p;
        }
        if (law == "impact_newton" && gap() >= -h.e * start) break;
        if (law == "impact_poisson" && gap() > 0 && p >= (1 + h.e) * atRest) break;
        if (law == "impact_stronge" && gap() > 0 && work >= least * (1 - h.e * h.e)) break;
    }
    return {u, v, w};
}

TEST(IncrementalImpact, IsTheLimitOfManySmallImpulses) {
    const Hit hits[] = {{1.0 / 12, -0.25, -0.43, 0.6, -2, 0.3, 0.5}, {0.1, -0.2, -0.4, 0.2, -2, 0.8, 0.7},
                        {0.2, 0.3, -0.5, -0.4, -1.5, 0.4, 0.3},      {0.1, 0.25, -0.4, 0.5, -2, 0.25, 0.6},
                        {0.08, -0.3, -0.45, 0.3, -2.1, 0.25, 0.6},   {0.1, 0.2, -0.4, 0, -2, 0.3, 0.5}};
    for (const Hit& h : hits)
        for (const char* law : {"impact_newton", "impact_poisson", "impact_stronge"}) {
            const Scenario s = cornerHit(h, law);
            const auto e = makeReference(s)->exact(1, 0.3 / -h.vy + 0.001);
            const Vec3 brute = stepped(h, law);
            EXPECT_NEAR(e.velocity->x, brute.x, 1e-3) << law;
            EXPECT_NEAR(e.velocity->y, brute.y, 1e-3) << law;
            EXPECT_NEAR(e.angularVelocity->z, brute.z, 5e-3) << law;
        }
}

TEST(IncrementalImpact, QuantitiesAreMeasuredUnderGravityToo) {
    Scenario s = cornerHit({0.1, 0.2, -0.4, 1, -2, 0.2, 0.5}, "impact_poisson");
    s.gravity = {0.4, -0.5, 0};
    s.duration = 0.3;
    const auto r = makeReference(s);
    ASSERT_GT(r->validUntil(), 0.3);
    const auto all = r->quantities(0.01, adapter::Scheme::Unknown);
    ASSERT_EQ(all.size(), 3U);
    for (const auto& q : all)
        EXPECT_NEAR(q.measure(exactRun(s, *r, 0.01, 30)).value(), q.exact, 1e-10) << q.name;
    expectConsistent(s, *r, 1, 0.25, 1e-8);
}

TEST(IncrementalImpact, RefusesWhatItDoesNotKnow) {
    Scenario s = cornerHit({0.1, 0.2, -0.4, 1, -2, 0.2, 0.5}, "impact_newton");
    s.bodies[1].velocity = {0, 2, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    // A flat side lands with both its corners.
    s = cornerHit({0.1, 0.2, -0.4, 0, -2, 0.2, 0.5}, "impact_poisson");
    s.bodies[1].shapes[0].geometry = ConvexHull{{{0.2, -0.4, 0}, {-0.2, -0.4, 0}, {0, 0.4, 0}}};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    // The rod is so steep and the floor so rough that friction drives the corner in while it slips.
    s = cornerHit({0.01, 0.4, -0.5, 2, -1, 3, 0.5}, "impact_newton");
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

TEST(IncrementalImpact, NewtonsLawThatAddsEnergyIsRefusedAndTheOthersAreNot) {
    // The slip turns round, so that Newton's law gives back more than the corner brought along the normal.
    int refused = 0;
    for (const double e : {0.0, 0.5, 0.9, 1.0}) {
        const Hit hit{1.0 / 12, 0.24, -0.38, -1.2, -2, 0.4, e};
        const auto energy = [&](const PartialState& after) {
            return dot(*after.velocity, *after.velocity) +
                   hit.inertia * after.angularVelocity->z * after.angularVelocity->z;
        };
        const double before = hit.vx * hit.vx + hit.vy * hit.vy;
        for (const char* law : {"impact_poisson", "impact_stronge"})
            EXPECT_LE(energy(makeReference(cornerHit(hit, law))->exact(1, 0.151)), before + 1e-12)
                << law << e;
        try {
            const Scenario s = cornerHit(hit, "impact_newton");
            EXPECT_LE(energy(makeReference(s)->exact(1, 0.151)), before + 1e-12) << e;
        } catch (const AssumptionViolated& violation) {
            EXPECT_NE(std::string(violation.what()).find("adds energy"), std::string::npos);
            ++refused;
        }
    }
    EXPECT_EQ(refused, 2) << "of the two with the larger restitution";
}

TEST(IncrementalImpact, WhatNewtonsLawWouldDoLaterDoesNotMatter) {
    // The law of impulses refuses the same drop: an impact after the first adds energy.
    Scenario s = emptyScene(2, {0, -9.81, 0}, 1.5);
    s.materials[0].friction = 0.9;
    s.materials[0].restitution = 1.0;
    addFloor(s);
    addBox(s, "body", {0.12, 0.45, 0}, 1, {0, 0.7, 0});
    s.bodies[1].pose.orientation = fromAxisAngle({0, 0, 1}, 0.14);
    s.bodies[1].massProperties.inertia = Mat3::diagonal(1, 1, (0.12 * 0.12 + 0.45 * 0.45) / 3);
    setReference(s, "planar_contact");
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    for (const char* law : {"impact_poisson", "impact_stronge"}) {
        setReference(s, law, {{"body", std::string("body")}, {"floor", std::string("floor")}});
        EXPECT_GT(makeReference(s)->validUntil(), 0.2) << law;
    }
}

// -------------------------------------------------------------------------------------------- pushed_block
Scenario pushed(Vec3 force, double friction = 0.4) {
    Scenario s = emptyScene(3, {0, -9.81, 0}, 1);
    s.materials[0].friction = friction;
    addFloor(s);
    addBox(s, "block", {0.3, 0.1, 0.3}, 2, {0, 0.1, 0});
    s.forces.push_back(ConstantForce{1, force, {}, 0, 1e300});
    setReference(s, "pushed_block");
    return s;
}

TEST(PushedBlock, StaysBelowTheThresholdAndObeysNewtonAboveIt) {
    const double most = 0.4 * 2 * 9.81;
    for (const double angle : {0.0, 0.4, 0.8, 2.0}) {
        const Vec3 along{std::cos(angle), 0, std::sin(angle)};
        const Scenario below = pushed(0.999 * most * along);
        EXPECT_EQ(*makeReference(below)->exact(1, 1).velocity, Vec3{});
        // A push that also lifts: less load, less friction.
        Scenario s = pushed(1.2 * most * along + Vec3{0, 3, 0});
        const auto r = makeReference(s);
        Wrench w = wrenchOn(s, *r, 1, 0.5);
        const Vec3 contact = w.force - std::get<ConstantForce>(s.forces[0]).force;
        EXPECT_NEAR(norm(Vec3{contact.x, 0, contact.z}), 0.4 * contact.y, 1e-9);
        EXPECT_NEAR(dot(contact, along), -0.4 * contact.y, 1e-9);
        expectConsistent(s, *r, 1, 0.5, 1e-9);
        EXPECT_NEAR(contact.y, 2 * 9.81 - 3, 1e-9);
    }
}

TEST(PushedBlock, SchemeValuesAreSteps) {
    const Scenario s = pushed({12, 0, 5});
    const auto r = makeReference(s);
    const Vec3 a = *r->exact(1, 1).velocity;
    Vec3 x = s.bodies[1].pose.position, v{};
    for (int k = 0; k < 50; ++k) {
        v += 0.01 * a;
        x += 0.01 * v;
    }
    EXPECT_LT(norm(*r->schemeExact(1, 50, 0.01, adapter::Scheme::SymplecticEuler)->position - x), 1e-14);
    x = s.bodies[1].pose.position;
    v = {};
    for (int k = 0; k < 50; ++k) {
        x += 0.01 * v;
        v += 0.01 * a;
    }
    EXPECT_LT(norm(*r->schemeExact(1, 50, 0.01, adapter::Scheme::ExplicitEuler)->position - x), 1e-14);
    EXPECT_FALSE(r->schemeExact(1, 1, 0.01, adapter::Scheme::RungeKutta4).has_value());
}

TEST(PushedBlock, StaticFrictionHoldsMoreThanSliding) {
    Scenario s = pushed({1.1 * 0.4 * 2 * 9.81, 0, 0});
    s.materials[0].staticFriction = 0.5;
    EXPECT_EQ(*makeReference(s)->exact(1, 1).velocity, Vec3{});
    std::get<ConstantForce>(s.forces[0]).force.x = 0.51 * 2 * 9.81;
    EXPECT_NEAR(makeReference(s)->exact(1, 1).velocity->x, 0.11 * 9.81, 1e-12);
}

TEST(PushedBlock, RefusesWhatItDoesNotKnow) {
    EXPECT_THROW(makeReference(pushed({0, 30, 0})), AssumptionViolated);
    Scenario s = pushed({1, 0, 0});
    std::get<ConstantForce>(s.forces[0]).end = 0.5;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = pushed({1, 0, 0});
    std::get<ConstantForce>(s.forces[0]).torque = {0, 1, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = pushed({1, 0, 0});
    s.bodies[1].velocity = {1, 0, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    EXPECT_THROW(makeReference(pushed({200, 0, 0}, 4)), AssumptionViolated);  // tips
}

// ---------------------------------------------------------------------------------------- rod_strikes_ball
Scenario swungRod(double rate, Vec3 ball, double restitution = 0.5, int dimension = 3) {
    Scenario s = emptyScene(dimension, {}, 0.4);
    s.materials[0].restitution = restitution;
    addBody(s, "rod", BodyType::Kinematic, Capsule{0.05, 0.5}, {});
    s.bodies[0].shapes[0].pose = {{0.5, 0, 0}, fromAxisAngle({0, 0, 1}, -pi / 2)};
    s.bodies[0].angularVelocity = {0, 0, rate};
    addBall(s, "ball", 0.1, 0.5, 0.4, ball);
    setReference(s, "rod_strikes_ball", {{"rod", std::string("rod")}, {"ball", std::string("ball")}});
    return s;
}

TEST(RodStrikesBall, CatalogueValue) {
    const Scenario swung = swungRod(10, {0.5, 0.5, 0});
    const auto r = makeReference(swung);
    EXPECT_NEAR(r->quantities(0.01, adapter::Scheme::Unknown)[0].exact, 0.05716420309, 1e-11);
}

TEST(RodStrikesBall, IsWhereTheDistanceFirstVanishesAndTheNormalSpeedIsReversed) {
    for (const double rate : {7.0, -9.0})
        for (const Vec3 at :
             {Vec3{0.3, 0.6, 0}, Vec3{0.9, 0.55, 0}, Vec3{-0.4, 0.8, 0}, Vec3{0.2, -0.7, 0}}) {
            Scenario s = swungRod(rate, at, 0.3);
            s.duration = 1.2;
            const auto r = makeReference(s);
            const double ahead = rate > 0 ? std::atan2(at.y, at.x) : -std::atan2(at.y, at.x);
            const double whole = (ahead < 0 ? ahead + 2 * pi : ahead) / std::abs(rate);
            double time = 0;
            Vec3 near{};
            for (int k = 0; k <= 2000000; ++k) {
                const double t = whole * k / 2000000;
                const Vec3 e{std::cos(rate * t), std::sin(rate * t), 0};
                near = std::clamp(dot(at, e), 0.0, 1.0) * e;
                if (norm(at - near) > 0.15) continue;
                time = t;
                break;
            }
            const Vec3 n = unit(at - near);
            const double speed = dot(cross({0, 0, rate}, near + 0.05 * n), n);
            ASSERT_LT(time, s.duration);
            const auto before = r->exact(1, time - 1e-5), after = r->exact(1, time + 1e-5);
            EXPECT_EQ(*before.velocity, Vec3{});
            EXPECT_LT(norm(*after.velocity - 1.3 * speed * n), 1e-4);
        }
}

TEST(RodStrikesBall, QuantitiesAreMeasured) {
    for (const int dimension : {2, 3}) {
        const Scenario s = swungRod(10, {0.9, 0.55, 0}, 0.5, dimension);
        const auto r = makeReference(s);
        const auto all = r->quantities(0.01, adapter::Scheme::Unknown);
        ASSERT_EQ(all.size(), 2U);
        for (const auto& q : all) EXPECT_NEAR(q.measure(exactRun(s, *r, 0.01, 40)).value(), q.exact, 1e-12);
    }
}

TEST(RodStrikesBall, RefusesWhatItDoesNotKnow) {
    EXPECT_THROW(makeReference(swungRod(10, {2, 0.5, 0})), AssumptionViolated);
    EXPECT_THROW(makeReference(swungRod(10, {0.5, 0.1, 0})), AssumptionViolated);
    EXPECT_THROW(makeReference(swungRod(10, {0.5, 0.5, 0.2})), AssumptionViolated);
    Scenario s = swungRod(10, {0.5, 0.5, 0});
    s.materials[0].friction = 0.2;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = swungRod(10, {0.5, 0.5, 0});
    s.gravity = {0, -1, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = swungRod(10, {0.5, 0.5, 0});
    s.bodies[0].shapes[0].pose.position = {0.6, 0, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

// ------------------------------------------------------------------------------------------------ dominoes
Scenario dominoes(double tilt, double gap, int dimension = 2) {
    const double b = 0.05, h = 0.25;
    Scenario s = emptyScene(dimension, {0, -9.81, 0}, 2);
    s.materials[0].friction = 0.9;
    addFloor(s);
    const double angle = std::atan(b / h) + tilt;
    const Quat q = fromAxisAngle({0, 0, 1}, -angle);
    addBox(s, "first", {b, h, 0.1}, 0.6, Vec3{b, 0, 0} + rotate(q, {-b, h, 0}));
    s.bodies[1].pose.orientation = q;
    addBox(s, "second", {b, h, 0.1}, 0.6, {2 * b + gap, h, 0});
    addBox(s, "third", {b, h, 0.1}, 0.6, {4 * b + 2 * gap, h, 0});
    for (std::size_t i = 1; i < 4; ++i)
        s.bodies[i].massProperties.inertia = Mat3::diagonal(1, 1, 0.6 * (b * b + h * h) / 3);
    setReference(s, "dominoes", {{"floor", std::string("floor")}});
    return s;
}

TEST(Dominoes, TheTouchIsAtTheTimeOfTheEllipticIntegral) {
    const double b = 0.05, h = 0.25, R = std::hypot(b, h), tilt = 0.06;
    const double p = std::sqrt(9.81 * R / (R * R * 4 / 3));
    for (const int dimension : {2, 3})
        for (const double gap : {0.2, 0.3}) {
            const Scenario fallen = dominoes(tilt, gap, dimension);
            const auto r = makeReference(fallen);
            // Upper corner at 2 h sin(turn) from the edge along the way, where the turn is from upright.
            const double turn = std::asin(gap / (2 * h)), end = turn - std::atan(b / h);
            const double kappa = std::cos(tilt / 2);
            const auto F = [&](double delta) {
                return static_cast<double>(
                    numerics::ellipticF(std::asin(std::cos(delta / 2) / kappa), kappa * kappa));
            };
            const double time = (F(tilt) - F(end)) / p;
            EXPECT_NEAR(r->quantities(0.01, adapter::Scheme::Unknown)[0].exact, time, 1e-9);
            EXPECT_EQ(r->validUntil(), r->quantities(0.01, adapter::Scheme::Unknown)[0].exact);
        }
}

TEST(Dominoes, TheTouchIsMeasuredAndTheOthersRest) {
    const Scenario s = dominoes(0.05, 0.3);
    const auto r = makeReference(s);
    const auto all = r->quantities(0.01, adapter::Scheme::Unknown);
    ASSERT_EQ(all.size(), 1U);
    // A run that goes on past the touch as the first domino alone would.
    Scenario alone = s;
    alone.bodies.resize(2);
    alone.observed.resize(2);
    setReference(alone, "planar_contact", {{"body", std::string("first")}, {"floor", std::string("floor")}});
    const auto falls = makeReference(alone);
    Trajectory run = exactRun(alone, *falls, 0.005, 200);
    EXPECT_NEAR(all[0].measure(run).value(), all[0].exact, 1e-6);
    EXPECT_EQ(*r->exact(2, 0.1).velocity, Vec3{});
    EXPECT_LT(norm(*r->exact(1, 0.2).position - *falls->exact(1, 0.2).position), 1e-10);
}

TEST(Dominoes, RefuseWhatTheyDoNotKnow) {
    EXPECT_THROW(makeReference(dominoes(0.05, 0.6)), AssumptionViolated);  // falls short
    EXPECT_THROW(makeReference(dominoes(0.4, 0.1)), AssumptionViolated);   // touches at the start
    Scenario s = dominoes(0.05, 0.2);
    s.bodies[2].velocity = {1, 0, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = dominoes(0.05, 0.2);
    s.bodies[2].pose.orientation = fromAxisAngle({0, 0, 1}, 0.2);
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

}  // namespace
}  // namespace rigor::validation::testing
