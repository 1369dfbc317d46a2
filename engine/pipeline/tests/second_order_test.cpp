// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The order of the integrators of second order with friction, rolling, joints and impacts, by fits over many
// step sizes: against closed forms, or between runs where there is none. Symplectic Euler, of order 1, is
// measured beside it, so that the fits are known to tell one from the other.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

/// Slope of ln error against ln h by least squares.
double fittedOrder(const std::vector<double>& h, const std::vector<double>& error) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < h.size(); ++i) {
        const double lx = std::log(h[i]), ly = std::log(error[i]);
        n += 1;
        x += lx;
        y += ly;
        xx += lx * lx;
        xy += lx * ly;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

/// State of a scene at `time` after `steps` equal steps.
using Run = std::function<Eigen::VectorXd(const std::string& integrator, int steps)>;

double orderAgainst(const Run& run, const char* integrator, double time, const Eigen::VectorXd& exact,
                    const std::vector<int>& steps) {
    std::vector<double> h, error;
    for (const int n : steps) {
        h.push_back(time / n);
        error.push_back((run(integrator, n) - exact).norm());
        if (std::getenv("RIGOR_SHOW_ERRORS"))
            std::printf("  %-18s h %.6f error %.3e\n", integrator, h.back(), error.back());
    }
    return fittedOrder(h, error);
}
/// From the differences of runs with n and 2 n steps.
double orderBetweenRuns(const Run& run, const char* integrator, double time, const std::vector<int>& steps) {
    std::vector<double> h, error;
    for (const int n : steps) {
        h.push_back(time / n);
        error.push_back((run(integrator, n) - run(integrator, 2 * n)).norm());
        if (std::getenv("RIGOR_SHOW_ERRORS"))
            std::printf("  %-18s h %.6f change %.3e\n", integrator, h.back(), error.back());
    }
    return fittedOrder(h, error);
}

template <class S>
class SecondOrder : public testing::Test {};
using Spaces = testing::Types<Space2d, Space3d>;
TYPED_TEST_SUITE(SecondOrder, Spaces);

template <class S>
WorldDef<S> with(const std::string& integrator) {
    WorldDef<S> def = earth<S>();
    def.integrator = integrator;
    return def;
}
template <class S>
void run(World<S>& world, double time, int steps) {
    for (int i = 0; i < steps; ++i) world.step(time / steps);
}

/// Position and velocity of a block that slides to rest, v0 / (mu g) = 0.886 s.
TYPED_TEST(SecondOrder, ABlockSlidesToRest) {
    using S = TypeParam;
    const double v0 = 3.217, mu = 0.37, time = 2;
    const auto x = [&](const std::string& integrator, int steps) {
        World<S> world(with<S>(integrator));
        const auto wood = world.addMaterial(mu, 0);
        addGround<S>(world, wood);
        const BodyId block = addCube<S>(world, 0, 0.5, 0.5, 2, wood, v0);
        run(world, time, steps);
        return Eigen::VectorXd::Constant(1, world.pose(block).p[0]).eval();
    };
    const Eigen::VectorXd exact = Eigen::VectorXd::Constant(1, v0 * v0 / (2 * mu * kGravity));
    std::vector<int> steps;
    for (int n = 60; n <= 2000; n = n * 6 / 5 + 1) steps.push_back(n);
    // Where in its step the block stops decides between zero and the largest error of order 2.
    EXPECT_NEAR(orderAgainst(x, "moreau_midpoint", time, exact, steps), 2, 0.3);
    EXPECT_NEAR(orderAgainst(x, "symplectic_euler", time, exact, steps), 1, 0.1);
    EXPECT_LT((x("moreau_midpoint", 120) - exact).norm(), 5e-4);
}

/// A sphere that slips, then rolls: at 5/7 of its speed.
TYPED_TEST(SecondOrder, ASphereSlipsThenRolls) {
    using S = TypeParam;
    const double v0 = 4.1, mu = 0.23, r = 0.1, time = 1.5;
    const auto x = [&](const std::string& integrator, int steps) {
        World<S> world(with<S>(integrator));
        const auto felt = world.addMaterial(mu, 0);
        addGround<S>(world, felt);
        const BodyId ball = addBall<S>(world, 0, r, r, 1, felt, v0);
        run(world, time, steps);
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
            World<S> world(with<S>(integrator));
            const std::vector<BodyId> bodies = addPendulums(world, angles);
            run(world, 2, steps);
            return placesAndVelocities(world, bodies);
        };
        EXPECT_NEAR(orderBetweenRuns(state, "moreau_midpoint", 2, {240, 480, 960}), 2, 0.1) << angles.size();
        EXPECT_NEAR(orderBetweenRuns(state, "symplectic_euler", 2, {960, 1920}), 1, 0.2) << angles.size();
    }
}

/// A heavy top on a ball joint: all of rotation, and a joint.
TEST(SecondOrderInSpace, ATopTurnsOnItsTip) {
    using S = Space3d;
    const auto state = [&](const std::string& integrator, int steps) {
        World<S> world(with<S>(integrator));
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
        run(world, 0.5, steps);
        Eigen::VectorXd all(10);
        all << world.pose(top).p, world.pose(top).q.coeffs(), world.velocity(top) / 10;
        return all;
    };
    EXPECT_NEAR(orderBetweenRuns(state, "moreau_midpoint", 0.5, {480, 960, 1920}), 2, 0.1);
    EXPECT_NEAR(orderBetweenRuns(state, "symplectic_euler", 0.5, {960, 1920}), 1, 0.2);
}

}  // namespace
}  // namespace rigor::engine::test
