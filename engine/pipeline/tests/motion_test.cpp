// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies that touch nothing, against the closed forms of the scheme and of physics.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Motion : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Motion, Spaces);

TYPED_TEST(Motion, FreeFallIsTheSchemesClosedForm) {
    using S = TypeParam;
    const double h = 1.0 / 64.0;  // a power of two: time has no rounding
    for (const char* name : {"symplectic_euler", "explicit_euler"}) {
        WorldDef<S> def = earth<S>();
        def.integrator = name;
        World<S> world(def);
        const BodyId ball = addBall<S>(world, 1, 10, 0.1, 2, 0, 3, 5);
        const int n = 128;
        for (int i = 0; i < n; ++i) world.step(static_cast<typename S::Real>(h));
        const double shift = std::string(name) == "symplectic_euler" ? 1.0 : -1.0;
        const double y = 10 + 5 * n * h - 0.5 * kGravity * h * h * n * (n + shift);
        EXPECT_NEAR(world.pose(ball).p[1], y, tol<S>(1e-13, 2e-5)) << name;
        EXPECT_NEAR(world.pose(ball).p[0], 1 + 3 * n * h, tol<S>(1e-13, 2e-5)) << name;
        EXPECT_NEAR(world.velocity(ball)[1], 5 - kGravity * n * h, tol<S>(1e-12, 1e-4)) << name;
    }
}

TYPED_TEST(Motion, ForceActsForOneStepAtTheCentreOfMass) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world{WorldDef<S>{}};
    BodyDef<S> def;
    def.mass = 2;
    def.inertia = isotropic<S>(0.5);
    def.centerOfMass = at<S>(0.3, 0.1);
    const BodyId body = world.addBody(def);
    world.applyForce(body, at<S>(4, 0), spin<S>(1));
    world.applyForce(body, at<S>(4, 2), spin<S>(1));
    for (int i = 0; i < 3; ++i) world.step(R(0.25));
    EXPECT_NEAR(world.velocity(body)[0], 8.0 / 2 * 0.25, tol<S>(1e-15, 1e-6));
    EXPECT_NEAR(world.velocity(body)[1], 2.0 / 2 * 0.25, tol<S>(1e-15, 1e-6));
    EXPECT_NEAR(spinOf<S>(world.angularVelocity(body)), 2.0 / 0.5 * 0.25, tol<S>(1e-14, 1e-6));
}

TYPED_TEST(Motion, DampingIsAPowerOfTheFactorPerSecondAndExactWithAForce) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const double h : {0.5, 0.125}) {
        World<S> world{WorldDef<S>{}};
        BodyDef<S> def;
        def.mass = 1;
        def.inertia = isotropic<S>(1);
        def.velocity = at<S>(3, 0);
        def.angularVelocity = spin<S>(2);
        def.linearVelocityKept = R(0.5);
        def.angularVelocityKept = R(0.25);
        const BodyId body = world.addBody(def);
        for (int i = 0; i < static_cast<int>(2 / h); ++i) {
            world.applyForce(body, at<S>(0, 1), spin<S>(0));
            world.step(static_cast<R>(h));
        }
        const double c = -std::log(0.5);
        EXPECT_NEAR(world.velocity(body)[0], 3 * 0.25, tol<S>(1e-14, 1e-6));
        EXPECT_NEAR(world.velocity(body)[1], (1 - std::exp(-2 * c)) / c, tol<S>(1e-14, 1e-6));
        EXPECT_NEAR(spinOf<S>(world.angularVelocity(body)), 2.0 / 16, tol<S>(1e-14, 1e-6));
    }
}

/// v = v0 kept^t + F/(m c) (1 - kept^t), c = -ln(kept), in every integrator. Both Euler schemes and Verlet
/// solve the damped kick exactly; rk4 is within h^4.
TYPED_TEST(Motion, DampingIsTheSameInEveryIntegrator) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& integrator : integratorTable<S>()) {
        WorldDef<S> worldDef;
        worldDef.integrator = integrator.name;
        World<S> world(worldDef);
        BodyDef<S> def;
        def.mass = 2;
        def.inertia = isotropic<S>(0.5);
        def.velocity = at<S>(3, 0);
        def.angularVelocity = spin<S>(2);
        def.linearVelocityKept = R(0.5);
        def.angularVelocityKept = R(0.25);
        const BodyId body = world.addBody(def);
        ConstantForce<S> force;
        force.body = body;
        force.force = at<S>(0, 4);
        force.torque = spin<S>(1);
        world.addForce(force);
        for (int i = 0; i < 128; ++i) world.step(R(1.0 / 64));
        const double c = -std::log(0.5), k = -std::log(0.25);
        const double tolerance = std::string(integrator.name) == "rk4" ? 1e-9 : 1e-13;
        EXPECT_NEAR(world.velocity(body)[0], 3 * 0.25, tol<S>(tolerance, 1e-5)) << integrator.name;
        EXPECT_NEAR(world.velocity(body)[1], 2 * 0.75 / c, tol<S>(tolerance, 1e-5)) << integrator.name;
        EXPECT_NEAR(spinOf<S>(world.angularVelocity(body)), 2.0 / 16 + 2 * (1 - 1.0 / 16) / k,
                    tol<S>(tolerance, 1e-5))
            << integrator.name;
    }
}

TYPED_TEST(Motion, GravityScaleAndOffsetCentreOfMass) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    BodyDef<S> def;
    def.mass = 1;
    def.inertia = isotropic<S>(1);
    def.centerOfMass = at<S>(0.5, 0);
    def.angularVelocity = spin<S>(2);
    def.gravityScale = 0;
    const BodyId body = world.addBody(def);
    for (int i = 0; i < 100; ++i) world.step(R(0.01));
    // The centre of mass stands at (0.5, 0); the body frame turns around it by 2 rad.
    EXPECT_NEAR(world.pose(body).p[0], 0.5 - 0.5 * std::cos(2.0), tol<S>(1e-13, 1e-5));
    EXPECT_NEAR(world.pose(body).p[1], -0.5 * std::sin(2.0), tol<S>(1e-13, 1e-5));
}

TYPED_TEST(Motion, KinematicBodiesFollowTheirVelocityThroughEverything) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    addGround<S>(world, 0);
    BodyDef<S> def;
    def.type = BodyType::Kinematic;
    def.pose.p = at<S>(0, 1);
    def.velocity = at<S>(0, -1);
    def.angularVelocity = spin<S>(1);
    const BodyId body = world.addBody(def);
    attach<S>(world, body, Sphere<S>{R(0.5)}, 0);
    for (int i = 0; i < 128; ++i) world.step(R(1.0 / 64));
    EXPECT_NEAR(world.pose(body).p[1], -1, tol<S>(1e-14, 1e-6));
    EXPECT_EQ(world.velocity(body)[1], R(-1));
}

// q(5) and w(5) of I = (1, 2, 3), w0 = (3, 1, -2): see lie_midpoint's order below; energy and momentum
// exactly.
double topError(const char* rotation, double h, double* energyDrift, double* momentumDrift) {
    using S = Space3d;
    WorldDef<S> def;
    def.rotation = rotation;
    World<S> world(def);
    BodyDef<S> body;
    body.mass = 1;
    body.inertia = Eigen::Vector3d(1, 2, 3).asDiagonal();
    body.angularVelocity = Eigen::Vector3d(3, 1, -2);
    const BodyId id = world.addBody(body);
    for (int i = 0; i < static_cast<int>(5 / h + 0.5); ++i) world.step(h);
    const Eigen::Quaterniond q = world.pose(id).q;
    const Eigen::Vector3d w = q.conjugate() * world.angularVelocity(id);
    const Eigen::Vector3d L = q * Eigen::Vector3d(body.inertia * w);
    *energyDrift = 0.5 * w.dot(body.inertia * w) - 11.5;
    *momentumDrift = (L - Eigen::Vector3d(3, 2, -6)).norm();
    // Integrated by two independent methods to 1e-10.
    return q.angularDistance(Eigen::Quaterniond(0.3375275118, 0.5678892417, -0.3075971611, -0.6848072535));
}

TEST(Top, LieMidpointKeepsEnergyAndMomentumAndIsOfOrderTwo) {
    double energy = 0, momentum = 0;
    const double coarse = topError("lie_midpoint", 1.0 / 64, &energy, &momentum);
    EXPECT_LT(std::abs(energy), 1e-10);
    EXPECT_LT(momentum, 1e-10);
    const double fine = topError("lie_midpoint", 1.0 / 256, &energy, &momentum);
    EXPECT_NEAR(std::log2(coarse / fine) / 2, 2.0, 0.05);
    EXPECT_LT(fine, 2e-4);
}

TEST(Top, EulerVariantsConvergeWithOrderOneFromTheirOwnSides) {
    for (const char* rotation : {"explicit", "implicit"}) {
        double energy = 0, momentum = 0, finerEnergy = 0;
        const double coarse = topError(rotation, 1.0 / 512, &energy, &momentum);
        const double fine = topError(rotation, 1.0 / 2048, &finerEnergy, &momentum);
        EXPECT_NEAR(std::log2(coarse / fine) / 2, 1.0, 0.1) << rotation;
        EXPECT_GT(finerEnergy * (std::string(rotation) == "explicit" ? 1 : -1), 1e-3) << rotation;
    }
    double energy = 0, momentum = 0;
    EXPECT_GT(topError("none", 1.0 / 2048, &energy, &momentum), 1.0) << "another law: does not converge";
}

TEST(Top, QuaternionStaysUnit) {
    for (const char* rotation : {"none", "explicit", "implicit", "lie_midpoint"}) {
        WorldDef<Space3f> def;
        def.rotation = rotation;
        World<Space3f> world(def);
        BodyDef<Space3f> body;
        body.mass = 1;
        body.inertia = Eigen::Vector3f(1.0f, 1.1f, 1.2f).asDiagonal();
        body.angularVelocity = Eigen::Vector3f(8, 3, -5);
        const BodyId id = world.addBody(body);
        for (int i = 0; i < 2000; ++i) {
            world.step(1.0f / 60);
            ASSERT_NEAR(world.pose(id).q.norm(), 1.0f, 4e-7f) << rotation;
        }
    }
}

}  // namespace
}  // namespace rigor::engine::test
