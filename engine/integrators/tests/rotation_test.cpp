// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Torque-free rotation: every rotation scheme and every orientation update, against its order and its
// invariants.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class R>
using Vec3 = Eigen::Matrix<R, 3, 1>;

/// The asymmetric top I = (1, 2, 3) kg m^2, w = (3, 1, -2) rad/s: tumbles through all axes.
template <class S>
BodyId addTop(World<S>& world, double speed = 1) {
    using R = typename S::Real;
    BodyDef<S> body;
    body.mass = 1;
    body.inertia = Vec3<R>(1, 2, 3).asDiagonal();
    body.angularVelocity = static_cast<R>(speed) * Vec3<R>(3, 1, -2);
    return world.addBody(body);
}

struct Drift {
    double energy = 0, momentum = 0;  ///< largest, relative
};
/// Follows energy and angular momentum over `steps` steps.
template <class S>
Drift driftOf(World<S>& world, BodyId top, int steps, double h) {
    const Eigen::Vector3d I(1, 2, 3);
    double E0 = 0;
    Eigen::Vector3d L0;
    Drift drift;
    for (int i = 0; i <= steps; ++i) {
        if (i > 0) world.step(static_cast<typename S::Real>(h));
        const Eigen::Quaterniond q = world.pose(top).q.template cast<double>();
        const Eigen::Vector3d w = q.conjugate() * world.angularVelocity(top).template cast<double>();
        const double E = 0.5 * w.dot(I.cwiseProduct(w));
        const Eigen::Vector3d L = q * I.cwiseProduct(w);
        if (i == 0) {
            E0 = E;
            L0 = L;
        }
        drift.energy = std::max(drift.energy, std::abs(E / E0 - 1));
        drift.momentum = std::max(drift.momentum, (L - L0).norm() / L0.norm());
    }
    return drift;
}

Eigen::Quaterniond orientationAfter(const std::string& rotation, const std::string& update, double duration,
                                    int steps) {
    WorldDef<Space3d> def;
    def.rotation = rotation;
    def.orientationUpdate = update;
    World<Space3d> world(def);
    const BodyId top = addTop(world);
    for (int i = 0; i < steps; ++i) world.step(duration / steps);
    return world.pose(top).q;
}

const std::map<std::string, double> kRotationOrder{
    {"explicit", 1}, {"implicit", 1}, {"lie_midpoint", 2}, {"moser_veselov", 2}};

TEST(Rotation, EverySchemeHasItsOrderWithEveryUpdate) {
    // Integrated by two independent methods to 1e-10.
    const Eigen::Quaterniond exact(0.3375275118, 0.5678892417, -0.3075971611, -0.6848072535);
    for (const auto& scheme : rotationTable<Space3d>()) {
        if (std::string(scheme.name) == "none") continue;  // another law
        ASSERT_TRUE(kRotationOrder.count(scheme.name)) << scheme.name << ": what is its order?";
        const double expected = kRotationOrder.at(scheme.name);
        for (const auto& update : orientationUpdateTable<Space3d>()) {
            const int steps = expected == 1 ? 4096 : 512;
            const double coarse = orientationAfter(scheme.name, update.name, 5, steps).angularDistance(exact),
                         fine =
                             orientationAfter(scheme.name, update.name, 5, 4 * steps).angularDistance(exact);
            EXPECT_NEAR(std::log2(coarse / fine) / 2, expected, 0.1) << scheme.name << " " << update.name;
        }
    }
}

TEST(Rotation, ConservingSchemesKeepEnergyAndMomentumOverAHundredThousandSteps) {
    for (const char* scheme : {"lie_midpoint", "moser_veselov"}) {
        WorldDef<Space3d> def;
        def.rotation = scheme;
        World<Space3d> world(def);
        const BodyId top = addTop(world);
        const Drift drift = driftOf(world, top, 100000, 1e-3);
        EXPECT_LT(drift.energy, 2e-11) << scheme;
        EXPECT_LT(drift.momentum, 1e-11) << scheme;
        RecordProperty(std::string(scheme) + "_drift", std::to_string(1e12 * drift.energy) + "e-12");
    }
}

/// Bodies whose inertias have no exact inverse, about axes of all kinds, also when the body axes are not the
/// principal ones: what rounding does to the length of the angular momentum must not add up.
TEST(Rotation, RoundingOfAnyBodyDoesNotAddUp) {
    struct Body {
        Eigen::Vector3d inertia, velocity;
        bool turned;
    };
    const Body bodies[] = {{{1.0 / 120, 37.0 / 1200, 3.0 / 80}, {0.2, 4, 0}, false},
                           {{0.7, 1.1, 1.3}, {1e-3, 5, 1e-3}, true},
                           {{0.013, 0.029, 0.041}, {3, 0.1, -2}, true}};
    for (const Body& top : bodies) {
        World<Space3d> world(WorldDef<Space3d>{});
        BodyDef<Space3d> def;
        const Eigen::Quaterniond turn = Eigen::Quaterniond(0.5, 0.1, -0.7, 0.3).normalized();
        const Eigen::Matrix3d R = top.turned ? turn.toRotationMatrix() : Eigen::Matrix3d::Identity();
        def.mass = 1;
        def.inertia = R * top.inertia.asDiagonal() * R.transpose();
        def.angularVelocity = R * top.velocity;
        const BodyId id = world.addBody(def);
        const auto momentum = [&] {
            const Eigen::Quaterniond q = world.pose(id).q;
            return Eigen::Vector3d(q * (def.inertia * (q.conjugate() * world.angularVelocity(id))));
        };
        const Eigen::Vector3d start = momentum();
        for (int i = 0; i < 50000; ++i) world.step(1e-3);
        EXPECT_LT(std::abs(momentum().norm() / start.norm() - 1), 5e-12) << top.inertia.transpose();
    }
}

TEST(Rotation, ConservingSchemesKeepEnergyAtLargeStepsToo) {
    // h |w| = 0.37 and 1.9.
    for (const char* scheme : {"lie_midpoint", "moser_veselov"})
        for (const double h : {0.1, 0.5}) {
            WorldDef<Space3d> def;
            def.rotation = scheme;
            World<Space3d> world(def);
            const BodyId top = addTop(world);
            const Drift drift = driftOf(world, top, 2000, h);
            EXPECT_LT(drift.energy, 1e-11) << scheme << " " << h;
            EXPECT_LT(drift.momentum, 1e-11) << scheme << " " << h;
        }
}

TEST(Rotation, InSinglePrecisionTheDriftIsRounding) {
    for (const char* scheme : {"lie_midpoint", "moser_veselov"}) {
        WorldDef<Space3f> def;
        def.rotation = scheme;
        World<Space3f> world(def);
        const BodyId top = addTop(world);
        const Drift drift = driftOf(world, top, 10000, 1.0 / 256);
        // 1e4 steps of a few units in the last place (6e-8), not quite without bias: measured 4.4e-4
        // and 1.8e-4.
        EXPECT_LT(drift.energy, 1e-3) << scheme;
        EXPECT_LT(drift.momentum, 5e-4) << scheme;
    }
}

TEST(Rotation, ExplicitGainsEnergyImplicitLosesIt) {
    for (const char* scheme : {"explicit", "implicit"}) {
        WorldDef<Space3d> def;
        def.rotation = scheme;
        World<Space3d> world(def);
        const BodyId top = addTop(world);
        double last = 0.5 * (9 + 2 + 12);
        const bool grows = std::string(scheme) == "explicit";
        for (int i = 0; i < 200; ++i) {
            for (int k = 0; k < 10; ++k) world.step(1.0 / 512);
            const Eigen::Vector3d w = world.pose(top).q.conjugate() * world.angularVelocity(top);
            const double E = 0.5 * w.dot(Eigen::Vector3d(1, 2, 3).cwiseProduct(w));
            ASSERT_EQ(E > last, grows) << scheme << " " << i;
            last = E;
        }
        EXPECT_GT(std::abs(last / 11.5 - 1), 0.01) << scheme;
    }
}

TEST(Rotation, BodiesTooFastForTheStepStayFinite) {
    // The explicit term squares the speed in every step: that one may overflow, and says so.
    for (const auto& scheme : rotationTable<Space3d>()) {
        if (std::string(scheme.name) == "explicit") continue;
        for (const double speed : {1e2, 1e4, 1e8, 1e100}) {
            WorldDef<Space3d> def;
            def.rotation = scheme.name;
            World<Space3d> world(def);
            const BodyId top = addTop(world, speed);
            for (int i = 0; i < 50; ++i) world.step(1.0 / 60);
            EXPECT_FALSE(world.lastStep().nonFinite) << scheme.name << " " << speed;
            EXPECT_NEAR(world.pose(top).q.norm(), 1, 1e-12) << scheme.name << " " << speed;
        }
    }
}

TEST(Rotation, PrincipalAxesAndSpheresTurnUniformlyInEveryScheme) {
    for (const auto& scheme : rotationTable<Space3d>())
        for (const int axis : {0, 1, 2}) {
            WorldDef<Space3d> def;
            def.rotation = scheme.name;
            World<Space3d> world(def);
            BodyDef<Space3d> body;
            body.mass = 1;
            body.inertia = Eigen::Vector3d(1, 2, 3).asDiagonal();
            body.angularVelocity = 4 * Eigen::Vector3d::Unit(axis);
            const BodyId id = world.addBody(body);
            for (int i = 0; i < 64; ++i) world.step(1.0 / 64);
            const Eigen::Quaterniond exact(Eigen::AngleAxisd(4, Eigen::Vector3d::Unit(axis)));
            EXPECT_LT(world.pose(id).q.angularDistance(exact), 1e-13) << scheme.name;
        }
}

/// A torque along no axis of the body: momentum is what the torque gave, in every scheme that has the term.
TEST(Rotation, TorqueGivesItsAngularMomentum) {
    for (const char* scheme : {"lie_midpoint", "moser_veselov"})
        for (const auto& integrator : integratorTable<Space3d>()) {
            WorldDef<Space3d> def;
            def.rotation = scheme;
            def.integrator = integrator.name;
            World<Space3d> world(def);
            const BodyId top = addTop(world);
            ConstantForce<Space3d> push;
            push.body = top;
            push.torque = {0.5, -1, 2};
            push.start = 0.3;
            push.end = 1.7;
            world.addForce(push);
            for (int i = 0; i < 256; ++i) world.step(1.0 / 128);
            const Eigen::Quaterniond q = world.pose(top).q;
            const Eigen::Vector3d w = q.conjugate() * world.angularVelocity(top);
            const Eigen::Vector3d L = q * Eigen::Vector3d(1, 2, 3).cwiseProduct(w);
            // Explicit Euler moves with the velocity of the start: its momentum is off by its order.
            const double bound = std::string(integrator.name) == "explicit_euler" ? 0.5 : 1e-12;
            EXPECT_LT((L - Eigen::Vector3d(3, 2, -6) - 1.4 * push.torque).norm(), bound)
                << scheme << " " << integrator.name;
        }
}

TEST(OrientationUpdate, AtAFixedRateTheFirstOrderUpdateIsShortByTheCubeOfTheAngle) {
    for (const double h : {0.1, 0.5}) {
        const double w = 3, turned = 2 * std::atan(w * h / 2);
        for (const char* update : {"first_order", "exponential_map"}) {
            const double expected = std::string(update) == "first_order" ? turned : w * h;
            WorldDef<Space3d> def3;
            def3.orientationUpdate = update;
            World<Space3d> world3(def3);
            BodyDef<Space3d> body3;
            body3.angularVelocity = {0, 0, w};
            const BodyId id3 = world3.addBody(body3);
            WorldDef<Space2d> def2;
            def2.orientationUpdate = update;
            World<Space2d> world2(def2);
            BodyDef<Space2d> body2;
            body2.angularVelocity = w;
            const BodyId id2 = world2.addBody(body2);
            for (int i = 1; i <= 2; ++i) {
                world3.step(h);
                world2.step(h);
                const Eigen::Quaterniond exact(Eigen::AngleAxisd(i * expected, Eigen::Vector3d::UnitZ()));
                EXPECT_LT(world3.pose(id3).q.angularDistance(exact), 1e-14) << update;
                EXPECT_NEAR(world2.pose(id2).q.c, std::cos(i * expected), 1e-14) << update;
                EXPECT_NEAR(world2.pose(id2).q.s, std::sin(i * expected), 1e-14) << update;
            }
        }
    }
}

}  // namespace
}  // namespace rigor::engine::test
