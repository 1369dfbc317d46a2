// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Impacts of bodies in flight at their own times, with steps from midpoint to midpoint.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class FlightImpact : public testing::Test {};
using FlightSpaces = testing::Types<Space2d, Space3d>;
TYPED_TEST_SUITE(FlightImpact, FlightSpaces);

/// A rod turns about its end and strikes a ball at rest: when its line is as far from the ball as their radii together.
/// The ball leaves with (1 + e) times the speed of the rod there. At every step size, wherever in the step that is.
TYPED_TEST(FlightImpact, ATurningRodStrikesABallWhenItReachesIt) {
    using S = TypeParam;
    using R = typename S::Real;
    constexpr double w = 10, x = 0.7, y = 0.5, apart = 0.15, e = 0.5;
    const double reach = std::hypot(x, y), when = (std::atan2(y, x) - std::asin(apart / reach)) / w;
    const double speed = (1 + e) * w * std::sqrt(reach * reach - apart * apart);
    for (int rate = 50; rate < 130; ++rate) {
        WorldDef<S> def;
        def.integrator = "moreau_midpoint";
        World<S> world(def);
        const std::uint32_t stuff = world.addMaterial(0, R(e));
        BodyDef<S> turning;
        turning.type = BodyType::Kinematic;
        turning.angularVelocity = spin<S>(w);
        ShapeDef<S> rod;
        rod.shape = Capsule<S>{R(0.05), R(0.5)};
        rod.pose.p = at<S>(0.5, 0);
        rod.pose.q = expMap(spin<S>(-std::numbers::pi / 2));
        rod.material = stuff;
        world.addShape(world.addBody(turning), rod);
        const BodyId ball = addBall<S>(world, x, y, 0.1, 0.5, stuff);
        std::vector<double> times;
        for (int i = 0; i * (1.0 / rate) < 0.06; ++i)
            for (const ImpactEvent<S>& impact : world.step(R(1.0 / rate)).impacts)
                times.push_back(i * (1.0 / rate) + double(impact.time));
        ASSERT_EQ(times.size(), 1u) << rate;
        EXPECT_NEAR(times[0], when, 1e-9) << rate;
        EXPECT_NEAR(world.velocity(ball).norm(), speed, 1e-7) << rate;
    }
}

}  // namespace
}  // namespace rigor::engine::test
