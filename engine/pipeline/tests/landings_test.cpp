// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies that land on one edge while they turn about another (pipeline/step_landings.cpp): impacts lose what the law of
// impact takes, whenever in a step they take place.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/pipeline/tests/order_fit.hpp"
#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Landings : public testing::Test {};
using LandingSpaces = testing::Types<Space2d, Space3d>;
TYPED_TEST_SUITE(Landings, LandingSpaces);

constexpr double kBreadth = 0.12, kHeight = 0.45;  // halves

/// A block of 2 kg that stands on its right lower edge, tilted to that side.
template <class S>
BodyId addTilted(World<S>& world, double tilt) {
    const auto stone = world.addMaterial(0.9, 0);
    addGround<S>(world, stone);
    BodyDef<S> def;
    def.mass = 2;
    const double inertia = def.mass / 3 * (kBreadth * kBreadth + kHeight * kHeight);
    if constexpr (S::dim == 2) {
        def.inertia = inertia;
        def.pose.q = expMap(-tilt);
    } else {
        def.inertia = Eigen::Vector3d(inertia, inertia, inertia).asDiagonal();
        def.pose.q = expMap(Eigen::Vector3d(0, 0, -tilt));
    }
    def.pose.p = at<S>(-kBreadth * std::cos(tilt) + kHeight * std::sin(tilt),
                       kBreadth * std::sin(tilt) + kHeight * std::cos(tilt));
    const BodyId block = world.addBody(def);
    typename S::Vec extents = S::Vec::Constant(kBreadth);
    extents[1] = kHeight;
    attach<S>(world, block, Box<S>{extents}, stone);
    return block;
}

/// Mechanical energy over that of the block at rest [J].
template <class S>
double energyOf(const World<S>& world, BodyId block) {
    const double mass = 2, inertia = mass / 3 * (kBreadth * kBreadth + kHeight * kHeight);
    const double w = spinOf<S>(world.angularVelocity(block));
    return 0.5 * mass * world.velocity(block).squaredNorm() + 0.5 * inertia * w * w +
           mass * kGravity * (world.pose(block).p[1] - kHeight);
}

/// It keeps (1 - 3/2 sin^2 a)^2 of its energy, a the angle of its diagonal [Housner 1963], for 20 times within a step.
TYPED_TEST(Landings, ARockingBlockLosesWhatTheImpactTakes) {
    using S = TypeParam;
    const double sine2 = kBreadth * kBreadth / (kBreadth * kBreadth + kHeight * kHeight);
    const double kept = std::pow(1 - 1.5 * sine2, 2);
    double least = 1, most = 0;
    for (int i = 0; i < 20; ++i) {
        World<S> world(earthWith<S>("moreau_midpoint"));
        const BodyId block = addTilted<S>(world, 0.14 + 1e-3 * i);
        const double before = energyOf(world, block);
        for (int k = 0; k < 130; ++k) world.step(1.0 / 240);
        const double ratio = energyOf(world, block) / before;
        least = std::min(least, ratio);
        most = std::max(most, ratio);
    }
    EXPECT_NEAR(least, kept, 0.01);
    EXPECT_NEAR(most, kept, 0.01);
}

/// Over three impacts, against a run with small steps.
TYPED_TEST(Landings, ABlockRocksOn) {
    using S = TypeParam;
    const auto run = [](const std::string& integrator, int steps) {
        World<S> world(earthWith<S>(integrator));
        const BodyId block = addTilted<S>(world, 0.14);
        runSteps(world, 1.5, steps);
        Eigen::VectorXd all(2);
        all << world.pose(block).p[0], spinOf<S>(world.angularVelocity(block)) / 10;
        return all;
    };
    const Eigen::VectorXd fine = run("moreau_midpoint", 12000);
    for (const int steps : {180, 360}) {
        const double error = (run("moreau_midpoint", steps) - fine).norm();
        EXPECT_LT(error, 0.02) << steps;
        EXPECT_LT(error, 0.25 * (run("symplectic_euler", steps) - fine).norm()) << steps;
    }
}

/// The impulses shown carry the weight until it lands and make the impact: momentum changes by what they and gravity are.
TYPED_TEST(Landings, ImpulsesShownChangeTheMomentum) {
    using S = TypeParam;
    World<S> world(earthWith<S>("moreau_midpoint"));
    const BodyId block = addTilted<S>(world, 0.143);
    bool landed = false;
    for (int k = 0; k < 130; ++k) {
        const typename S::Vec before = world.velocity(block);
        world.step(1.0 / 240);
        std::vector<ContactView<S>> contacts;
        world.readContacts(contacts);
        typename S::Vec impulse = at<S>(0, -2 * kGravity / 240);
        double largest = 0;
        for (const ContactView<S>& contact : contacts) {
            impulse += contact.normalImpulse * contact.normal + contact.frictionImpulse;
            largest = std::max(largest, contact.normalImpulse);
        }
        landed = landed || largest > 0.15;
        EXPECT_NEAR((2 * (world.velocity(block) - before) - impulse).norm(), 0, 1e-9) << k;
    }
    EXPECT_TRUE(landed);
}

}  // namespace
}  // namespace rigor::engine::test
