// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts hold up to the static coefficient and slide at that of sliding: every reference that decides
// between the two must use the first for what rests or rolls and the second for what slides, or refuse.
#include <gtest/gtest.h>

#include "validation/references/sliding/planar_slide.hpp"
#include "validation/references/tests/newton_euler.hpp"

namespace rigor::validation {
namespace {

using namespace testing;
using adapter::Scheme;

/// A block or a ball of moment 2/5 m r^2 on a slope that rises towards +x by `slope`.
Scenario onSlope(double slope, double sliding, double holding, bool isBall) {
    Scenario s = emptyScene(3, {0, -9.81, 0}, 2);
    s.materials[0].friction = sliding;
    s.materials[0].staticFriction = holding;
    const double angle = std::atan(slope);
    const Vec3 n{-std::sin(angle), std::cos(angle), 0};
    addFloor(s, n);
    if (isBall)
        addBall(s, "body", 0.1, 1, 0.4, 0.1 * n);
    else
        addBox(s, "body", {0.2, 0.05, 0.2}, 1, 0.05 * n);
    s.bodies.back().pose.orientation = fromAxisAngle({0, 0, 1}, angle);
    setReference(s, isBall ? "rolling_incline" : "incline_slide");
    return s;
}
Vec3 uphill(double slope) {
    const double angle = std::atan(slope);
    return {std::cos(angle), std::sin(angle), 0};
}

TEST(StaticFriction, ABlockThrownUpASlopeStaysWhereItStops) {
    const double g = 9.81 / std::sqrt(1.25);  // g cos for the slope 1/2; g sin is half of it
    for (const double holding : {0.45, 0.6}) {
        Scenario s = onSlope(0.5, 0.4, holding, false);
        s.bodies[1].velocity = 2.0 * uphill(0.5);
        const auto r = makeReference(s);
        const double stop = 2.0 / (0.9 * g), top = 0.5 * 2.0 * stop;
        const Vec3 from = s.bodies[1].pose.position;
        EXPECT_NEAR(norm(*r->exact(1, stop).position - from), top, 1e-13);
        // A block that is not held comes back with g (sin - mu cos).
        const double back = holding < 0.5 ? 0.1 * g : 0.0, later = 1.5 - stop;
        EXPECT_NEAR(dot(*r->exact(1, 1.5).velocity, uphill(0.5)), -back * later, 1e-13);
        EXPECT_NEAR(dot(*r->exact(1, 1.5).position - from, uphill(0.5)), top - 0.5 * back * later * later,
                    1e-13);
        EXPECT_FALSE(r->schemeExact(1, 10, 0.01, Scheme::SymplecticEuler)) << "two coefficients";
    }
}

TEST(StaticFriction, ABlockWithoutSlidingFrictionRestsAllTheSame) {
    const Scenario s = onSlope(0.5, 0.0, 0.6, false);
    EXPECT_EQ(*makeReference(s)->exact(1, 1).velocity, Vec3{});
    const PlanarSlide aside({0, 0, 4}, 0.0, {1, 0, -1}, 5.0);
    EXPECT_EQ(aside.at(2).displacement, (Vec3{2, 0, 6})) << "it never comes to rest: a parabola";
    EXPECT_FALSE(aside.sticks());
}

TEST(StaticFriction, ABallRollsWhereSlidingFrictionAloneWouldLetItSlip) {
    // Rolling needs 2/7 of the slope.
    const double g = 9.81 / std::sqrt(1.25);
    const Scenario rough = onSlope(0.5, 0.1, 0.15, true), smooth = onSlope(0.5, 0.1, 0.14, true);
    const auto rolls = makeReference(rough);
    EXPECT_NEAR(norm(*rolls->exact(1, 1).velocity), 5.0 / 7 * 0.5 * g, 1e-13);
    const auto slips = makeReference(smooth);
    EXPECT_NEAR(norm(*slips->exact(1, 1).velocity), 0.4 * g, 1e-13);
}

TEST(StaticFriction, WhatLeansStandsByTheStaticCoefficient) {
    for (const double holding : {0.49, 0.51}) {
        Scenario s = onSlope(0.5, 0.1, holding, false);
        setReference(s, "static_equilibrium");
        EXPECT_EQ(makeReference(s)->quantities(0.01, Scheme::Unknown)[0].exact, holding > 0.5 ? 0.0 : 1.0);
    }
}

TEST(StaticFriction, ASceneThatNeedsASmoothContactIsRefused) {
    Scenario s = emptyScene(3, {0, -9.81, 0}, 1);
    addFloor(s);
    addBall(s, "ball", 0.1, 1, 0.4, {0, 1, 0}, {1, 0, 0});
    setReference(s, "bouncing_ball");
    EXPECT_NO_THROW(makeReference(s));
    s.materials[0].staticFriction = 0.3;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

TEST(StaticFriction, AnImpactThatOnlyStaticFrictionWouldStickIsRefused) {
    // Stops its slip with an impulse of 2/7 of 2 m/s; the normal impulse is 1 m/s.
    Scenario s = emptyScene(3, {}, 1);
    addFloor(s);
    addBall(s, "ball", 0.1, 1, 0.4, {0, 0.5, 0}, {2, -1, 0});
    setReference(s, "sphere_plane_impact");
    const auto after = [&](double sliding, double holding) {
        s.materials[0].friction = sliding;
        s.materials[0].staticFriction = holding;
        return makeReference(s)->exact(1, 0.9).velocity->x;
    };
    EXPECT_NEAR(after(0.3, 0.5), 2.0 - 0.3, 1e-14) << "slips by both";
    EXPECT_NEAR(after(0.6, 0.9), 2.0 * 5 / 7, 1e-14) << "sticks by both";
    EXPECT_THROW(after(0.5, 0.6), AssumptionViolated);
}

// ------------------------------------------------------------------------------------------- ball_off_ball
Scenario ballOnBall(double sliding, double holding, double angle, double speed, double spin) {
    Scenario s = emptyScene(3, {0, -9.81, 0}, 1.2);
    s.materials[0].friction = sliding;
    s.materials[0].staticFriction = holding;
    addBody(s, "base", BodyType::Static, Sphere{1}, {});
    addBall(s, "ball", 0.1, 1, 0.4, {1.1 * std::sin(angle), 1.1 * std::cos(angle), 0},
            {speed * std::cos(angle), -speed * std::sin(angle), 0}, {0, 0, -spin});
    setReference(s, "ball_off_ball");
    return s;
}

TEST(StaticFriction, EveryForceOnABallThatRollsOffABallIsOneThatItsContactCanGive) {
    struct Case {
        double sliding, holding, angle, speed, spin;
    };
    // Slips from rest at once; slips, rolls and slips again; spins faster than it rolls; runs up first; rolls
    // by static friction alone.
    for (const Case& c : {Case{0.01, 0, 0.2, 0, 0}, Case{0.5, 0, 0.05, 1, 0}, Case{0.4, 0, 0.1, 0.3, 20},
                          Case{0.5, 0, 0.3, -0.6, 0}, Case{0.1, 0.4, 0.3, 0, 0}}) {
        const Scenario s = ballOnBall(c.sliding, c.holding, c.angle, c.speed, c.spin);
        const auto r = makeReference(s);
        double before = energyOf(s, *r, 0);
        int checked = 0;
        for (double t = 0.01; t < 1.0; t += 0.01) {
            EXPECT_LE(energyOf(s, *r, t), before + 1e-11) << "friction drives the ball, " << t;
            before = energyOf(s, *r, t);
            const Wrench w = wrenchOn(s, *r, 1, t, 1e-4);
            const Vec3 n = unit(w.com), arm = -0.1 * n;
            if (norm(w.com) > 1.1 + 1e-9) break;
            const double load = dot(w.force, n);
            const auto e = r->exact(1, t);
            const Vec3 friction = w.force - load * n, slip = *e.velocity + cross(*e.angularVelocity, arm);
            // Differences across a change from rolling to slipping mean nothing.
            const auto slipAt = [&](double at) {
                const auto x = r->exact(1, at);
                return norm(*x.velocity + cross(*x.angularVelocity, -0.1 * unit(*x.position)));
            };
            if ((slipAt(t - 3e-4) < 1e-9) != (slipAt(t + 3e-4) < 1e-9)) continue;
            ++checked;
            EXPECT_GT(load, -1e-6);
            if (norm(slip) < 1e-9)
                EXPECT_LE(norm(friction), std::max(c.sliding, c.holding) * load + 1e-5) << t;
            else
                EXPECT_LT(norm(friction + (c.sliding * load / norm(slip)) * slip), 1e-5) << t;
        }
        EXPECT_GT(checked, 20);
    }
}

}  // namespace
}  // namespace rigor::validation
