// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Worlds that can be put somewhere else: what is set is read back, a state that is set again changes nothing,
// and a body touches what is where it is now.
#include <cmath>

#include "adapters/conformance/kit.hpp"
#include "adapters/interface/state_setting.hpp"

namespace rigor::conformance {
namespace {

class StateSettingTest : public DynamicsTest {
  protected:
    void SetUp() override {
        if (!hasShape("box") || !hasShape(is2d() ? "circle" : "sphere"))
            GTEST_SKIP() << "no boxes and balls to put somewhere else";
    }
    static adapter::StateSetting* setterOf(adapter::World& world) {
        return dynamic_cast<adapter::StateSetting*>(&world);
    }
    static std::vector<BodyState> statesOf(const adapter::World& world, const Scenario& s) {
        std::vector<BodyState> states(s.bodies.size());
        world.readStates(states);
        return states;
    }
    BodyState somewhere() const {
        const Quat turned =
            is2d() ? fromAxisAngle({0, 0, 1}, -0.8) : fromAxisAngle(Vec3{1, -2, 2} / 3.0, 0.8);
        return {flat({-2.0, 3.5, 1.25}), turned, flat({0.75, -1.5, 2.0}),
                is2d() ? Vec3{0, 0, 1.5} : Vec3{0.5, -1.0, 1.5}};
    }
    static void expectSame(const BodyState& a, const BodyState& b, double tolerance) {
        EXPECT_LE(norm(a.position - b.position), tolerance);
        EXPECT_LE(angleBetween(a.orientation, b.orientation), std::sqrt(tolerance) * 1e-1);
        EXPECT_LE(norm(a.velocity - b.velocity), tolerance);
        EXPECT_LE(norm(a.angularVelocity - b.angularVelocity), tolerance);
    }
    /// A floor whose surface is y = 0.
    int addFloor(Scenario& s) const { return addStatic(s, block({10.0, 0.5, 10.0}), {0.0, -0.5, 0.0}); }
    /// True if the distance is within the largest skin that an engine leaves between resting shapes [m].
    bool touches(const adapter::World& world, int a, int b) const {
        for (const ContactPoint& c : contactsOf(world))
            if (c.bodyA == a && c.bodyB == b && c.depth > -0.03) return true;
        return false;
    }
};
INSTANTIATE_TEST_SUITE_P(Kit, StateSettingTest, testing::ValuesIn(dynamicsArenas()), arenaName);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(StateSettingTest);

/// The centre of mass is away from the body's origin; states are set before the first step and later.
TEST_P(StateSettingTest, WhatIsSetIsReadBack) {
    Scenario s = scene();
    const int still = addStatic(s, ball(0.2), {5, 5, 0}), b = addBody(s, ball(0.5), {}, 2.0);
    if (engine().capabilities().centerOfMassOffset)
        s.bodies[b].massProperties.centerOfMass = flat({0.1, -0.2, 0.05});
    auto world = build(s, 0.01);
    auto* setter = setterOf(*world);
    if (setter == nullptr) GTEST_SKIP() << "this world cannot be put somewhere else";
    for (const int steps : {0, 7}) {
        run(*world, steps);
        auto states = statesOf(*world, s);
        states[b] = somewhere();
        setter->setStates(states);
        const auto now = statesOf(*world, s);
        expectSame(now[b], somewhere(), tol(1e-13, 1e-6));
        EXPECT_EQ(norm(now[still].position - Vec3{5, 5, 0}), 0.0);
    }
    EXPECT_STRNE(setter->warmStart(), "");
}

/// Free flight: the state that the world has is set at every step, and the world flies on as if nothing were.
TEST_P(StateSettingTest, SettingTheStateOfNowChangesNothing) {
    Scenario s = scene();
    s.gravity = flat({0.5, -9.81, 0.25});
    const int b = addBody(s, ball(0.5), flat({1, 2, 3}), 2.5);
    s.bodies[0].velocity = flat({3, 4, -1});
    s.bodies[0].angularVelocity = is2d() ? Vec3{0, 0, 2} : Vec3{1, 2, -2};
    auto plain = build(s, 0.01), set = build(s, 0.01);
    auto* setter = setterOf(*set);
    if (setter == nullptr) GTEST_SKIP() << "this world cannot be put somewhere else";
    for (int n = 0; n < 50; ++n) {
        setter->setStates(statesOf(*set, s));
        run(*plain, 1);
        run(*set, 1);
    }
    expectSame(stateOf(*set, s, b), stateOf(*plain, s, b), tol(1e-11, 1e-4));
}

/// A box that slides over a floor, set once on its way: what the impulses of the step before were is all that
/// may be lost.
TEST_P(StateSettingTest, AContactGoesOnUpToWarmStarting) {
    Scenario s = scene(0.3);
    s.gravity = {0, -9.81, 0};
    addFloor(s);
    const int b = addBody(s, block({0.5, 0.25, 0.5}), {0, 0.25, 0}, 1.0, boxMoments(1.0, {0.5, 0.25, 0.5}));
    s.bodies[b].velocity = {2, 0, 0};
    auto plain = build(s, 1.0 / 240.0), set = build(s, 1.0 / 240.0);
    auto* setter = setterOf(*set);
    if (setter == nullptr) GTEST_SKIP() << "this world cannot be put somewhere else";
    run(*plain, 60);
    run(*set, 60);
    setter->setStates(statesOf(*set, s));
    run(*plain, 60);
    run(*set, 60);
    const BodyState a = stateOf(*plain, s, b), c = stateOf(*set, s, b);
    within("set_state_contact", norm(a.position - c.position), 2e-3);
    within("set_state_contact_speed", norm(a.velocity - c.velocity), 2e-2);
}

/// The broad phase knows at once: a body put onto another is held by it, one put away from it falls.
TEST_P(StateSettingTest, AMovedBodyTouchesWhatIsWhereItIsNow) {
    Scenario s = scene(0.5);
    s.gravity = {0, -9.81, 0};
    const int floor = addFloor(s);
    const int b = addBody(s, ball(0.5), flat({100.0, 40.0, 3.0}), 1.0);
    auto world = build(s, 1.0 / 240.0);
    auto* setter = setterOf(*world);
    if (setter == nullptr) GTEST_SKIP() << "this world cannot be put somewhere else";
    run(*world, 5);
    EXPECT_FALSE(touches(*world, floor, b));
    auto states = statesOf(*world, s);
    states[b] = {{1.0, 0.5, 0.0}, {}, {}, {}};
    setter->setStates(states);
    run(*world, 24);
    EXPECT_TRUE(touches(*world, floor, b)) << "it rests on the floor";
    within("set_state_rest", std::abs(stateOf(*world, s, b).position.y - 0.5), 0.03);
    states[b] = {{1.0, 10.0, 0.0}, {}, {}, {}};
    setter->setStates(states);
    run(*world, 24);
    EXPECT_FALSE(touches(*world, floor, b));
    // 24 steps of an Euler scheme: g h^2 n (n + 1) / 2, or n (n - 1) / 2 where bodies move before their velocities; of
    // Moreau's midpoint rule n^2 / 2.
    const double steps = world->scheme() == adapter::Scheme::ExplicitEuler    ? 276.0
                         : world->scheme() == adapter::Scheme::MoreauMidpoint ? 288.0
                                                                              : 300.0;
    EXPECT_NEAR(stateOf(*world, s, b).position.y, 10.0 - 9.81 * steps / 240.0 / 240.0, 2e-3);
}

/// A body that the engine has put to sleep wakes up when it is put into the air.
TEST_P(StateSettingTest, WhoSleptIsAwake) {
    Scenario s = scene(0.5);
    s.gravity = {0, -9.81, 0};
    addFloor(s);
    const int b = addBody(s, block({0.5, 0.25, 0.5}), {0, 0.25, 0}, 1.0, boxMoments(1.0, {0.5, 0.25, 0.5}));
    auto world = build(s, 1.0 / 60.0);
    auto* setter = setterOf(*world);
    if (setter == nullptr) GTEST_SKIP() << "this world cannot be put somewhere else";
    run(*world, 300);
    auto states = statesOf(*world, s);
    states[b].position.y = 10.0;
    setter->setStates(states);
    run(*world, 30);
    EXPECT_LT(stateOf(*world, s, b).position.y, 9.0);
}

}  // namespace
}  // namespace rigor::conformance
