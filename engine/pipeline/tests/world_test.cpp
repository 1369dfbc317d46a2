// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The world as a container: the same bits, no allocation, refusals, handles, tables.
#include <gtest/gtest.h>

#include <limits>

#include "engine/broadphase/broad_phase.hpp"
#include "engine/core/tests/counting_new.hpp"
#include "engine/pipeline/algorithms.hpp"
#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Worlds : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Worlds, Spaces);

/// A tower with a swinging rod: contacts, joints, impacts, friction.
template <class S>
World<S> busyWorld(WorldDef<S> def = earth<S>()) {
    World<S> world(def);
    const std::uint32_t m = world.addMaterial(typename S::Real(0.5), typename S::Real(0.3));
    addGround<S>(world, m);
    for (int i = 0; i < 4; ++i) addCube<S>(world, 0.05 * i, 0.55 + 1.02 * i, 0.5, 1, m);
    const BodyId ball = addBall<S>(world, -3, 2, 0.4, 2, m, 4);
    JointDef<S> j;
    j.bodyB = ball;
    j.anchorA = at<S>(-2, 3.5);
    j.anchorB = at<S>(1, 1.5);
    world.addJoint(j);
    return world;
}

TYPED_TEST(Worlds, SameBitsFromRunToRunAndFromACopy) {
    using S = TypeParam;
    World<S> first = busyWorld<S>(), second = busyWorld<S>();
    for (int i = 0; i < 120; ++i) {
        first.step(typename S::Real(1.0 / 60));
        second.step(typename S::Real(1.0 / 60));
    }
    EXPECT_EQ(first.stateHash(), second.stateHash());
    World<S> copy = first;
    for (int i = 0; i < 120; ++i) {
        first.step(typename S::Real(1.0 / 60));
        copy.step(typename S::Real(1.0 / 60));
        ASSERT_EQ(first.stateHash(), copy.stateHash()) << i;
    }
    EXPECT_NE(first.stateHash(), second.stateHash());
}

TYPED_TEST(Worlds, BroadPhasesGiveTheSameWorld) {
    using S = TypeParam;
    std::vector<std::uint64_t> hashes;
    for (const auto& entry : broadPhaseTable<S>()) {
        WorldDef<S> def = earth<S>();
        def.broadPhase = entry.name;
        World<S> world = busyWorld<S>(def);
        for (int i = 0; i < 200; ++i) world.step(typename S::Real(1.0 / 60));
        hashes.push_back(world.stateHash());
    }
    for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes.front());
}

TYPED_TEST(Worlds, SteadyStepDoesNotAllocate) {
    using S = TypeParam;
    for (const auto& family : algorithmFamilies()) {
        if (family.name != "broad_phase" && family.name != "position_correction" &&
            family.name != "integrator" && family.name != "rotation")
            continue;
        for (const AlgorithmInfo& choice : family.algorithms) {
            WorldDef<S> def = earth<S>();
            *choiceOf(def, family.name) = choice.name;
            World<S> world = busyWorld<S>(def);
            for (int i = 0; i < 400; ++i) world.step(typename S::Real(1.0 / 60));
            const long before = allocationCount();
            for (int i = 0; i < 50; ++i) world.step(typename S::Real(1.0 / 60));
            EXPECT_EQ(allocationCount() - before, 0) << choice.name;
            EXPECT_GT(world.lastStep().contacts, 0u);
        }
    }
}

TYPED_TEST(Worlds, ResidualsFallAndAreOnePerIteration) {
    using S = TypeParam;
    World<S> world = busyWorld<S>();
    for (int i = 0; i < 200; ++i) world.step(typename S::Real(1.0 / 60));
    const StepResult<S>& result = world.lastStep();
    ASSERT_GT(result.residuals.size(), 1u);
    // Newton's finish counts as one more.
    EXPECT_LE(result.residuals.size(), static_cast<std::size_t>(world.velocityIterations()) + 1);
    EXPECT_EQ(result.iterations, static_cast<int>(result.residuals.size()));
    EXPECT_LE(result.residuals.back(), result.residuals.front());
    EXPECT_FALSE(result.nonFinite);
    EXPECT_GE(result.rows, result.contacts);
}

template <class Call>
std::string refusal(Call call) {
    try {
        call();
    } catch (const EngineError& error) {
        return error.id();
    }
    return "accepted";
}

TYPED_TEST(Worlds, BadInputIsRefusedById) {
    using S = TypeParam;
    using R = typename S::Real;
    const R nan = std::numeric_limits<R>::quiet_NaN();
    World<S> world(earth<S>());
    const auto body = [&](auto change) {
        BodyDef<S> def;
        change(def);
        return refusal([&] { world.addBody(def); });
    };
    EXPECT_EQ(body([](auto& d) { d.mass = -1; }), "body_mass");
    EXPECT_EQ(body([](auto& d) { d.inertia = isotropic<S>(1); }), "body_mass") << "an inertia without a mass";
    EXPECT_EQ(body([&](auto& d) { d.mass = nan; }), "body_mass");
    const auto withMass = [&](double inertia) {
        return body([=](auto& d) {
            d.mass = 1;
            d.inertia = isotropic<S>(inertia);
        });
    };
    EXPECT_EQ(withMass(-1), "body_inertia");
    EXPECT_EQ(body([&](auto& d) { d.pose.p[1] = nan; }), "body_pose");
    EXPECT_EQ(body([&](auto& d) { d.velocity[0] = nan; }), "body_velocity");
    EXPECT_EQ(body([](auto& d) { d.linearVelocityKept = 0; }), "body_damping");
    EXPECT_EQ(world.bodyCount(), 0u) << "a refused body leaves nothing behind";

    const BodyId a = world.addBody(BodyDef<S>{});
    EXPECT_EQ(refusal([&] { attach<S>(world, a, HalfSpace<S>{S::Vec::Unit(1), 0}, 0); }), "half_space_body");
    EXPECT_EQ(refusal([&] { attach<S>(world, a, Sphere<S>{0}, 0); }), "shape_size");
    EXPECT_EQ(refusal([&] { attach<S>(world, a, Box<S>{S::Vec::Constant(nan)}, 0); }), "shape_size");
    EXPECT_EQ(refusal([&] { attach<S>(world, a, Capsule<S>{1, -1}, 0); }), "shape_size");
    EXPECT_EQ(refusal([&] { attach<S>(world, a, Hull<S>{}, 0); }), "shape_size");
    EXPECT_EQ(refusal([&] { attach<S>(world, a, Sphere<S>{1}, 7); }), "shape_material");
    EXPECT_EQ(refusal([&] { world.addMaterial(-1, 0); }), "material_friction");
    EXPECT_EQ(refusal([&] { world.addMaterial(0, R(1.5)); }), "material_restitution");
    JointDef<S> joint;
    joint.bodyA = joint.bodyB = a;
    EXPECT_EQ(refusal([&] { world.addJoint(joint); }), "joint_bodies");
    joint.bodyA = {};
    joint.type = JointType::Distance;
    EXPECT_EQ(refusal([&] { world.addJoint(joint); }), "joint_length");
    EXPECT_EQ(refusal([&] { world.step(0); }), "time_step");
    EXPECT_EQ(refusal([&] { world.step(nan); }), "time_step");

    WorldDef<S> def;
    def.solver = "no_such";
    EXPECT_EQ(refusal([&] { World<S> unknown(def); }), "unknown_algorithm");
    def = {};
    def.narrowPhase = "no_such";
    EXPECT_EQ(refusal([&] { World<S> unknown(def); }), "unknown_algorithm");
    def = {};
    def.velocityIterations = -1;
    EXPECT_EQ(refusal([&] { World<S> unknown(def); }), "velocity_iterations");
}

TYPED_TEST(Worlds, NumericalTroubleIsAFlag) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    const BodyId a = world.addBody(BodyDef<S>{});
    world.applyForce(a, at<S>(0, std::numeric_limits<R>::max()), zeroAng<S>());
    world.step(R(1));
    world.applyForce(a, at<S>(0, std::numeric_limits<R>::max()), zeroAng<S>());
    EXPECT_TRUE(world.step(R(1)).nonFinite);
}

TYPED_TEST(Worlds, HandlesSurviveRemovalAndStaleOnesAreKnown) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    const std::uint32_t m = world.addMaterial(R(0.5), 0);
    addGround<S>(world, m);
    const BodyId low = addCube<S>(world, 0, 0.5, 0.5, 1, m), gone = addCube<S>(world, 5, 0.5, 0.5, 1, m),
                 high = addCube<S>(world, 0, 1.5, 0.5, 1, m);
    for (int i = 0; i < 10; ++i) world.step(R(1.0 / 60));
    world.removeBody(gone);
    EXPECT_FALSE(world.contains(gone));
    EXPECT_TRUE(world.contains(high));
    for (int i = 0; i < 60; ++i) world.step(R(1.0 / 60));
    EXPECT_NEAR(world.pose(low).p[1], 0.5, 1e-3);
    EXPECT_NEAR(world.pose(high).p[1], 1.5, 1e-3);
    const BodyId next = addCube<S>(world, 5, 0.5, 0.5, 1, m);
    EXPECT_FALSE(next == gone);
    EXPECT_EQ(next.index, gone.index) << "the slot is used again, the generation distinguishes them";
    EXPECT_THROW(world.pose(gone), EngineError);
}

TYPED_TEST(Worlds, FilterKeepsJoinedAndGhostBodiesApart) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const bool collideConnected : {false, true}) {
        World<S> world{WorldDef<S>{}};
        const BodyId a = addBall<S>(world, 0, 0, 0.5, 1, 0), b = addBall<S>(world, 0.8, 0, 0.5, 1, 0);
        JointDef<S> j;
        j.bodyA = a;
        j.bodyB = b;
        j.anchorA = at<S>(0.4, 0);
        j.anchorB = at<S>(-0.4, 0);
        j.collideConnected = collideConnected;
        world.addJoint(j);
        BodyDef<S> ghost;
        ghost.collides = false;
        attach<S>(world, world.addBody(ghost), Sphere<S>{R(1)}, 0);
        world.step(R(1.0 / 60));
        EXPECT_EQ(world.lastStep().contacts, collideConnected ? 1u : 0u);
    }
}

TEST(Algorithms, TablesAreSortedAndEveryEntryMakesAWorldThatFalls) {
    for (const AlgorithmFamily& family : algorithmFamilies()) {
        ASSERT_FALSE(family.algorithms.empty()) << family.name;
        bool hasDefault = false;
        for (std::size_t i = 0; i < family.algorithms.size(); ++i) {
            const AlgorithmInfo& algorithm = family.algorithms[i];
            if (i > 0) {
                EXPECT_LT(family.algorithms[i - 1].name, algorithm.name) << family.name;
            }
            EXPECT_FALSE(algorithm.summary.empty());
            hasDefault = hasDefault || algorithm.name == family.defaultChoice;
            if (family.name == "fault") continue;  // engine/faults/tests asserts what each breaks
            WorldDef<Space3d> def = earth<Space3d>();
            std::string* field = choiceOf(def, family.name);
            ASSERT_NE(field, nullptr) << family.name;
            *field = algorithm.name;
            World<Space3d> world = busyWorld<Space3d>(def);
            for (int k = 0; k < 120; ++k) ASSERT_FALSE(world.step(1.0 / 120).nonFinite) << algorithm.name;
            EXPECT_GT(world.lastStep().contacts, 0u) << algorithm.name;
        }
        EXPECT_TRUE(hasDefault) << family.name;
    }
}

}  // namespace
}  // namespace rigor::engine::test
