// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A world restored from bytes has the future that the saved one had, bit for bit, whatever the choices.
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "engine/core/hash.hpp"
#include "engine/pipeline/algorithms.hpp"
#include "engine/pipeline/tests/scene.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Snapshot : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Snapshot, Spaces);

/// Stack, sphere, pendulum, rod, spring, drag: contacts that rest, hit and slide, joints and forces.
template <class S>
World<S> scene(const WorldDef<S>& def) {
    using R = typename S::Real;
    World<S> world(def);
    const auto wood = world.addMaterial(R(0.5), R(0.2)), ice = world.addMaterial(R(0.05), R(0.7));
    const BodyId ground = addGround<S>(world, wood);
    addCube<S>(world, 0, 0.25, 0.25, 1, wood);
    addCube<S>(world, 0.05, 0.75, 0.25, 1, wood, 0.3);
    const BodyId gone = addCube<S>(world, 8, 3, 0.1, 1, wood);
    const BodyId ball = addBall<S>(world, -1.2, 0.6, 0.2, 0.5, ice, 2.5, 0, 3);
    const BodyId bob = addBall<S>(world, 3, 2, 0.1, 1, wood), link = addCube<S>(world, 4, 2, 0.1, 0.3, wood);
    JointDef<S> joint;
    joint.bodyB = bob;
    joint.anchorA = at<S>(2, 2);
    joint.anchorB = at<S>(-1, 0);
    world.addJoint(joint);
    joint.type = JointType::Distance;
    joint.bodyA = bob;
    joint.bodyB = link;
    joint.anchorA = joint.anchorB = at<S>(0, 0);
    joint.length = 1;
    joint.breakForce = 8;  // breaks on the way: its force goes up to 8.2 N, 1.2 s after the start
    world.addJoint(joint);
    LinearSpring<S> spring;
    spring.bodyA = ground;
    spring.bodyB = link;
    spring.anchorA = at<S>(4, 3);
    spring.anchorB = at<S>(0.1, 0.1);
    spring.stiffness = 5;
    spring.restLength = R(0.5);
    world.addForce(spring);
    world.addForce(LinearDrag<S>{ball, R(0.1)});
    world.removeBody(gone);  // dense indices and names part ways
    return world;
}

/// Goes on in both worlds and expects the same bits.
template <class S>
void expectSameFuture(World<S>& one, World<S>& other, int steps, const std::string& what) {
    using R = typename S::Real;
    ASSERT_EQ(one.stateHash(), other.stateHash()) << what << ": at once";
    std::vector<ContactView<S>> a, b;
    for (int i = 0; i < steps; ++i) {
        one.step(R(1.0 / 120));
        other.step(R(1.0 / 120));
        ASSERT_EQ(one.stateHash(), other.stateHash()) << what << ": step " << i;
    }
    one.readContacts(a);
    other.readContacts(b);
    ASSERT_EQ(a.size(), b.size()) << what;
    EXPECT_FALSE(one.lastStep().nonFinite) << what;
}

template <class S>
void savedAndRestored(const WorldDef<S>& def, const std::string& what) {
    using R = typename S::Real;
    World<S> saved = scene<S>(def);
    std::vector<unsigned char> bytes;
    for (const int before : {1, 40}) {
        for (int i = 0; i < before; ++i) saved.step(R(1.0 / 120));
        saved.saveSnapshot(bytes);
        World<S> fresh = scene<S>(def);
        fresh.restoreSnapshot(bytes);
        World<S> used = scene<S>(def);  // has a history of its own
        for (int i = 0; i < 25; ++i) used.step(R(1.0 / 100));
        used.restoreSnapshot(bytes);
        World<S> original = saved;
        expectSameFuture(original, fresh, 40, what + " fresh");
        original = saved;
        expectSameFuture(original, used, 40, what + " used");
    }
}

TYPED_TEST(Snapshot, HasTheSameFutureWithTheDefaults) {
    savedAndRestored<TypeParam>(earth<TypeParam>(), "default");
}

/// Every choice there is, one at a time.
TEST(SnapshotChoices, HaveTheSameFutureForEveryAlgorithm) {
    using S = Space3d;
    for (const AlgorithmFamily& family : algorithmFamilies())
        for (const AlgorithmInfo& algorithm : family.algorithms) {
            WorldDef<S> def = earth<S>();
            std::string* field = choiceOf(def, family.name);
            if (!field) continue;
            *field = algorithm.name;
            savedAndRestored<S>(def, family.name + "=" + algorithm.name);
        }
    WorldDef<S> substeps = earth<S>();
    substeps.substeps = 4;
    savedAndRestored<S>(substeps, "substeps");
}

/// Boxes that tumble off each other: contacts with cached manifolds end, and their shapes stay near each other.
TYPED_TEST(Snapshot, HasTheSameHashesAfterContactsHaveEnded) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldDef<S> def = earth<S>();
    preferSpeed(def);
    const auto tower = [&] {
        World<S> world(def);
        const auto wood = world.addMaterial(R(0.5), R(0));
        addGround<S>(world, wood);
        for (int i = 0; i < 12; ++i) addCube<S>(world, 0.1 * i, 0.5 + 1.05 * i, 0.5, 1, wood);
        return world;
    };
    World<S> saved = tower();
    for (int i = 0; i < 300; ++i) {
        saved.step(R(1.0 / 60));
        if (i % 10 != 0) continue;
        std::vector<unsigned char> bytes;
        saved.saveSnapshot(bytes);
        World<S> fresh = tower(), original = saved;
        fresh.restoreSnapshot(bytes);
        expectSameFuture(original, fresh, 20, "saved after step " + std::to_string(i));
    }
}

TYPED_TEST(Snapshot, OfAWorldWhoseJointBrokeFitsTheWorldAsItWasBuilt) {
    using S = TypeParam;
    World<S> saved = scene<S>(earth<S>());
    bool broke = false;
    for (int i = 0; i < 200 && !broke; ++i) broke = !saved.step(typename S::Real(1.0 / 120)).broken.empty();
    ASSERT_TRUE(broke) << "nothing to test";
    std::vector<unsigned char> bytes;
    saved.saveSnapshot(bytes);
    World<S> fresh = scene<S>(earth<S>());
    fresh.restoreSnapshot(bytes);
    expectSameFuture(saved, fresh, 60, "after the break");
}

TYPED_TEST(Snapshot, NamesGoOnAsTheyWould) {
    using S = TypeParam;
    World<S> saved = scene<S>(earth<S>());
    std::vector<unsigned char> bytes;
    saved.saveSnapshot(bytes);
    World<S> restored = scene<S>(earth<S>());
    restored.restoreSnapshot(bytes);
    const BodyId a = addBall<S>(saved, 0, 9, 0.1, 1, 0), b = addBall<S>(restored, 0, 9, 0.1, 1, 0);
    EXPECT_EQ(a, b) << "the free list is part of the state";
    EXPECT_EQ(a.generation, 1u) << "the removed body's slot is used again";
}

template <class S>
std::string refusal(World<S>& world, std::span<const unsigned char> bytes) {
    try {
        world.restoreSnapshot(bytes);
    } catch (const EngineError& error) {
        return error.id();
    }
    return "";
}

TYPED_TEST(Snapshot, DamagedBytesAreRefusedAndChangeNothing) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world = scene<S>(earth<S>());
    for (int i = 0; i < 20; ++i) world.step(R(1.0 / 120));
    std::vector<unsigned char> bytes;
    world.saveSnapshot(bytes);
    const std::uint64_t before = world.stateHash();
    for (std::size_t i = 0; i < bytes.size(); i += 1 + bytes.size() / 200) {
        std::vector<unsigned char> damaged = bytes;
        damaged[i] ^= static_cast<unsigned char>(1 << (i % 8));
        EXPECT_EQ(refusal(world, damaged), i < 8 ? "snapshot_format" : "snapshot_corrupt") << i;
    }
    for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 50)
        EXPECT_NE(refusal(world, std::span(bytes).first(length)), "") << length;
    EXPECT_EQ(world.stateHash(), before);
    EXPECT_EQ(refusal(world, bytes), "");
}

/// The checksum is right; the inconsistent content is found all the same.
TYPED_TEST(Snapshot, ForgedBytesAreRefused) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world = scene<S>(earth<S>());
    for (int i = 0; i < 20; ++i) world.step(R(1.0 / 120));
    std::vector<unsigned char> bytes;
    world.saveSnapshot(bytes);
    int refused = 0, tried = 0;
    for (std::size_t i = 8; i + 8 < bytes.size(); i += 7) {
        std::vector<unsigned char> forged = bytes;
        forged[i] ^= 0xff;
        Hasher hash;
        hash.bytes(forged.data(), forged.size() - 8);
        const std::uint64_t sum = hash.value();
        std::memcpy(forged.data() + forged.size() - 8, &sum, sizeof sum);
        World<S> target = world;
        ++tried;
        if (!refusal(target, forged).empty()) {
            ++refused;
            ASSERT_EQ(target.stateHash(), world.stateHash());
        } else {
            target.step(R(1.0 / 120));  // other numbers, but a world in order
        }
    }
    EXPECT_GT(refused, tried / 20);
}

TYPED_TEST(Snapshot, OtherWorldsAreRefused) {
    using S = TypeParam;
    World<S> world = scene<S>(earth<S>());
    std::vector<unsigned char> bytes;
    world.saveSnapshot(bytes);
    World<S> more = scene<S>(earth<S>());
    addBall<S>(more, 0, 5, 0.1, 1, 0);
    EXPECT_EQ(refusal(more, bytes), "snapshot_world");
    World<S> empty(earth<S>());
    EXPECT_EQ(refusal(empty, bytes), "snapshot_world");
    std::vector<unsigned char> other;
    using Other = std::conditional_t<sizeof(typename S::Real) == 4, Space3d, Space3f>;
    scene<Other>(earth<Other>()).saveSnapshot(other);
    EXPECT_EQ(refusal(world, other), "snapshot_world");
    world.beginStep(typename S::Real(0.01));
    EXPECT_EQ(refusal(world, bytes), "step_in_progress");
    EXPECT_THROW(world.saveSnapshot(bytes), EngineError);
}

}  // namespace
}  // namespace rigor::engine::test
