// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The order of the integrators of second order with joints, by fits as in second_order_test.cpp, and the energy that
// pendulums keep.
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
class SecondOrderOfJoints : public testing::Test {};
using SecondOrderOfJointsSpaces = testing::Types<Space2d, Space3d>;
TYPED_TEST_SUITE(SecondOrderOfJoints, SecondOrderOfJointsSpaces);

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
TYPED_TEST(SecondOrderOfJoints, PendulumsSwing) {
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
TYPED_TEST(SecondOrderOfJoints, PendulumsKeepTheirEnergy) {
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
        EXPECT_LT(high[1], tumbles ? 1e-3 : 4e-4) << angles.size();
        EXPECT_GT(low[1], tumbles ? -0.05 : -1e-7) << angles.size();
        EXPECT_LT(high[1] - low[1], 1.5 * (high[0] - low[0])) << angles.size();
    }
}

/// A rod pushed where it hangs so that it nearly turns over: what its motion begins with decides its period. Where joints are
/// put right alone on the way to the first midpoint it is 0.091 m off.
TYPED_TEST(SecondOrderOfJoints, APushedPendulumKeepsItsPeriod) {
    using S = TypeParam;
    const auto placeOf = [](int perSecond, bool setAgain, const char* correction) {
        WorldDef<S> earth = earthWith<S>("moreau_midpoint");
        earth.positionCorrection = correction;
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
    for (const auto& [correction, most] : {std::pair{"rattle", 0.025}, std::pair{"processed_rattle", 0.01}}) {
        const typename S::Vec place = placeOf(1920, false, correction);
        EXPECT_LT((placeOf(60, false, correction) - place).norm(), most) << correction;
        EXPECT_LT((placeOf(60, true, correction) - place).norm(), most + 0.01)
            << correction << ": what the world shows is what a step begins with";
    }
}

/// Without forces but those of joints the midpoints keep H + c h^2 a M a, with the accelerations a: c = -1/12 where the shown
/// velocity is the chord's, 1/24 by RATTLE, 1/96 with 3/4 of it. The shown energy H changes by -c h^2 times the change of a M a.
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

TYPED_TEST(SecondOrderOfJoints, TheEnergyOfJointsIsKeptWithTheFactorOfRattle) {
    EXPECT_NEAR(energyPerAcceleration<TypeParam>("ngs"), 1.0 / 12, 0.05 / 12);
    EXPECT_NEAR(energyPerAcceleration<TypeParam>("rattle"), -1.0 / 24, 0.05 / 24);
    EXPECT_NEAR(energyPerAcceleration<TypeParam>("processed_rattle"), -1.0 / 96, 0.05 / 24);
}

/// A weight on a massless rod that is released level: with a fraction w of RATTLE the energy shown is off by
/// h^2/8 (1 - w) v^4 / r^2 per mass to the order h^2 (correction_ngs.cpp), most where it hangs, v^2 = 2 g r.
TYPED_TEST(SecondOrderOfJoints, APendulumReleasedLevelHasTheEnergyOfItsShareOfRattle) {
    using S = TypeParam;
    const double h = 1.0 / 240, r = 1, inertia = 1e-9;
    for (const auto& [correction, w] :
         {std::pair{"ngs", 0.0}, std::pair{"processed_rattle", 0.75}, std::pair{"rattle", 1.0}}) {
        WorldDef<S> earth = earthWith<S>("moreau_midpoint");
        earth.positionCorrection = correction;
        World<S> world(earth);
        BodyDef<S> def;
        def.mass = 1;
        def.inertia = isotropic<S>(inertia);
        def.pose.p = at<S>(r, 0);
        const BodyId weight = world.addBody(def);
        JointDef<S> joint;
        joint.type = JointType::Hinge;
        joint.bodyB = weight;
        joint.anchorB = at<S>(-r, 0);
        world.addJoint(joint);
        double most = 0;
        for (int i = 0; i < 480; ++i) {
            world.step(h);
            const double energy =
                0.5 * world.velocity(weight).squaredNorm() + kGravity * world.pose(weight).p[1];
            most = std::max(most, std::abs(energy));
        }
        const double bottom = 2 * kGravity * r;
        EXPECT_NEAR(most, h * h / 8 * (1 - w) * bottom * bottom, 0.02 * h * h / 8 * bottom * bottom)
            << correction;
    }
}

/// The midpoints are part of the state: a copy and a restored world go on as the world does, bit for bit.
TYPED_TEST(SecondOrderOfJoints, MidpointsAreState) {
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

/// A weight on a spring of the joint's, which symplectic Euler treats implicitly, and so damps.
TYPED_TEST(SecondOrderOfJoints, AWeightOnAJointSpringSwings) {
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

/// A heavy top on a ball joint: all of rotation, and a joint.
TEST(SecondOrderOfJointsInSpace, ATopTurnsOnItsTip) {
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
TEST(SecondOrderOfJointsInSpace, ALoopOfHingesWithARedundantRow) {
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

}  // namespace
}  // namespace rigor::engine::test
