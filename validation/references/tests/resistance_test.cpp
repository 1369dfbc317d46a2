// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rolling and torsional friction and moving surfaces: closed forms against small steps of the laws themselves, and
// the refusals of references that do not know them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "validation/references/rolling/line_roll.hpp"
#include "validation/references/tests/newton_euler.hpp"

namespace rigor::validation {
namespace {

using namespace testing;

/// Moreau's time stepping of the laws: an implicit step finds the force and the moment by fixed-point iteration on
/// their projections.
LineRoll::State stepped(const LineRoll::Setup& s, double velocity, double roll, double end, int steps) {
    LineRoll::State x{0, velocity, 0, roll};
    const double h = end / steps, k = s.k;
    double f = 0, c = 0;
    for (int n = 0; n < steps; ++n) {
        double v = 0, q = 0;
        for (int i = 0; i < 400; ++i) {
            v = x.velocity + h * (s.pull + f);
            q = x.roll + h * (c - f) / k;
            const double nextF = std::clamp(f - (v - q) / (h * (1 + 1 / k)), -s.sliding, s.sliding);
            const double turned = x.roll + h * (c - nextF) / k;
            const double nextC = std::clamp(c - turned * k / h, -s.resistance, s.resistance);
            if (std::abs(nextF - f) + std::abs(nextC - c) < 1e-14) break;
            f = nextF;
            c = nextC;
        }
        v = x.velocity + h * (s.pull + f);
        q = x.roll + h * (c - f) / k;
        x.way += 0.5 * h * (x.velocity + v);
        x.turned += 0.5 * h * (x.roll + q);
        x.velocity = v;
        x.roll = q;
    }
    return x;
}

TEST(LineRoll, IsTheLimitOfSmallStepsOfTheLaws) {
    std::mt19937 random(7);
    const auto uniform = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    for (int i = 0; i < 200; ++i) {
        LineRoll::Setup s;
        s.sliding = s.holding = uniform(0, 1) < 0.1 ? 0.0 : uniform(0, 3);
        s.resistance = uniform(0, 1) < 0.2 ? 0.0 : uniform(0, 1.5);
        s.pull = uniform(0, 1) < 0.5 ? 0.0 : uniform(-2, 2);
        s.k = uniform(0.2, 1);
        const double v = uniform(-2, 2), q = uniform(0, 1) < 0.4   ? v
                                             : uniform(0, 1) < 0.3 ? 0.0
                                                                   : uniform(-2, 2);
        const LineRoll roll(s, v, q);
        const LineRoll::State exact = roll.at(1.5), small = stepped(s, v, q, 1.5, 3000);
        SCOPED_TRACE(::testing::Message()
                     << i << ": pull " << s.pull << ", sliding " << s.sliding << ", resistance "
                     << s.resistance << ", k " << s.k << ", v " << v << ", q " << q);
        EXPECT_NEAR(exact.velocity, small.velocity, 4e-3);
        EXPECT_NEAR(exact.roll, small.roll, 8e-3);
        EXPECT_NEAR(exact.way, small.way, 4e-3);
        EXPECT_NEAR(exact.turned, small.turned, 8e-3);
    }
}

TEST(LineRoll, StaticFrictionLetsABallRollThatWouldSlide) {
    const LineRoll::Setup slides{2, 0.3, 0.3, 0.1, 0.4}, holds{2, 0.3, 2, 0.1, 0.4};
    EXPECT_DOUBLE_EQ(LineRoll(slides, 0, 0).at(1).velocity, 1.7);
    EXPECT_DOUBLE_EQ(LineRoll(slides, 0, 0).at(1).roll, 0.5);
    EXPECT_DOUBLE_EQ(LineRoll(holds, 0, 0).at(1).velocity, 1.9 / 1.4);
    EXPECT_FALSE(LineRoll(slides, 0, 0).rollTime());
    EXPECT_EQ(*LineRoll(holds, 0, 0).rollTime(), 0.0);
}

Scenario ballOnFloor(double rolling, double torsional) {
    Scenario s = emptyScene(3, {0, -9.81, 0}, 2);
    s.materials[0].friction = 0.5;
    s.materials[0].rollingFriction = rolling;
    s.materials[0].torsionalFriction = torsional;
    addFloor(s, {0, 1, 0});
    addBall(s, "body", 0.1, 2, 0.4, {0, 0.1, 0});
    setReference(s, "rolling_resistance");
    return s;
}

TEST(RollingResistance, StopsWhereItsWorkHasTakenTheEnergy) {
    Scenario s = ballOnFloor(0.01, 0);
    s.bodies[1].velocity = {0.6, 0, 0.8};
    s.bodies[1].angularVelocity = {8, 0, -6};
    const auto r = makeReference(s);
    const double energy = 0.5 * 2 * 1 * 1.4;  // m v^2 (1 + k)/2
    const double moment = 0.01 * 2 * 9.81, way = energy / moment * 0.1;
    const Vec3 end = *r->exact(1, 2).position;
    EXPECT_NEAR(norm(end - s.bodies[1].pose.position), way, 1e-12);
    EXPECT_NEAR(end.x / end.z, 0.75, 1e-12);
    EXPECT_EQ(norm(*r->exact(1, 2).velocity), 0.0);
    expectConsistent(s, *r, 1, 0.4, 1e-9);
    EXPECT_EQ(r->quantities(0.01, adapter::Scheme::SymplecticEuler).front().name, "stop_distance");
}

TEST(RollingResistance, SpinEndsByTorsionalFrictionWhateverTheBallRolls) {
    Scenario s = ballOnFloor(0.002, 0.004);
    s.bodies[1].velocity = {1, 0, 0};
    s.bodies[1].angularVelocity = {0, 3, -10};
    const auto r = makeReference(s);
    const double braking = 0.004 * 9.81 / (0.4 * 0.01);
    EXPECT_NEAR(r->exact(1, 0.2).angularVelocity->y, 3 - 0.2 * braking, 1e-12);
    EXPECT_EQ(r->exact(1, 1).angularVelocity->y, 0.0);
    EXPECT_NEAR(r->exact(1, 1).velocity->x, 1 - 0.002 * 9.81 / 0.1 / 1.4, 1e-12);
    EXPECT_FALSE(r->exact(1, 1).orientation) << "about two axes";
}

TEST(RollingResistance, OthersRefuseItAndItRefusesCurves) {
    Scenario s = ballOnFloor(0.01, 0);
    s.bodies[1].velocity = {1, 0, 0};
    setReference(s, "slip_to_roll");
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    setReference(s, "rolling_resistance");
    s.bodies[1].angularVelocity = {5, 0, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s.bodies[1].angularVelocity = {};
    s.bodies[0].shapes[0].surfaceVelocity.linear = {1, 0, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated) << "a belt is for conveyor";
}

/// The laws of a ball on a level floor in small explicit steps of the fourth order, while it slides.
struct Oblique {
    double mu, rho, g, r, k;
    using State = std::array<double, 6>;  ///< vx, vz, wx, wz, x, z; the normal is y
    State derivative(const State& y) const {
        // u = v - r w x n with n = y: w x n = (-wz, wx).
        const double ux = y[0] + r * y[3], uz = y[1] - r * y[2];
        const double slip = std::hypot(ux, uz), turning = std::hypot(y[2], y[3]);
        const double fx = -mu * g * ux / slip, fz = -mu * g * uz / slip;
        // The torque of f at -r n is -r n x f = -r (fz, -fx).
        return {fx,
                fz,
                (-r * fz - rho * g * y[2] / turning) / (k * r * r),
                (r * fx - rho * g * y[3] / turning) / (k * r * r),
                y[0],
                y[1]};
    }
    void step(State& y, double h) const {
        const auto plus = [](const State& a, double s, const State& b) {
            State c = a;
            for (std::size_t i = 0; i < c.size(); ++i) c[i] += s * b[i];
            return c;
        };
        const State a = derivative(y), b = derivative(plus(y, h / 2, a)), c = derivative(plus(y, h / 2, b)),
                    d = derivative(plus(y, h, c));
        for (std::size_t i = 0; i < y.size(); ++i) y[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    }
};

Scenario obliqueBall(double rolling, double torsional) {
    Scenario s = ballOnFloor(rolling, torsional);
    s.materials[0].friction = 0.2;
    s.bodies[1].velocity = {1.5, 0, 0.3};
    s.bodies[1].angularVelocity = {6, 9, 4};
    setReference(s, "oblique_rolling");
    return s;
}

TEST(ObliqueRolling, IsWhatSmallStepsOfTheLawsGive) {
    const Scenario s = obliqueBall(0.012, 0.003);
    const auto r = makeReference(s);
    const double end = r->quantities(0.01, adapter::Scheme::SymplecticEuler).front().exact;
    const Oblique law{0.2, 0.012, 9.81, 0.1, 0.4};
    Oblique::State y{1.5, 0.3, 6, 4, 0, 0};
    const int steps = 20000;
    const double h = 0.98 * end / steps;
    for (int i = 0; i < steps; ++i) law.step(y, h);
    const PartialState at = r->exact(1, 0.98 * end);
    EXPECT_NEAR(at.velocity->x, y[0], 1e-10);
    EXPECT_NEAR(at.velocity->z, y[1], 1e-10);
    EXPECT_NEAR(at.angularVelocity->x, y[2], 1e-9);
    EXPECT_NEAR(at.angularVelocity->z, y[3], 1e-9);
    EXPECT_NEAR(at.position->x, y[4], 1e-10);
    EXPECT_NEAR(at.position->z, y[5], 1e-10);
    EXPECT_NEAR(at.angularVelocity->y, 9 - 0.003 * 9.81 / (0.4 * 0.01) * 0.98 * end, 1e-12);
    // It then rolls, along a straight line.
    const PartialState rolls = r->exact(1, end + 0.05), later = r->exact(1, end + 0.15);
    EXPECT_NEAR(rolls.velocity->x, -0.1 * rolls.angularVelocity->z, 1e-11);
    EXPECT_NEAR(rolls.velocity->z, 0.1 * rolls.angularVelocity->x, 1e-11);
    EXPECT_NEAR(norm(*rolls.velocity) - norm(*later.velocity), 0.012 / 0.1 * 9.81 / 1.4 * 0.1, 1e-12);
    EXPECT_NEAR(later.velocity->x * rolls.velocity->z, later.velocity->z * rolls.velocity->x, 1e-12);
    EXPECT_EQ(norm(*makeReference(s)->exact(1, 2).velocity), 0.0) << "at rest";
}

TEST(ObliqueRolling, WithoutRollingFrictionIsTheParabolaOfSlipToRoll) {
    Scenario s = obliqueBall(0, 0);
    const auto curve = makeReference(s);
    setReference(s, "slip_to_roll");
    const auto parabola = makeReference(s);
    for (const double t : {0.05, 0.2, 0.4, 0.9, 1.7}) {
        EXPECT_LT(norm(*curve->exact(1, t).position - *parabola->exact(1, t).position), 1e-12) << t;
        EXPECT_LT(norm(*curve->exact(1, t).velocity - *parabola->exact(1, t).velocity), 1e-12) << t;
        EXPECT_LT(norm(*curve->exact(1, t).angularVelocity - *parabola->exact(1, t).angularVelocity), 1e-10)
            << t;
    }
}

TEST(ObliqueRolling, RefusesWhatItDoesNotKnow) {
    Scenario s = obliqueBall(0.012, 0);
    s.gravity = {1, -9.81, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated) << "a slope";
    s = obliqueBall(0.012, 0);
    s.bodies[1].angularVelocity = {0, 3, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated) << "does not turn along the floor";
    s = obliqueBall(0.03, 0);
    EXPECT_THROW(makeReference(s), AssumptionViolated) << "rolls in no case";
}

TEST(Conveyor, ABlockComesToRideAndABallRollsAtItsShare) {
    Scenario s = emptyScene(3, {0, -9.81, 0}, 2);
    s.materials[0].friction = 0.3;
    addFloor(s, {0, 1, 0});
    s.bodies[0].shapes[0].surfaceVelocity.linear = {1, 0, -0.5};
    addBox(s, "body", {0.2, 0.05, 0.2}, 1, {0, 0.05, 0});
    s.bodies[1].velocity = {-1, 0, 1};
    setReference(s, "conveyor");
    const auto r = makeReference(s);
    const double speed = std::sqrt(4 + 2.25), stop = speed / (0.3 * 9.81);
    expectNear(*r->exact(1, 1.5).velocity, {1, 0, -0.5}, 1e-13);
    // The way over the belt is half of what the speed at the start would give.
    expectNear(*r->exact(1, 1.5).position, Vec3{1.5, 0.05, -0.75} + 0.5 * stop * Vec3{-2, 0, 1.5}, 1e-12);
    expectNear(derivativeOf([&](double t) { return *r->exact(1, t).velocity; }, 0.3),
               0.3 * 9.81 / speed * Vec3{2, 0, -1.5}, 1e-8);
    s.bodies.pop_back();
    addBall(s, "body", 0.1, 2, 0.6, {0, 0.1, 0});
    setReference(s, "conveyor");
    const auto ball = makeReference(s);
    expectNear(*ball->exact(1, 1.5).velocity, 0.375 * Vec3{1, 0, -0.5}, 1e-13);
    s.materials[0].rollingFriction = 0.01;
    const auto rough = makeReference(s);
    EXPECT_GT(norm(*rough->exact(1, 1.9).velocity), norm(*ball->exact(1, 1.9).velocity))
        << "it is carried along";
}

TEST(Conveyor, ALandingHasTheImpulseOfFriction) {
    Scenario s = emptyScene(3, {0, -10, 0}, 2);
    s.materials[0].friction = 0.2;
    addFloor(s, {0, 1, 0});
    s.bodies[0].shapes[0].surfaceVelocity.linear = {3, 0, 0};
    addBox(s, "body", {0.3, 0.1, 0.3}, 1, {0, 0.1 + 0.2, 0});
    setReference(s, "conveyor");
    const auto r = makeReference(s);
    // It lands at 2 m/s after 0.2 s.
    EXPECT_NEAR(r->exact(1, 0.19).velocity->x, 0, 1e-9);
    EXPECT_NEAR(r->exact(1, 0.7).velocity->x, 0.2 * 2 + 0.5 * 0.2 * 10, 1e-9);
}

TEST(Turntable, ASurfaceThatTurnsIsATableThatTurns) {
    Scenario s = emptyScene(3, {0, -9.81, 0}, 2);
    s.materials[0].friction = 1;
    addFloor(s, {0, 1, 0});
    s.bodies[0].shapes[0] = {scenario::Box{{3, 0.5, 3}}, {}, 0, {{0, 0, 1.4}, {0, 2.8, 0}}};
    s.bodies[0].pose.position = {0.5, -0.5, 0};
    addBall(s, "body", 0.1, 2, 0.4, {0.5, 0.1, 0});
    s.bodies[1].velocity = {0, 0, 0.2};
    s.bodies[1].angularVelocity = {-12, 0, 0};
    setReference(s, "turntable");
    const auto r = makeReference(s);
    // The circle of 2/7 of the rate: back after 2 pi / 0.8 s, opposite after half of it.
    const Vec3 away = *r->exact(1, 1.5).velocity;
    EXPECT_NEAR(std::atan2(away.x, away.z), 0.8 * 1.5, 1e-12);
    const Vec3 p = *r->exact(1, 1.5).position, w = *r->exact(1, 1.5).angularVelocity;
    const Vec3 surface = cross({0, 2.8, 0}, p - Vec3{1, 0, 0});
    expectNear(away + cross(w, {0, -0.1, 0}), {surface.x, 0, surface.z}, 1e-12);
    s.bodies[0].shapes[0].surfaceVelocity.angular = {};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

TEST(SpinningDisc, TorsionalFrictionAddsItsShare) {
    Scenario s = emptyScene(3, {0, -10, 0}, 1);
    s.materials[0].torsionalFriction = 0.03;
    addFloor(s, {0, 1, 0});
    addBox(s, "body", {0.3, 0.05, 0.3}, 1, {0, 0.05, 0});
    s.bodies[1].shapes[0].geometry = scenario::Cylinder{0.2, 0.05};
    s.bodies[1].massProperties.inertia = Mat3::diagonal(0.011, 0.02, 0.011);
    s.bodies[1].angularVelocity = {0, 20, 0};
    setReference(s, "spinning_disc");
    for (const double mu : {0.0, 0.2}) {
        s.materials[0].friction = mu;
        const auto r = makeReference(s);
        // Even pressure has the mean arm 2/3 R.
        EXPECT_NEAR(r->exact(1, 0.5).angularVelocity->y, 20 - 0.5 * 10 * (0.03 + mu * 2 / 3 * 0.2) / 0.02,
                    1e-9);
    }
}

}  // namespace
}  // namespace rigor::validation
