// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Fast bodies against thin walls, for every choice of the table that claims to stop them.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

constexpr double kStep = 1.0 / 60;

template <class S>
class Tunnelling : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Tunnelling, Spaces);

/// A wall of thickness 1 mm and 4 m high and wide around `x`.
template <class S>
BodyId addWall(World<S>& world, std::uint32_t material, bool dynamic = false, double mass = 1, double x = 0) {
    using R = typename S::Real;
    BodyDef<S> wall;
    wall.type = dynamic ? BodyType::Dynamic : BodyType::Static;
    wall.mass = R(mass);
    wall.inertia = isotropic<S>(10 * mass);
    wall.pose.p = at<S>(x, 0);
    wall.gravityScale = 0;
    const BodyId id = world.addBody(wall);
    typename S::Vec half = S::Vec::Constant(R(2));
    half[0] = R(0.0005);
    attach<S>(world, id, Box<S>{half}, material);
    return id;
}
template <class S>
double placeX(const World<S>& world, BodyId id) {
    return static_cast<double>(world.pose(id).p.x());
}
template <class S>
double speedX(const World<S>& world, BodyId id) {
    return static_cast<double>(world.velocity(id).x());
}

const std::vector<std::string>& stopping() {
    static const std::vector<std::string> names{"conservative_advancement", "speculative"};
    return names;
}

/// A ball of 500 m/s flies at a thin wall from `start`; `impacts`: how many are reported, if that is known.
template <class S>
void shootAtWall(const WorldDef<S>& def, double restitution, double start, bool misses,
                 std::optional<int> impacts) {
    SCOPED_TRACE(def.continuousCollision + " " + def.integrator + " e " + std::to_string(restitution) +
                 " from " + std::to_string(start));
    World<S> world(def);
    const auto material = world.addMaterial(0, typename S::Real(restitution));
    addWall<S>(world, material);
    const BodyId ball = addBall<S>(world, start, 0.3, 0.1, 2, material, 500);
    double energy = 0.5 * 2 * 500 * 500;
    int count = 0;
    for (int i = 0; i < 6; ++i) {
        for (const auto& event : world.step(typename S::Real(kStep)).impacts) {
            ++count;
            EXPECT_NEAR(static_cast<double>(event.impulse), 2 * 500 * (1 + restitution), 0.2);
            EXPECT_NEAR(static_cast<double>(event.normal.x()), -1, 1e-5);
            const double exact = (-start - 0.1005) / 500 - i * kStep;
            EXPECT_NEAR(static_cast<double>(event.time), exact, tol<S>(1e-9, 2e-6));
        }
        const double v = static_cast<double>(world.velocity(ball).norm());
        EXPECT_LE(v * v, energy * 1.0001);
        energy = v * v;
    }
    if (impacts) {
        EXPECT_EQ(count, *impacts);
    }
    if (misses) {
        EXPECT_GT(placeX<S>(world, ball), 0) << "the test needs a scene that is missed";
    } else {
        EXPECT_LT(placeX<S>(world, ball), -0.1);
        EXPECT_NEAR(speedX<S>(world, ball), -500 * restitution, 0.1);
    }
}

/// The ball of 500 m/s of each choice, with steps of symplectic Euler, or from midpoint to midpoint, where impacts in flight
/// are located by `none` as well.
TYPED_TEST(Tunnelling, EveryChoiceStopsAtAThinWallAndNoneWithEulerDoesNot) {
    using S = TypeParam;
    for (const char* integrator : {"symplectic_euler", "moreau_midpoint"})
        for (const auto& entry : continuousCollisionTable<S>())
            for (const double restitution : {0.0, 0.5, 1.0})
                for (int k = 0; k < 12; ++k) {
                    WorldDef<S> def;
                    def.integrator = integrator;
                    def.continuousCollision = entry.name;
                    const bool byEuler = std::string(integrator) == "symplectic_euler";
                    const bool locates = std::string(entry.name) == "conservative_advancement";
                    shootAtWall<S>(def, restitution, -1 - 0.731 * k,
                                   byEuler && std::string(entry.name) == "none",
                                   byEuler || locates ? std::optional<int>(locates) : std::nullopt);
                }
}

TYPED_TEST(Tunnelling, AThinWallThatMayMoveTakesTheMomentum) {
    using S = TypeParam;
    for (const std::string& name : stopping())
        for (const double restitution : {0.0, 1.0}) {
            WorldDef<S> def;
            def.continuousCollision = name;
            World<S> world(def);
            const auto material = world.addMaterial(0, typename S::Real(restitution));
            const BodyId wall = addWall<S>(world, material, true, 3);
            const BodyId ball = addBall<S>(world, -4.2, 0, 0.1, 1, material, 500);
            for (int i = 0; i < 5; ++i) world.step(typename S::Real(kStep));
            EXPECT_LT(placeX<S>(world, ball), placeX<S>(world, wall)) << name;
            const double common = 500 * 1.0 / 4;
            EXPECT_NEAR(speedX<S>(world, ball), common - restitution * 500 * 0.75, 0.1) << name;
            EXPECT_NEAR(speedX<S>(world, wall), common + restitution * 500 * 0.25, 0.1) << name;
            EXPECT_NEAR(speedX<S>(world, ball) + 3 * speedX<S>(world, wall), 500, 0.05) << name;
        }
}

TYPED_TEST(Tunnelling, ProjectilesOfEveryShapeAndTurningOnes) {
    using S = TypeParam;
    using R = typename S::Real;
    using Vec = typename S::Vec;
    std::vector<Vec> points;
    for (int i = 0; i < 9; ++i) {
        Vec p = Vec::Zero();
        p[0] = R(0.1 * std::cos(2.4 * i));
        p[1] = R(0.1 * std::sin(2.4 * i));
        if constexpr (S::dim == 3) p[2] = R(0.02 * (i - 4));
        points.push_back(p);
    }
    const std::vector<Shape<S>> shapes{Sphere<S>{R(0.05)}, Box<S>{Vec::Constant(R(0.06))},
                                       Capsule<S>{R(0.03), R(0.1)}, makeHull<S>(points)};
    for (const std::string& name : stopping())
        for (std::size_t k = 0; k < shapes.size(); ++k)
            for (const double w : {0.0, 3.0, -60.0}) {
                WorldDef<S> def;
                def.continuousCollision = name;
                World<S> world(def);
                const auto material = world.addMaterial(R(0.3), R(0.4));
                addWall<S>(world, material);
                BodyDef<S> body;
                body.mass = 1;
                body.inertia = isotropic<S>(0.002);
                body.pose.p = at<S>(-3.3, 0.1);
                body.velocity = at<S>(500, -40);
                body.angularVelocity = spin<S>(w);
                const BodyId id = world.addBody(body);
                attach<S>(world, id, shapes[k], material);
                const auto energy = [&] {
                    const double v = static_cast<double>(world.velocity(id).norm());
                    const double turn = spinOf<S>(world.angularVelocity(id));
                    return 0.5 * v * v + 0.5 * 0.002 * turn * turn;
                };
                const double before = energy();
                for (int i = 0; i < 12; ++i) {
                    world.step(R(kStep));
                    ASSERT_LT(placeX<S>(world, id), 0) << name << " shape " << k << " w " << w;
                }
                EXPECT_LT(speedX<S>(world, id), 0) << name << " shape " << k << " w " << w;
                EXPECT_LT(energy(), before * 1.0001) << name << " shape " << k << " w " << w;
                EXPECT_FALSE(world.lastStep().nonFinite);
            }
}

TYPED_TEST(Tunnelling, FlyingPastIsNoCollision) {
    using S = TypeParam;
    for (const std::string& name : stopping()) {
        WorldDef<S> def;
        def.continuousCollision = name;
        World<S> world(def);
        const auto material = world.addMaterial(0, 1);
        addWall<S>(world, material);  // ends at y = 2
        // Clear of the edge by 1 mm: nothing; 5 mm below it: grazes the edge and is deflected.
        const BodyId clear = addBall<S>(world, -3, 2.101, 0.1, 1, material, 500);
        world.step(typename S::Real(kStep));
        EXPECT_NEAR(speedX<S>(world, clear), 500, tol<S>(1e-9, 1e-3)) << name;
        EXPECT_NEAR(placeX<S>(world, clear), -3 + 500 * kStep, tol<S>(1e-9, 1e-4)) << name;
        const BodyId grazing = addBall<S>(world, -3, 2.095, 0.1, 1, material, 500);
        for (int i = 0; i < 3; ++i) world.step(typename S::Real(kStep));
        EXPECT_GT(static_cast<double>(world.velocity(grazing).y()), 50) << name;
        EXPECT_NEAR(static_cast<double>(world.velocity(grazing).norm()), 500, 1) << name;
    }
}

TYPED_TEST(Tunnelling, AThinRodThatTurnsFastDoesNotPassThroughAPost) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const std::string& name : stopping()) {
        WorldDef<S> def;
        def.continuousCollision = name;
        World<S> world(def);
        const auto material = world.addMaterial(0, 0);
        // A rod 2 m long and 4 mm thick turns about its middle, 0.9 m from which stands a post of radius 1
        // cm.
        BodyDef<S> rod;
        rod.mass = 1;
        rod.inertia = isotropic<S>(1.0 / 3);
        rod.angularVelocity = spin<S>(40);  // 0.67 rad a step
        const BodyId id = world.addBody(rod);
        typename S::Vec half = S::Vec::Constant(R(0.002));
        half[0] = 1;
        attach<S>(world, id, Box<S>{half}, material);
        BodyDef<S> post;
        post.type = BodyType::Static;
        post.pose.p = at<S>(0.9 * std::cos(1.0), 0.9 * std::sin(1.0));
        attach<S>(world, world.addBody(post), Sphere<S>{R(0.01)}, material);
        double hit = -1;
        for (int i = 0; i < 4; ++i)
            for (const auto& event : world.step(R(kStep)).impacts)
                if (hit < 0) hit = i * kStep + static_cast<double>(event.time);
        // Contact normal is across the rod: 1 rad less what half its thickness and the post's radius take.
        const double exact = (1.0 - std::asin((0.01 + 0.002) / 0.9)) / 40;
        if (name == "conservative_advancement") {
            EXPECT_NEAR(hit, exact, tol<S>(1e-6, 2e-5)) << name;
        }
        // An inelastic blow at a lever of 0.9 m: the rod goes on, slower, its middle moving.
        const Pose<S> X = world.pose(id);
        const double side = static_cast<double>(toLocal<S>(X, post.pose.p).y());
        EXPECT_GT(side, 0) << name << ": the post is still ahead of the rod";
        EXPECT_LT(spinOf<S>(world.angularVelocity(id)), 40 * 0.9) << name;
    }
}

TYPED_TEST(Tunnelling, SeveralImpactsInOneStep) {
    using S = TypeParam;
    WorldDef<S> def = euler<S>();
    def.continuousCollision = "conservative_advancement";
    World<S> world(def);
    const auto material = world.addMaterial(0, 1);
    addWall<S>(world, material, false, 1, -1.0005);
    addWall<S>(world, material, false, 1, 1.0005);
    const BodyId ball = addBall<S>(world, 0, 0, 0.1, 1, material, 400);  // 6.67 m a step in a gap of 1.8 m
    std::size_t impacts = 0;
    for (int i = 0; i < 10; ++i) {
        double last = 0;
        const auto& result = world.step(typename S::Real(kStep));
        for (const auto& event : result.impacts) {
            const double t = static_cast<double>(event.time);
            const double global = i * kStep + t;
            const double n = std::round((global * 400 - 0.9) / 1.8);
            EXPECT_NEAR(global, (0.9 + 1.8 * n) / 400, tol<S>(1e-5, 1e-5));
            EXPECT_GE(t, last);
            last = t;
        }
        impacts += result.impacts.size();
        EXPECT_FALSE(result.impactsCut);
        EXPECT_LT(std::abs(placeX<S>(world, ball)), 0.901);
        EXPECT_NEAR(std::abs(speedX<S>(world, ball)), 400, tol<S>(1e-6, 1e-2));
    }
    EXPECT_EQ(impacts, 37u);  // (400 10/60 - 0.9) / 1.8 = 36.5: the 37th is the last before the end
}

TYPED_TEST(Tunnelling, AChainOfBallsPassesTheBlowOnWithinTheStep) {
    using S = TypeParam;
    WorldDef<S> def;
    def.continuousCollision = "conservative_advancement";
    World<S> world(def);
    const auto material = world.addMaterial(0, 1);
    std::vector<BodyId> balls;
    for (int i = 0; i < 5; ++i)
        balls.push_back(addBall<S>(world, 0.25 * i, 0, 0.1, 1, material, i == 0 ? 300 : 0));
    world.step(typename S::Real(kStep));
    EXPECT_EQ(world.lastStep().impacts.size(), 4u);
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(speedX<S>(world, balls[i]), i == 4 ? 300 : 0, tol<S>(1e-6, 1e-2));
    // The way of the momentum is 300 m/s times the step, less four gaps' worth of sphere.
    EXPECT_NEAR(placeX<S>(world, balls[4]), 300 * kStep + 4 * 0.2, 1e-3);
}

TYPED_TEST(Tunnelling, ABlowInTheMiddleOfAStepKeepsTheParabola) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldDef<S> def = euler<S>();
    def.continuousCollision = "conservative_advancement";
    def.gravity = at<S>(0, -9.81);
    World<S> world(def);
    const auto material = world.addMaterial(0, 1);
    addWall<S>(world, material);
    const BodyId ball = addBall<S>(world, -4, 0, 0.1, 1, material, 450);
    for (int i = 0; i < 10; ++i) world.step(R(kStep));
    // The bounce does not touch the fall: v_y = -g t exactly, y to the order of the scheme.
    const double t = 10 * kStep;
    EXPECT_NEAR(static_cast<double>(world.velocity(ball).y()), -9.81 * t, tol<S>(1e-9, 1e-4));
    EXPECT_NEAR(static_cast<double>(world.pose(ball).p.y()), -0.5 * 9.81 * t * (t + kStep), 2e-3);
    EXPECT_NEAR(speedX<S>(world, ball), -450, tol<S>(1e-9, 1e-2));
}

TYPED_TEST(Tunnelling, SlowScenesKeepTheirBits) {
    using S = TypeParam;
    std::vector<std::uint64_t> hashes;
    for (const auto& entry : continuousCollisionTable<S>()) {
        WorldDef<S> def = earthByEuler<S>();
        def.continuousCollision = entry.name;
        World<S> world(def);
        const auto material = world.addMaterial(typename S::Real(0.5), typename S::Real(0.3));
        addGround<S>(world, material);
        for (int i = 0; i < 4; ++i) addCube<S>(world, 0.1 * i, 0.6 + 1.1 * i, 0.5, 1, material, 1);
        addBall<S>(world, 4, 3, 0.3, 1, material, -2, 0, 5);
        for (int i = 0; i < 120; ++i) world.step(typename S::Real(kStep));
        hashes.push_back(world.stateHash());
    }
    for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes.front());
}

}  // namespace
}  // namespace rigor::engine::test
