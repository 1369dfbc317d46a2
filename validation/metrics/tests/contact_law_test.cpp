// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The residuals of the contact law of the law itself: gaps, overlap, impacts, pulling contacts, friction
// along and across the slip, static friction; and K of a point against finite differences of an impulse on
// rigid bodies.
#include <gtest/gtest.h>

#include <cmath>

#include "validation/metrics/contact_point.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/references/tests/scene.hpp"

namespace rigor::validation::testing {
namespace {

constexpr double kStep = 0.01;

/// A ball of 2 kg and 0.25 m on a floor without gravity, two frames, one contact in the step between.
struct OneStep {
    OneStep() : scenario(emptyScene(3, {}, kStep)) {
        scenario.materials[0].friction = 0.5;
        addFloor(scenario);
        addBall(scenario, "ball", 0.25, 2, 0.4, {0, 0.25, 0});
        run.dt = kStep;
        run.bodyCount = 2;
        run.times = {0.0, kStep};
        BodyState floor, ball;
        ball.position = {0, 0.25, 0};
        run.states = {floor, ball, floor, ball};
        ContactPoint c;
        c.bodyA = 0;
        c.bodyB = 1;
        c.normal = {0, 1, 0};
        c.hasImpulse = true;
        c.normalImpulse = 2;
        run.contacts = {{c}, {}};
    }
    BodyState& before() { return run.states[1]; }
    BodyState& after() { return run.states[3]; }
    ContactPoint& contact() { return run.contacts[0][0]; }
    /// The row of the whole scene, or -1 where there is none.
    double value(const char* metric) const {
        const auto rows = findMetric(metric)->evaluate({scenario, run, nullptr, adapter::Scheme::Unknown});
        return rows.empty() ? -1.0 : rows.front().value;
    }
    double signorini() const { return value("signorini_residual"); }
    double coulomb() const { return value("coulomb_residual"); }
    double dissipation() const { return value("dissipation_error"); }

    Scenario scenario;
    Trajectory run;
};

TEST(Signorini, ARestingContactObeysIt) {
    const OneStep step;
    EXPECT_EQ(step.signorini(), 0.0);
    EXPECT_EQ(step.coulomb(), 0.0);
    EXPECT_EQ(step.dissipation(), 0.0);
}

TEST(Signorini, MayNotComeNearer) {
    OneStep step;
    step.after().velocity = {0, -0.3, 0};
    EXPECT_NEAR(step.signorini(), 0.3, 1e-15);
    step.contact().normalImpulse = 0;
    EXPECT_NEAR(step.signorini(), 0.3, 1e-15) << "found and left alone is no better";
}

TEST(Signorini, AnImpulseNeverPulls) {
    OneStep step;
    step.contact().normalImpulse = -0.2;
    EXPECT_NEAR(step.signorini(), 0.1, 1e-15);  // K_nn = 1/m
}

TEST(Signorini, WhatLeavesIsNotPushed) {
    OneStep step;
    step.after().velocity = {0, 0.3, 0};
    EXPECT_NEAR(step.signorini(), 0.3, 1e-15);
    step.contact().normalImpulse = 0.2;  // the lesser of both
    EXPECT_NEAR(step.signorini(), 0.1, 1e-15);
    step.contact().normalImpulse = 0;
    EXPECT_EQ(step.signorini(), 0.0);
}

TEST(Signorini, AGapMayBeClosedWithinTheStepAndNoFaster) {
    OneStep step;
    step.contact().depth = -0.002;
    step.after().velocity = {0, -0.2, 0};
    EXPECT_NEAR(step.signorini(), 0.0, 1e-15);
    step.after().velocity = {0, -0.25, 0};
    EXPECT_NEAR(step.signorini(), 0.05, 1e-15);
    step.after().velocity = {};  // held at its gap
    EXPECT_EQ(step.signorini(), 0.0);
    step.contact().normalImpulse = 0;  // a contact without impulse is not counted
    EXPECT_EQ(step.signorini(), -1.0);
}

TEST(Signorini, OverlapMayBeRemovedWithinTheStepAndNoFaster) {
    OneStep step;
    step.contact().depth = 0.002;
    step.after().velocity = {0, 0.2, 0};
    EXPECT_NEAR(step.signorini(), 0.0, 1e-15);
    step.after().velocity = {0, 0.5, 0};
    EXPECT_NEAR(step.signorini(), 0.3, 1e-15);
}

TEST(Signorini, ImpactsReboundByNewtonsLaw) {
    OneStep step;
    step.scenario.materials[0].restitution = 0.5;
    step.before().velocity = {0, -4, 0};
    step.contact().normalImpulse = 12;
    step.after().velocity = {0, 2, 0};
    EXPECT_NEAR(step.signorini(), 0.0, 1e-15);
    step.after().velocity = {0, 1.5, 0};
    EXPECT_NEAR(step.signorini(), 0.5, 1e-15);
    step.after().velocity = {0, 2.25, 0};
    EXPECT_NEAR(step.signorini(), 0.25, 1e-15);
    // The approach under gravity may or may not contain that of the step: 0.5 x 0.1 m/s either way.
    step.scenario.gravity = {0, -10, 0};
    step.after().velocity = {0, 2.05, 0};
    EXPECT_NEAR(step.signorini(), 0.0, 1e-12);
    step.after().velocity = {0, 1.95, 0};
    EXPECT_NEAR(step.signorini(), 0.05, 1e-12);
}

TEST(Signorini, FramesFartherApartThanStepsSayNothing) {
    OneStep step;
    step.contact().frictionImpulse = {1.1, 0, 0};
    step.run.stride = 2;
    EXPECT_EQ(step.signorini(), -1.0);
    EXPECT_EQ(step.dissipation(), -1.0);
    EXPECT_NEAR(step.coulomb(), 0.175, 1e-14);
    step.run.stride = 1;
    step.contact().hasImpulse = false;
    for (const char* metric : {"signorini_residual", "coulomb_residual", "dissipation_error"})
        EXPECT_EQ(step.value(metric), -1.0) << metric;
}

/// A ball that rolls: where its contact was found after it had moved, the point at rest is that below its last place.
TEST(ContactLaw, ContactsOfTheStepsEndAreJudgedAtItsPoses) {
    OneStep step;
    step.after().position = {0.1, 0.25, 0};
    step.after().velocity = {1, 0, 0};
    step.after().angularVelocity = {0, 0, -4};
    step.contact().pointA = step.contact().pointB = {0.1, 0, 0};
    step.contact().frictionImpulse = {0.3, 0, 0};
    EXPECT_NEAR(step.signorini(), 0.4, 1e-14)
        << "held against the first place, it goes down by 4 rad/s x 0.1 m";
    step.run.contacts = {{}, {step.contact()}};
    step.run.contactInstant = adapter::ContactInstant::StepEnd;
    EXPECT_NEAR(step.signorini(), 0.0, 1e-14);
    EXPECT_NEAR(step.dissipation(), 0.0, 1e-14);
}

TEST(Coulomb, ThePairsOwnCoefficientCounts) {
    OneStep step;
    step.contact().frictionImpulse = {0, 0, 1.1};
    EXPECT_NEAR(step.coulomb(), 0.175, 1e-14);
    step.scenario.pairs = {{0, 0, 0.6, 0.0}};
    EXPECT_EQ(step.coulomb(), 0.0);
    step.scenario.pairs = {{0, 0, 0.5, 0.0, 0.6}};  // static friction
    EXPECT_EQ(step.coulomb(), 0.0);
    step.contact().frictionImpulse = {0, 0, std::nan("")};
    EXPECT_FALSE(std::isfinite(step.coulomb())) << "not-a-number can not hide";
}

TEST(Dissipation, FrictionIsOppositeToTheSlipAndAtItsLimit) {
    OneStep step;
    step.after().velocity = {0.12, 0, -0.16};
    const double most = 1.0;  // mu p_n
    const auto pull = [&](double along, double across) {
        step.contact().frictionImpulse = along * Vec3{0.6, 0, -0.8} + across * Vec3{0.8, 0, 0.6};
        return step.dissipation();
    };
    EXPECT_NEAR(pull(-most, 0), 0.0, 1e-15);
    EXPECT_NEAR(pull(0, 0), 0.2, 1e-15);
    EXPECT_NEAR(pull(most, 0), 0.2, 1e-15);           // drives it
    EXPECT_NEAR(pull(-0.95, 0), 0.05 * 1.75, 1e-14);  // nearly enough
    EXPECT_GT(pull(0, most), 0.19);                   // sideways
    // The part beyond the cone is Coulomb's residual alone.
    EXPECT_NEAR(pull(-1.1, 0), 0.0, 1e-15);
    EXPECT_NEAR(step.coulomb(), 0.175, 1e-14);
}

TEST(Dissipation, TheSlipIsThatOfTheSurfaces) {
    OneStep step;
    // Rolls: v = w r. Then slides on by 0.1 m/s.
    step.after().velocity = {1, 0, 0};
    step.after().angularVelocity = {0, 0, -4};
    EXPECT_NEAR(step.dissipation(), 0.0, 1e-15);
    step.after().angularVelocity = {0, 0, -3.6};
    EXPECT_NEAR(step.dissipation(), 0.1, 1e-14);
    // The floor is a belt that runs along.
    step.scenario.bodies[0].type = BodyType::Kinematic;
    step.run.states[2].velocity = {0.1, 0, 0};
    EXPECT_NEAR(step.dissipation(), 0.0, 1e-14);
}

TEST(Dissipation, ABeltCountsAsASurfaceThatMoves) {
    OneStep step;
    step.after().velocity = {1, 0, 0};
    step.after().angularVelocity = {0, 0, -3.6};
    scenario::SurfaceVelocity& belt = step.scenario.bodies[0].shapes[0].surfaceVelocity;
    belt.linear = {0.1, 5, 0};  // the part across the face is none of friction's business
    EXPECT_NEAR(step.dissipation(), 0.0, 1e-14);
    belt = {{0, 0, 0}, {0, -2, 0}};  // turns about the point of contact
    EXPECT_NEAR(step.dissipation(), 0.1, 1e-14);
    step.scenario.bodies[0].pose.position = {0, 0, 0.05};  // the states count, not where it was built
    EXPECT_NEAR(step.dissipation(), 0.1, 1e-14);
    for (const std::size_t frame : {0, 2}) step.run.states[frame].position = {0, 0, 0.05};
    EXPECT_NEAR(step.dissipation(), 0.0, 1e-14) << "2 rad/s at 0.05 m";
    // The surface of the ball itself.
    belt = {};
    step.scenario.bodies[1].shapes[0].surfaceVelocity.angular = {0, 0, -0.4};
    EXPECT_NEAR(step.dissipation(), 0.0, 1e-14) << "0.4 rad/s at the radius";
}

TEST(Dissipation, StaticFrictionHoldsWithinItsOwnLimit) {
    OneStep step;
    step.scenario.pairs = {{0, 0, 0.5, 0.0, 0.8}};
    step.contact().frictionImpulse = {1.5, 0, 0};
    EXPECT_EQ(step.dissipation(), 0.0);
    EXPECT_EQ(step.coulomb(), 0.0);
}

/// K dp = J M^-1 J^T dp, by pushing the bodies and looking at what the point does.
TEST(PointOfContact, RespondsAsTheBodiesDo) {
    for (const int dimension : {2, 3}) {
        Scenario s = emptyScene(dimension, {}, 1);
        addBox(s, "a", {0.5, 0.2, 0.3}, 3, {0.1, 0.2, dimension == 3 ? 0.3 : 0.0});
        addBox(s, "b", {0.1, 0.7, 0.2}, 5, {0.4, 0.9, 0});
        std::vector<BodyState> states(2);
        for (std::size_t i = 0; i < 2; ++i) {
            states[i].position = s.bodies[i].pose.position;
            const Vec3 axis = dimension == 3 ? Vec3{0.6, 0, 0.8} : Vec3{0, 0, 1};
            states[i].orientation = fromAxisAngle(axis, 0.7 + i);
        }
        ContactPoint c;
        c.bodyA = 0;
        c.bodyB = 1;
        c.normal = dimension == 3 ? Vec3{2.0 / 3, 1.0 / 3, 2.0 / 3} : Vec3{0.6, 0.8, 0};
        c.pointA = {0.3, 0.5, dimension == 3 ? 0.1 : 0.0};
        c.pointB = c.pointA + 0.02 * c.normal;
        const PointOfContact point(s, c, states);
        const Vec3 at = 0.5 * (c.pointA + c.pointB);
        const auto [t1, t2] = tangentsOf(c.normal, dimension);
        EXPECT_NEAR(dot(cross(c.normal, t1), t2), 1.0, 1e-15);
        for (const Vec3& impulse : {c.normal, t1, dimension == 3 ? t2 : t1}) {
            auto pushed = states;
            for (std::size_t i = 0; i < 2; ++i) {
                const Vec3 p = i == 0 ? -impulse : impulse, L = cross(at - states[i].position, p);
                const auto& m = s.bodies[i].massProperties;
                pushed[i].velocity = p / m.mass;
                // I w = L in body axes, which are principal here
                const Vec3 l = rotateInverse(states[i].orientation, L);
                const Vec3 w = dimension == 2 ? Vec3{0, 0, l.z / m.inertia(2, 2)}
                                              : Vec3{l.x / m.inertia(0, 0), l.y / m.inertia(1, 1),
                                                     l.z / m.inertia(2, 2)};
                pushed[i].angularVelocity = rotate(states[i].orientation, w);
            }
            EXPECT_LT(norm(point.velocity(pushed) - point.response(impulse)), 1e-14);
        }
        // The largest over a sweep of directions.
        double most = 0;
        for (int i = 0; i < 3600; ++i) {
            const double angle = i * 3.14159265358979 / 3600;
            const Vec3 t = dimension == 3 ? std::cos(angle) * t1 + std::sin(angle) * t2 : t1;
            most = std::max(most, dot(t, point.response(t)));
        }
        EXPECT_NEAR(point.tangentialMobility(), most, 1e-5 * most);
    }
}

}  // namespace
}  // namespace rigor::validation::testing
