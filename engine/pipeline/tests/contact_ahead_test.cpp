// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// WorldDef::speculativeMotion: contacts are found as far ahead as bodies move in the step.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/pipeline/tests/scene.hpp"
#include "engine/shapes/surface.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::engine::test {
namespace {

constexpr double kFall = 15;  ///< 0.25 m in a step [m/s]
/// Overlap that the single pass of `fast` leaves where four corners hit; measured 5.0e-3, of one or two 1e-4.
constexpr double kOnePass = 7e-3;

template <class S>
WorldDef<S> lookingAhead(bool fast, double motion) {
    WorldDef<S> def = earthByEuler<S>();
    if (fast) preferSpeed(def);
    def.speculativeMotion = static_cast<typename S::Real>(motion);
    return def;
}

/// Grounds whose top is y = 0.
template <class S>
std::vector<Shape<S>> topsAtZero() {
    using R = typename S::Real;
    std::vector<Shape<S>> all{HalfSpace<S>{S::Vec::Unit(1), 0}};
    if constexpr (S::dim == 2) {
        const typename S::Vec v[] = {at<S>(-3, 0), at<S>(0.3, 0), at<S>(3, 0)};
        all.push_back(makeChain<S>(v, false));
    } else {
        all.push_back(makeHeightField<S>(7, 7, R(0.9), R(0.9), std::vector<R>(49, R(0)), R(1)));
    }
    return all;
}

/// Greatest depth of the body's lowest point under y = 0 over some steps after the fall from `height`.
template <class S>
double deepest(const WorldDef<S>& def, const Shape<S>& ground, const Shape<S>& shape, double height,
               double restitution, double& speed) {
    World<S> world(def);
    const std::uint32_t material = world.addMaterial(0, static_cast<typename S::Real>(restitution));
    BodyDef<S> still;
    still.type = BodyType::Static;
    attach<S>(world, world.addBody(still), ground, material);
    BodyDef<S> body;
    body.mass = 1;
    body.inertia = isotropic<S>(0.1);
    body.pose.p = at<S>(0.1, height);
    body.velocity = at<S>(0, -kFall);
    const BodyId id = world.addBody(body);
    attach<S>(world, id, shape, material);
    double depth = 0;
    speed = 0;
    for (int step = 0; step < 6; ++step) {
        world.step(typename S::Real(1.0 / 60));
        depth = std::max(depth, -static_cast<double>(boundingBox<S>(shape, world.pose(id)).min.y()));
        speed = std::max(speed, static_cast<double>(world.velocity(id).y()));
    }
    return depth;
}

template <class S>
class ContactsAhead : public testing::Test {};
using AheadSpaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(ContactsAhead, AheadSpaces);

/// A body that falls 0.25 m in a step stops at the ground, whatever the phase of the step; without the setting
/// it overlaps it by up to that.
TYPED_TEST(ContactsAhead, ImpactsBeginWithoutOverlap) {
    using S = TypeParam;
    using R = typename S::Real;
    const Shape<S> shapes[] = {Sphere<S>{R(0.3)}, Box<S>{S::Vec::Constant(R(0.3))},
                               Capsule<S>{R(0.1), R(0.2)}};
    for (const bool fast : {false, true})
        for (const Shape<S>& ground : topsAtZero<S>())
            for (const Shape<S>& shape : shapes) {
                double without = 0, speed = 0;
                for (int phase = 0; phase < 5; ++phase) {
                    const double height = 0.8 + 0.05 * phase;
                    without = std::max(without,
                                       deepest<S>(lookingAhead<S>(fast, 0), ground, shape, height, 0, speed));
                    EXPECT_LE(deepest<S>(lookingAhead<S>(fast, 1), ground, shape, height, 0, speed),
                              fast ? kOnePass : 2e-3)
                        << shapeName<S>(shape) << " on " << shapeName<S>(ground) << " fast " << fast
                        << " phase " << phase;
                }
                EXPECT_GT(without, 0.1) << "the test needs a scene that overlaps";
            }
}

/// A bounce keeps its speed; `wide` finds it in the sub-step in which the body touches.
TYPED_TEST(ContactsAhead, BouncesKeepTheirSpeed) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const bool fast : {false, true})
        for (const Shape<S>& ground : topsAtZero<S>())
            for (int phase = 0; phase < 5; ++phase) {
                double speed = 0;
                const double depth = deepest<S>(lookingAhead<S>(fast, 1), ground, Sphere<S>{R(0.3)},
                                                0.8 + 0.05 * phase, 0.5, speed);
                EXPECT_NEAR(speed, 0.5 * kFall, 0.4) << shapeName<S>(ground) << " fast " << fast;
                EXPECT_LE(depth, fast ? 0.25 / 5 + 5e-3 : 0.255);
            }
}

/// A sphere that passes beside the ground is not touched: points that may not close in the step are dropped.
TYPED_TEST(ContactsAhead, PassingIsNoImpact) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const bool fast : {false, true}) {
        WorldDef<S> def = lookingAhead<S>(fast, 1);
        def.gravity.setZero();
        World<S> world(def);
        const std::uint32_t material = world.addMaterial(R(0.5), 0);
        addGround<S>(world, material);
        const BodyId ball = addBall<S>(world, 0, 0.35, 0.3, 1, material, kFall, -0.5);
        world.step(R(1.0 / 60));
        EXPECT_EQ(world.velocity(ball).x(), R(kFall));
        EXPECT_NEAR(static_cast<double>(world.velocity(ball).y()), -0.5, 1e-6);
    }
}

/// A ball that passes another by 5 mm: the plane between them where the step begins would stop it, although it closes
/// half of the distance only. With 5 mm less than their radii it is an impact.
TYPED_TEST(ContactsAhead, ANearMissIsNoImpact) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const bool fast : {false, true})
        for (const bool meets : {false, true}) {
            WorldDef<S> def = lookingAhead<S>(fast, 1);
            def.gravity.setZero();
            World<S> world(def);
            const BodyId still = addBall<S>(world, 0, 0, 0.5, 1, kFrictionless);
            const double beside = meets ? 0.995 : 1.005;
            const BodyId passing = addBall<S>(world, -0.25, beside, 0.5, 1, kFrictionless, 2 * kFall);
            const double distance = std::hypot(0.25, beside), closing = 2 * kFall * 0.25 / distance;
            ASSERT_LT(distance - closing / 60, 1) << "the plane alone stops it";
            for (int i = 0; i < 3; ++i) world.step(R(1.0 / 60));
            EXPECT_EQ(world.velocity(still).norm() > 0, meets) << "fast " << fast;
            EXPECT_EQ(world.velocity(passing)[0] == R(2 * kFall), !meets) << "fast " << fast;
        }
}

}  // namespace
}  // namespace rigor::engine::test
