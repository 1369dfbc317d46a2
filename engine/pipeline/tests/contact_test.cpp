// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Impacts, friction and rest.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Contacts : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Contacts, Spaces);

TYPED_TEST(Contacts, ReboundIsExactlyTheCoefficientTimesTheApproach) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const double e : {1.0, 0.7, 0.5, 0.0}) {
        WorldDef<S> def = earthByEuler<S>();
        def.speculativeMotion = 0;  // the ball touches when its approach ends, whatever e
        World<S> world(def);
        const std::uint32_t m = world.addMaterial(R(0.3), static_cast<R>(e));
        addGround<S>(world, m);
        const BodyId ball = addBall<S>(world, 0, 2, 0.5, 3, m);
        double before = 0;
        int impacts = 0;
        for (int i = 0; i < 200 && impacts < 3; ++i) {
            before = world.velocity(ball)[1];
            world.step(R(1.0 / 60));
            const double after = world.velocity(ball)[1];
            if (before < -0.5 && after > before + 0.4) {
                ++impacts;
                EXPECT_NEAR(after, -e * before, tol<S>(1e-14, 1e-6) * std::abs(before)) << "e = " << e;
            }
        }
        EXPECT_EQ(impacts, e > 0 ? 3 : 1) << "e = " << e;
    }
}

TYPED_TEST(Contacts, ElasticBallComesBackToItsHeight) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    const std::uint32_t m = world.addMaterial(0, 1);
    addGround<S>(world, m);
    const BodyId ball = addBall<S>(world, 0, 2, 0.5, 1, m);
    double highest = 0;
    for (int i = 0; i < 3600; ++i) {
        world.step(R(1.0 / 60));
        if (i > 3500) highest = std::max(highest, static_cast<double>(world.pose(ball).p[1]));
    }
    // A minute of bounces; the sampling of the apex alone is g h^2 / 8 = 3e-4.
    EXPECT_NEAR(highest, 2, tol<S>(4e-4, 2e-2));
}

TYPED_TEST(Contacts, CollisionsConserveMomentumAndObeyNewton) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world{WorldDef<S>{}};
    const std::uint32_t m = world.addMaterial(R(0.4), R(0.5));
    const double m1 = 1, m2 = 3, u1 = 2, u2 = -1, e = 0.5;
    const BodyId a = addBall<S>(world, -0.5, 0, 0.2, m1, m, u1);
    const BodyId b = addBall<S>(world, 0.5, 0, 0.3, m2, m, u2);
    for (int i = 0; i < 60; ++i) world.step(R(1.0 / 60));
    const double v1 = (m1 * u1 + m2 * u2 - m2 * e * (u1 - u2)) / (m1 + m2);
    EXPECT_NEAR(world.velocity(a)[0], v1, tol<S>(1e-14, 1e-6));
    EXPECT_NEAR(world.velocity(b)[0], v1 + e * (u1 - u2), tol<S>(1e-14, 1e-6));
}

TYPED_TEST(Contacts, ObliqueFrictionalImpactConservesLinearAndAngularMomentum) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world{WorldDef<S>{}};
    const std::uint32_t m = world.addMaterial(R(0.6), R(0.8));
    const BodyId a = addBall<S>(world, -0.6, 0.15, 0.2, 1, m, 2, 0, 5);
    const BodyId b = addCube<S>(world, 0.3, 0, 0.25, 2, m, -1);
    const auto momentum = [&] {
        double L = 0, px = 0, py = 0;
        for (const BodyId id : {a, b}) {
            const double mass = world.constants(id).mass;
            const typename S::Vec p = world.pose(id).p, v = world.velocity(id);
            px += mass * v[0];
            py += mass * v[1];
            const double I = id == a ? 0.4 * 1 * 0.04 : 2.0 / 3 * 2 * 0.0625;
            L += mass * (p[0] * v[1] - p[1] * v[0]) + I * spinOf<S>(world.angularVelocity(id));
        }
        return std::array<double, 3>{px, py, L};
    };
    const auto before = momentum();
    for (int i = 0; i < 120; ++i) world.step(R(1.0 / 60));
    EXPECT_GT(std::abs(spinOf<S>(world.angularVelocity(b))), 0.1) << "they did collide";
    const auto after = momentum();
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(after[k], before[k], tol<S>(1e-13, 2e-5));
}

TYPED_TEST(Contacts, CradleWithGapsPassesTheBlowOn) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world{WorldDef<S>{}};
    const std::uint32_t m = world.addMaterial(0, 1);
    std::vector<BodyId> balls;
    for (int i = 0; i < 5; ++i) balls.push_back(addBall<S>(world, i * 0.201, 0, 0.1, 1, m, i == 0 ? 1 : 0));
    for (int i = 0; i < 60; ++i) world.step(R(1.0 / 60));
    for (std::size_t i = 0; i < 5; ++i)
        EXPECT_NEAR(world.velocity(balls[i])[0], i == 4 ? 1 : 0, tol<S>(1e-14, 1e-6));
}

TYPED_TEST(Contacts, SlidingBoxStopsWhereTheSchemeStopsIt) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const double h : {1.0 / 60, 1.0 / 240}) {
        World<S> world(earthByEuler<S>());
        const std::uint32_t m = world.addMaterial(R(0.5), 0);
        addGround<S>(world, m);
        const BodyId box = addCube<S>(world, 0, 0.25, 0.25, 2, m, 4);
        for (double t = 0; t < 1.5; t += h) world.step(static_cast<R>(h));
        const double v = 4, mu = 0.5;
        // d = v^2 / (2 mu g) - v h / 2 + O(h^2)
        EXPECT_NEAR(world.pose(box).p[0], v * v / (2 * mu * kGravity) - v * h / 2,
                    1.5 * h * h * kGravity * mu);
        EXPECT_LT(world.velocity(box).norm(), tol<S>(1e-12, 1e-5));
    }
}

TYPED_TEST(Contacts, SkiddingBallEndsAtFiveSevenths) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    const std::uint32_t m = world.addMaterial(R(0.3), 0);
    addGround<S>(world, m);
    const BodyId ball = addBall<S>(world, 0, 0.2, 0.2, 1, m, 3);
    for (int i = 0; i < 180; ++i) world.step(R(1.0 / 60));
    EXPECT_NEAR(world.velocity(ball)[0], 3 * 5.0 / 7, tol<S>(1e-12, 2e-5));
    EXPECT_NEAR(spinOf<S>(world.angularVelocity(ball)) * 0.2, -3 * 5.0 / 7, tol<S>(1e-12, 2e-5));
}

TYPED_TEST(Contacts, BoxOnAnInclineSticksAboveTheThresholdAndSlidesBelow) {
    using S = TypeParam;
    using R = typename S::Real;
    const double alpha = 0.5;
    for (const double excess : {-0.01, 0.01}) {
        WorldDef<S> def;
        def.gravity = at<S>(kGravity * std::sin(alpha), -kGravity * std::cos(alpha));
        World<S> world(def);
        const double mu = std::tan(alpha) + excess;
        const std::uint32_t m = world.addMaterial(static_cast<R>(mu), 0);
        addGround<S>(world, m);
        const BodyId box = addCube<S>(world, 0, 0.25, 0.25, 1, m);
        for (int i = 0; i < 120; ++i) world.step(R(1.0 / 60));
        const double a = std::max(0.0, kGravity * (std::sin(alpha) - mu * std::cos(alpha)));
        EXPECT_NEAR(world.velocity(box)[0], 2 * a, tol<S>(1e-5, 1e-4));
        // The box itself must not rock off its face.
        EXPECT_NEAR(world.pose(box).p[1], 0.25, 1e-4);
    }
}

/// Largest displacement from the start, and largest kinetic energy at and after the given step.
struct Rest {
    double moved = 0, energy = 0;
};
template <class S>
Rest restOf(World<S>& world, const std::vector<BodyId>& bodies, int steps) {
    using R = typename S::Real;
    std::vector<typename S::Vec> start;
    for (const BodyId id : bodies) start.push_back(world.pose(id).p);
    Rest rest;
    for (int i = 0; i < steps; ++i) {
        world.step(R(1.0 / 60));
        double energy = 0;
        for (const BodyId id : bodies) {
            energy += 0.5 * world.constants(id).mass * world.velocity(id).squaredNorm();
            energy += 0.5 * dotAng(world.angularVelocity(id), world.angularVelocity(id)) / 6;
        }
        rest.energy = std::max(rest.energy, energy);
    }
    for (std::size_t i = 0; i < bodies.size(); ++i)
        rest.moved = std::max(rest.moved, static_cast<double>((world.pose(bodies[i]).p - start[i]).norm()));
    return rest;
}

TYPED_TEST(Contacts, StackOfTenStandsStill) {
    using S = TypeParam;
    World<S> world(earth<S>());
    const std::uint32_t m = world.addMaterial(typename S::Real(0.5), 0);
    addGround<S>(world, m);
    std::vector<BodyId> boxes;
    for (int i = 0; i < 10; ++i) boxes.push_back(addCube<S>(world, 0, 0.5 + i, 0.5, 1, m));
    const Rest rest = restOf<S>(world, boxes, 600);
    // Measured: 1e-5 m in double, 1e-4 to 1e-3 m in single precision; one step of free fall is 0.13 J.
    EXPECT_LT(rest.moved, sizeof(typename S::Real) == 4 ? 3e-3 : 1e-4);
    EXPECT_LT(rest.energy, 1e-6);
}

/// Taller ones have more rows than Newton's method takes in any case, but narrow matrices.
TYPED_TEST(Contacts, TallerStacksAreSolvedToo) {
    using S = TypeParam;
    if constexpr (sizeof(typename S::Real) == 8) {
        for (const int count : {11, 14, 18}) {
            World<S> world(earth<S>());
            const std::uint32_t m = world.addMaterial(typename S::Real(0.5), 0);
            addGround<S>(world, m);
            std::vector<BodyId> boxes;
            for (int i = 0; i < count; ++i) boxes.push_back(addCube<S>(world, 0, 0.5 + i, 0.5, 1, m));
            const Rest rest = restOf<S>(world, boxes, 240);
            EXPECT_LT(rest.energy, 1e-7) << count << " boxes";
            EXPECT_LT(rest.moved, 1e-4) << count << " boxes";
            int iterations = 0;
            for (int i = 0; i < 30; ++i) iterations += world.step(typename S::Real(1.0 / 60)).iterations;
            EXPECT_LT(iterations, 30 * 12) << count << " boxes";
        }
    }
}

TYPED_TEST(Contacts, PyramidOfTenRowsStandsStill) {
    using S = TypeParam;
    World<S> world(earth<S>());
    const std::uint32_t m = world.addMaterial(typename S::Real(0.5), 0);
    addGround<S>(world, m);
    std::vector<BodyId> boxes;
    for (int row = 0; row < 10; ++row)
        for (int i = 0; i < 10 - row; ++i)
            boxes.push_back(addCube<S>(world, 1.05 * (i - 0.5 * (9 - row)), 0.5 + row, 0.5, 1, m));
    const Rest rest = restOf<S>(world, boxes, 600);
    // Measured: 2e-6 m and 3e-9 J; in single precision up to 2e-4 m and 9e-6 J: a rounding of 1e-6 m, ten
    // metres up, is 6e-5 m/s at this step, and each of 55 boxes moves by some of them.
    EXPECT_LT(rest.moved, 5e-4);
    EXPECT_LT(rest.energy, tol<S>(1e-7, 1e-4));
    // Such rounding is nothing that sweeps have to solve.
    int most = 0;
    for (int i = 0; i < 300; ++i) most = std::max(most, world.step(typename S::Real(1.0 / 60)).iterations);
    EXPECT_LT(most, 40);
}

TYPED_TEST(Contacts, StackDroppedOntoTheGroundComesToRest) {
    using S = TypeParam;
    World<S> world(earth<S>());
    const std::uint32_t m = world.addMaterial(typename S::Real(0.5), 0);
    addGround<S>(world, m);
    std::vector<BodyId> boxes;
    for (int i = 0; i < 5; ++i) boxes.push_back(addCube<S>(world, 0.02 * i, 0.55 + 1.05 * i, 0.5, 1, m));
    restOf<S>(world, boxes, 300);
    const Rest rest = restOf<S>(world, boxes, 300);
    EXPECT_LT(rest.energy, 1e-4);
    EXPECT_NEAR(world.pose(boxes[4]).p[1], 4.5, 2e-3);
}

TYPED_TEST(Contacts, ImpulsesCarryTheWeight) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    const std::uint32_t m = world.addMaterial(R(0.5), 0);
    addGround<S>(world, m);
    addCube<S>(world, 0, 0.5, 0.5, 2, m);
    addCube<S>(world, 0.1, 1.5, 0.5, 3, m);
    for (int i = 0; i < 60; ++i) world.step(R(1.0 / 60));
    std::vector<ContactView<S>> contacts;
    world.readContacts(contacts);
    double ground = 0, upper = 0;
    for (const ContactView<S>& c : contacts) {
        EXPECT_NEAR(c.normal[1], 1, 1e-4) << "from the lower index to the higher";
        (c.bodyA.index == 1 ? ground : upper) += c.normalImpulse;
    }
    EXPECT_NEAR(ground, 5 * kGravity / 60, tol<S>(1e-5, 1e-4));
    EXPECT_NEAR(upper, 3 * kGravity / 60, tol<S>(1e-5, 1e-4));
}

TEST(Contacts3d, ConeFrictionIsTheSameInEveryDirectionAndPyramidIsNot) {
    using S = Space3d;
    const auto travelled = [](const char* friction, double angle) {
        WorldDef<S> def = earth<S>();
        def.friction = friction;
        World<S> world(def);
        const std::uint32_t m = world.addMaterial(0.5, 0);
        addGround<S>(world, m);
        const BodyId box = addCube<S>(world, 0, 0.25, 0.25, 1, m);
        world.setVelocity(box, {3 * std::cos(angle), 0, 3 * std::sin(angle)}, S::Ang::Zero());
        for (int i = 0; i < 240; ++i) world.step(1.0 / 240);
        const Eigen::Vector3d p = world.pose(box).p;
        return Eigen::Vector2d(p.x(), p.z());
    };
    const double straight = travelled("cone", 0).norm();
    for (const double angle : {0.2, 0.39269908, 0.78539816, 2.0}) {
        const Eigen::Vector2d d = travelled("cone", angle);
        EXPECT_NEAR(d.norm(), straight, 1e-4) << angle;
        EXPECT_NEAR(std::remainder(std::atan2(d.y(), d.x()) - angle, 2 * 3.14159265358979), 0, 2e-4) << angle;
    }
    EXPECT_NEAR(travelled("pyramid", 0.78539816).norm() / straight, std::sqrt(0.5), 0.01);
}

TEST(Contacts3d, SpinningBallBouncesWithCoulombsImpulse) {
    using S = Space3d;
    WorldDef<S> def;
    World<S> world(def);
    const std::uint32_t m = world.addMaterial(0.2, 0.5);
    addGround<S>(world, m);
    const BodyId ball = addBall<S>(world, 0, 0.5, 0.1, 1, m, 1, -2, 0);
    for (int i = 0; i < 120; ++i) world.step(1.0 / 240);
    // Slides throughout: mu (1 + e) |vn| = 0.6 < (2/7) |vt| is false here (0.286), so it ends rolling.
    EXPECT_NEAR(world.velocity(ball).y(), 1.0, 1e-14);
    EXPECT_NEAR(world.velocity(ball).x(), 5.0 / 7, 1e-14);
    EXPECT_NEAR(world.angularVelocity(ball).z(), -5.0 / 7 / 0.1, 1e-13);
}

TEST(PlaneAndSpace, BallsAgreeToRounding) {
    const auto run = []<class S>(S) {
        World<S> world(earth<S>());
        const std::uint32_t m = world.addMaterial(0.4, 0.6);
        addGround<S>(world, m);
        const BodyId a = addBall<S>(world, 0, 1, 0.3, 1, m, 1, 0, -4);
        const BodyId b = addBall<S>(world, 1.3, 0.3, 0.3, 2, m, -0.5);
        for (int i = 0; i < 240; ++i) world.step(1.0 / 120);
        return std::array<double, 6>{
            world.pose(a).p[0], world.pose(a).p[1], spinOf<S>(world.angularVelocity(a)),
            world.pose(b).p[0], world.pose(b).p[1], spinOf<S>(world.angularVelocity(b))};
    };
    const auto plane = run(Space2d{}), space = run(Space3d{});
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(plane[i], space[i], 1e-11);
}

}  // namespace
}  // namespace rigor::engine::test
