// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The order of the integrators of second order with friction, rolling, joints and impacts, by fits over many
// step sizes: against closed forms, or between runs where there is none. Symplectic Euler, of order 1, is
// measured beside it: the fits distinguish one from the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
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

/// Bodies on a chain of hinges, the first on the ground; angles from the vertical.
template <class S>
std::vector<BodyId> addPendulums(World<S>& world, const std::vector<double>& angles) {
    std::vector<BodyId> bodies;
    typename S::Vec from = S::Vec::Zero();
    for (const double angle : angles) {
        const typename S::Vec down = at<S>(std::sin(angle), -std::cos(angle));
        BodyDef<S> def;
        def.mass = 1.3;
        def.inertia = isotropic<S>(0.07);
        def.pose.q = expMap(spin<S>(angle));
        def.pose.p = from + 0.5 * down;
        const BodyId body = world.addBody(def);
        JointDef<S> joint;
        joint.type = JointType::Hinge;
        joint.bodyB = body;
        joint.anchorB = at<S>(0, 0.5);
        if (!bodies.empty()) {
            joint.bodyA = bodies.back();
            joint.anchorA = at<S>(0, -0.5);
        }
        world.addJoint(joint);
        bodies.push_back(body);
        from += down;
    }
    return bodies;
}
template <class S>
Eigen::VectorXd placesAndVelocities(const World<S>& world, const std::vector<BodyId>& bodies) {
    std::vector<double> all;
    for (const BodyId id : bodies) {
        for (int k = 0; k < S::dim; ++k) all.push_back(world.pose(id).p[k]);
        for (int k = 0; k < S::dim; ++k) all.push_back(world.velocity(id)[k]);
    }
    return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

TYPED_TEST(SecondOrder, PendulumsSwing) {
    using S = TypeParam;
    for (const std::vector<double>& angles : {std::vector{1.2}, std::vector{0.9, 1.4}}) {
        const auto state = [&](const std::string& integrator, int steps) {
            World<S> world(earthWith<S>(integrator));
            const std::vector<BodyId> bodies = addPendulums(world, angles);
            runSteps(world, 2, steps);
            return placesAndVelocities(world, bodies);
        };
        EXPECT_NEAR(orderBetweenRuns(state, "moreau_midpoint", 2, {240, 480, 960}), 2, 0.1) << angles.size();
        EXPECT_NEAR(orderBetweenRuns(state, "symplectic_euler", 2, {960, 1920}), 1, 0.2) << angles.size();
    }
}

/// Energy over 40 000 steps: bounded, with a drift below its oscillation by orders.
TYPED_TEST(SecondOrder, PendulumsKeepTheirEnergy) {
    using S = TypeParam;
    const double mass = 1.3, inertia = 0.07;
    for (const std::vector<double>& angles : {std::vector{1.2}, std::vector{1.9, 2.4}}) {
        World<S> world(earthWith<S>("moreau_midpoint"));
        const std::vector<BodyId> bodies = addPendulums(world, angles);
        const auto energy = [&] {
            double sum = 0;
            for (const BodyId id : bodies) {
                const double w = spinOf<S>(world.angularVelocity(id));
                sum += 0.5 * mass * world.velocity(id).squaredNorm() + 0.5 * inertia * w * w +
                       mass * kGravity * world.pose(id).p[1];
            }
            return sum;
        };
        const double start = energy();
        double low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9};
        constexpr int kSteps = 40000;
        for (int i = 0; i < kSteps; ++i) {
            world.step(1.0 / 240);
            const double change = energy() - start;
            const int half = 2 * i / kSteps;
            low[half] = std::min(low[half], change);
            high[half] = std::max(high[half], change);
        }
        const bool tumbles = angles.size() > 1;
        EXPECT_LT(high[1], tumbles ? 0.3 : 6e-4) << angles.size();
        EXPECT_GT(low[1], tumbles ? -1e-3 : -1e-7) << angles.size();
        EXPECT_LT(high[1], 1.5 * high[0]) << angles.size();
    }
}

/// A rod pushed where it hangs so that it nearly turns over: what its motion begins with decides its period. Where joints are
/// put right alone on the way to the first midpoint it is 0.091 m off.
TYPED_TEST(SecondOrder, APushedPendulumKeepsItsPeriod) {
    using S = TypeParam;
    const auto placeOf = [](int perSecond, bool setAgain) {
        WorldDef<S> earth = earthWith<S>("moreau_midpoint");
        earth.positionCorrection = "rattle";
        World<S> world(earth);
        BodyDef<S> def;
        def.mass = 1;
        def.inertia = isotropic<S>(1.0 / 12);
        def.pose.p = at<S>(0, -0.5);
        def.velocity = at<S>(-3.75, 0);
        def.angularVelocity = spin<S>(-7.5);
        const BodyId rod = world.addBody(def);
        JointDef<S> joint;
        joint.type = JointType::Hinge;
        joint.bodyB = rod;
        joint.anchorB = at<S>(0, 0.5);
        world.addJoint(joint);
        for (int i = 0; i < 3 * perSecond; ++i) {
            if (setAgain) world.setVelocity(rod, world.velocity(rod), world.angularVelocity(rod));
            world.step(1.0 / perSecond);
        }
        return typename S::Vec(world.pose(rod).p);
    };
    const typename S::Vec place = placeOf(1920, false);
    EXPECT_LT((placeOf(60, false) - place).norm(), 0.025);
    EXPECT_LT((placeOf(60, true) - place).norm(), 0.03) << "what the world shows is what a step begins with";
}

/// Without forces but those of joints the midpoints keep H + c h^2 a M a, with the accelerations a: c = -1/12 where the shown
/// velocity is the chord's, 1/24 by RATTLE. The shown energy H changes by -c h^2 times the change of a M a.
template <class S>
double energyPerAcceleration(const std::string& correction) {
    const double h = 1.0 / 960, mass = 1.3, inertia = 0.07;
    WorldDef<S> def = earthWith<S>("moreau_midpoint");
    def.gravity.setZero();
    def.positionCorrection = correction;
    World<S> world(def);
    const std::vector<BodyId> bodies = addPendulums(world, {0, 0});
    world.setVelocity(bodies[0], at<S>(1, 0), spin<S>(2));
    world.setVelocity(bodies[1], at<S>(-0.5, 0), spin<S>(-5));
    std::vector<Eigen::VectorXd> velocities;
    for (int i = 0; i < 3000; ++i) {
        world.step(h);
        Eigen::VectorXd scaled(3 * 2);  // its square is twice the energy
        for (int k = 0; k < 2; ++k) {
            const BodyId id = bodies[static_cast<std::size_t>(k)];
            const typename S::Vec v = world.velocity(id);
            scaled.segment<3>(3 * k) << std::sqrt(mass) * v[0], std::sqrt(mass) * v[1],
                std::sqrt(inertia) * spinOf<S>(world.angularVelocity(id));
        }
        velocities.push_back(scaled);
    }
    std::vector<double> x, y;
    for (std::size_t i = 1; i + 1 < velocities.size(); ++i) {
        x.push_back((velocities[i + 1] - velocities[i - 1]).squaredNorm() / 4);  // h^2 a M a
        y.push_back(0.5 * velocities[i].squaredNorm());
    }
    const auto mean = [](const std::vector<double>& all) {
        return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
    };
    const double meanX = mean(x), meanY = mean(y);
    double xy = 0, xx = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xy += (x[i] - meanX) * (y[i] - meanY);
        xx += (x[i] - meanX) * (x[i] - meanX);
    }
    return xy / xx;
}

TYPED_TEST(SecondOrder, TheEnergyOfJointsIsKeptWithTheFactorOfRattle) {
    EXPECT_NEAR(energyPerAcceleration<TypeParam>("ngs"), 1.0 / 12, 0.05 / 12);
    EXPECT_NEAR(energyPerAcceleration<TypeParam>("rattle"), -1.0 / 24, 0.05 / 24);
}

/// The midpoints are part of the state: a copy and a restored world go on as the world does, bit for bit.
TYPED_TEST(SecondOrder, MidpointsAreState) {
    using S = TypeParam;
    const auto make = [] {
        World<S> world(earthWith<S>("moreau_midpoint"));
        const auto wood = world.addMaterial(0.4, 0.3);
        addGround<S>(world, wood);
        addBall<S>(world, 2, 0.7, 0.2, 1, wood, -1.5);
        addPendulums(world, {0.9, 1.4});
        return world;
    };
    World<S> world = make(), other = make();
    runSteps(world, 0.5, 30);
    std::vector<unsigned char> bytes;
    world.saveSnapshot(bytes);
    other.restoreSnapshot(bytes);
    World<S> copy = world;
    EXPECT_EQ(other.stateHash(), world.stateHash());
    for (World<S>* each : {&world, &other, &copy}) runSteps(*each, 0.5, 30);
    EXPECT_EQ(other.stateHash(), world.stateHash());
    EXPECT_EQ(copy.stateHash(), world.stateHash());
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

/// A weight on a spring of the joint's, which symplectic Euler treats implicitly, and so damps.
TYPED_TEST(SecondOrder, AWeightOnAJointSpringSwings) {
    using S = TypeParam;
    const auto state = [](const std::string& integrator, int steps) {
        WorldDef<S> def;
        def.integrator = integrator;
        World<S> world(def);
        BodyDef<S> body;
        body.mass = 2;
        body.pose.p = at<S>(0.3, 0);
        const BodyId weight = world.addBody(body);
        JointDef<S> rail;
        rail.type = JointType::Slider;
        rail.bodyB = weight;
        rail.anchorA = at<S>(0.3, 0);
        rail.axisA = rail.axisB = at<S>(1, 0);
        rail.axes[0].stiffness = 200;
        rail.axes[0].damping = 1;
        rail.axes[0].target = 0.2;
        world.addJoint(rail);
        runSteps(world, 1.5, steps);
        return placesAndVelocities(world, {weight});
    };
    // m x'' + c x' + k (x - 0.5) = 0 from rest at 0.3
    const double gamma = 1.0 / 4, w = std::sqrt(100 - gamma * gamma), t = 1.5, decay = std::exp(-gamma * t);
    Eigen::VectorXd exact = Eigen::VectorXd::Zero(2 * S::dim);
    exact[0] = 0.5 - 0.2 * decay * (std::cos(w * t) + gamma / w * std::sin(w * t));
    exact[S::dim] = 0.2 * decay * (100 / w) * std::sin(w * t);
    EXPECT_NEAR(orderAgainst(state, "moreau_midpoint", t, exact, {90, 180, 360, 720}), 2, 0.1);
    EXPECT_NEAR(orderAgainst(state, "symplectic_euler", t, exact, {720, 1440, 2880}), 1, 0.1);
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
// ------------------------------------------------------------------------------------------------------
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

/// A heavy top on a ball joint: all of rotation, and a joint.
TEST(SecondOrderInSpace, ATopTurnsOnItsTip) {
    using S = Space3d;
    const auto state = [&](const std::string& integrator, int steps) {
        World<S> world(earthWith<S>(integrator));
        BodyDef<S> def;
        def.mass = 0.8;
        def.inertia = Eigen::Vector3d(0.004, 0.003, 0.0045).asDiagonal();
        def.pose.q = expMap(Eigen::Vector3d(0.3, 0, 0.4));
        def.pose.p = rotate(def.pose.q, Eigen::Vector3d(0, 0.1, 0));
        def.angularVelocity = Eigen::Vector3d(2, 40, 1);
        const Eigen::Vector3d arm = def.pose.p;
        def.velocity = def.angularVelocity.cross(arm);
        const BodyId top = world.addBody(def);
        JointDef<S> tip;
        tip.type = JointType::Ball;
        tip.bodyB = top;
        tip.anchorB = {0, -0.1, 0};
        world.addJoint(tip);
        runSteps(world, 0.5, steps);
        Eigen::VectorXd all(10);
        all << world.pose(top).p, world.pose(top).q.coeffs(), world.velocity(top) / 10;
        return all;
    };
    EXPECT_NEAR(orderBetweenRuns(state, "moreau_midpoint", 0.5, {480, 960, 1920}), 2, 0.1);
    EXPECT_NEAR(orderBetweenRuns(state, "symplectic_euler", 0.5, {960, 1920}), 1, 0.2);
}

/// The loop of Bricard: five bars and six hinges, one equation of which follows from the others.
TEST(SecondOrderInSpace, ALoopOfHingesWithARedundantRow) {
    using S = Space3d;
    using Vec = Eigen::Vector3d;
    const auto state = [](const std::string& integrator, int steps) {
        World<S> world(earthWith<S>(integrator));
        const std::array<Vec, 6> corner{Vec(0, 0, 0),  Vec(1, 0, 0),  Vec(1, -1, 0),
                                        Vec(1, -1, 1), Vec(0, -1, 1), Vec(0, 0, 1)};
        const std::array<Vec, 6> axis{Vec::UnitY(), Vec::UnitZ(), Vec::UnitX(),
                                      Vec::UnitY(), Vec::UnitZ(), Vec::UnitX()};
        std::array<BodyId, 5> bars;
        for (std::size_t i = 0; i < bars.size(); ++i) {
            BodyDef<S> def;
            const Vec along = corner[i + 1] - corner[i];
            def.pose.p = 0.5 * (corner[i] + corner[i + 1]);
            def.mass = 1;
            def.inertia = Vec(Vec::Constant(1.0 / 12) - along.cwiseAbs() * (1.0 / 12 - 1e-3)).asDiagonal();
            bars[i] = world.addBody(def);
        }
        for (std::size_t i = 0; i < corner.size(); ++i) {
            JointDef<S> hinge;
            hinge.type = JointType::Hinge;
            if (i > 0 && i < 5) hinge.bodyA = bars[i - 1];
            hinge.bodyB = bars[std::min<std::size_t>(i, 4)];
            const Vec a = i > 0 && i < 5 ? world.pose(hinge.bodyA).p : Vec(0, 0, 0);
            hinge.anchorA = corner[i] - a;
            hinge.anchorB = corner[i] - world.pose(hinge.bodyB).p;
            hinge.axisA = hinge.axisB = axis[i];
            world.addJoint(hinge);
        }
        runSteps(world, 1.0, steps);
        Eigen::VectorXd all(6);
        all << world.pose(bars[2]).p, world.velocity(bars[2]);
        return all;
    };
    EXPECT_NEAR(orderBetweenRuns(state, "moreau_midpoint", 1.0, {120, 240, 480}), 2, 0.1);
    EXPECT_LT((state("moreau_midpoint", 120) - state("moreau_midpoint", 480)).norm(), 0.03);
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
