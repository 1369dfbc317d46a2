// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every fault of the table, in every space: it does what its file says, by the numbers it says; and `none` is
// no fault at all.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "engine/faults/fault.hpp"
#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine {
namespace {

using namespace test;

constexpr double kStep = 1.0 / 60;

template <class R>
R rotLength(const Rot2<R>& q) {
    return std::hypot(q.c, q.s);
}
template <class R>
R rotLength(const Eigen::Quaternion<R>& q) {
    return q.norm();
}

template <class S>
class Faults : public testing::Test {
  public:
    using Real = typename S::Real;

    /// A cube at rest on the ground.
    static World<S> cubeOnGround(const std::string& fault, const std::string& correction = "none",
                                 double friction = 0.5, double restitution = 0.5) {
        WorldDef<S> def = earthByEuler<S>();
        def.fault = fault;
        def.positionCorrection = correction;
        World<S> world(def);
        const auto material = world.addMaterial(Real(friction), Real(restitution));
        addGround<S>(world, material);
        cube_ = addCube<S>(world, 0, 0.5, 0.5, 1, material);
        return world;
    }
    static double height(const World<S>& world) { return static_cast<double>(world.pose(cube_).p[1]); }
    static void run(World<S>& world, int steps) {
        for (int i = 0; i < steps; ++i) world.step(Real(kStep));
    }
    static inline BodyId cube_;
};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Faults, Spaces);

TYPED_TEST(Faults, WithoutAFaultTheCubeRests) {
    auto world = this->cubeOnGround("none");
    this->run(world, 60);
    EXPECT_NEAR(this->height(world), 0.5, 1e-3);
    EXPECT_EQ(findAlgorithm(faultTable<TypeParam>(), "fault", "none").make(), nullptr);
}

TYPED_TEST(Faults, UnknownNamesAreRefused) {
    WorldDef<TypeParam> def = euler<TypeParam>();
    def.fault = "bad_luck";
    EXPECT_THROW(World<TypeParam>{def}, EngineError);
}

/// Test of every fault of the table: it changes the future of some scene, the same way twice and in a copy.
TYPED_TEST(Faults, EachIsVisibleAndDeterministic) {
    using S = TypeParam;
    using R = typename S::Real;
    const auto scene = [](const std::string& fault) {
        WorldDef<S> def = earthByEuler<S>();
        def.fault = fault;
        World<S> world(def);
        const auto material = world.addMaterial(R(0.5), R(0.5));
        addGround<S>(world, material);
        addCube<S>(world, 0, 0.5, 0.5, 1, material, 1.0);
        addBall<S>(world, 3, 0.45, 0.5, 1, material, 0, 2.0, 5.0);
        addBall<S>(world, 6, 2, 0.5, 1, material);
        addBall<S>(world, 6, 2, 0.5, 1, material);
        return world;
    };
    // The state, and how many pairs it took to get there.
    const auto hashAfter = [](World<S> world, int steps) {
        for (int i = 0; i < steps; ++i) world.step(R(kStep));
        return std::pair(world.stateHash(), world.lastStep().pairs);
    };
    const auto sound = hashAfter(scene("none"), 20);
    int faults = 0;
    for (const auto& entry : faultTable<S>()) {
        if (entry.make() == nullptr) continue;
        ++faults;
        World<S> half = scene(entry.name);
        for (int i = 0; i < 8; ++i) half.step(R(kStep));
        EXPECT_NE(hashAfter(scene(entry.name), 20), sound) << entry.name;
        EXPECT_EQ(hashAfter(scene(entry.name), 20), hashAfter(half, 12)) << entry.name;
    }
    EXPECT_GE(faults, 9);
}

/// All pairs with a body that moves, and the same motion to the last bit.
TYPED_TEST(Faults, NoCheapRejectionOnlyCosts) {
    using S = TypeParam;
    using R = typename S::Real;
    std::uint64_t hash[2] = {};
    std::size_t pairs[2] = {};
    for (const int bad : {0, 1}) {
        WorldDef<S> def = earthByEuler<S>();
        def.fault = bad != 0 ? "no_cheap_rejection" : "none";
        World<S> world(def);
        const auto material = world.addMaterial(R(0.5), 0);
        addGround<S>(world, material);
        for (int i = 0; i < 10; ++i) addBall<S>(world, 3.0 * i, 0.5, 0.5, 1, material);
        for (int i = 0; i < 10; ++i) world.step(R(kStep));
        hash[bad] = world.stateHash();
        pairs[bad] = world.lastStep().pairs;
    }
    EXPECT_EQ(hash[0], hash[1]);
    EXPECT_EQ(pairs[0], 10u);
    EXPECT_EQ(pairs[1], 10u * 11u / 2u);
}

TYPED_TEST(Faults, FlippedNormalLetsBodiesThrough) {
    auto world = this->cubeOnGround("flipped_normal");
    this->run(world, 30);
    // No impulse at all: free fall, x = -g t (t + h) / 2 in the symplectic scheme.
    const double t = 30 * kStep;
    EXPECT_NEAR(this->height(world), 0.5 - 0.5 * kGravity * t * (t + kStep), 1e-3);
}

/// A bias velocity of the wrong sign makes the overlap grow geometrically: faster than free fall.
TYPED_TEST(Faults, FlippedNormalIsPulledByPositionCorrection) {
    auto world = this->cubeOnGround("flipped_normal", "baumgarte");
    this->run(world, 30);
    const double t = 30 * kStep;
    EXPECT_LT(this->height(world), 0.5 - 0.5 * kGravity * t * (t + kStep) - 0.1);
}

/// The cube and a floor that weighs as much as it fall together at g / 2.
TYPED_TEST(Faults, ImpulseOnStaticSharesTheMomentum) {
    auto world = this->cubeOnGround("impulse_on_static");
    this->run(world, 60);
    const double t = 60 * kStep;
    EXPECT_NEAR(this->height(world), 0.5 - 0.25 * kGravity * t * t, 0.1);
}

/// Sinks at about half of the threshold of 0.5 m/s: free fall over ceil(0.5 / g h) steps, stopped, again.
TYPED_TEST(Faults, NoRestingContactSinks) {
    auto world = this->cubeOnGround("no_resting_contact", "none", 0.5, 0);
    const int steps = 60, period = static_cast<int>(std::ceil(0.5 / (kGravity * kStep)));
    this->run(world, steps);
    double expected = 0;
    for (int i = 0; i < steps; ++i) expected += (i % period + 1) % period * kGravity * kStep * kStep;
    EXPECT_NEAR(0.5 - this->height(world), expected, 0.25 * expected);
    EXPECT_GT(expected, 0.1);
}

TYPED_TEST(Faults, RestitutionAtRestThrowsUp) {
    auto world = this->cubeOnGround("restitution_at_rest");
    world.step(typename TypeParam::Real(kStep));
    EXPECT_NEAR(static_cast<double>(world.velocity(this->cube_)[1]), 0.5 * kGravity * kStep, 1e-3);
    double fastest = 0;
    for (int i = 0; i < 240; ++i) {
        world.step(typename TypeParam::Real(kStep));
        if (i > 180)
            fastest = std::max(fastest, std::abs(static_cast<double>(world.velocity(this->cube_)[1])));
    }
    EXPECT_GT(fastest, 0.25 * kGravity * kStep) << "never comes to rest";
}

TYPED_TEST(Faults, StickyContactHoldsDown) {
    const auto thrownUp = [this](const char* fault) {
        auto world = this->cubeOnGround(fault);
        this->run(world, 2);
        world.setVelocity(this->cube_, at<TypeParam>(0, 3), spin<TypeParam>(0));
        this->run(world, 12);
        return this->height(world);
    };
    EXPECT_GT(thrownUp("none"), 0.8);
    EXPECT_LT(thrownUp("sticky_contact"), 0.51);
}

TYPED_TEST(Faults, NormalFlickerShakes) {
    const auto sideways = [this](const char* fault) {
        auto world = this->cubeOnGround(fault, "none", 0, 0);  // friction would hold it
        double fastest = 0;
        for (int i = 0; i < 60; ++i) {
            world.step(typename TypeParam::Real(kStep));
            fastest = std::max(fastest, static_cast<double>(world.velocity(this->cube_).norm()));
        }
        return fastest;
    };
    EXPECT_LT(sideways("none"), 1e-3);
    EXPECT_GT(sideways("normal_flicker"), 5e-3);
}

TYPED_TEST(Faults, UnguardedDivisionOfCoincidentBalls) {
    using R = typename TypeParam::Real;
    for (const char* fault : {"none", "unguarded_division"}) {
        WorldDef<TypeParam> def = euler<TypeParam>();
        def.fault = fault;
        World<TypeParam> world(def);
        const auto material = world.addMaterial(0, 0);
        addBall<TypeParam>(world, 0, 0, 0.5, 1, material);
        addBall<TypeParam>(world, 0, 0, 0.5, 1, material);
        bool nonFinite = false;
        for (int i = 0; i < 3; ++i) nonFinite = world.step(R(kStep)).nonFinite || nonFinite;
        EXPECT_EQ(nonFinite, std::string(fault) != "none") << fault;
    }
}

/// |q| grows by sqrt(1 + (h w / 2)^2) per step, in 2D (cosine and sine) by sqrt(1 + (h w)^2).
TYPED_TEST(Faults, UnnormalisedQuaternionGrows) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldDef<S> def = euler<S>();
    def.fault = "unnormalised_quaternion";
    def.rotation = "none";
    World<S> world(def);
    const auto ball = addBall<S>(world, 0, 0, 0.5, 1, 0, 0, 0, 6.0);
    for (int i = 0; i < 60; ++i) world.step(R(kStep));
    const double part = kStep * 6.0 * (S::dim == 2 ? 1.0 : 0.5);
    EXPECT_NEAR(static_cast<double>(rotLength(world.pose(ball).q)), std::pow(1 + part * part, 30.0), 1e-3);
}

}  // namespace
}  // namespace rigor::engine
