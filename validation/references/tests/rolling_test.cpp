// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies that roll and slip in 3D, tripods, a ball on a ball, block and wedge: catalogued values, constants
// of the motion, and contact forces by Newton's and Euler's laws.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenarios/loader/loader.hpp"
#include "validation/references/tests/newton_euler.hpp"

namespace rigor::validation::testing {
namespace {

using adapter::Scheme;
using std::numbers::pi;

void expectQuat(Quat a, Quat b, double tolerance) {
    const double sign = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z < 0 ? -1 : 1;
    for (const double d : {sign * a.w - b.w, sign * a.x - b.x, sign * a.y - b.y, sign * a.z - b.z})
        EXPECT_NEAR(d, 0.0, tolerance);
}

/// Floor normal and "up" along z, as in the catalogue.
Scenario upright(double friction, double duration) {
    Scenario s = emptyScene(3, {0, 0, -9.81}, duration);
    s.materials[0].friction = friction;
    addFloor(s, {0, 0, 1});
    return s;
}
/// Ball whose centre is at `off` from the centre of mass (= body origin); rolls, or slips from rest of its
/// centre of mass.
Scenario ball(double a, Vec3 off, double mass, Mat3 inertia, Quat q, Vec3 spin, double friction, bool rolls,
              double duration) {
    Scenario s = upright(friction, duration);
    q = normalized(q);
    const Vec3 contact = rotate(q, off) - Vec3{0, 0, a};
    addBody(s, "ball", BodyType::Dynamic, Sphere{a}, {0, 0, -contact.z});
    Body& body = s.bodies.back();
    body.shapes[0].pose.position = off;
    body.pose.orientation = q;
    body.massProperties = {mass, {}, inertia};
    body.angularVelocity = spin;
    body.velocity = rolls ? cross(contact, spin) : Vec3{0, 0, -cross(spin, contact).z};
    setReference(s, "rolling_body");
    return s;
}
/// The contact force pushes, acts at the contact, and is inside the cone or against the slip.
void expectContact(const Scenario& s, const Reference& r, double t, Vec3 arm, bool slips) {
    const Wrench w = wrenchOn(s, r, 1, t, 1e-4);
    const Vec3 n{0, 0, 1};
    const double load = dot(w.force, n), mu = s.materials[0].friction;
    const Vec3 friction = w.force - load * n;
    EXPECT_LT(norm(w.torque - cross(arm, w.force)), 2e-6) << t;
    EXPECT_GT(load, 0.0);
    const auto e = r.exact(1, t);
    const Vec3 slip = *e.velocity + cross(*e.angularVelocity, arm);
    if (slips) {
        EXPECT_NEAR(dot(slip, n), 0.0, 1e-9);
        EXPECT_LT(norm(friction + (mu * load / norm(slip)) * slip), 2e-6);
    } else {
        EXPECT_LT(norm(slip), 1e-11);
        EXPECT_LE(norm(friction), mu * load);
    }
    expectConsistent(s, r, 1, t, 1e-7, 1e-4);
}

TEST(RollingBody, BallOfChaplygin) {
    const Scenario s = ball(0.5, {}, 1, Mat3::diagonal(0.1, 0.15, 0.2), {}, {1, 2, 3}, 5, true, 2.5);
    const auto r = makeReference(s);
    expectQuat(*r->exact(1, 1).orientation, {0.3543899264, -0.05634223638, -0.4603820547, -0.8119616347},
               1e-9);
    expectQuat(*r->exact(1, 2).orientation, {0.746612587, -0.05515664475, 0.4519006461, 0.4850909147}, 1e-9);
    expectNear(*r->exact(1, 2).position, {1.899245298, -0.7644931868, 0.5}, 1e-8);
    expectContact(s, *r, 1.3, {0, 0, -0.5}, false);
    const auto all = r->quantities(0.01, Scheme::Unknown);
    ASSERT_EQ(all.size(), 3U);
    // The catalogue's constant vector (0.35, 0.8, 0.6), and constant it is.
    const double k2 = all[0].exact * all[0].exact + all[1].exact * all[1].exact + all[2].exact * all[2].exact;
    EXPECT_NEAR(k2, 0.35 * 0.35 + 0.8 * 0.8 + 0.6 * 0.6, 1e-12);
    const Trajectory run = exactRun(s, *r, 0.05, 50);
    for (const auto& q : all) EXPECT_NEAR(q.measure(run).value(), q.exact, 1e-11) << q.name;
}

TEST(RollingBody, BallOfRouthKeepsItsEnergyAndJellettsConstant) {
    const Quat q{0.8, 0.6, 0, 0};
    const Scenario s =
        ball(0.2, {0, 0, 0.05}, 1, Mat3::diagonal(0.016, 0.016, 0.014), q, rotate(q, {1, 2, 5}), 5, true, 1);
    const auto r = makeReference(s);
    expectQuat(*r->exact(1, 0.5).orientation, {0.1133109449, -0.192160706, -0.1439401643, 0.9641141644},
               1e-9);
    expectQuat(*r->exact(1, 1).orientation, {0.8600275085, 0.4570806751, -0.1702330838, -0.1498353703}, 1e-9);
    EXPECT_NEAR(r->exact(1, 1).position->z, 0.1737902046, 1e-9);
    EXPECT_NEAR(energyOf(s, *r, 0), 2.507462, 1e-6);
    EXPECT_NEAR(energyOf(s, *r, 1), energyOf(s, *r, 0), 1e-11);
    const auto all = r->quantities(0.01, Scheme::Unknown);
    const Quantity* jellett = findQuantity(all, "jellett");
    ASSERT_NE(jellett, nullptr);
    EXPECT_NEAR(jellett->measure(exactRun(s, *r, 0.05, 20)).value(), jellett->exact, 1e-12);
}

TEST(RollingBody, TippeTopSlips) {
    // The axis e = (0.6, 0, 0.8) is the body's z axis.
    const Quat q = fromAxisAngle({0, 1, 0}, std::atan2(0.6, 0.8));
    const Scenario s =
        ball(0.1, {0, 0, 0.02}, 1, Mat3::diagonal(0.004, 0.004, 0.004), q, {0, 0, 100}, 0.3, false, 0.25);
    const auto r = makeReference(s);
    const auto axis = [&](double t) { return rotate(*r->exact(1, t).orientation, {0, 0, 1}); };
    expectNear(axis(0.05), {0.191088636, -0.5974117759, 0.7788352221}, 1e-8);
    expectNear(axis(0.2), {0.3440785395, 0.6001740946, 0.7220810307}, 1e-8);
    const auto all = r->quantities(0.01, Scheme::Unknown);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_NEAR(all[0].exact, 0.0336, 1e-12);
    EXPECT_NEAR(all[0].measure(exactRun(s, *r, 0.01, 25)).value(), 0.0336, 1e-11);
    for (const double t : {0.03, 0.17}) expectContact(s, *r, t, 0.02 * axis(t) - Vec3{0, 0, 0.1}, true);
    EXPECT_NEAR(dot(wrenchOn(s, *r, 1, 0.05, 1e-5).force, {0, 0, 1}), 9.023232091, 1e-4);
}

TEST(RollingBody, ALoadThatVanishesBetweenWideSamplesIsSeen) {
    // The weight beside the axis lifts the ball off within the first turn at 300 turns a second.
    const Quat q = fromAxisAngle({0, 1, 0}, 0.4);
    const Scenario s =
        ball(0.1, {0, 0, 0.015}, 1, Mat3::diagonal(0.0042, 0.0042, 0.0038), q, {0, 0, 5000}, 0.6, false, 0.3);
    const auto r = makeReference(s);
    EXPECT_LT(r->validUntil(), 0.0015);
    for (int k = 1; k < 40; ++k) {
        const double t = r->validUntil() * k / 40;
        EXPECT_GT(wrenchOn(s, *r, 1, t, 1e-7).force.z, 0.0) << t;
    }
}

/// A disc of half thickness h on its rim: normal at `theta` from the vertical, rates along e1, e2, e3.
Scenario disc(double theta, Vec3 rates, double a, double h, double A, double C, double duration) {
    Scenario s = upright(8, duration);
    const double c = std::cos(theta), si = std::sin(theta);
    const Vec3 e1{1, 0, 0}, e2{0, c, si}, e3{0, -si, c};
    const Vec3 arm = -a * e2 - h * e3, w = rates.x * e1 + rates.y * e2 + rates.z * e3;
    addBody(s, "disc", BodyType::Dynamic, Cylinder{a, h}, {0, 0, -arm.z});
    Body& body = s.bodies.back();
    body.pose.orientation = fromAxisAngle({1, 0, 0}, pi / 2 + theta);
    body.massProperties = {1, {}, Mat3::diagonal(A, C, A)};
    body.angularVelocity = w;
    body.velocity = cross(arm, w);
    setReference(s, "rolling_body");
    return s;
}

TEST(RollingBody, DiscOnItsRim) {
    const Scenario s = disc(1.2, {0, 0.5, 3}, 1, 1e-13, 0.25, 0.5, 1.1);
    const auto r = makeReference(s);
    const auto theta = [&](double t) { return std::acos(rotate(*r->exact(1, t).orientation, {0, 1, 0}).z); };
    EXPECT_NEAR(theta(0.5), 0.7874168233, 1e-9);
    EXPECT_NEAR(theta(1), 1.033684213, 1e-9);
    EXPECT_NEAR(energyOf(s, *r, 1), energyOf(s, *r, 0), 1e-11);
    // A thick disc, where the contact is out of the middle plane.
    const Scenario thick = disc(1.1, {0.2, 0.7, 4}, 0.8, 0.15, 0.2, 0.33, 0.6);
    const auto t = makeReference(thick);
    const Vec3 e3 = rotate(*t->exact(1, 0.4).orientation, {0, 1, 0});
    const Vec3 p = Vec3{0, 0, 1} - e3.z * e3;
    expectContact(thick, *t, 0.4, -0.15 * e3 - 0.8 * unit(p), false);
}

TEST(RollingBody, EulersDiscPrecessesSteadily) {
    // Centre at rest: W^2 sin(theta) = m g a/A.
    const double theta = 0.3, a = 0.5, A = 0.0625, C = 0.125, W = std::sqrt(9.81 * a / (A * std::sin(theta)));
    const Vec3 rates{0, W * std::sin(theta), 0};  // no spin about e3: the contact runs round under the centre
    const Scenario s = disc(theta, rates, a, 1e-13, A, C, 0.5);
    const auto r = makeReference(s);
    for (const double t : {0.1, 0.3, 0.5}) {
        EXPECT_NEAR(rotate(*r->exact(1, t).orientation, {0, 1, 0}).z, std::cos(theta), 1e-11);
        expectNear(*r->exact(1, t).position, s.bodies[1].pose.position, 1e-11);
    }
}

TEST(RollingBody, EndsWhereFrictionDoesNotHold) {
    Scenario s = disc(0.9, {0, 0.5, 3}, 1, 1e-13, 0.25, 0.5, 1.5);
    s.materials[0].friction = 0.45;
    double until = 0.0;
    try {
        until = makeReference(s)->validUntil();
    } catch (const AssumptionViolated&) {
    }
    EXPECT_LT(until, 1.5);
    Scenario other = ball(0.5, {}, 1, Mat3::diagonal(0.1, 0.15, 0.2), {}, {1, 2, 3}, 5, true, 1);
    other.bodies[1].pose.position.z += 0.01;
    EXPECT_THROW(makeReference(other), AssumptionViolated);
}

// --------------------------------------------------------------------------------------------- tripod_slide
TEST(TripodSlide, CatalogueAndLoads) {
    Scenario s = upright(0.3, 0.5);
    const double H = 0.1, foot = 0.02;
    addBody(s, "tripod", BodyType::Dynamic, Sphere{foot}, {0, 0, H});
    Body& body = s.bodies.back();
    body.shapes.clear();
    for (int i = 0; i < 3; ++i)
        body.shapes.push_back(
            {Sphere{foot},
             {{0.3 * std::cos(2 * pi * i / 3), 0.3 * std::sin(2 * pi * i / 3), foot - H}, {}},
             0});
    body.massProperties = {1, {}, Mat3::diagonal(0.03, 0.03, 0.05)};
    body.velocity = {2, 0, 0};
    body.angularVelocity = {0, 0, 4};
    setReference(s, "tripod_slide");
    const auto r = makeReference(s);
    expectNear(*r->exact(1, 0.2).position, {0.3479801703, -0.0008713682751, H}, 1e-9);
    expectNear(*r->exact(1, 0.4).position, {0.5900918326, -0.008258394405, H}, 1e-9);
    EXPECT_NEAR(r->exact(1, 0.4).angularVelocity->z, 1.667948019, 1e-9);
    // Second method: with the catalogue's loads the forces at the feet give force and torque of the motion.
    const double loads[] = {3.57704032, 2.65567882, 3.57728086};
    const Wrench w = wrenchOn(s, *r, 1, 0.4, 1e-4);
    Vec3 force{}, torque{};
    const auto e = r->exact(1, 0.4);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 arm = rotate(*e.orientation, body.shapes[i].pose.position) - Vec3{0, 0, foot};
        const Vec3 slip = *e.velocity + cross(*e.angularVelocity, arm);
        const Vec3 f = loads[i] * (Vec3{0, 0, 1} - 0.3 * unit(slip));
        force += f;
        torque += cross(arm, f);
    }
    expectNear(w.force, force, 1e-7);
    expectNear(w.torque, torque, 1e-7);
    s.bodies[1].shapes.pop_back();
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

// --------------------------------------------------------------------------------------------- ball_off_ball
Scenario ballOnBall(int dimension, double friction, double angle, double duration) {
    Scenario s = emptyScene(dimension, {0, -9.81, 0}, duration);
    s.materials[0].friction = friction;
    addBody(s, "base", BodyType::Static, Sphere{1}, {});
    addBall(s, "ball", 0.1, 1, dimension == 2 ? 0.5 : 0.4, {1.1 * std::sin(angle), 1.1 * std::cos(angle), 0});
    setReference(s, "ball_off_ball");
    return s;
}

TEST(BallOffBall, LeavesAtTheClosedFormAngle) {
    const Scenario s = ballOnBall(3, 0, 0.1, 1.2);
    const auto r = makeReference(s);
    const auto angle = [&](const Reference& ref, double t) {
        return std::atan2(ref.exact(1, t).position->x, ref.exact(1, t).position->y);
    };
    // cos = 2/3 cos(0.1) at t = 0.95138..., and free fall after it.
    EXPECT_NEAR(angle(*r, 0.9513851107), 0.8455282019, 1e-9);
    EXPECT_NEAR(norm(*r->exact(1, 0.95).position), 1.1, 1e-12);
    EXPECT_GT(norm(*r->exact(1, 0.96).position), 1.1 + 1e-9);
    expectNear(wrenchOn(s, *r, 1, 1.1).force, {}, 1e-8);
    EXPECT_NEAR(energyOf(s, *r, 1.1), energyOf(s, *r, 0), 1e-11);
    const auto all = r->quantities(0.01, Scheme::Unknown);
    ASSERT_EQ(all.size(), 2U);
    const Trajectory run = exactRun(s, *r, 0.002, 600);
    EXPECT_NEAR(all[0].measure(run).value(), all[0].exact, 1e-6);
    EXPECT_NEAR(all[1].measure(run).value(), all[1].exact, 1e-5);
}

TEST(BallOffBall, RollsThenSlipsThenLeaves) {
    for (const int dimension : {2, 3}) {
        const Scenario s = ballOnBall(dimension, 0.6, 0.2, 1.2);
        const auto r = makeReference(s);
        const double k = dimension == 2 ? 0.5 : 0.4;
        for (const double t : {0.3, 0.6, 0.8, 0.9}) {
            const Wrench w = wrenchOn(s, *r, 1, t, 1e-4);
            const Vec3 n = unit(w.com);
            const double load = dot(w.force, n);
            const Vec3 friction = w.force - load * n, arm = -0.1 * n;
            const auto e = r->exact(1, t);
            const Vec3 slip = *e.velocity + cross(*e.angularVelocity, arm);
            EXPECT_LT(norm(w.torque - cross(arm, w.force)), 1e-6);
            EXPECT_GT(load, 0.0);
            if (norm(slip) < 1e-9) {
                EXPECT_LE(norm(friction), 0.6 * load + 1e-7);
            } else {
                EXPECT_LT(norm(friction + (0.6 * load / norm(slip)) * slip), 1e-6);
            }
            expectConsistent(s, *r, 1, t, 1e-8, 1e-4);
        }
        // Rolling to the end (friction without bound) would leave at cos = 2 cos(th0)/(3 + k).
        const Scenario rough = ballOnBall(dimension, 30, 0.2, 1.3);
        const auto rolls = makeReference(rough);
        double leaves = 0;
        for (double t = 0.5; t < 1.3; t += 1e-4)
            if (norm(*rolls->exact(1, t).position) > 1.1 + 1e-10) {
                leaves = t;
                break;
            }
        const Vec3 x = *rolls->exact(1, leaves).position;
        EXPECT_NEAR(x.y / norm(x), 2 * std::cos(0.2) / (3 + k), 6e-3);
    }
    Scenario s = ballOnBall(3, 0, 0.1, 1);
    s.bodies[1].velocity = {0, 0, 0.1};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

// ----------------------------------------------------------------------------------------------- wedge_block
Scenario wedgeScene(int dimension, double mu, double alpha) {
    Scenario s = emptyScene(dimension, {0, -9.81, 0}, 0.4);
    s.materials.push_back({"smooth", 0.0, 0.0, 1000.0});
    s.materials[0].friction = mu;
    addBody(s, "floor", BodyType::Static, HalfSpace{}, {});
    s.bodies[0].shapes[0].material = 1;
    // The slope falls towards +x from (0, h) to (b, 0).
    const double b = 2, h = b * std::tan(alpha);
    std::vector<Vec3> corners;
    for (const double z : dimension == 3 ? std::vector<double>{-0.5, 0.5} : std::vector<double>{0.0})
        for (const Vec3 p : {Vec3{0, 0, z}, Vec3{b, 0, z}, Vec3{0, h, z}}) corners.push_back(p);
    const Vec3 center{b / 3, h / 3, 0};
    for (Vec3& c : corners) c = c - center;
    addBody(s, "wedge", BodyType::Dynamic, ConvexHull{corners}, center);
    s.bodies.back().massProperties = {2, {}, Mat3::diagonal(1, 1, 1)};
    const Vec3 n{std::sin(alpha), std::cos(alpha), 0};
    addBox(s, "block", {0.2, 0.1, dimension == 3 ? 0.2 : 0.0}, 1,
           Vec3{0.5, h - 0.5 * std::tan(alpha), 0} + 0.1 * n);
    s.bodies.back().pose.orientation = fromAxisAngle({0, 0, 1}, -alpha);
    setReference(
        s, "wedge_block",
        {{"wedge", std::string("wedge")}, {"block", std::string("block")}, {"floor", std::string("floor")}});
    return s;
}

TEST(WedgeBlock, CatalogueValuesAndMomentum) {
    for (const int dimension : {2, 3})
        for (const double mu : {0.0, 0.2}) {
            const Scenario s = wedgeScene(dimension, mu, pi / 6);
            const auto r = makeReference(s);
            const double A = mu == 0.0 ? 1.88793538 : 1.283330806, relative = mu == 0.0 ? 6.54 : 4.445588318;
            const Vec3 wedge = *r->exact(1, 0.3).velocity / 0.3, block = *r->exact(2, 0.3).velocity / 0.3;
            EXPECT_NEAR(wedge.x, -A, 1e-8);
            EXPECT_NEAR(wedge.y, 0.0, 1e-12);
            EXPECT_NEAR(norm(block - wedge), relative, 1e-8);
            EXPECT_NEAR(2 * wedge.x + block.x, 0.0, 1e-12);
            // The force on the block is inside, or on, the cone about the face's normal.
            const Vec3 n{std::sin(pi / 6), std::cos(pi / 6), 0}, f = wrenchOn(s, *r, 2, 0.2).force;
            EXPECT_NEAR(norm(f - dot(f, n) * n), mu * dot(f, n), 1e-8);
            EXPECT_TRUE(mu == 0 || std::abs(dot(f, n) - 7.854043808) < 1e-7);
            const auto all = r->quantities(0.01, Scheme::Unknown);
            EXPECT_NEAR(all[0].measure(exactRun(s, *r, 0.01, 40)).value(), A, 1e-8);
        }
}

TEST(WedgeBlock, RestsBelowTheFrictionAngleAndRefusesTipping) {
    const Scenario s = wedgeScene(2, 0.6, pi / 6);
    EXPECT_EQ(norm(*makeReference(s)->exact(2, 0.4).velocity), 0.0);
    Scenario tall = wedgeScene(2, 0.55, pi / 6);
    std::get<Box>(tall.bodies[2].shapes[0].geometry).halfExtents = {0.05, 0.3, 0};
    const Vec3 n{std::sin(pi / 6), std::cos(pi / 6), 0};
    tall.bodies[2].pose.position += 0.2 * n;
    EXPECT_THROW(makeReference(tall), AssumptionViolated);
    Scenario rough = wedgeScene(2, 0.2, pi / 6);
    rough.materials[1].friction = 0.5;
    EXPECT_THROW(makeReference(rough), AssumptionViolated);
}

TEST(RollingBody, AChiralBallTurnsItsSpinRoundAndItsMirrorImageDoesNot) {
    Scenario s = loadScenario(findScenario("chiral_ball")).scenario;
    const int ball = findBody(s, "ball");
    const auto spin = [&](const Scenario& scene, double t) {
        return makeReference(scene)->exact(ball, t).angularVelocity->y;
    };
    EXPECT_GT(spin(s, 0), 0.6);
    EXPECT_LT(spin(s, 2.1), -0.2);
    const auto r = makeReference(s);
    for (const double t : {1.0, 2.5}) {
        EXPECT_NEAR(energyOf(s, *r, t), energyOf(s, *r, 0), 1e-10);
        // No work at the touch: the contact point is at rest.
        const auto e = r->exact(ball, t);
        const Vec3 touch{e.position->x, 0, e.position->z};
        EXPECT_LT(norm(*e.velocity + cross(*e.angularVelocity, touch - centerAt(s, *r, ball, t))), 1e-10);
    }
    // A ball with the inertia mirrored (x to -x) and the same start is another ball and turns in another way.
    Scenario mirrored = s;
    Mat3& inertia = mirrored.bodies[ball].massProperties.inertia;
    for (const auto& [i, j] : {std::pair{0, 1}, std::pair{1, 0}, std::pair{0, 2}, std::pair{2, 0}})
        inertia(i, j) = -inertia(i, j);
    EXPECT_GT(std::abs(spin(mirrored, 2.1) - spin(s, 2.1)), 0.1);
}

}  // namespace
}  // namespace rigor::validation::testing
