// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The traps of ODE that the adapter works around, and the options that leave them open.
#include <cmath>
#include <cstring>

#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

double turned(const Quat& q) {
    return 2.0 * std::atan2(norm(Vec3{q.x, q.y, q.z}), std::abs(q.w));
}

/// A flat box sliding at 45 degrees over a floor; its path relative to v^2 / (2 mu g).
double slidingRatio(const std::string& options) {
    Scenario s = scene(0.5);
    addStatic(s, Box{{20, 1, 20}}, {0, -1, 0});
    const int b = addBody(s, Box{{0.5, 0.1, 0.5}}, {0, 0.1, 0}, 2.0, boxMoments(2.0, {0.5, 0.1, 0.5}));
    s.bodies.back().velocity = Vec3{3, 0, 3} / std::sqrt(2.0);
    Simulation simulation(s, 1.0 / 240.0, options);
    const Vec3 end = simulation.seconds(2.0).state(b).position;
    return std::hypot(end.x, end.z) / (9.0 / (2.0 * 0.5 * 9.81));
}

/// A pile of boxes with about 4 contacts each.
Scenario pile(int count) {
    Scenario s = scene(0.5);
    addStatic(s, HalfSpace{});
    for (int i = 0; i < count; ++i)
        addBody(s, Box{{0.25, 0.25, 0.25}}, {0.3 * (i % 3), 0.3 + 0.55 * (i / 3), 0.05 * (i % 2)}, 1.0,
                boxMoments(1.0, {0.25, 0.25, 0.25}));
    return s;
}

TEST(OdeErrors, AnErrorInsideOdeIsAnExceptionAndOtherWorldsGoOn) {
    Scenario lost = scene();
    addBody(lost, Sphere{0.5}, {});
    addStatic(lost, Sphere{0.5}, {5, 0, 0});
    lost.bodies[0].velocity = {1e300, 0, 0};
    Scenario fine = scene();
    const int b = addBody(fine, Sphere{0.5}, {});
    Simulation other(fine, 0.01);
    {
        // The hash space asserts on bounds of this size, in the middle of its work.
        Simulation broken(lost, 0.01, "preset=matched,space=hash");
        EXPECT_THROW(broken.steps(5), std::runtime_error);
        EXPECT_THROW(broken.steps(1), std::runtime_error);
    }
    other.steps(100);
    EXPECT_NEAR(other.state(b).velocity.y, -9.81, 1e-12);
}

TEST(OdeFriction, TheSquareFollowsTheSlidingInMatched) {
    EXPECT_NEAR(slidingRatio("preset=matched"), 1.0, 1e-2);
    // Both tangents brake with mu if their axes are fixed: 1 / sqrt(2).
    EXPECT_NEAR(slidingRatio("preset=matched,friction=pyramid_world"), std::sqrt(0.5), 1e-2);
}

TEST(OdeFriction, ABoxOnASlopeAcrossTheAxesSlipsWhenItShould) {
    for (const auto& [slope, moves] : {std::pair{0.4, false}, {0.6, true}}) {
        Scenario s = scene(0.5);
        // Gravity leans at 45 degrees to the world's axes instead of the floor.
        const double down = 9.81 / std::sqrt(1.0 + slope * slope), along = slope * down;
        s.gravity = {along * std::sqrt(0.5), -down, along * std::sqrt(0.5)};
        addStatic(s, Box{{20, 1, 20}}, {0, -1, 0});
        const int b = addBody(s, Box{{0.5, 0.1, 0.5}}, {0, 0.1, 0}, 2.0, boxMoments(2.0, {0.5, 0.1, 0.5}));
        const Vec3 end = Simulation(s, 1.0 / 240.0).seconds(1.0).state(b).position;
        const double expected = moves ? 0.5 * (along - 0.5 * down) : 0.0;
        EXPECT_NEAR(std::hypot(end.x, end.z), expected, 5e-3) << "slope " << slope;
    }
}

TEST(OdeRotation, FiniteIsExactAndInfinitesimalTurnsByTheArcTangent) {
    Scenario s = scene();
    s.gravity = {};
    const int b = addBody(s, Sphere{0.5}, {});
    s.bodies[0].angularVelocity = {0, 0, 1.0};
    EXPECT_NEAR(turned(Simulation(s, 1.0).steps(1).state(b).orientation), 1.0, 1e-12);
    Simulation first(s, 1.0, "preset=default");
    EXPECT_NEAR(turned(first.steps(1).state(b).orientation), 2.0 * std::atan(0.5), 1e-12);
}

TEST(OdeGyroscopic, ExternalKeepsTheMomentumAndOdesOwnIsFirstOrder) {
    const Vec3 moments{1, 1, 2}, spin{0.5, 0, 4};
    const auto drift = [&](const std::string& gyroscopic, double dt) {
        Scenario s = scene();
        s.gravity = {};
        const int b = addBody(s, Sphere{0.5}, {}, 1.0, moments);
        s.bodies[0].angularVelocity = spin;
        Simulation simulation(s, dt, "preset=matched,gyroscopic=" + gyroscopic);
        const BodyState state = simulation.seconds(2.0).state(b);
        const Vec3 w = rotateInverse(state.orientation, state.angularVelocity);
        const Vec3 now = rotate(state.orientation, Vec3{moments.x * w.x, moments.y * w.y, moments.z * w.z});
        return norm(now - Vec3{0.5, 0, 8});
    };
    EXPECT_LE(drift("external", 0.01), 1e-10);
    const double coarse = drift("ode", 0.01), fine = drift("ode", 0.0025);
    EXPECT_GT(coarse, 1e-4);
    EXPECT_LT(fine, 0.5 * coarse);
    EXPECT_GT(drift("none", 0.01), 10.0 * coarse);
}

TEST(OdeSolver, StepsWithTooManyContactsFallBackAndTheLedgerSaysSo) {
    Simulation direct(pile(12), 1.0 / 120.0, "preset=matched,worldstep_limit=0");
    direct.seconds(0.5);
    EXPECT_EQ(direct.ledgerLine("solver_fallback"), nullptr);
    Simulation limited(pile(12), 1.0 / 120.0, "preset=matched,worldstep_limit=20");
    limited.seconds(0.5);
    EXPECT_GT(limited.contacts().size(), 20u);
    const auto* line = limited.ledgerLine("solver_fallback");
    ASSERT_NE(line, nullptr);
    EXPECT_NE(line->resolved.find("of 60 steps"), std::string::npos) << line->resolved;
}

TEST(OdeSolver, QuickStepRepeatsBitForBitAndTheSeedMatters) {
    const auto run = [](const std::string& seed) {
        Simulation simulation(pile(9), 1.0 / 120.0, "preset=default,stepper=quickstep,seed=" + seed);
        return simulation.seconds(1.0).state(9);
    };
    const BodyState first = run("3"), again = run("3"), other = run("4");
    EXPECT_EQ(std::memcmp(&first, &again, sizeof first), 0);
    EXPECT_NE(std::memcmp(&first, &other, sizeof first), 0);
}

TEST(OdeSolver, EverySpaceGivesTheSameBits) {
    const auto run = [](const std::string& space) {
        return Simulation(pile(9), 1.0 / 120.0, "preset=matched,space=" + space).seconds(1.0).state(9);
    };
    const BodyState expected = run("simple");
    for (const char* space : {"hash", "sap", "quadtree"}) {
        const BodyState found = run(space);
        EXPECT_EQ(std::memcmp(&expected, &found, sizeof expected), 0) << space;
    }
}

TEST(OdePlanar, BodiesNeverLeaveThePlane) {
    Scenario s = scene(0.5, 0.3, 2);
    addStatic(s, HalfSpace{});
    for (int i = 0; i < 4; ++i) {
        const int b = addBody(s, Box{{0.3, 0.2, 0}}, {0.1 * i, 0.4 + 0.6 * i, 0}, 1.0, even(0.05));
        s.bodies[b].angularVelocity = {0, 0, 1.0 * i};
    }
    Simulation simulation(s, 1.0 / 120.0);
    simulation.seconds(2.0);
    for (int b = 1; b <= 4; ++b) {
        const BodyState state = simulation.state(b);
        EXPECT_EQ(state.position.z, 0.0);
        EXPECT_EQ(state.velocity.z, 0.0);
        EXPECT_EQ(state.orientation.x, 0.0);
        EXPECT_EQ(state.orientation.y, 0.0);
        EXPECT_EQ(state.angularVelocity.x, 0.0);
    }
    for (const ContactPoint& c : simulation.contacts()) EXPECT_EQ(c.pointA.z, 0.0);
}

}  // namespace
}  // namespace rigor::test
