// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/forces.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rigor::validation {
namespace {

using adapter::BodyState;
using adapter::Vec3;
using scenario::kNone;

/// Sums what it is given.
class ScalesWorld : public adapter::World {
  public:
    explicit ScalesWorld(std::size_t bodies) : force(bodies), torque(bodies) {}
    void applyForce(int body, const Vec3& f, const Vec3& t) override {
        force[body] += f;
        torque[body] += t;
    }
    void step() override {}
    void readStates(std::span<BodyState>) const override {}
    void readContacts(std::vector<adapter::ContactPoint>&) const override {}
    adapter::ReadBack readBack() const override { return {}; }
    std::vector<adapter::LedgerEntry> ledger() const override { return {}; }
    adapter::Scheme scheme() const override { return adapter::Scheme::Unknown; }
    std::vector<Vec3> force, torque;
};

scenario::Scenario twoBodies() {
    scenario::Scenario s;
    s.bodies.resize(2);
    return s;
}

ScalesWorld weigh(const scenario::Scenario& s, std::size_t step, double dt,
                  const std::vector<BodyState>& states) {
    ScalesWorld world(s.bodies.size());
    applyForces(s, step, dt, states, world);
    return world;
}

void expectNear(Vec3 a, Vec3 b) {
    EXPECT_NEAR(norm(a - b), 0.0, 1e-12) << a.x << " " << a.y << " " << a.z;
}

/// The impulse of a force that starts and ends within steps is force * time, for any step.
TEST(Forces, ConstantForceGivesItsImpulse) {
    scenario::Scenario s = twoBodies();
    s.forces = {scenario::ConstantForce{1, {3, 0, -1}, {0, 2, 0}, 0.137, 0.4711}};
    for (const double dt : {0.1, 0.05, 0.003}) {
        Vec3 impulse, angular;
        for (std::size_t step = 0; step * dt < 1.0; ++step) {
            const auto world = weigh(s, step, dt, std::vector<BodyState>(2));
            impulse += dt * world.force[1];
            angular += dt * world.torque[1];
            EXPECT_EQ(world.force[0], Vec3{});
        }
        expectNear(impulse, (0.4711 - 0.137) * Vec3{3, 0, -1});
        expectNear(angular, (0.4711 - 0.137) * Vec3{0, 2, 0});
    }
}

/// Hooke's law and the damper along the line of the anchors; action is reaction; torques about both centres
/// of mass.
TEST(Forces, SpringAgainstAHandComputation) {
    scenario::Scenario s = twoBodies();
    s.bodies[1].massProperties.centerOfMass = {0, 0.1, 0};
    s.forces = {scenario::SpringForce{0, 1, {0, 0.5, 0}, {0, -0.25, 0}, 10.0, 2.0, 1.0}};
    std::vector<BodyState> states(2);
    states[1].position = {3, 0.75, 0};  // anchors at (0, 0.5, 0) and (3, 0.5, 0): length 3, along x
    states[1].velocity = {0.5, 7, 0};
    states[1].angularVelocity = {0, 0, 2};  // anchor B moves with v + w x arm, arm = (0, -0.35, 0)
    const double rate = 0.5 + 2 * 0.35;     // (w x arm).x = -w_z * arm_y
    const double tension = 10.0 * (3 - 1) + 2.0 * rate;
    const auto world = weigh(s, 0, 0.01, states);
    expectNear(world.force[1], {-tension, 0, 0});
    expectNear(world.force[0], {tension, 0, 0});
    expectNear(world.torque[0], scenario::cross({0, 0.5, 0}, {tension, 0, 0}));
    expectNear(world.torque[1], scenario::cross({0, -0.35, 0}, {-tension, 0, 0}));
}

TEST(Forces, SpringTurnsWithTheBodyAndPullsOnlyDynamicOnes) {
    scenario::Scenario s = twoBodies();
    s.bodies[0].type = scenario::BodyType::Static;
    s.forces = {scenario::SpringForce{0, 1, {1, 0, 0}, {}, 4.0, 0.0, 0.0}};
    std::vector<BodyState> states(2);
    states[0].orientation = scenario::fromAxisAngle({0, 0, 1}, std::acos(0.0));  // anchor A at (0, 1, 0)
    states[1].position = {0, 3, 0};
    const auto world = weigh(s, 0, 0.01, states);
    expectNear(world.force[1], {0, -8, 0});
    EXPECT_EQ(world.force[0], Vec3{});
}

TEST(Forces, SpringToTheWorldAndWithoutLength) {
    scenario::Scenario s = twoBodies();
    s.forces = {scenario::SpringForce{kNone, 1, {0, 2, 0}, {}, 3.0, 0.0, 0.5}};
    std::vector<BodyState> states(2);
    expectNear(weigh(s, 0, 0.01, states).force[1], {0, 4.5, 0});
    states[1].position = {0, 2, 0};
    EXPECT_EQ(weigh(s, 0, 0.01, states).force[1], Vec3{}) << "no direction, no force, no NaN";
}

TEST(Forces, DragOpposesTheVelocity) {
    scenario::Scenario s = twoBodies();
    s.forces = {scenario::DragForce{1, 0.25}};
    std::vector<BodyState> states(2);
    states[1].velocity = {4, 0, -8};
    expectNear(weigh(s, 0, 0.01, states).force[1], {-1, 0, 2});
    EXPECT_TRUE(forcesNeedStates(s, ScalesWorld(2)));
    EXPECT_FALSE(forcesNeedStates(twoBodies(), ScalesWorld(2)));
}

/// A world that evaluates forces itself, and takes impulses as such.
class OwnForcesWorld final : public ScalesWorld {
  public:
    using ScalesWorld::ScalesWorld;
    bool evaluatesForces() const override { return true; }
    bool applyImpulse(int body, const Vec3& impulse, const Vec3& angularImpulse) override {
        linear[body] += impulse;
        angular[body] += angularImpulse;
        return true;
    }
    std::vector<Vec3> linear = std::vector<Vec3>(2), angular = std::vector<Vec3>(2);
};

TEST(Forces, WorldsThatEvaluateThemGetTheEventsAlone) {
    scenario::Scenario s = twoBodies();
    s.forces = {scenario::DragForce{1, 0.25}, scenario::ConstantForce{0, {1, 2, 3}, {}, 0, 1}};
    s.events = {scenario::Event{0.05, 1, {1, 2, 3}, {4, 5, 6}}};
    std::vector<BodyState> states(2);
    states[1].velocity = {4, 0, -8};
    OwnForcesWorld world(2);
    EXPECT_FALSE(forcesNeedStates(s, world));
    for (std::size_t step = 0; step < 10; ++step) applyForces(s, step, 0.02, states, world);
    for (const std::size_t body : {0, 1}) {
        EXPECT_EQ(world.force[body], Vec3{});
        EXPECT_EQ(world.torque[body], Vec3{});
    }
    EXPECT_EQ(world.linear[1], (Vec3{1, 2, 3}));
    EXPECT_EQ(world.angular[1], (Vec3{4, 5, 6}));
    EXPECT_EQ(world.linear[0], Vec3{});
}

/// Exactly once, in the first step that starts at or after the event, whatever rounding step * dt suffers.
TEST(Forces, EventsGiveTheirImpulseOnce) {
    for (const double dt : {0.1, 1.0 / 60.0, 1.0 / 240.0, 0.003})
        for (const double time : {0.0, 0.05, 0.3, 0.7, 21 * dt}) {
            scenario::Scenario s = twoBodies();
            s.events = {{time, 1, {1, 2, 3}, {0, 0, 5}}};
            Vec3 impulse, angular;
            int times = 0;
            for (std::size_t step = 0; step * dt < 2.5; ++step) {
                const auto world = weigh(s, step, dt, std::vector<BodyState>(2));
                if (norm(world.force[1]) == 0.0) continue;
                ++times;
                impulse += dt * world.force[1];
                angular += dt * world.torque[1];
                EXPECT_GE(step * dt, time - 1e-9 * dt);
                EXPECT_LT(step * dt, time + dt - 1e-9 * dt);
            }
            EXPECT_EQ(times, 1) << "dt " << dt << " time " << time;
            expectNear(impulse, {1, 2, 3});
            expectNear(angular, {0, 0, 5});
        }
}

}  // namespace
}  // namespace rigor::validation
