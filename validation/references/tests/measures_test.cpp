// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Frames, drives and measures of several references, with values that are all different: masses other than
// one, tilted floors, bodies that start turned, centres of mass off the origin.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenarios/loader/loader.hpp"
#include "validation/references/joints/swing.hpp"
#include "validation/references/planar/planar_motion.hpp"
#include "validation/references/tests/newton_euler.hpp"

namespace rigor::validation::testing {
namespace {

using std::numbers::pi;

// ------------------------------------------------------------------------------------------- planar frames
/// A body of mass 2.5 above a slope, turned, with its centre of mass off its origin.
Scenario aboveSlope(int dimension) {
    const Vec3 n = unit({-0.3, 1, 0});
    Scenario s = emptyScene(dimension, {0.4, -9.81, 0}, 0.2);
    addFloor(s, n);
    addBox(s, "body", {0.3, 0.2, dimension == 3 ? 0.1 : 0.0}, 2.5, 2.0 * n);
    Body& b = s.bodies[1];
    b.gravityScale = 0.6;
    b.pose.orientation = fromAxisAngle({0, 0, 1}, 0.7);
    b.massProperties = {2.5, {0.05, -0.03, 0}, Mat3::diagonal(0.2, 0.3, 0.15)};
    b.velocity = {0.5, -0.2, 0};
    b.angularVelocity = {0, 0, 1.5};
    s.forces.push_back(ConstantForce{1, {3, 4, 0}, {0, 0, 0.7}, 0, 1e300});
    setReference(s, "planar_contact", {{"body", std::string("body")}, {"floor", std::string("floor")}});
    return s;
}

TEST(PlanarFrame, ConstantForcesAndTorquesMoveABodyOfAnyMass) {
    for (const int dimension : {2, 3}) {
        const Scenario s = aboveSlope(dimension);
        const auto r = makeReference(s);
        for (const double t : {0.05, 0.15}) {
            const Wrench w = wrenchOn(s, *r, 1, t);
            expectNear(w.force, {3, 4, 0}, 1e-8);
            expectNear(w.torque, {0, 0, 0.7}, 1e-8);
            expectConsistent(s, *r, 1, t, 1e-8);
        }
        const auto start = r->exact(1, 0);
        expectNear(*start.position, s.bodies[1].pose.position, 1e-12);
        expectNear(rotate(*start.orientation, {1, 0, 0}), rotate(s.bodies[1].pose.orientation, {1, 0, 0}),
                   1e-12);
        expectNear(*start.velocity, s.bodies[1].velocity, 1e-12);
    }
}

TEST(PlanarFrame, ReadsBackWhatItLiftsAndHasTheBodysCorners) {
    for (const int dimension : {2, 3}) {
        const Scenario s = aboveSlope(dimension);
        const PlanarFrame frame(s, 1, 0);
        for (const double angle : {-2.5, 0.3, 3.0}) {
            const PlanarMotion::State state{0.4, 1.3, angle, -0.7, 0.2, 2.5};
            const PartialState lifted = frame.lift(state);
            const auto back = frame.read(
                {*lifted.position, *lifted.orientation, *lifted.velocity, *lifted.angularVelocity});
            EXPECT_NEAR(static_cast<double>(back.x), 0.4, 1e-12);
            EXPECT_NEAR(static_cast<double>(back.z), 1.3, 1e-12);
            EXPECT_NEAR(static_cast<double>(back.angle), angle, 1e-12);
            EXPECT_NEAR(static_cast<double>(back.vx), -0.7, 1e-12);
            EXPECT_NEAR(static_cast<double>(back.vz), 0.2, 1e-12);
            EXPECT_NEAR(static_cast<double>(back.rate), 2.5, 1e-12);
            // Heights of the corners above the slope, counted on the lifted body.
            const Vec3 n = unit({-0.3, 1, 0});
            std::vector<double> expected, found;
            for (const double x : {-0.3, 0.3})
                for (const double y : {-0.2, 0.2})
                    expected.push_back(dot(n, *lifted.position + rotate(*lifted.orientation, {x, y, 0})));
            for (const auto& c : frame.setup().corners)
                found.push_back(static_cast<double>(
                    state.z + std::sin(static_cast<PlanarMotion::Real>(angle)) * c.along +
                    std::cos(static_cast<PlanarMotion::Real>(angle)) * c.above - c.radius));
            ASSERT_EQ(found.size(), expected.size());
            std::sort(expected.begin(), expected.end());
            std::sort(found.begin(), found.end());
            for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12);
        }
    }
}

TEST(PlanarFrame, WithoutSpinALeaningBodyMovesInThePlaneOfItsLean) {
    // Leaning over an edge askew to the axes, at rest: it falls across the edge, towards the lean.
    Scenario s = emptyScene(3, {0, -9.81, 0}, 0.3);
    s.materials[0].friction = 0.9;
    addFloor(s);
    const Vec3 edge = unit({1, 0, 2});
    const Quat facing = fromAxisAngle({0, 1, 0}, std::atan2(-edge.x, -edge.z));
    for (const double lean : {0.5, -0.5}) {
        const Quat q = fromAxisAngle(edge, lean) * facing;
        double low = 1e9;
        for (const double x : {-0.1, 0.1})
            for (const double z : {-0.2, 0.2}) low = std::min(low, rotate(q, {x, -0.4, z}).y);
        Scenario one = s;
        addBox(one, "block", {0.1, 0.4, 0.2}, 1, {0, -low, 0});
        one.bodies[1].pose.orientation = q;
        setReference(one, "planar_contact");
        const auto e = makeReference(one)->exact(1, 0.2);
        EXPECT_NEAR(std::abs(dot(unit(*e.angularVelocity), edge)), 1.0, 1e-9);
        EXPECT_GT(dot(*e.angularVelocity, edge) * lean, 0.0);
        EXPECT_NEAR(dot(*e.velocity, edge), 0.0, 1e-12);
    }
}

TEST(PlanarFrame, APushAloneSaysInWhichPlaneAnUprightBoxTips) {
    const Scenario plane = loadScenario(findScenario("tipping_push_2d")).scenario,
                   space = loadScenario(findScenario("tipping_push")).scenario;
    const auto a = makeReference(plane), b = makeReference(space);
    ASSERT_EQ(a->bodies(), b->bodies());
    for (const int body : a->bodies())
        for (const double t : {0.3, 0.8}) {
            expectNear(*a->exact(body, t).position, *b->exact(body, t).position, 1e-9);
            expectNear(*a->exact(body, t).angularVelocity, *b->exact(body, t).angularVelocity, 1e-9);
        }
    EXPECT_GT(norm(*b->exact(findBody(space, "tips"), 0.8).angularVelocity), 0.1);
}

// --------------------------------------------------------------------------------------------------- swing
TEST(Swing, TheFirstPassageIsTheFirstTimeAtTheLowestPoint) {
    for (const auto& [angle, rate] : {std::pair{1.0, 0.5}, std::pair{-0.4, -2.0}, std::pair{0.5, 9.0},
                                      std::pair{-2.0, 8.0}, std::pair{0.3, -8.5}}) {
        const Swing swing(3.0L, angle, rate);
        const bool turns = swing.parameter() > 1;
        // The sign is positive towards a growing angle; a body that turns over the other way counts the other
        // way.
        const double sign = turns && rate < 0 ? -1 : 1;
        const auto round = [&](double t) {
            return std::remainder(sign * static_cast<double>(swing.at(t).angle), 2 * pi);
        };
        double first = 0;
        for (int k = 1; k < 100000 && first == 0; ++k) {
            const double a = round((k - 1) * 1e-4), b = round(k * 1e-4);
            if (a < 0 && b >= 0 && b - a < 3) first = k * 1e-4;
        }
        EXPECT_NEAR(swing.firstPassage(), first, 1.1e-4) << angle << " " << rate;
        EXPECT_NEAR(round(swing.firstPassage()), 0, 1e-12);
        EXPECT_NEAR(std::remainder(round(swing.firstPassage() + static_cast<double>(swing.period())), 2 * pi),
                    0, 1e-12);
    }
}

// ------------------------------------------------------------------------------------------ rotating hinge
TEST(RotatingHinge, ASkewHingeOnAShaftElsewhereGivesNoTorqueAboutItsAxis) {
    Scenario s = emptyScene(3, {1, -9.81, 0.5}, 2);
    addBody(s, "shaft", BodyType::Kinematic, Sphere{0.01}, {0.3, 0.2, -0.1});
    s.bodies[0].angularVelocity = {0.5, 3, -1};
    s.bodies[0].collides = false;
    const Vec3 anchor{0.5, 0.3, 0.2}, axis = unit({1, 0.4, 0.3});
    addBox(s, "arm", {0.1, 0.4, 0.05}, 1.7, {0.7, -0.2, 0.25});
    Body& b = s.bodies[1];
    b.pose.orientation = normalized(Quat{0.9, 0.1, -0.2, 0.3});
    b.massProperties.centerOfMass = {0.03, 0.05, -0.02};
    b.massProperties.inertia(0, 1) = b.massProperties.inertia(1, 0) = 0.004;
    b.collides = false;
    b.angularVelocity = s.bodies[0].angularVelocity + 0.8 * axis;
    b.velocity = cross(s.bodies[0].angularVelocity, anchor - s.bodies[0].pose.position) +
                 cross(b.angularVelocity, centerOfMass(b) - anchor);
    addJoint(s, JointType::Hinge, 0, 1, anchor, axis);
    setReference(s, "rotating_hinge");
    const auto r = makeReference(s);
    const Vec3 turn = s.bodies[0].angularVelocity;
    for (const double t : {0.2, 0.9, 1.6}) {
        const Quat carried = fromAxisAngle(unit(turn), norm(turn) * t);
        const Vec3 hinge = s.bodies[0].pose.position + rotate(carried, anchor - s.bodies[0].pose.position);
        const Vec3 n = rotate(carried, axis);
        expectNear(pointAt(*r, 1, t, s.joints[0].anchorB), hinge, 1e-11);
        expectNear(rotate(*r->exact(1, t).orientation, s.joints[0].axisB), n, 1e-11);
        EXPECT_NEAR(dot(wrenchOn(s, *r, 1, t).remainder(hinge), n), 0.0, 1e-7);
        expectConsistent(s, *r, 1, t, 1e-7);
    }
    // The tilt of the arm against gravity, extremes over the run.
    double low = 10, high = -10;
    for (int k = 0; k <= 4000; ++k) {
        const double t = s.duration * k / 4000;
        const Vec3 arm = centerAt(s, *r, 1, t) - pointAt(*r, 1, t, s.joints[0].anchorB);
        const double tilt = std::acos(dot(unit(arm), unit(s.gravity)));
        low = std::min(low, tilt);
        high = std::max(high, tilt);
    }
    const auto all = r->quantities(0.01, adapter::Scheme::Unknown);
    const Trajectory run = exactRun(s, *r, 0.0005, 4000);
    for (const auto& [name, expected] : {std::pair{"tilt_max", high}, std::pair{"tilt_min", low}}) {
        const Quantity* q = findQuantity(all, name);
        ASSERT_NE(q, nullptr);
        EXPECT_NEAR(q->exact, expected, 1e-7) << name;
        EXPECT_NEAR(q->measure(run).value(), expected, 1e-7) << name;
    }
}

// ---------------------------------------------------------------------------------------- spherical pendulum
TEST(SphericalPendulum, TheExtremesOfItsTiltAreMeasured) {
    Scenario s = loadScenario(findScenario("heavy_top_nutation")).scenario;
    const auto r = makeReference(s);
    double low = 10, high = -10;
    for (int k = 0; k <= 6000; ++k) {
        const double t = s.duration * k / 6000;
        const Vec3 arm = centerAt(s, *r, 0, t) - pointAt(*r, 0, t, s.joints[0].anchorB);
        const double tilt = std::acos(dot(unit(arm), -1.0 * unit(s.gravity)));
        low = std::min(low, tilt);
        high = std::max(high, tilt);
    }
    const auto all = r->quantities(0.01, adapter::Scheme::Unknown);
    const Trajectory run = exactRun(s, *r, s.duration / 6000, 6000);
    for (const auto& [name, expected] : {std::pair{"tilt_max", high}, std::pair{"tilt_min", low}}) {
        const Quantity* q = findQuantity(all, name);
        if (q == nullptr) continue;
        EXPECT_NEAR(q->measure(run).value(), q->exact, 1e-5) << name;
        EXPECT_TRUE(std::abs(q->exact - expected) < 1e-5 || std::abs(pi - q->exact - expected) < 1e-5)
            << name;
    }
    EXPECT_FALSE(all.empty());
}

TEST(SphericalPendulum, WithoutGravityThereIsNoTiltToSpeakOf) {
    Scenario s = loadScenario(findScenario("heavy_top_nutation")).scenario;
    s.gravity = {};
    EXPECT_TRUE(makeReference(s)->quantities(0.01, adapter::Scheme::Unknown).empty());
}

// ------------------------------------------------------------------------------------------- planar linkage
TEST(PlanarLinkage, AMotorGivesItsTorqueUntilItsSpeedAndHoldsItThen) {
    for (const char* name : {"four_bar_linkage", "four_bar_linkage_2d", "slider_crank", "slider_crank_2d"})
        for (const bool turned : {false, true}) {
            Scenario s = loadScenario(findScenario(name)).scenario;
            s.duration = 0.6;
            // Gravity askew.
            s.gravity = {2, -3, 0};
            const int crank = findBody(s, "crank");
            for (auto& joint : s.joints)
                for (auto& axis : joint.axes) axis.motorMaxForce = 0;
            Joint* drive = nullptr;
            for (auto& joint : s.joints)
                if (std::min(joint.bodyA, joint.bodyB) < 0 && std::max(joint.bodyA, joint.bodyB) == crank)
                    drive = &joint;
            ASSERT_NE(drive, nullptr);
            for (auto& body : s.bodies) body.velocity = body.angularVelocity = {};
            const double most = turned ? 60 : 45, speed = (turned ? -1.5 : 2.0);
            drive->axes[0].motorMaxForce = most;
            drive->axes[0].motorSpeed = speed;
            const auto r = makeReference(s);
            const double sense = drive->bodyB == crank ? 1 : -1;
            const Vec3 axis{0, 0, 1};
            const auto rate = [&](double t) {
                return sense * dot(r->exact(crank, t).angularVelocity.value(), axis);
            };
            // The time at which the speed is reached.
            double low = 0, high = 0.6;
            ASSERT_NEAR(std::abs(rate(0.6)), std::abs(speed), 1e-9) << name;
            const double way = rate(0.6) > 0 ? 1 : -1;
            for (int k = 0; k < 60; ++k) {
                const double t = (low + high) / 2;
                (way * rate(t) < std::abs(speed) - 1e-9 ? low : high) = t;
            }
            // Work of the motor until then is its torque times the angle.
            const int steps = 400;
            double angle = 0;
            for (int k = 0; k < steps; ++k) {  // Simpson's rule
                const double a = low * k / steps, h = low / steps;
                angle += h / 6 * (rate(a) + 4 * rate(a + h / 2) + rate(a + h));
            }
            EXPECT_NEAR(energyOf(s, *r, low) - energyOf(s, *r, 0), way * most * angle, 1e-6) << name;
            for (const double t : {low + 0.01, 0.5})
                EXPECT_NEAR(way * rate(t), std::abs(speed), 1e-9) << name;
            for (const int body : r->bodies()) expectConsistent(s, *r, body, low / 2, 1e-6, low / 20);
            for (const auto& joint : s.joints) {
                if (joint.type != JointType::Hinge || joint.bodyA == kNone || joint.bodyB == kNone) continue;
                expectNear(pointAt(*r, joint.bodyA, low / 2, joint.anchorA),
                           pointAt(*r, joint.bodyB, low / 2, joint.anchorB), 1e-11);
            }
        }
}

// ------------------------------------------------------------------------------------------- spring network
TEST(SpringNetwork, TheRadialPeriodOfUnequalBodiesIsThatOfTheirDistance) {
    Scenario s = emptyScene(3, {}, 5);
    addBall(s, "a", 0.1, 3, 0.4, {0.2, 0, 0}, {0, 0.5, 0});
    addBall(s, "b", 0.1, 0.7, 0.4, {1.6, 0.3, 0}, {0, -1.1, 0.4});
    s.forces.push_back(SpringForce{0, 1, {}, {}, 30, 0, 0.9});
    setReference(s, "spring_network");
    const auto r = makeReference(s);
    const auto apart = [&](double t) { return norm(*r->exact(1, t).position - *r->exact(0, t).position); };
    // Brute force: time between the first two minima of the distance.
    std::vector<double> minima;
    for (int k = 1; k + 1 < 50000 && minima.size() < 2; ++k) {
        const double h = 1e-4, a = apart((k - 1) * h), b = apart(k * h), c = apart((k + 1) * h);
        if (b < a && b <= c) minima.push_back(k * h + h * (a - c) / (2 * (a - 2 * b + c)));
    }
    ASSERT_EQ(minima.size(), 2U);
    const auto all = r->quantities(0.01, adapter::Scheme::Unknown);
    const Quantity* period = findQuantity(all, "radial_period");
    ASSERT_NE(period, nullptr);
    EXPECT_NEAR(period->exact, minima[1] - minima[0], 1e-6);
    EXPECT_NEAR(period->measure(exactRun(s, *r, 0.002, 2500)).value(), period->exact, 1e-6);
}

TEST(SpringNetwork, StepsOfTheExplicitSchemeUnderGravityWithADamper) {
    Scenario s = emptyScene(2, {0.3, -9.81, 0}, 1);
    addBall(s, "bob", 0.1, 1.6, 0.5, {0.4, -1, 0}, {0.5, 0.2, 0});
    s.bodies[0].gravityScale = 0.8;
    s.forces.push_back(SpringForce{kNone, 0, {0.1, 0.2, 0}, {}, 25, 1.2, 0.7});
    setReference(s, "spring_network");
    const auto r = makeReference(s);
    Vec3 x = s.bodies[0].pose.position, v = s.bodies[0].velocity;
    for (int k = 0; k < 60; ++k) {
        const Vec3 d = x - Vec3{0.1, 0.2, 0}, n = unit(d);
        const Vec3 a = 0.8 * s.gravity - ((25 * (norm(d) - 0.7) + 1.2 * dot(v, n)) / 1.6) * n;
        x += 0.004 * v;
        v += 0.004 * a;
    }
    const auto scheme = r->schemeExact(0, 60, 0.004, adapter::Scheme::ExplicitEuler);
    ASSERT_TRUE(scheme.has_value());
    expectNear(*scheme->position, x, 1e-12);
    expectNear(*scheme->velocity, v, 1e-12);
}

}  // namespace
}  // namespace rigor::validation::testing
