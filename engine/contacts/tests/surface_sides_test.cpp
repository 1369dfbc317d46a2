// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies stay on their side of a sheet: dropped so fast that they pass it within one step, in all shapes, on
// flat and rough meshes, height fields and chains; and a snapshot taken while they are through has the same
// future.
#include <gtest/gtest.h>

#include <random>

#include "engine/pipeline/tests/scene.hpp"
#include "engine/shapes/surface.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::engine::test {
namespace {

constexpr double kRough = 0.05;  ///< heights of rough ground, at most [m]

template <class S>
std::vector<Shape<S>> grounds(double rough) {
    using R = typename S::Real;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> height(-rough, rough);
    constexpr int kSide = 41;
    constexpr double kCell = 0.25, kHalf = 0.5 * kCell * (kSide - 1);
    if constexpr (S::dim == 2) {
        std::vector<typename S::Vec> v;
        for (int i = 0; i < kSide; ++i) v.push_back(at<S>(i * kCell - kHalf, height(random)));
        return {makeChain<S>(v, false)};
    } else {
        std::vector<typename S::Vec> v;
        std::vector<std::array<std::uint32_t, 3>> t;
        std::vector<R> heights;
        for (int k = 0; k < kSide; ++k)
            for (int i = 0; i < kSide; ++i) {
                heights.push_back(static_cast<R>(height(random)));
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

template <class S>
std::vector<Shape<S>> bodies(double size) {
    using R = typename S::Real;
    const auto length = [&](double x) { return R(size * x); };
    typename S::Vec plate = S::Vec::Constant(length(0.1));
    plate[1] = R(0.02);
    if constexpr (S::dim == 2)
        return {Sphere<S>{length(0.05)}, Capsule<S>{length(0.03), length(0.08)}, Box<S>{plate}};
    else
        return {Sphere<S>{length(0.05)}, Capsule<S>{length(0.03), length(0.08)}, Box<S>{plate},
                Cylinder<S>{length(0.06), length(0.04)}};
}

template <class S>
struct Rain {
    World<S> world;
    std::vector<BodyId> drops;
    std::vector<char> hasLeft;  ///< flag of each drop: 1 if it has gone beyond the ground's rim

    Rain(const WorldDef<S>& def, const Shape<S>& ground, int count, bool bouncing = false, double size = 1)
        : world(def) {
        using R = typename S::Real;
        const std::uint32_t stuff = world.addMaterial(R(0.5), R(bouncing ? 0.5 : 0));
        BodyDef<S> still;
        still.type = BodyType::Static;
        attach<S>(world, world.addBody(still), ground, stuff);
        std::mt19937 random(11);
        std::uniform_real_distribution<double> u(-1, 1);
        const std::vector<Shape<S>> shapes = bodies<S>(size);
        for (int i = 0; i < count; ++i) {
            const Shape<S>& shape = shapes[static_cast<std::size_t>(i) % shapes.size()];
            const MassProperties<S> m = massProperties<S>(shape, R(1000));
            BodyDef<S> body;
            body.mass = m.mass;
            body.inertia = m.inertia;
            body.pose.p = at<S>(3 * u(random), 2 + 3 * u(random) * (S::dim == 2 ? 8 : 0.5));
            if constexpr (S::dim == 3) {
                body.pose.p.z() = static_cast<R>(3 * u(random));
                body.pose.q = typename S::Rot(R(u(random)), R(u(random)), R(u(random)), R(u(random)));
                body.pose.q.normalize();
            } else {
                body.pose.p.y() += R(25);
                body.pose.q = S::Rot::fromAngle(R(3 * u(random)));
            }
            body.velocity = at<S>(u(random), -10 + 2 * u(random));
            body.angularVelocity = spin<S>(3 * u(random));
            drops.push_back(world.addBody(body));
            attach<S>(world, drops.back(), shape, stuff);
        }
        hasLeft.assign(drops.size(), 0);
    }
    void run(int steps, int rate = 60) {
        for (int i = 0; i < steps; ++i) {
            world.step(typename S::Real(1.0 / rate));
            for (std::size_t k = 0; k < drops.size(); ++k)
                hasLeft[k] = hasLeft[k] || !isOverGround(world.pose(drops[k]).p);
        }
    }
    static bool isOverGround(const typename S::Vec& p) {
        return std::abs(p.x()) < 4.8 && (S::dim == 2 || std::abs(p[S::dim - 1]) < 4.8);
    }
    /// Bodies below the ground that have not gone round its rim.
    int lost() const {
        int count = 0;
        for (std::size_t k = 0; k < drops.size(); ++k)
            count += !hasLeft[k] && world.pose(drops[k]).p.y() < -kRough - 0.3;
        return count;
    }
};

template <class S>
class SurfaceSidesOf : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(SurfaceSidesOf, Spaces);

TYPED_TEST(SurfaceSidesOf, NoBodyIsLost) {
    using S = TypeParam;
    for (const double rough : {0.0, kRough})
        for (const Shape<S>& ground : grounds<S>(rough))
            for (const bool fast : {false, true})
                for (const bool bouncing : {false, true}) {
                    WorldDef<S> def = earth<S>();
                    if (fast) preferSpeed(def);
                    Rain<S> rain(def, ground, 60, bouncing);
                    rain.run(S::dim == 2 ? 240 : 120);
                    EXPECT_EQ(rain.lost(), 0) << "ground " << ground.index() << " rough " << rough << " fast "
                                              << fast << " bouncing " << bouncing;
                }
}

/// At 1/30 s a plate moves by several times its thickness in a step. Where a midpoint is put back before a surface, the way
/// from there to the end of the step must not cross it.
TYPED_TEST(SurfaceSidesOf, NoPlateIsLostInLongSteps) {
    using S = TypeParam;
    for (const Shape<S>& ground : grounds<S>(kRough))
        for (const char* integrator : {"symplectic_euler", "moreau_midpoint"}) {
            WorldDef<S> def = earth<S>();
            def.integrator = integrator;
            Rain<S> rain(def, ground, 150, false, 1.6);
            rain.run(S::dim == 2 ? 120 : 60, 30);
            EXPECT_EQ(rain.lost(), 0) << integrator << " ground " << ground.index();
        }
}

TYPED_TEST(SurfaceSidesOf, BelongToTheState) {
    using S = TypeParam;
    const Shape<S> ground = grounds<S>(kRough)[0];
    for (const char* integrator : {"symplectic_euler", "moreau_midpoint"}) {
        WorldDef<S> def = earth<S>();
        def.integrator = integrator;
        Rain<S> whole(def, ground, 30), halves(def, ground, 30);
        for (int i = 0; i < 40; ++i) {
            whole.run(1);
            halves.run(1);
            std::vector<unsigned char> bytes;
            halves.world.saveSnapshot(bytes);
            Rain<S> fresh(def, ground, 30);
            fresh.world.restoreSnapshot(bytes);
            fresh.run(1);
            Rain<S> reference = whole;
            reference.run(1);
            ASSERT_EQ(fresh.world.stateHash(), reference.world.stateHash()) << integrator << " step " << i;
        }
    }
}

}  // namespace
}  // namespace rigor::engine::test
