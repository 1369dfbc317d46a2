// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/live/instance_world.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>

#include "scenarios/loader/loader.hpp"
#include "validation/live/instance_frame.hpp"
#include "validation/live/tests/live_fixtures.hpp"

namespace rigor::validation {
namespace {

constexpr double kLong = 1e9;

std::unique_ptr<InstanceWorld> instance(const std::string& spec,
                                        const std::string& text = fixtures::slidingBlock()) {
    fixtures::useEngines();
    const scenario::Scenario s = scenario::loadScenarioText(text, "test.json").scenario;
    return std::make_unique<InstanceWorld>(s, adapter::parseSpec(spec), s.timeSteps.front());
}

std::vector<double> bits(InstanceWorld& instance) {
    std::vector<double> all;
    for (const adapter::BodyState& s : instance.states())
        for (const double v : {s.position.x, s.position.y, s.position.z, s.orientation.w, s.orientation.x,
                               s.orientation.y, s.orientation.z, s.velocity.x, s.velocity.y, s.velocity.z,
                               s.angularVelocity.x, s.angularVelocity.y, s.angularVelocity.z})
            all.push_back(v);
    return all;
}

class Instances : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        if (!fixtures::hasEngine(adapter::parseSpec(GetParam()).engine)) GTEST_SKIP() << "not installed";
    }
};
INSTANTIATE_TEST_SUITE_P(Engines, Instances,
                         testing::Values("rigor", "rigor:integrator=symplectic_euler", "bullet", "ode"),
                         [](const auto& one) {
                             std::string name = one.param;
                             std::replace_if(
                                 name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
                             return name;
                         });

/// Every earlier state is restored bit for bit, by snapshots of the state (rigor, ode) or of the log
/// (bullet), and so is the future after it, with a drag in between.
TEST_P(Instances, GoBackToTheSameBits) {
    const auto world = instance(GetParam());
    std::vector<std::vector<double>> states{bits(*world)};
    for (int i = 0; i < 60; ++i) {
        if (i == 20) world->drag(Drag{1, {0.1, 0.1, 0}, {1, 2, 1}, 0.0});
        if (i == 35) world->drag(std::nullopt);
        world->advance(1, kLong);
        states.push_back(bits(*world));
    }
    for (const std::size_t to : {59, 58, 40, 33, 25, 3, 0}) {
        world->goTo(to);
        EXPECT_EQ(world->steps(), to);
        EXPECT_EQ(bits(*world), states[to]) << to;
    }
    world->advance(15, kLong);
    EXPECT_EQ(bits(*world), states[15]) << "what was dragged later is forgotten";
}

/// A block slides at metres a second: its contacts are reported as the step found them, and drawn where they
/// have gone with it; after a step back as well. Those that an engine reports where the step ends stay there.
TEST_P(Instances, ContactsAreCarriedAlongWithTheirBodies) {
    const auto world = instance(GetParam());
    const bool atEnd = world->world().contactInstant() == adapter::ContactInstant::StepEnd;
    world->advance(5, kLong);
    world->goTo(4);
    const scenario::Vec3 at = world->states()[1].position;
    const Packet packet = Packet::decode(instanceFrame(*world, false).encode());
    const scenario::Vec3 before = world->statesBefore()[1].position;
    ASSERT_GT(norm(at - before), 1e-3) << "it slides";
    const auto bodyB = packet.arrays.integers("contacts/body_b");
    const auto found = packet.arrays.doubles("contacts/point_b");
    const auto carried = packet.arrays.doubles("contacts/carried_b");
    ASSERT_EQ(carried.size(), found.size());
    std::size_t ofBlock = 0;
    for (std::size_t i = 0; i < bodyB.size(); ++i) {
        if (bodyB[i] != 1) continue;
        ++ofBlock;
        const auto vec = [i](const auto& v) { return scenario::Vec3{v[3 * i], v[3 * i + 1], v[3 * i + 2]}; };
        EXPECT_NEAR(norm(vec(carried) - at), norm(vec(found) - (atEnd ? at : before)), 1e-9)
            << "on the same spot of it";
        if (!atEnd) {
            EXPECT_GT(norm(vec(carried) - vec(found)), 1e-3);
        }
    }
    EXPECT_GT(ofBlock, 0u);
}

/// Counts belong to the step that is shown, not to the one that was taken last.
TEST_P(Instances, CountsAfterAStepBackAreThoseOfThatStep) {
    const auto world = instance(GetParam());
    const auto counted = [&] {
        const Packet packet = Packet::decode(instanceFrame(*world, false).encode());
        nlohmann::json shown{{"points", packet.arrays.integers("contacts/body_b").size()}};
        for (const char* key : {"contacts", "iterations", "residual"})
            shown[key] = packet.header.at("counters").value(key, -1.0);
        return shown;
    };
    std::vector<nlohmann::json> seen{counted()};
    for (int i = 0; i < 100; ++i) {
        world->advance(1, kLong);
        seen.push_back(counted());
    }
    std::size_t landing = 50;
    while (landing < 100 && seen[landing].at("points") == seen[50].at("points")) ++landing;
    ASSERT_LT(landing, 100u) << "the ball lands in this time";
    for (const std::size_t steps : {landing, landing - 1, std::size_t{1}, std::size_t{0}}) {
        world->goTo(steps);
        EXPECT_EQ(counted(), seen[steps]) << steps;
    }
}

TEST_P(Instances, ADragPullsABodyToItsTarget) {
    const auto world = instance(GetParam());
    world->drag(Drag{2, {0, 0, 0}, {1, 4, 2}, 200.0});
    world->advance(600, kLong);
    // The spring carries the ball: it hangs m g / k below.
    const scenario::Vec3 at = world->states()[2].position;
    EXPECT_NEAR(at.x, 1.0, 0.01);
    EXPECT_NEAR(at.y, 4.0 - 9.81 / 200.0, 0.01);
    ASSERT_TRUE(world->pull().has_value());
    EXPECT_NEAR(world->pull()->force.y, 9.81, 0.2);
    world->drag(std::nullopt);
    EXPECT_FALSE(world->pull().has_value());
    world->advance(60, kLong);
    EXPECT_LT(world->states()[2].velocity.y, -1.0) << "let go";
}

TEST_P(Instances, ADragOfAnyStiffnessIsStable) {
    const auto world = instance(GetParam());
    world->drag(Drag{1, {0.25, 0.25, 0.25}, {0, 3, 0}, 1e12});
    world->advance(600, kLong);
    EXPECT_EQ(world->nonFinite(), "");
    EXPECT_NEAR(norm(world->pull()->point - scenario::Vec3{0, 3, 0}), 0.0, 0.1);
}

TEST(Instance, BodiesThatDoNotMoveCanNotBeDragged) {
    const auto world = instance("rigor");
    EXPECT_THROW(world->drag(Drag{0, {}, {}, 1.0}), adapter::BadInput);
    EXPECT_THROW(world->drag(Drag{7, {}, {}, 1.0}), adapter::BadInput);
    EXPECT_THROW(world->drag(Drag{-1, {}, {}, 1.0}), adapter::BadInput);
    EXPECT_THROW(world->drag(Drag{1, {}, {0, 1e300 * 1e300, 0}, 1.0}), adapter::BadInput);
}

TEST(Instance, StagesAreTheStep) {
    const auto whole = instance("rigor"), staged = instance("rigor");
    whole->advance(3, kLong);
    std::vector<std::string> names;
    while (staged->steps() < 3) {
        ASSERT_TRUE(staged->stage());
        if (staged->steps() == 0 || names.empty() || !staged->inStep()) names.push_back(staged->lastStage());
    }
    EXPECT_EQ(names.front(), "broad_phase");
    EXPECT_EQ(bits(*whole), bits(*staged));
    staged->stage();
    staged->stage();
    EXPECT_TRUE(staged->inStep());
    EXPECT_THROW((void)staged->now(), adapter::BadInput) << "no scene in the middle of a step";
    staged->advance(1, kLong);
    EXPECT_EQ(staged->steps(), 4u) << "the step that had begun";
    whole->advance(1, kLong);
    EXPECT_EQ(bits(*whole), bits(*staged));
    staged->stage();
    staged->goTo(4);
    EXPECT_FALSE(staged->inStep());
    EXPECT_EQ(bits(*whole), bits(*staged)) << "back to the start of the step";
}

TEST(Instance, EnginesWithoutStagesSaySo) {
    if (!fixtures::hasEngine("ode")) GTEST_SKIP() << "not installed";
    EXPECT_FALSE(instance("ode")->stage());
}

TEST(Instance, AFrameHasWhatTheWorldHas) {
    const auto world = instance("rigor");
    world->advance(30, kLong);
    world->stage();
    Packet packet = Packet::decode(instanceFrame(*world, true).encode());
    const nlohmann::json& h = packet.header;
    EXPECT_EQ(h["step"], 30);
    EXPECT_EQ(h["state"], "ready");
    EXPECT_EQ(h["stage"]["done"], "broad_phase");
    EXPECT_EQ(h["stage"]["next"], "narrow_phase");
    const auto position = packet.arrays.doubles("position");
    ASSERT_EQ(position.size(), 9u);
    EXPECT_EQ(position[3], world->states()[1].position.x);
    EXPECT_EQ(packet.arrays.doubles("orientation").size(), 12u);
    EXPECT_EQ(packet.arrays.doubles("velocity")[3], world->states()[1].velocity.x);
    const auto bodyB = packet.arrays.integers("contacts/body_b");
    ASSERT_GE(bodyB.size(), 1u);
    EXPECT_EQ(packet.arrays.integers("contacts/body_a")[0], 0);
    EXPECT_EQ(bodyB[0], 1);
    EXPECT_NEAR(packet.arrays.doubles("contacts/normal")[1], 1.0, 1e-6) << "up";
    EXPECT_EQ(packet.arrays.doubles("contacts/point_b").size(), 3 * bodyB.size());
    EXPECT_EQ(packet.arrays.integers("boxes/of").size(), 6u);
    EXPECT_EQ(packet.arrays.doubles("boxes/sides").size(), 18u);
    for (int i = 0; i < 5; ++i) world->stage();
    packet = instanceFrame(*world, true);
    const auto sizes = packet.arrays.integers("iterations/sizes");
    ASSERT_GE(sizes.size(), 2u);
    std::size_t all = 0;
    for (std::size_t i = 1; i < sizes.size(); i += 2) all += sizes[i];
    EXPECT_EQ(packet.arrays.doubles("iterations/impulses").size(), all);
    const auto start = packet.arrays.doubles("iterations/start");
    EXPECT_EQ(start.size(), static_cast<std::size_t>(sizes[1]));
    EXPECT_GT(*std::max_element(start.begin(), start.end()), 0.0) << "warm starting";
    EXPECT_EQ(packet.arrays.integers("rows/names").size(), 4u * static_cast<std::size_t>(sizes[1]));
    EXPECT_FALSE(instanceFrame(*world, false).arrays.has("rows/names")) << "for those who look";
}

TEST(Instance, StopsAtTheFirstStateThatIsNotFinite) {
    const auto world = instance("double_nan");
    world->advance(20, kLong);
    EXPECT_EQ(world->steps(), 5u);
    EXPECT_THAT(world->nonFinite(), testing::HasSubstr("not finite"));
    EXPECT_EQ(instanceFrame(*world, false).header["state"], "non_finite");
    world->goTo(4);
    EXPECT_EQ(world->nonFinite(), "");
    EXPECT_EQ(world->steps(), 4u);
}

}  // namespace
}  // namespace rigor::validation
