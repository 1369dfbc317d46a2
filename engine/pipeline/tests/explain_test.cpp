// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The engine explains itself: phases one at a time, rows between them, the event log.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <charconv>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Explain : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Explain, Spaces);

template <class S>
World<S> droppedCube(BodyId& cube, int substeps = 1) {
    WorldDef<S> def = earth<S>();
    def.substeps = substeps;
    World<S> world(def);
    const std::uint32_t m = world.addMaterial(typename S::Real(0.5), 0);
    addGround<S>(world, m);
    cube = addCube<S>(world, 0, 0.55, 0.5, 1, m);
    return world;
}

TYPED_TEST(Explain, PhasesOneAtATimeAreTheWholeStep) {
    using S = TypeParam;
    using R = typename S::Real;
    BodyId cube;
    World<S> whole = droppedCube<S>(cube, 2), phased = droppedCube<S>(cube, 2);
    for (int i = 0; i < 30; ++i) {
        whole.step(R(1.0 / 60));
        phased.beginStep(R(1.0 / 60));
        std::vector<Phase> seen;
        while (phased.stepping()) {
            seen.push_back(phased.nextPhase());
            phased.runPhase();
        }
        ASSERT_EQ(seen.size(), 2u + 2u * 7u);
        EXPECT_EQ(seen[0], Phase::BroadPhase);
        EXPECT_EQ(seen[1], Phase::NarrowPhase);
        EXPECT_EQ(seen[2], Phase::Rows);
        EXPECT_EQ(seen[9], Phase::Rows);
        ASSERT_EQ(whole.stateHash(), phased.stateHash());
    }
}

TYPED_TEST(Explain, RowsBeforeAndAfterTheSolver) {
    using S = TypeParam;
    using R = typename S::Real;
    BodyId cube;
    World<S> world = droppedCube<S>(cube);
    for (int i = 0; i < 60; ++i) world.step(R(1.0 / 60));
    const auto weight = [&] {
        R sum = 0;
        for (const Block<S>& block : world.rows().blocks)
            if (block.kind == BlockKind::Contact) sum += world.rows().rows[block.first].impulse;
        return sum;
    };
    world.beginStep(R(1.0 / 60));
    while (world.nextPhase() != Phase::Velocities) world.runPhase();
    const Velocity<S> before{world.velocity(cube), world.angularVelocity(cube)};
    world.runPhase();  // gravity has acted, nothing holds the cube
    EXPECT_NEAR(world.velocity(cube)[1] - before.v[1], -kGravity / 60, 1e-6);
    world.runPhase();  // the contacts hold it
    EXPECT_NEAR(world.velocity(cube)[1], 0, 1e-5);
    EXPECT_NEAR(weight(), kGravity / 60, 1e-5);
    EXPECT_THROW(world.beginStep(R(1.0 / 60)), EngineError);
    while (world.stepping()) world.runPhase();
    EXPECT_THROW(world.runPhase(), EngineError);
}

TYPED_TEST(Explain, ContactsBeginAndEndOnce) {
    using S = TypeParam;
    using R = typename S::Real;
    BodyId cube;
    World<S> world = droppedCube<S>(cube);
    std::vector<std::string> log;
    const auto names = [&](BodyId id) { return id == cube ? std::string("cube") : std::string("ground"); };
    const auto run = [&](int steps) {
        for (int i = 0; i < steps; ++i)
            for (const Event<S>& event : world.step(R(1.0 / 60)).events)
                log.push_back(describe(event, names));
    };
    run(120);
    ASSERT_EQ(log.size(), 1u);
    EXPECT_THAT(log[0], testing::StartsWith("contact_begins a=ground b=cube n=(0,1"));
    EXPECT_THAT(log[0], testing::HasSubstr(" jn="));
    world.setVelocity(cube, at<S>(0, 3), zeroAng<S>());
    run(20);
    ASSERT_EQ(log.size(), 2u);
    EXPECT_EQ(log[1], "contact_ends a=ground b=cube");
    run(120);
    EXPECT_EQ(log.size(), 3u);
}

TYPED_TEST(Explain, ContactLinesReadBack) {
    using S = TypeParam;
    using R = typename S::Real;
    BodyId cube;
    World<S> world = droppedCube<S>(cube);
    for (int i = 0; i < 60; ++i) world.step(R(1.0 / 60));
    std::vector<ContactView<S>> contacts;
    world.readContacts(contacts);
    ASSERT_EQ(contacts.size(), S::dim == 2 ? 2u : 4u);
    const std::string line = describe(contacts[0]);
    const std::string key = " jn=";
    const auto at = line.find(key);
    ASSERT_NE(at, std::string::npos) << line;
    R read = 0;
    std::from_chars(line.data() + at + key.size(), line.data() + line.size(), read);
    EXPECT_EQ(read, contacts[0].normalImpulse) << "round-trip digits";
}

}  // namespace
}  // namespace rigor::engine::test
