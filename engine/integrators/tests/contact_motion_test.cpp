// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Integrators together with constraints: resting, bouncing, hanging, in every integrator and solver style.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class ConstrainedMotion : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(ConstrainedMotion, Spaces);

template <class S>
WorldDef<S> with(const char* integrator) {
    WorldDef<S> def = earth<S>();
    def.integrator = integrator;
    return def;
}

TYPED_TEST(ConstrainedMotion, ARestingCubeStaysAtRest) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& integrator : integratorTable<S>()) {
        World<S> world(with<S>(integrator.name));
        const auto wood = world.addMaterial(R(0.5), R(0));
        addGround<S>(world, wood);
        const BodyId cube = addCube<S>(world, 0, 0.5, 0.5, 2, wood);
        // Explicit Euler moves with the velocity of before: it oscillates by g h^2 for ever.
        const bool oscillates = std::string(integrator.name) == "explicit_euler";
        const double place = oscillates ? 6e-3 : 2e-5, speed = oscillates ? 0.4 : tol<S>(1e-9, 1e-4);
        for (int i = 0; i < 300; ++i) {
            world.step(R(1.0 / 60));
            ASSERT_NEAR(world.pose(cube).p[1], 0.5, place) << integrator.name << " " << i;
            ASSERT_LT(world.velocity(cube).norm(), speed) << integrator.name << " " << i;
        }
        EXPECT_NEAR(world.pose(cube).p[0], 0, 1e-5) << integrator.name;
    }
}

TYPED_TEST(ConstrainedMotion, ABallBouncesToItsHeight) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& integrator : integratorTable<S>()) {
        World<S> world(with<S>(integrator.name));
        const auto rubber = world.addMaterial(R(0), R(0.8));
        addGround<S>(world, rubber);
        const BodyId ball = addBall<S>(world, 0, 1.1, 0.1, 1, rubber);
        double top = 0;
        bool hit = false;
        for (int i = 0; i < 900; ++i) {
            world.step(R(1.0 / 1000));
            hit = hit || world.velocity(ball)[1] > R(0.1);
            if (hit) top = std::max(top, double(world.pose(ball).p[1]) - 0.1);
        }
        EXPECT_NEAR(top, 0.64, 0.02) << integrator.name;
    }
}

/// A rod with a weight: it hangs where it hung, and swings with its period.
TYPED_TEST(ConstrainedMotion, APendulumHangsAndSwings) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& integrator : integratorTable<S>()) {
        if (std::string(integrator.name) == "explicit_euler") continue;  // gains energy at every step
        for (const double angle : {0.0, 0.1}) {
            World<S> world(with<S>(integrator.name));
            const auto none = world.addMaterial(R(0), R(0));
            const BodyId bob = addBall<S>(world, std::sin(angle), -std::cos(angle), 0.01, 1, none);
            JointDef<S> rod;
            rod.type = JointType::Distance;
            rod.bodyB = bob;
            rod.length = 1;
            world.addJoint(rod);
            const double h = 1.0 / 500, omega = std::sqrt(kGravity);
            double worst = 0;
            for (int i = 1; i <= 1000; ++i) {
                world.step(static_cast<R>(h));
                const double exact = std::sin(angle) * std::cos(omega * (1 - angle * angle / 16) * i * h);
                worst = std::max(worst, std::abs(double(world.pose(bob).p[0]) - exact));
                ASSERT_NEAR(world.pose(bob).p.norm(), 1, 1e-4) << integrator.name << " " << i;
            }
            EXPECT_LT(worst, angle == 0 ? 1e-6 : 3e-3) << integrator.name << " " << angle;
        }
    }
}

/// Solvers that iterate on positions take velocities from them: what forces did must not be lost on the way.
TYPED_TEST(ConstrainedMotion, EverySolverLeavesFreeMotionAlone) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& solver : solverTable<S>())
        for (const auto& integrator : integratorTable<S>()) {
            WorldDef<S> def = with<S>(integrator.name);
            def.substeps = 1;
            World<S> plain(def);
            def.solver = solver.name;
            World<S> world(def);
            const BodyId a = addBall<S>(plain, 0, 0, 0.1, 1, 0, 3, 4, 2),
                         b = addBall<S>(world, 0, 0, 0.1, 1, 0, 3, 4, 2);
            for (int i = 0; i < 60; ++i) {
                plain.step(R(1.0 / 60));
                world.step(R(1.0 / 60));
            }
            EXPECT_NEAR((plain.pose(a).p - world.pose(b).p).norm(), 0, tol<S>(1e-12, 1e-4))
                << solver.name << " " << integrator.name;
            EXPECT_NEAR((plain.velocity(a) - world.velocity(b)).norm(), 0, tol<S>(1e-11, 1e-3))
                << solver.name << " " << integrator.name;
        }
}

}  // namespace
}  // namespace rigor::engine::test
