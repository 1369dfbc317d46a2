// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The order of the integrators of second order with friction, rolling and impacts, by fits over many step sizes: against
// closed forms, or between runs where there is none. Symplectic Euler, of order 1, is measured beside it: the fits
// distinguish one from the other.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/pipeline/tests/order_fit.hpp"
#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class SecondOrder : public testing::Test {};
using SecondOrderSpaces = testing::Types<Space2d, Space3d>;
TYPED_TEST_SUITE(SecondOrder, SecondOrderSpaces);

/// Position and velocity of a block that slides to rest, v0 / (mu g) = 0.886 s.
TYPED_TEST(SecondOrder, ABlockSlidesToRest) {
    using S = TypeParam;
    const double v0 = 3.217, mu = 0.37, time = 2;
    const auto x = [&](const std::string& integrator, int steps) {
        World<S> world(earthWith<S>(integrator));
        const auto wood = world.addMaterial(mu, 0);
        addGround<S>(world, wood);
        const BodyId block = addCube<S>(world, 0, 0.5, 0.5, 2, wood, v0);
        runSteps(world, time, steps);
        return Eigen::VectorXd::Constant(1, world.pose(block).p[0]).eval();
    };
    const Eigen::VectorXd exact = Eigen::VectorXd::Constant(1, v0 * v0 / (2 * mu * kGravity));
    std::vector<int> steps;
    for (int n = 60; n <= 2000; n = n * 6 / 5 + 1) steps.push_back(n);
    // The error of order 2 is between zero and its largest, depending on when in its step the block stops.
    EXPECT_NEAR(orderAgainst(x, "moreau_midpoint", time, exact, steps), 2, 0.3);
    EXPECT_NEAR(orderAgainst(x, "symplectic_euler", time, exact, steps), 1, 0.1);
    EXPECT_LT((x("moreau_midpoint", 120) - exact).norm(), 5e-4);
}

/// A sphere that slips, then rolls: at 5/7 of its speed.
TYPED_TEST(SecondOrder, ASphereSlipsThenRolls) {
    using S = TypeParam;
    const double v0 = 4.1, mu = 0.23, r = 0.1, time = 1.5;
    const auto x = [&](const std::string& integrator, int steps) {
        World<S> world(earthWith<S>(integrator));
        const auto felt = world.addMaterial(mu, 0);
        addGround<S>(world, felt);
        const BodyId ball = addBall<S>(world, 0, r, r, 1, felt, v0);
        runSteps(world, time, steps);
        return Eigen::VectorXd::Constant(1, world.pose(ball).p[0]).eval();
    };
    const double slip = 2 * v0 / (7 * mu * kGravity);
    const Eigen::VectorXd exact = Eigen::VectorXd::Constant(
        1, v0 * slip - 0.5 * mu * kGravity * slip * slip + 5.0 / 7 * v0 * (time - slip));
    std::vector<int> steps;
    for (int n = 45; n <= 1500; n = n * 6 / 5 + 1) steps.push_back(n);
    EXPECT_NEAR(orderAgainst(x, "moreau_midpoint", time, exact, steps), 2, 0.3);
    EXPECT_NEAR(orderAgainst(x, "symplectic_euler", time, exact, steps), 1, 0.1);
    EXPECT_LT((x("moreau_midpoint", 90) - exact).norm(), 5e-4);
}

/// A velocity that is set counts from the end of the last step on.
TYPED_TEST(SecondOrder, AVelocityThatIsSetMovesTheBody) {
    using S = TypeParam;
    World<S> world(earthWith<S>("moreau_midpoint"));
    const BodyId ball = addBall<S>(world, 0, 5, 0.2, 1, 0, 1, 2);
    runSteps(world, 0.5, 30);
    const typename S::Vec from = world.pose(ball).p;
    world.setVelocity(ball, at<S>(-3, 4), spin<S>(0));
    runSteps(world, 0.5, 30);
    EXPECT_NEAR(world.pose(ball).p[0], from[0] - 1.5, 1e-12);
    EXPECT_NEAR(world.pose(ball).p[1], from[1] + 2 - 0.125 * kGravity, 1e-12);
    const typename S::Vec then = world.pose(ball).p;
    runSteps(world, 0.5, 10);  // another step size
    EXPECT_NEAR(world.pose(ball).p[0], then[0] - 1.5, 1e-12);
    EXPECT_NEAR(world.pose(ball).p[1], then[1] + 0.5 * (4 - 0.5 * kGravity) - 0.125 * kGravity, 1e-12);
}

/// A block that is launched across a slope: friction turns with its way.
TEST(SecondOrderInSpace, ABlockSlidesOnACurve) {
    using S = Space3d;
    const auto state = [](const std::string& integrator, int steps) {
        WorldDef<S> def = earthWith<S>(integrator);
        def.gravity = {4.2, -8.7, 0};
        World<S> world(def);
        const auto wood = world.addMaterial(0.4, 0);
        addGround<S>(world, wood);
        BodyDef<S> body;
        body.mass = 1;
        body.inertia = isotropic<S>(0.04);
        body.pose.p = {0, 0.02, 0};
        body.velocity = {0, 0, 2};
        const BodyId block = world.addBody(body);
        attach<S>(world, block, Box<S>{{0.25, 0.02, 0.25}}, wood);
        runSteps(world, 1, steps);
        return placesAndVelocities(world, {block});
    };
    const std::vector<int> steps{60, 120, 240, 480};
    EXPECT_NEAR(orderBetweenRuns(state, "moreau_midpoint", 1, steps), 2, 0.1);
    EXPECT_NEAR(orderBetweenRuns(state, "symplectic_euler", 1, steps), 1, 0.1);
}

/// A ball with side spin: its slip keeps its direction, so that the ball goes along a parabola, which is exact.
TEST(SecondOrderInSpace, ABallWithSideSpinSlips) {
    using S = Space3d;
    const auto state = [](const std::string& integrator, int steps) {
        World<S> world(earthWith<S>(integrator));
        const auto felt = world.addMaterial(0.15, 0);
        addGround<S>(world, felt);
        BodyDef<S> def;
        def.mass = 1;
        def.inertia = isotropic<S>(0.4 * 0.1 * 0.1);
        def.pose.p = {0, 0.1, 0};
        def.velocity = {3, 0, 0.5};
        def.angularVelocity = {30, 5, 10};
        const BodyId ball = world.addBody(def);
        attach<S>(world, ball, Sphere<S>{0.1}, felt);
        runSteps(world, 0.5, steps);
        return placesAndVelocities(world, {ball});
    };
    for (const int steps : {30, 77})
        EXPECT_LT((state("moreau_midpoint", steps) - state("moreau_midpoint", 960)).norm(), 1e-9) << steps;
    EXPECT_NEAR(orderBetweenRuns(state, "symplectic_euler", 0.5, {60, 120, 240, 480}), 1, 0.1);
}

// --- impacts
/// A ball that bounces, 4 or 5 times in 1.9 s: exact at every step size.
TYPED_TEST(SecondOrder, ABallBouncesAtTheTimesOfItsImpacts) {
    using S = TypeParam;
    const double e = 0.8, radius = 0.1, drop = 1.03, time = 1.9;
    double fall = std::sqrt(2 * drop / kGravity), speed = e * kGravity * fall;
    while (time - fall > 2 * speed / kGravity) {
        fall += 2 * speed / kGravity;
        speed *= e;
    }
    const double rest = time - fall, height = speed * rest - 0.5 * kGravity * rest * rest;
    for (const int steps : {38, 114, 457, 1824}) {
        World<S> world(earthWith<S>("moreau_midpoint"));
        const auto rubber = world.addMaterial(0, e);
        addGround<S>(world, rubber);
        const BodyId ball = addBall<S>(world, 0, drop + radius, radius, 1, rubber);
        std::size_t impacts = 0;
        for (int i = 0; i < steps; ++i) impacts += world.step(time / steps).impacts.size();
        EXPECT_NEAR(world.pose(ball).p[1], radius + height, 1e-12) << steps;
        EXPECT_NEAR(world.velocity(ball)[1], speed - kGravity * rest, 1e-11) << steps;
        EXPECT_EQ(impacts, 3u) << steps;
    }
}

/// A disc or sphere that spins between two rough walls and a floor, and hits another in flight: ways without
/// forces are straight, so that all is exact whatever the step.
TYPED_TEST(SecondOrder, StraightWaysBetweenImpactsAreExact) {
    using S = TypeParam;
    const auto state = [](int steps) {
        WorldDef<S> def;
        def.integrator = "moreau_midpoint";
        World<S> world(def);
        const auto rough = world.addMaterial(0.3, 0.9);
        addGround<S>(world, rough);
        BodyDef<S> wall;
        wall.type = BodyType::Static;
        attach<S>(world, world.addBody(wall), HalfSpace<S>{at<S>(1, 0), -1}, rough);
        attach<S>(world, world.addBody(wall), HalfSpace<S>{at<S>(-1, 0), -2}, rough);
        const BodyId first = addBall<S>(world, 0, 0.4, 0.1, 1, rough, 1.7, -1.1, 6),
                     second = addBall<S>(world, 0.9, 0.3, 0.15, 2, rough, -0.7, 0.2, -3);
        runSteps(world, 3, steps);
        return placesAndVelocities(world, {first, second});
    };
    const Eigen::VectorXd fine = state(3000);
    for (const int steps : {45, 180, 731}) EXPECT_NEAR((state(steps) - fine).norm(), 0, 1e-8) << steps;
}

/// A stick that tumbles and hits the ground with friction: its free rotation is exact, and so is all.
TYPED_TEST(SecondOrder, AStickTumblesOverBounces) {
    using S = TypeParam;
    const auto state = [](const std::string& integrator, int steps) {
        World<S> world(earthWith<S>(integrator));
        const auto wood = world.addMaterial(0.4, 0.7);
        addGround<S>(world, wood);
        BodyDef<S> def;
        def.mass = 1.2;
        def.inertia = isotropic<S>(0.05);
        def.pose.p = at<S>(0, 1.1);
        def.pose.q = expMap(spin<S>(0.7));
        def.velocity = at<S>(1.2, 0.5);
        def.angularVelocity = spin<S>(2.3);
        const BodyId stick = world.addBody(def);
        attach<S>(world, stick, Capsule<S>{0.3, 0.05}, wood);
        runSteps(world, 1.2, steps);
        return placesAndVelocities(world, {stick});
    };
    const Eigen::VectorXd fine = state("moreau_midpoint", 4000);
    for (const int steps : {60, 171, 555}) {
        EXPECT_LT((state("moreau_midpoint", steps) - fine).norm(), 1e-8) << steps;
        EXPECT_GT((state("symplectic_euler", steps) - fine).norm(), 1e-3) << steps;
    }
}

/// A block that falls flat on the ground, does not bounce, and slides.
TYPED_TEST(SecondOrder, ABlockLandsAndSlides) {
    using S = TypeParam;
    const double drop = 0.37, mu = 0.3, vx = 3.1, time = 0.6;
    const double fall = std::sqrt(2 * drop / kGravity), landed = vx - mu * kGravity * fall,
                 rest = time - fall;
    const auto x = [&](const std::string& integrator, int steps) {
        World<S> world(earthWith<S>(integrator));
        const auto wood = world.addMaterial(mu, 0);
        addGround<S>(world, wood);
        const BodyId block = addCube<S>(world, 0, 0.2 + drop, 0.2, 1, wood, vx);
        runSteps(world, time, steps);
        Eigen::VectorXd all(2);
        all << world.pose(block).p[0], world.pose(block).p[1] - 0.2;
        return all;
    };
    Eigen::VectorXd exact(2);
    exact << vx * fall + landed * rest - 0.5 * mu * kGravity * rest * rest, 0;
    for (const int steps : {36, 100, 400}) {
        EXPECT_LT((x("moreau_midpoint", steps) - exact).norm(), 1e-11) << steps;
    }
}

/// A body of three moments of inertia that falls on an edge of its capsule and bounces off, twice.
TEST(SecondOrderInSpace, AnUnevenBodyTumblesOverBounces) {
    using S = Space3d;
    const auto state = [](const std::string& integrator, int steps) {
        World<S> world(earthWith<S>(integrator));
        const auto wood = world.addMaterial(0.4, 0.8);
        addGround<S>(world, wood);
        BodyDef<S> def;
        def.mass = 1.2;
        def.inertia = Eigen::Vector3d(0.05, 0.02, 0.035).asDiagonal();
        def.pose.p = {0, 1.1, 0};
        def.pose.q = expMap(Eigen::Vector3d(0.2, 0.4, 0.9));
        def.velocity = {0.6, 0.5, -0.3};
        def.angularVelocity = {1.5, -4, 2.3};
        const BodyId body = world.addBody(def);
        attach<S>(world, body, Capsule<S>{0.3, 0.05}, wood);
        runSteps(world, 1.1, steps);
        Eigen::VectorXd all(13);
        all << world.pose(body).p, world.pose(body).q.coeffs(), world.velocity(body),
            world.angularVelocity(body) / 10;
        return all;
    };
    std::vector<int> steps;
    for (int n = 110; n < 2000; n = n * 7 / 5 + 1) steps.push_back(n);
    const double order = orderBetweenRuns(state, "moreau_midpoint", 1.1, steps);
    EXPECT_GE(order, 1.9);
    EXPECT_LE(order, 2.3);
    EXPECT_GT((state("symplectic_euler", 110) - state("symplectic_euler", 220)).norm(), 1e-2);
}

}  // namespace
}  // namespace rigor::engine::test
