// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A callback before the solve: it refuses contacts and changes coefficients.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/embedding/tests/tick.hpp"
#include "engine/pipeline/tests/scene.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class PreSolveCall : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(PreSolveCall, Spaces);

template <class S>
BodyId addPlatform(World<S>& world, double y) {
    BodyDef<S> fixed;
    fixed.type = BodyType::Static;
    fixed.pose.p = at<S>(0, y);
    const BodyId platform = world.addBody(fixed);
    typename S::Vec half = S::Vec::Constant(typename S::Real(2));
    half[1] = typename S::Real(0.1);
    attach<S>(world, platform, Box<S>{half}, kUsualMaterial);
    return platform;
}

/// Solid for what comes from above: refuses a contact with the platform while the other moves up or is already in it.
template <class S>
PreSolve<S> oneWay(BodyId platform) {
    return [platform](PreSolveContact<S>& contact) {
        if (contact.bodyA != platform && contact.bodyB != platform) return;
        const bool isA = contact.bodyA == platform;
        const typename S::Vec up = isA ? contact.normal : typename S::Vec(-contact.normal);
        const typename S::Vec velocity = isA ? contact.velocity : typename S::Vec(-contact.velocity);
        typename S::Real deepest = 0;
        for (const auto& point : contact.points) deepest = std::min(deepest, point.separation);
        contact.veto = up[1] < typename S::Real(0.7) || velocity[1] > typename S::Real(0.1) ||
                       deepest < typename S::Real(-0.05);
    };
}

TYPED_TEST(PreSolveCall, MakesAOneWayPlatform) {
    using S = TypeParam;
    using R = typename S::Real;
    // Whatever solves and finds its contacts.
    for (const char* solver : {"block", "pgs", "tgs_soft", "wide", "nsgs"})
        for (const char* ccd : {"none", "conservative_advancement", "speculative"}) {
            WorldDef<S> def = earthByEuler<S>();
            def.solver = solver;
            def.continuousCollision = ccd;
            World<S> world(def);
            const BodyId platform = addPlatform<S>(world, 2);
            world.setPreSolve(oneWay<S>(platform));
            const BodyId ball = addBall<S>(world, 0, 0.5, 0.25, 1, kUsualMaterial, 0, 8);
            double highest = 0;
            for (int i = 0; i < 180; ++i) {
                world.step(R(kTick));
                highest = std::max(highest, double(world.pose(ball).p[1]));
            }
            // Free flight from 0.5 m at v = 8 m/s reaches 0.5 + v^2 / 2g, less v h / 2 with symplectic Euler.
            EXPECT_NEAR(highest, 0.5 + 64 / (2 * kGravity) - 8 * kTick / 2 / world.substeps(), 2e-3)
                << solver << ' ' << ccd;
            EXPECT_NEAR(double(world.pose(ball).p[1]), 2.35, 2e-3) << solver << ' ' << ccd;
        }
}

/// Surfaces keep bodies on their side, continuous collision or not; a refused contact lets them pass.
TYPED_TEST(PreSolveCall, LetsABodyThroughASurface) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const bool refuses : {true, false}) {
        World<S> world(earthByEuler<S>());
        BodyDef<S> fixed;
        fixed.type = BodyType::Static;
        const BodyId floor = world.addBody(fixed);
        if constexpr (S::dim == 2) {
            const std::vector<typename S::Vec> line{{10, 0}, {-10, 0}};
            attach<S>(world, floor, makeChain<S>(line, false), 0);
        } else {
            const std::vector<typename S::Vec> corners{
                {-10, 0, -10}, {10, 0, -10}, {-10, 0, 10}, {10, 0, 10}};
            const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 2, 1}, {1, 2, 3}};
            attach<S>(world, floor, makeTriangleMesh<S>(corners, triangles), 0);
        }
        const BodyId ball = addBall<S>(world, 0.3, 1, 0.25, 1, 0);
        world.setPreSolve([&](PreSolveContact<S>& contact) {
            EXPECT_NE(contact.piece, kNullIndex);
            contact.veto = refuses;
        });
        int begins = 0;
        for (int i = 0; i < 60; ++i)
            for (const Event<S>& event : world.step(R(kTick)).events)
                begins += event.kind == EventKind::ContactBegins;
        const double fallen = kGravity * kTick * kTick * 60 * 61 / 2;
        EXPECT_NEAR(double(world.pose(ball).p[1]), refuses ? 1 - fallen : 0.25, 2e-3);
        EXPECT_EQ(begins, refuses ? 0 : 1);
        std::vector<ContactView<S>> contacts;
        world.readContacts(contacts);
        EXPECT_EQ(contacts.size(), refuses ? 0u : 1u);
    }
}

/// A cube slides a distance v^2 / (2 mu g), with the friction that the callback says; without it, with its material's.
TYPED_TEST(PreSolveCall, ChangesFrictionForAStep) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const char* solver : {"by_island", "wide"}) {
        WorldDef<S> def = earth<S>();
        def.solver = solver;
        World<S> world(def);
        const auto material = world.addMaterial(R(0.5), 0);
        addGround<S>(world, material);
        const BodyId box = addCube<S>(world, 0, 0.5, 0.5, 1, material, 2);
        world.setPreSolve([](PreSolveContact<S>& contact) {
            EXPECT_EQ(contact.coefficients.friction, R(0.5))
                << "called with those of the materials in each step";
            contact.coefficients.friction = R(0.25);
        });
        for (int i = 0; i < 30; ++i) world.step(R(kTick));
        EXPECT_NEAR(double(world.velocity(box)[0]), 2 - 0.25 * kGravity * 0.5, 5e-3) << solver;
        world.setPreSolve({});
        for (int i = 0; i < 6; ++i) world.step(R(kTick));
        EXPECT_NEAR(double(world.velocity(box)[0]), 2 - 0.25 * kGravity * 0.5 - 0.5 * kGravity * 0.1, 5e-3)
            << solver;
    }
}

TYPED_TEST(PreSolveCall, ChangesRestitution) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    addGround<S>(world, kUsualMaterial);
    const BodyId ball = addBall<S>(world, 0, 2, 0.25, 1, kUsualMaterial);
    world.setPreSolve([](PreSolveContact<S>& contact) { contact.coefficients.restitution = R(0.5); });
    double fastest = 0, lowest = 0;
    for (int i = 0; i < 60; ++i) {
        world.step(R(kTick));
        lowest = std::min(lowest, double(world.velocity(ball)[1]));
        if (lowest < -1) fastest = std::max(fastest, double(world.velocity(ball)[1]));
    }
    EXPECT_NEAR(fastest, -0.5 * lowest, 0.1);
    EXPECT_GT(fastest, 2);
}

/// A belt that a callback drives at 1.5 m/s pulls a cube along with mu g until it has the speed of the belt, whichever of
/// the two is A; when the callback no longer drives it the cube stops.
TYPED_TEST(PreSolveCall, DrivesASurface) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const char* solver : {"by_island", "wide", "pgs"})
        for (const bool beltIsA : {true, false}) {
            WorldDef<S> def = earth<S>();
            def.solver = solver;
            World<S> world(def);
            const auto material = world.addMaterial(R(0.5), 0);
            BodyId belt;
            if (beltIsA) belt = addGround<S>(world, material);
            const BodyId box = addCube<S>(world, 0, 0.5, 0.5, 1, material);
            if (!beltIsA) belt = addGround<S>(world, material);
            R speed = R(1.5);
            world.setPreSolve([&](PreSolveContact<S>& contact) {
                EXPECT_EQ(contact.surfaceVelocity[0], 0) << "called with none in each step";
                contact.surfaceVelocity[0] = contact.bodyA == belt ? -speed : speed;
            });
            for (int i = 0; i < 12; ++i) world.step(R(kTick));
            EXPECT_NEAR(double(world.velocity(box)[0]), 0.5 * kGravity * 12 * kTick, 5e-3) << solver;
            for (int i = 0; i < 30; ++i) world.step(R(kTick));
            EXPECT_NEAR(double(world.velocity(box)[0]), 1.5, 1e-3) << solver;
            speed = 0;
            for (int i = 0; i < 30; ++i) world.step(R(kTick));
            EXPECT_NEAR(double(world.velocity(box)[0]), 0, 1e-3) << solver;
        }
}

/// The same in an impact that continuous collision solves: the impulse of friction is mu times the normal one.
TYPED_TEST(PreSolveCall, DrivesASurfaceInAnImpact) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldDef<S> def = earth<S>();
    def.gravity.setZero();
    def.continuousCollision = "conservative_advancement";
    World<S> world(def);
    const auto material = world.addMaterial(R(0.25), 0);
    const BodyId belt = addPlatform<S>(world, 0);
    BodyDef<S> fast;
    fast.pose.p = at<S>(0, 3);
    fast.velocity = at<S>(0, -200);
    const BodyId ball = world.addBody(fast);
    attach<S>(world, ball, Sphere<S>{R(0.05)}, material);
    world.setPreSolve([&](PreSolveContact<S>& contact) {
        contact.coefficients.friction = R(0.25);
        contact.surfaceVelocity[0] = contact.bodyA == belt ? R(-500) : R(500);
    });
    world.step(R(kTick));
    EXPECT_NEAR(double(world.velocity(ball)[1]), 0, 1e-3);
    EXPECT_NEAR(double(world.velocity(ball)[0]), 0.25 * 200, 1e-2);
}

/// The order is that of the contacts, whatever the threads; it is not called for sleeping contacts.
TYPED_TEST(PreSolveCall, IsCalledInTheOrderOfContacts) {
    using S = TypeParam;
    using R = typename S::Real;
    std::vector<std::vector<std::uint32_t>> orders;
    for (const int threads : {1, 3}) {
        WorldDef<S> def = earth<S>();
        def.sleeping = "islands";
        def.threads = threads;
        World<S> world(def);
        addGround<S>(world, kUsualMaterial);
        for (int i = 0; i < 40; ++i) addCube<S>(world, 1.5 * (i % 8), 0.5 + i / 8, 0.5, 1, kUsualMaterial);
        std::vector<std::uint32_t>& order = orders.emplace_back();
        world.setPreSolve([&](PreSolveContact<S>& contact) {
            order.push_back(contact.shapeA.index);
            order.push_back(contact.shapeB.index);
        });
        world.step(R(kTick));
        ASSERT_EQ(order.size(), 2 * world.manifolds().size());
        std::size_t k = 0;
        for (const Contact<S>& contact : world.manifolds()) {
            EXPECT_EQ(order[k++], world.shapes()[contact.shapeA].id.index);
            EXPECT_EQ(order[k++], world.shapes()[contact.shapeB].id.index);
        }
        for (int i = 0; i < 120; ++i) world.step(R(kTick));
        ASSERT_EQ(world.lastStep().sleeping, 40u);
        const std::size_t before = order.size();
        world.step(R(kTick));
        EXPECT_EQ(order.size(), before);
    }
    EXPECT_EQ(orders[0], orders[1]);
}

TYPED_TEST(PreSolveCall, IsSeenByIslandsAndSnapshots) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldDef<S> def = earth<S>();
    def.sleeping = "islands";
    World<S> world(def);
    addGround<S>(world, kUsualMaterial);
    const BodyId a = addCube<S>(world, 0, 0.5, 0.5, 1, kUsualMaterial);
    const BodyId b = addCube<S>(world, 0.5, 0.5, 0.5, 1, kUsualMaterial);
    world.setPreSolve(
        [&](PreSolveContact<S>& contact) { contact.veto = contact.bodyA == a && contact.bodyB == b; });
    for (int i = 0; i < 60; ++i) world.step(R(kTick));
    ASSERT_TRUE(world.isAsleep(a) && world.isAsleep(b));
    EXPECT_NEAR(double(world.pose(b).p[0]), 0.5, 1e-4) << "they overlap and stay";
    std::vector<unsigned char> saved;
    world.saveSnapshot(saved);
    const std::uint64_t hash = world.stateHash();
    world.wake(a);
    EXPECT_TRUE(world.isAsleep(b)) << "two islands";
    world.restoreSnapshot(saved);
    EXPECT_EQ(world.stateHash(), hash);
    world.wake(a);
    EXPECT_TRUE(world.isAsleep(b)) << "two islands, restored";
}

/// An exception of the callback leaves the step; the world goes on from there.
TYPED_TEST(PreSolveCall, MayThrow) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    addGround<S>(world, kUsualMaterial);
    const BodyId box = addCube<S>(world, 0, 0.5, 0.5, 1, kUsualMaterial);
    world.setPreSolve([](PreSolveContact<S>&) { throw std::runtime_error("from the program"); });
    EXPECT_THROW(world.step(R(kTick)), std::runtime_error);
    EXPECT_FALSE(world.stepping());
    world.setPreSolve([](PreSolveContact<S>& contact) { contact.coefficients.friction = -1; });
    EXPECT_THROW(world.step(R(kTick)), EngineError);
    world.setPreSolve([](PreSolveContact<S>& contact) { contact.surfaceVelocity[0] = R(NAN); });
    EXPECT_THROW(world.step(R(kTick)), EngineError);
    world.setPreSolve({});
    for (int i = 0; i < 30; ++i) world.step(R(kTick));
    EXPECT_NEAR(double(world.pose(box).p[1]), 0.5, 1e-3);
    EXPECT_NEAR(world.time(), 30 * kTick, 1e-6);
}

/// Bodies, shapes, joints and forces neither come nor go during a step, from a callback or between its phases.
TYPED_TEST(PreSolveCall, MayNotChangeTheWorld) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    addGround<S>(world, kUsualMaterial);
    const BodyId ball = addBall<S>(world, 0, 0.25, 0.25, 1, kUsualMaterial);
    const ForceId drag = world.addForce(LinearDrag<S>{ball, R(0.1)});
    JointDef<S> joint;
    joint.bodyB = ball;
    const std::vector<std::function<void()>> changes{
        [&] { world.addBody({}); },
        [&] { world.removeBody(ball); },
        [&] {
            world.addShape(ball, {Sphere<S>{R(0.1)}, {}});
        },
        [&] { world.removeShape(world.shapes().back().id); },
        [&] { world.addJoint(joint); },
        [&] {
            world.addForce(LinearDrag<S>{ball, R(0.1)});
        },
        [&] { world.removeForce(drag); },
        [&] { world.setPose(ball, world.pose(ball)); },
    };
    for (std::size_t k = 0; k < changes.size(); ++k) {
        world.setPreSolve([&](PreSolveContact<S>&) { changes[k](); });
        EXPECT_EQ(refusal([&] { world.step(R(kTick)); }), "step_in_progress") << "change " << k;
        world.setPreSolve({});
        world.beginStep(R(kTick));
        world.runPhase();
        EXPECT_EQ(refusal([&] { changes[k](); }), "step_in_progress") << "change " << k << " between phases";
        while (world.stepping()) world.runPhase();
    }
    EXPECT_EQ(world.bodyCount(), 2U);
    EXPECT_NO_THROW(changes.back()());
}

/// A callback that changes nothing changes no bit.
TYPED_TEST(PreSolveCall, CostsNoBit) {
    using S = TypeParam;
    using R = typename S::Real;
    std::uint64_t hashes[2];
    for (const bool called : {false, true}) {
        World<S> world(earth<S>());
        addGround<S>(world, kUsualMaterial);
        for (int i = 0; i < 20; ++i) addCube<S>(world, 0.3 * (i % 3), 0.6 + 1.1 * i, 0.5, 1, kUsualMaterial);
        if (called) world.setPreSolve([](PreSolveContact<S>&) {});
        for (int i = 0; i < 100; ++i) world.step(R(kTick));
        hashes[called] = world.stateHash();
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace rigor::engine::test
