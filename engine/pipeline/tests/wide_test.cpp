// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The solver `wide`: the same bits on every instruction set, and the laws of contact, against closed forms
// and against solvers that know contacts as rows.
#include <gtest/gtest.h>

#include <hwy/targets.h>
#include <cmath>
#include <set>
#include <string>

#include "engine/pipeline/tests/scene.hpp"
#include "engine/solvers/wide/kernels.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Wide : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Wide, Spaces);

template <class S>
WorldDef<S> wideEarth() {
    WorldDef<S> def = earth<S>();
    def.solver = "wide";
    return def;
}

/// A heap of boxes and spheres, some of them bouncing.
template <class S>
World<S> heap(int columns, int height) {
    using R = typename S::Real;
    WorldDef<S> def = earth<S>();
    preferSpeed(def);
    World<S> world(def);
    const auto wood = world.addMaterial(R(0.5), 0), rubber = world.addMaterial(R(0.8), R(0.6), R(1));
    addGround<S>(world, wood);
    for (int x = 0; x < columns; ++x)
        for (int y = 0; y < height; ++y)
            if ((x + y) % 4 == 0)
                addBall<S>(world, 0.51 * x + 0.03 * y, 0.3 + 0.55 * y, 0.25, 1, rubber, 0.1 * (x % 3), 0, 1);
            else
                addCube<S>(world, 0.51 * x + 0.03 * y, 0.3 + 0.55 * y, 0.25, 1 + y % 2, wood, 0.2);
    return world;
}

/// Every instruction set that this machine has and that the kernels were compiled for.
std::vector<std::int64_t> targets() {
    std::vector<std::int64_t> list;
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1)
        list.push_back(left & -left);
    return list;
}

TYPED_TEST(Wide, HasTheSameBitsOnEveryInstructionSet) {
    using S = TypeParam;
    using R = typename S::Real;
    std::vector<std::uint64_t> expected;
    std::set<std::string> names;
    for (const std::int64_t target : targets()) {
        hwy::SetSupportedTargetsForTest(target);
        names.insert(simdTarget());
        World<S> world = heap<S>(10, 5);
        std::vector<std::uint64_t> hashes;
        for (int i = 0; i < 60; ++i) {
            world.step(R(1.0 / 60));
            hashes.push_back(world.stateHash());
        }
        if (expected.empty()) expected = hashes;
        EXPECT_EQ(hashes, expected) << simdTarget();
        EXPECT_GT(world.lastStep().contacts, 40u);
    }
    hwy::SetSupportedTargetsForTest(0);
    EXPECT_GT(names.size(), 1u) << "nothing was compared";
}

TYPED_TEST(Wide, CarriesExactlyTheWeight) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(wideEarth<S>());
    const auto wood = world.addMaterial(R(0.5), 0);
    const BodyId ground = addGround<S>(world, wood);
    for (int y = 0; y < 5; ++y) addCube<S>(world, 0.02 * y, 0.25 + 0.5 * y, 0.25, 2, wood);
    const double h = 1.0 / 60;
    for (int i = 0; i < 300; ++i) world.step(static_cast<R>(h));
    std::vector<ContactView<S>> contacts;
    world.readContacts(contacts);
    double up = 0;
    for (const ContactView<S>& contact : contacts)
        if (contact.bodyA == ground) up += contact.normalImpulse * contact.normal[1];
    const double weight = 5 * 2 * kGravity * h;
    EXPECT_NEAR(up, weight, tol<S>(2e-7, 1e-3) * weight);
}

/// A cube that turns on the ground about the vertical, by friction at its four corners alone:
/// I dw/dt = -mu m g r.
template <class S>
void expectTwistStops() {
    using R = typename S::Real;
    World<S> world(wideEarth<S>());
    const auto wood = world.addMaterial(R(0.3), 0);
    addGround<S>(world, wood);
    const double half = 0.25, w0 = 6, mass = 2;
    const BodyId cube = addCube<S>(world, 0, half, half, mass, wood);
    for (int i = 0; i < 60; ++i) world.step(R(1.0 / 60));
    world.setVelocity(cube, S::Vec::Zero(), typename S::Ang(0, static_cast<R>(w0), 0));
    const double slowing = 0.3 * kGravity * half * std::sqrt(2.0) / (2.0 / 3 * half * half);
    const int steps = static_cast<int>(0.6 * w0 / slowing * 240);
    for (int i = 0; i < steps; ++i) world.step(R(1.0 / 240));
    EXPECT_NEAR(world.angularVelocity(cube)[1], w0 - slowing * steps / 240, 0.01 * w0);
    for (int i = 0; i < steps; ++i) world.step(R(1.0 / 240));
    EXPECT_NEAR(world.angularVelocity(cube)[1], 0, 1e-4);
}
TEST(WideTwist, SpinningCubeIsSlowedByFrictionAtItsCorners) {
    expectTwistStops<Space3f>();
    expectTwistStops<Space3d>();
}

/// A body that a torque turns about no axis of its own moves the same whether a force on another one, which
/// changes how bodies are moved, is there or not.
template <class S>
void expectTorqueTurnsAsWithForces() {
    using R = typename S::Real;
    const auto turn = [](bool force) {
        WorldDef<S> def = wideEarth<S>();
        def.substeps = 8;
        World<S> world(def);
        BodyDef<S> body;
        body.mass = 1;
        body.inertia = typename S::Vec(R(1), R(2), R(4)).asDiagonal();
        const BodyId tumbler = world.addBody(body), other = world.addBody(body);
        if (force) world.addForce(ConstantForce<S>{other, S::Vec::UnitX()});
        world.setVelocity(tumbler, S::Vec::Zero(), typename S::Ang(3, 5, 2));
        for (int i = 0; i < 30; ++i) {
            world.applyForce(tumbler, S::Vec::Zero(), typename S::Ang(20, -10, 15));
            world.step(R(1.0 / 60));
        }
        return typename S::Ang(world.angularVelocity(tumbler));
    };
    EXPECT_LT((turn(true) - turn(false)).norm(), tol<S>(1e-11, 1e-3));
}
TEST(WideTorque, TurnsAsWithForcesOnOthers) {
    expectTorqueTurnsAsWithForces<Space3f>();
    expectTorqueTurnsAsWithForces<Space3d>();
}

/// Bodies that only joints hold: sub-steps are steps of their own, with the inertia of the pose in each.
template <class S>
void expectSubStepsOfJointsAreSteps() {
    using R = typename S::Real;
    const auto swing = [](int substeps) {
        WorldDef<S> def = wideEarth<S>();
        def.substeps = substeps;
        World<S> world(def);
        BodyDef<S> rod;
        rod.mass = 1;
        rod.inertia = typename S::Vec(R(0.05), R(1), R(1.2)).asDiagonal();
        rod.angularVelocity = {3, 5, 2};
        JointDef<S> joint;
        joint.bodyB = world.addBody(rod);
        joint.anchorB = at<S>(-1, 0);
        joint.anchorA = at<S>(-1, 0);
        world.addJoint(joint);
        for (int i = 0; i < 30 * 8 / substeps; ++i) world.step(static_cast<R>(substeps / 480.0));
        return std::pair(world.pose(joint.bodyB).p, world.angularVelocity(joint.bodyB));
    };
    const auto [p, w] = swing(8);
    const auto [q, u] = swing(1);
    EXPECT_LT((p - q).norm(), tol<S>(1e-10, 1e-3));
    EXPECT_LT((w - u).norm(), tol<S>(1e-10, 1e-2));
    EXPECT_GT((p - at<S>(0, 0)).norm(), 0.1) << "or nothing moved";
}
TEST(WideJoints, SubStepsAreSteps) {
    expectSubStepsOfJointsAreSteps<Space3f>();
    expectSubStepsOfJointsAreSteps<Space3d>();
}

/// Friction of a patch that slides and leans: against the row solver to rounding of the sub-steps.
TYPED_TEST(Wide, SlidingBoxMovesAsWithRows) {
    using S = TypeParam;
    using R = typename S::Real;
    const auto slide = [](const char* solver) {
        WorldDef<S> def = earth<S>();
        def.solver = solver;
        World<S> world(def);
        const auto wood = world.addMaterial(R(0.4), 0);
        addGround<S>(world, wood);
        const BodyId cube = addCube<S>(world, 0, 0.25, 0.25, 1, wood, 3);
        for (int i = 0; i < 30; ++i) world.step(R(1.0 / 60));
        return world.velocity(cube)[0];
    };
    EXPECT_NEAR(slide("wide"), 3 - 0.4 * kGravity * 0.5, 0.02);
    EXPECT_NEAR(slide("wide"), slide("nsgs"), 0.02);
}

/// The id of what a world refuses these settings for; empty where it does not.
template <class S>
std::string refusal(const WorldDef<S>& def) {
    try {
        World<S> world(def);
        return {};
    } catch (const EngineError& error) {
        return error.id();
    }
}

/// The refused settings are for contacts as rows, of which there are none here.
TYPED_TEST(Wide, SettingsThatItDoesNotHaveAreRefused) {
    using S = TypeParam;
    const WorldDef<S> plain = wideEarth<S>();
    const auto with = [&](auto change) {
        WorldDef<S> def = plain;
        change(def);
        return refusal(def);
    };
    EXPECT_EQ(refusal(plain), "");
    EXPECT_EQ(with([](auto& def) { def.restitution = "none"; }), "");
    EXPECT_EQ(with([](auto& def) { def.fault = "flipped_normal"; }), "fault_solver");
    EXPECT_EQ(with([](auto& def) { def.friction = "pyramid"; }), "friction_solver");
    EXPECT_EQ(with([](auto& def) { def.friction = "pyramid_2"; }), "friction_solver");
    EXPECT_EQ(with([](auto& def) { def.restitution = "poisson"; }), "restitution_solver");
    EXPECT_EQ(with([](auto& def) { def.measureResiduals = true; }), "measure_residuals_solver");
    WorldDef<S> speed = earth<S>();
    preferSpeed(speed);
    EXPECT_EQ(refusal(speed), "");
}

}  // namespace
}  // namespace rigor::engine::test
