// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Mechanisms in maximal coordinates against references that use none of their equations (angles, closed
// forms, quaternions about a fixed point), against published values and, where RIGOR_DATA names the folder,
// against the histories of textbook benchmarks computed elsewhere.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>

#include "scenarios/loader/loader.hpp"
#include "validation/references/tests/newton_euler.hpp"
#include "validation/references/tests/other_units.hpp"

namespace rigor::validation::testing {
namespace {

using std::numbers::pi;

Scenario libraryScene(const std::string& name, const std::vector<std::string>& overrides = {}) {
    return loadScenario(findScenario(name), overrides).scenario;
}

// ------------------------------------------------------------------------------------------- second methods
TEST(Mechanism, AgreesWithEveryReferenceThatUsesAngles) {
    const std::pair<const char*, double> scenes[] = {
        {"four_bar_linkage", 0.5},   {"four_bar_linkage_2d", 0.5}, {"slider_crank", 0.5},
        {"slider_crank_2d", 0.5},    {"hooke_joint", 0.5},         {"double_pendulum_2d", 0.5},
        {"pendulum_chain", 0.5},     {"cart_pendulum", 0.5},       {"cart_pendulum_2d", 0.5},
        {"rod_pendulum", 0.5},       {"physical_pendulum", 0.5},   {"spherical_pendulum", 0.5},
        {"heavy_top_nutation", 0.4}, {"conical_pendulum", 0.5},    {"rotating_hoop", 0.5},
    };
    for (const auto& [name, end] : scenes) {
        Scenario s = libraryScene(name);
        s.duration = end;
        for (auto& joint : s.joints)
            for (auto& axis : joint.axes) axis.motorMaxForce = 0.0;
        const auto own = makeReference(s);
        setReference(s, "mechanism");
        const auto mechanism = makeReference(s);
        ASSERT_GT(mechanism->validUntil(), end) << name;
        for (const int body : own->bodies())
            for (const double t : {0.37 * end, end}) {
                const auto a = own->exact(body, t), b = mechanism->exact(body, t);
                EXPECT_LT(norm(*a.position - *b.position), 1e-8) << name;
                EXPECT_LT(norm(*a.velocity - *b.velocity), 1e-7) << name;
                if (!a.angularVelocity) continue;
                EXPECT_LT(norm(*a.angularVelocity - *b.angularVelocity), 1e-7) << name;
            }
    }
}

TEST(Mechanism, ForcesOnTheBodiesAreThoseOfTheJoints) {
    Scenario s = libraryScene("bricard_loop");
    s.duration = 0.6;
    const auto r = makeReference(s);
    const double t = 0.4;
    // The sum of forces and of torques about the origin on all five bars is what the two outer hinges give:
    // no torque of the first about its own axis through its anchor, none of the last about its own beyond it.
    Vec3 outer{}, moment{};
    for (const int body : r->bodies()) {
        expectConsistent(s, *r, body, t, 1e-8);
        const Wrench w = wrenchOn(s, *r, body, t);
        outer += w.force;
        moment += w.torque + cross(w.com, w.force);
    }
    EXPECT_GT(norm(outer), 10.0);
    EXPECT_NEAR(energyOf(s, *r, t), energyOf(s, *r, 0), 1e-9);
    // Neighbours are joined at their hinge and have its axis in common.
    for (const auto& joint : s.joints) {
        const Vec3 a = joint.bodyA == kNone ? joint.anchorA : pointAt(*r, joint.bodyA, t, joint.anchorA);
        expectNear(a, pointAt(*r, joint.bodyB, t, joint.anchorB), 1e-9);
        const Vec3 n =
            joint.bodyA == kNone ? joint.axisA : rotate(*r->exact(joint.bodyA, t).orientation, joint.axisA);
        expectNear(n, rotate(*r->exact(joint.bodyB, t).orientation, joint.axisB), 1e-9);
    }
    // d'Alembert: what acts does no work on the one motion that is possible, the actual one.
    double power = 0.0;
    for (const int body : r->bodies()) {
        const Wrench w = wrenchOn(s, *r, body, t);
        power +=
            dot(w.force, *r->exact(body, t).velocity) + dot(w.torque, *r->exact(body, t).angularVelocity);
    }
    EXPECT_NEAR(power, 0.0, 1e-6);
}

TEST(Mechanism, SuperfluousJointsChangeNothing) {
    Scenario s = libraryScene("four_bar_linkage_2d");
    s.duration = 0.5;
    for (auto& joint : s.joints)
        for (auto& axis : joint.axes) axis.motorMaxForce = 0.0;
    setReference(s, "mechanism");
    const auto once = makeReference(s);
    s.joints.push_back(s.joints.back());
    s.joints.back().name = "again";
    const auto twice = makeReference(s);
    for (const int body : once->bodies())
        expectNear(*once->exact(body, 0.5).position, *twice->exact(body, 0.5).position, 1e-10);
}

TEST(Mechanism, SpringsDampersAndLoadsAreThoseOfTheScenario) {
    // A rod on a hinge with a spring and damper off its centre and a load for a while: in its angle alone.
    Scenario s = emptyScene(2, {0, -9.81, 0}, 1);
    addBox(s, "rod", {0.5, 0.02, 0.02}, 2, {0.5, 0, 0});
    s.bodies[0].massProperties.inertia = Mat3::diagonal(0, 0, 2.0 / 12);
    addJoint(s, JointType::Hinge, kNone, 0, {});
    s.forces.push_back(SpringForce{kNone, 0, {0.7, 0.9, 0}, {0.2, 0, 0}, 80, 3, 0.5});
    s.forces.push_back(ConstantForce{0, {1, 2, 0}, {0, 0, 4}, 0.2, 0.6});
    setReference(s, "mechanism");
    const auto r = makeReference(s);
    double angle = 0.0, rate = 0.0;
    const auto slope = [&](double t, double q, double u) {
        const Vec3 e{std::cos(q), std::sin(q), 0}, n{-std::sin(q), std::cos(q), 0};
        const Vec3 p = 0.7 * e, d = p - Vec3{0.7, 0.9, 0};
        const double l = norm(d), pull = 80 * (l - 0.5) + 3 * dot(d, 0.7 * u * n) / l;
        double torque = -2 * 9.81 * 0.5 * e.x - cross(p, (pull / l) * d).z;
        if (t >= 0.2 && t < 0.6) torque += 4 + cross(0.5 * e, {1, 2, 0}).z;
        return torque / (2.0 / 3);
    };
    const int steps = 20000;
    for (int k = 0; k < steps; ++k) {  // classical Runge-Kutta
        const double h = 1.0 / steps, t = k * h + 1e-12;
        const double a1 = slope(t, angle, rate), u2 = rate + h / 2 * a1;
        const double a2 = slope(t, angle + h / 2 * rate, u2), u3 = rate + h / 2 * a2;
        const double a3 = slope(t, angle + h / 2 * u2, u3), u4 = rate + h * a3;
        const double a4 = slope(t, angle + h * u3, u4);
        angle += h / 6 * (rate + 2 * u2 + 2 * u3 + u4);
        rate += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    EXPECT_NEAR(r->exact(0, 1).angularVelocity->z, rate, 1e-4);
    EXPECT_NEAR(std::remainder(angleAboutZ(*r->exact(0, 1).orientation) - angle, 2 * pi), 0.0, 1e-5);
}

TEST(Mechanism, ALongRunIsAnsweredUpToWhereNeighboursPartInAnyUnits) {
    Scenario s = libraryScene("bricard_loop");
    s.gravity = 30 * s.gravity;
    s.duration = 60;
    const auto r = makeReference(s);
    EXPECT_GT(r->validUntil(), 0.5);
    EXPECT_LT(r->validUntil(), 60);
    Scenario other = s;
    ASSERT_TRUE(inUnits(other, {1048576, 1024, 1}));
    EXPECT_EQ(makeReference(other)->validUntil(), 1024 * r->validUntil());
}

TEST(Mechanism, RefusesWhatItDoesNotKnow) {
    const auto bricard = [] { return libraryScene("bricard_loop"); };
    Scenario s = bricard();
    s.bodies[1].angularVelocity = {0, 1, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = bricard();
    s.joints[2].anchorB.x += 1e-3;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = bricard();
    s.joints[2].axes[0].motorMaxForce = 1;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = bricard();
    s.joints[5].type = JointType::Fixed;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = bricard();
    s.joints.clear();
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

TEST(Mechanism, AndrewsSqueezerAtThirtyMilliseconds) {
    Scenario s = libraryScene("andrews_squeezer_2d");
    s.duration = 0.03;
    const auto r = makeReference(s);
    ASSERT_GT(r->validUntil(), 0.03);
    // IVP Test Set, 14 digits: turns of the bodies are sums of the catalogued angles, from their start.
    const double beta = 15.81077119629904, theta = -15.75637105984298, gamma = 0.04082224013073101,
                 phi = -0.5347301163226948, delta = 0.5244099658805304, omega = 0.5347301163226948,
                 epsilon = 1.048080741042263;
    const double start[] = {-0.0617138900142764, 0,
                            0.4552798191630704,  0.2226683901658859,
                            0.4873649795438425,  -0.2226683901658859,
                            1.2305474445498212};
    const double turns[] = {beta - start[0],   beta + theta - start[0] - start[1],
                            gamma - start[2],  phi + delta - start[3] - start[4],
                            delta - start[4],  omega + epsilon - start[5] - start[6],
                            epsilon - start[6]};
    for (int i = 0; i < 7; ++i)
        EXPECT_NEAR(std::remainder(angleAboutZ(*r->exact(i, 0.03).orientation) - turns[i], 2 * pi), 0.0, 2e-7)
            << s.bodies[i].name;
}

// ------------------------------------------------------------------------------------------- parallel_bars
TEST(ParallelBars, AgreeWithTheSolvedMechanismBetweenTheFlatPositions) {
    for (const char* name : {"parallel_windows", "parallel_windows_2d"}) {
        Scenario s = libraryScene(name);
        s.duration = 0.6;
        const auto closed = makeReference(s);
        setReference(s, "mechanism");
        const auto solved = makeReference(s);
        for (const double t : {0.2, 0.5})
            for (const int body : closed->bodies()) {
                const auto a = closed->exact(body, t), b = solved->exact(body, t);
                expectNear(*a.position, *b.position, 1e-9);
                expectNear(*a.velocity, *b.velocity, 1e-8);
                expectNear(*a.angularVelocity, *b.angularVelocity, 1e-8);
            }
    }
}

TEST(ParallelBars, EnergyStaysAndThePeriodIsMeasuredThroughTheFlatPosition) {
    Scenario s = libraryScene("parallel_windows_2d");
    s.duration = 6;
    const auto r = makeReference(s);
    for (const double t : {0.5, 1.1, 2.3, 5.7}) EXPECT_NEAR(energyOf(s, *r, t), energyOf(s, *r, 0), 1e-10);
    const auto all = r->quantities(0.01, adapter::Scheme::Unknown);
    const Quantity* period = findQuantity(all, "period");
    ASSERT_NE(period, nullptr);
    EXPECT_NEAR(period->measure(exactRun(s, *r, 0.002, 3000)).value(), period->exact, 1e-6);
    for (const double t : {0.3, 0.9})
        expectNear(*r->exact(0, t).position, *r->exact(0, t + period->exact).position, 1e-9);
}

TEST(ParallelBars, RefuseOtherLinkages) {
    const auto base = [] { return libraryScene("parallel_windows_2d"); };
    Scenario s = base();
    s.bodies[0].angularVelocity = {0, 0, 2};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = base();
    s.joints[0].anchorA.y -= 0.1;
    s.joints[0].anchorB.y -= 0.1;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = base();
    s.bodies[1].gravityScale = 0.5;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = base();
    s.joints.pop_back();
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

}  // namespace
}  // namespace rigor::validation::testing
