// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ellipsoids in motion: at rest at the height of their half axis, and rocking about it with the period of a small
// oscillation. At the tilt t the centre of half axes a (along the ground) and c (upright) is sqrt(c^2 cos^2 t + a^2
// sin^2 t) over the ground: the potential's curvature is m g (a^2 - c^2) / c. Without friction the centre only rises
// and falls, so that the inertia is I = m (a^2 + c^2) / 5; rolling adds m c^2.
#include <gtest/gtest.h>

#include <numbers>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class MovingEllipsoids : public testing::Test {};
using Spaces3 = testing::Types<Space3f, Space3d>;
TYPED_TEST_SUITE(MovingEllipsoids, Spaces3);

constexpr double kAlong = 0.5, kUpright = 0.3;

/// Turned by `tilt` about z, its lowest point on the ground.
template <class S>
BodyId addEllipsoid(World<S>& world, double x, double tilt, std::uint32_t material) {
    using R = typename S::Real;
    const Shape<S> shape = Ellipsoid<S>{{R(kAlong), R(kUpright), R(0.4)}};
    const MassProperties<S> mass = massProperties<S>(shape, R(1000));
    BodyDef<S> def;
    def.mass = mass.mass;
    def.inertia = mass.inertia;
    def.pose.q = rotatedBy(def.pose.q, spin<S>(tilt));
    def.pose.p = at<S>(x, std::hypot(kUpright * std::cos(tilt), kAlong * std::sin(tilt)));
    const BodyId body = world.addBody(def);
    attach<S>(world, body, shape, material);
    return body;
}
template <class S>
double tiltOf(const World<S>& world, BodyId body) {
    const auto q = world.pose(body).q;
    return 2 * std::atan2(static_cast<double>(q.z()), static_cast<double>(q.w()));
}

TYPED_TEST(MovingEllipsoids, RestAtTheHeightOfTheirHalfAxis) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const bool onBox : {false, true}) {
        World<S> world(earth<S>());
        const std::uint32_t stuff = world.addMaterial(R(0.5), R(0));
        if (onBox) {
            BodyDef<S> table;
            table.type = BodyType::Static;
            table.pose.p = at<S>(0, -1);
            attach<S>(world, world.addBody(table), Box<S>{{5, 1, 5}}, stuff);
        } else {
            addGround<S>(world, stuff);
        }
        const BodyId body = addEllipsoid<S>(world, 0, 0, stuff);
        for (int i = 0; i < 240; ++i) world.step(R(1.0 / 120));
        EXPECT_NEAR(static_cast<double>(world.pose(body).p[1]), kUpright, 2e-4);
        EXPECT_NEAR(tiltOf(world, body), 0, 1e-4);
        EXPECT_EQ(world.lastStep().contacts, 1u);
    }
}

TYPED_TEST(MovingEllipsoids, RockWithThePeriodOfASmallOscillation) {
    using S = TypeParam;
    using R = typename S::Real;
    const double curvature = kGravity * (kAlong * kAlong - kUpright * kUpright) / kUpright;
    const double inertia = 0.2 * (kAlong * kAlong + kUpright * kUpright);
    for (const bool rolls : {false, true}) {
        World<S> world(earth<S>());
        const std::uint32_t stuff = world.addMaterial(R(rolls ? 1 : 0), R(0));
        addGround<S>(world, stuff);
        const BodyId body = addEllipsoid<S>(world, 0, 0.03, stuff);
        const double h = 1.0 / 480;
        std::vector<double> crossings;
        double before = tiltOf(world, body);
        for (int i = 0; i < 480 * 4; ++i) {
            world.step(static_cast<R>(h));
            const double now = tiltOf(world, body);
            if (before < 0 && now >= 0) crossings.push_back(h * (i + 1 - now / (now - before)));
            before = now;
        }
        ASSERT_GE(crossings.size(), 3u);
        const double period =
            (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
        const double exact =
            2 * std::numbers::pi * std::sqrt((inertia + (rolls ? kUpright * kUpright : 0)) / curvature);
        EXPECT_NEAR(period / exact, 1, 5e-3) << rolls;
        const double moved = std::abs(static_cast<double>(world.pose(body).p[0]));
        EXPECT_LT(moved, rolls ? 0.05 : 1e-4);
    }
}

}  // namespace
}  // namespace rigor::engine::test
