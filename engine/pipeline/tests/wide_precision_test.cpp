// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The solver `wide` in worlds of f64: patches are in f32, bodies are not. The relative motion of two bodies
// is accurate to f32's rounding of that motion, at any common speed and distance from the origin, and what
// one gains the other loses to as much of what they exchange.
#include <gtest/gtest.h>

#include <vector>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class WidePrecision : public testing::Test {};
using WideSpaces = testing::Types<Space2d, Space3d>;
TYPED_TEST_SUITE(WidePrecision, WideSpaces);

/// A row of spheres and cubes that collide off their centres, without gravity; all have the velocity `common`
/// in addition, and the row begins at `x0`.
template <class S>
struct Crowd {
    World<S> world;
    std::vector<BodyId> bodies;
    std::vector<double> masses;

    explicit Crowd(double common, double x0 = 0) : world(def()) {
        const auto rubber = world.addMaterial(0.5, 0.4);
        for (int k = 0; k < 6; ++k) {
            const double mass = 1 + k, x = x0 + 1.1 * k, y = 0.1 * (k % 3), vx = common + 3 - k;
            const bool ball = k % 2 == 0;
            bodies.push_back(ball ? addBall<S>(world, x, y, 0.5, mass, rubber, vx, 0, 2.0 - k)
                                  : addCube<S>(world, x, y, 0.5, mass, rubber, vx));
            masses.push_back(mass);
        }
    }
    static WorldDef<S> def() {
        WorldDef<S> def;
        def.solver = "wide";
        return def;
    }
    void run() {
        for (int i = 0; i < 60; ++i) world.step(1.0 / 240);
    }
    typename S::Vec momentum() const {
        typename S::Vec p = S::Vec::Zero();
        for (std::size_t k = 0; k < bodies.size(); ++k) p += masses[k] * world.velocity(bodies[k]);
        return p;
    }
};

TYPED_TEST(WidePrecision, WhatOneGainsTheOtherLoses) {
    using S = TypeParam;
    Crowd<S> crowd(0);
    const typename S::Vec p = crowd.momentum();
    const typename S::Vec first = crowd.world.velocity(crowd.bodies[0]);
    crowd.run();
    EXPECT_GT((crowd.world.velocity(crowd.bodies[0]) - first).norm(), 1) << "nothing collided";
    EXPECT_LT((crowd.momentum() - p).norm(), 2e-6);  // the momenta are about 20 N s
}

/// The resolution of f32 velocities in a frame that flies at 10 km/s would be 1e-3 m/s.
TYPED_TEST(WidePrecision, DoesNotDependOnTheSpeedOfAll) {
    using S = TypeParam;
    Crowd<S> still(0), flying(1e4);
    still.run();
    flying.run();
    for (std::size_t k = 0; k < still.bodies.size(); ++k) {
        typename S::Vec v = flying.world.velocity(flying.bodies[k]);
        v[0] -= 1e4;
        EXPECT_NEAR((v - still.world.velocity(still.bodies[k])).norm(), 0, 2e-5) << k;
        EXPECT_NEAR(spinOf<S>(flying.world.angularVelocity(flying.bodies[k])),
                    spinOf<S>(still.world.angularVelocity(still.bodies[k])), 2e-5)
            << k;
    }
}

/// 100 km away f32 would know positions to 8 mm.
TYPED_TEST(WidePrecision, DoesNotDependOnThePlace) {
    using S = TypeParam;
    Crowd<S> here(0), there(0, 1e5);
    here.run();
    there.run();
    for (std::size_t k = 0; k < here.bodies.size(); ++k) {
        typename S::Vec x = there.world.pose(there.bodies[k]).p;
        x[0] -= 1e5;
        EXPECT_NEAR((x - here.world.pose(here.bodies[k]).p).norm(), 0, 1e-6) << k;
    }
}

}  // namespace
}  // namespace rigor::engine::test
