// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Fast bodies against chains, meshes and height fields, for every choice that stops them: they stay on their
// side, they are stopped by the surface and not by its convex hull, and inner edges do not catch them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/pipeline/tests/scene.hpp"
#include "engine/shapes/surface.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::engine::test {
namespace {

constexpr double kFrame = 1.0 / 60;
constexpr int kSide = 41;  ///< vertices along a side
constexpr double kCell = 0.4, kHalf = 0.5 * kCell * (kSide - 1);

/// Surfaces of the heights over x.
template <class S, class Height>
std::vector<Shape<S>> surfacesOf(Height height) {
    using R = typename S::Real;
    std::vector<typename S::Vec> v;
    if constexpr (S::dim == 2) {
        for (int i = 0; i < kSide; ++i) v.push_back(at<S>(i * kCell - kHalf, height(i * kCell - kHalf)));
        return {makeChain<S>(v, false)};
    } else {
        std::vector<std::array<std::uint32_t, 3>> t;
        std::vector<R> heights;
        for (int k = 0; k < kSide; ++k)
            for (int i = 0; i < kSide; ++i) {
                heights.push_back(static_cast<R>(height(i * kCell - kHalf)));
                v.push_back({R(i * kCell - kHalf), heights.back(), R(k * kCell - kHalf)});
            }
        for (std::uint32_t k = 0; k + 1 < kSide; ++k)
            for (std::uint32_t i = 0; i + 1 < kSide; ++i) {
                const std::uint32_t a = kSide * k + i;
                t.push_back({a, a + kSide, a + 1});
                t.push_back({a + 1, a + kSide, a + kSide + 1});
            }
        return {makeTriangleMesh<S>(v, t),
                makeHeightField<S>(kSide, kSide, R(kCell), R(kCell), heights, R(1))};
    }
}
double flat(double) {
    return 0;
}
double valley(double x) {
    return std::abs(x);
}

template <class S>
std::vector<Shape<S>> bullets() {
    using R = typename S::Real;
    typename S::Vec plate = S::Vec::Constant(R(0.06));
    plate[1] = R(0.01);
    std::vector<Shape<S>> all{Sphere<S>{R(0.05)}, Box<S>{S::Vec::Constant(R(0.05))}, Box<S>{plate},
                              Capsule<S>{R(0.02), R(0.06)}};
    if constexpr (S::dim == 3) all.push_back(Cylinder<S>{R(0.06), R(0.005)});
    return all;
}

/// The settings under test: every choice of continuous collision but none, default, from midpoint to midpoint, and fast.
template <class S>
std::vector<WorldDef<S>> settingsToTry() {
    std::vector<WorldDef<S>> all;
    for (const char* choice : {"conservative_advancement", "speculative"})
        for (const bool fast : {false, true}) {
            WorldDef<S> def = earth<S>();
            if (fast) preferSpeed(def);
            def.continuousCollision = choice;
            all.push_back(def);
            if (fast) continue;
            def.integrator = "moreau_midpoint";
            all.push_back(def);
        }
    return all;
}

template <class S>
BodyId addStatic(World<S>& world, const Shape<S>& shape, std::uint32_t material,
                 const typename S::Vec& p = S::Vec::Zero()) {
    BodyDef<S> still;
    still.type = BodyType::Static;
    still.pose.p = p;
    const BodyId id = world.addBody(still);
    attach<S>(world, id, shape, material);
    return id;
}

template <class S>
BodyId addBullet(World<S>& world, const Shape<S>& shape, std::uint32_t material, const typename S::Vec& p,
                 const typename S::Vec& v, const typename S::Rot& q, const typename S::Ang& w) {
    const MassProperties<S> m = massProperties<S>(shape, typename S::Real(2000));
    BodyDef<S> body;
    body.mass = m.mass;
    body.inertia = m.inertia;
    body.pose.p = p;
    body.pose.q = q;
    body.velocity = v;
    body.angularVelocity = w;
    const BodyId id = world.addBody(body);
    attach<S>(world, id, shape, material);
    return id;
}

template <class S>
class SurfaceImpacts : public testing::Test {};
using SurfaceSpaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(SurfaceImpacts, SurfaceSpaces);

/// Directions up to 80 degrees off the vertical, turned and turning bodies, all phases of the step. A plate
/// of 1 mm stands for the surfaces too.
TYPED_TEST(SurfaceImpacts, BulletsStayOnTheirSide) {
    using S = TypeParam;
    using R = typename S::Real;
    std::vector<Shape<S>> grounds = surfacesOf<S>(flat);
    typename S::Vec thin = S::Vec::Constant(R(kHalf));
    thin[1] = R(0.5e-3);
    grounds.push_back(Box<S>{thin});
    for (const WorldDef<S>& def : settingsToTry<S>())
        for (const Shape<S>& ground : grounds)
            for (const Shape<S>& bullet : bullets<S>()) {
                std::mt19937 random(3);
                std::uniform_real_distribution<double> any(-1, 1);
                for (int shot = 0; shot < 12; ++shot) {
                    World<S> world(def);
                    const std::uint32_t material = world.addMaterial(R(0.3), R(shot % 2 == 0 ? 0 : 0.5));
                    addStatic<S>(world, ground, material);
                    const double steep = 1.4 * any(random), distance = 3 + 2.5 * any(random);
                    const typename S::Vec way = at<S>(std::sin(steep), -std::cos(steep));
                    typename S::Rot q = Pose<S>::identityRot();
                    typename S::Ang w = zeroAng<S>();
                    if constexpr (S::dim == 3) {
                        q = typename S::Rot(R(any(random)), R(any(random)), R(any(random)), R(any(random)));
                        q.normalize();
                        w = {R(50 * any(random)), R(50 * any(random)), R(50 * any(random))};
                    } else {
                        q = S::Rot::fromAngle(R(3 * any(random)));
                        w = R(50 * any(random));
                    }
                    const BodyId id = addBullet<S>(world, bullet, material,
                                                   typename S::Vec(static_cast<R>(-distance) * way),
                                                   typename S::Vec(R(300) * way), q, w);
                    for (int step = 0; step < 8; ++step) {
                        world.step(R(kFrame));
                        const auto p = world.pose(id).p;
                        if (std::abs(p.x()) > kHalf) break;
                        ASSERT_GT(static_cast<double>(p.y()), 0)
                            << def.continuousCollision << " solver " << def.solver << " ground "
                            << shapeName<S>(ground) << " bullet " << shapeName<S>(bullet) << " shot " << shot
                            << " step " << step;
                    }
                }
            }
}

/// Into a valley, whose convex hull is closed above: the sphere flies on until it meets the slopes, with the
/// impact at its exact time.
TYPED_TEST(SurfaceImpacts, AreWithTheSurfaceNotWithItsHull) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const Shape<S>& ground : surfacesOf<S>(valley)) {
        WorldDef<S> def;
        def.continuousCollision = "conservative_advancement";
        World<S> world(def);
        const std::uint32_t material = world.addMaterial(0, 0);
        addStatic<S>(world, ground, material);
        const double height = 6, speed = 150, radius = 0.1, x = 1;
        const BodyId ball = addBall<S>(world, x, height, radius, 1, material, 0, -speed);
        // It touches the slope of 45 degrees where its middle is radius sqrt(2) above it.
        const double exact = (height - x - radius * std::sqrt(2.0)) / speed;
        double time = -1;
        for (int step = 0; step < 4 && time < 0; ++step)
            for (const auto& impact : world.step(R(kFrame)).impacts)
                if (time < 0) time = step * kFrame + static_cast<double>(impact.time);
        EXPECT_NEAR(time, exact, 2e-6) << shapeName<S>(ground);
        EXPECT_LT(static_cast<double>(world.velocity(ball).x()), -1) << "deflected along the slope";
    }
}

/// A sphere and a box that slide over dozens of inner edges in a step keep their speed.
TYPED_TEST(SurfaceImpacts, InnerEdgesDoNotStopFastBodies) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const WorldDef<S>& def : settingsToTry<S>())
        for (const Shape<S>& ground : surfacesOf<S>(flat))
            for (const bool box : {false, true}) {
                World<S> world(def);
                const std::uint32_t material = world.addMaterial(0, 0);
                addStatic<S>(world, ground, material);
                const Shape<S> shape =
                    box ? Shape<S>(Box<S>{S::Vec::Constant(R(0.1))}) : Shape<S>(Sphere<S>{R(0.1)});
                const BodyId id = addBullet<S>(world, shape, material, at<S>(-7, 0.1), at<S>(100, 0),
                                               Pose<S>::identityRot(), zeroAng<S>());
                for (int step = 0; step < 8; ++step) world.step(R(kFrame));
                EXPECT_NEAR(static_cast<double>(world.velocity(id).x()), 100, 0.1)
                    << def.continuousCollision << " solver " << def.solver << " box " << box;
                EXPECT_NEAR(static_cast<double>(world.pose(id).p.x()), -7 + 800 * kFrame, 0.02);
                EXPECT_NEAR(static_cast<double>(world.velocity(id).y()), 0, 0.1);
            }
}

}  // namespace
}  // namespace rigor::engine::test
