// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <gtest/gtest.h>

#include "scenarios/loader/loader.hpp"

namespace rigor::scenario {
namespace {

LoadedScenario with(const std::string& name, const std::vector<std::string>& overrides) {
    return loadScenario(findScenario(name), overrides);
}

std::string idOf(const std::string& name, const std::string& override) {
    try {
        (void)with(name, {override});
    } catch (const LoadError& error) {
        return error.problems().front().id;
    }
    return "loaded";
}

TEST(Overrides, ByNameByIndexAndDeep) {
    const Scenario s = with("slide_and_stop", {"bodies.block.velocity=[3.1,0,0.2]", "bodies.1.mass=5",
                                               "gravity=[0,-1.6,0]", "pairs.0.friction=0.25",
                                               "materials.wood.restitution=0.125", "dt=[0.001,0.0005]"})
                           .scenario;
    const Body& block = s.bodies[findBody(s, "block")];
    EXPECT_EQ(block.velocity, (Vec3{3.1, 0.0, 0.2}));
    EXPECT_EQ(block.massProperties.mass, 5.0);
    EXPECT_EQ(s.gravity, (Vec3{0.0, -1.6, 0.0}));
    EXPECT_EQ(pairCoefficients(s, block.shapes[0].material, s.bodies[0].shapes[0].material).friction, 0.25);
    EXPECT_EQ(s.timeSteps, (std::vector<double>{0.001, 0.0005}));
}

TEST(Overrides, TimeStepsAsOnTheCommandLine) {
    const Scenario s = with("slide_and_stop", {"dt=[\"1/60\", \"0.004\", 0.002]"}).scenario;
    EXPECT_EQ(s.timeSteps, (std::vector<double>{1.0 / 60, 0.004, 0.002}));
    for (const char* wrong : {"1/0", "1/", "/60", "sixty", "1/60 s", "2", "-1/60", ""})
        EXPECT_NE(idOf("slide_and_stop", "dt=[\"" + std::string(wrong) + "\"]"), "loaded") << wrong;
}

TEST(Overrides, InsideShapesAndGenerators) {
    const Scenario s = with("box_stack", {"generators.0.grid.counts=[1,3,1]"}).scenario;
    EXPECT_EQ(s.bodies.size(), 4u);
    const Scenario ball = with("bouncing_ball", {"bodies.ball.shapes.0.sphere.radius=0.2"}).scenario;
    EXPECT_EQ(std::get<Sphere>(ball.bodies[1].shapes[0].geometry).radius, 0.2);
}

TEST(Overrides, ANewKeyAndAWordWithoutQuotes) {
    EXPECT_EQ(with("slide_and_stop", {"bodies.block.gravity_scale=0.5"}).scenario.bodies[1].gravityScale,
              0.5);
    EXPECT_FALSE(with("slide_and_stop", {"reference=none"}).scenario.reference.has_value());
}

TEST(Overrides, ABoundMayBeNew) {
    const Scenario s = with("slide_and_stop", {R"(accept.*.position_final={"min":0.1,"max":0.2})",
                                               "accept.rigor.energy_gain=0.5"})
                           .scenario;
    ASSERT_EQ(s.accept.size(), 2u);
    EXPECT_EQ(s.accept[0].engine, "*");
    EXPECT_EQ(s.accept[0].metric, "position_final");
    EXPECT_EQ(s.accept[0].min, 0.1);
    EXPECT_EQ(s.accept[0].max, 0.2);
    EXPECT_EQ(s.accept[1].engine, "rigor");
    EXPECT_EQ(idOf("slide_and_stop", "accept.rigor=0.5"), "override.unknown");
    EXPECT_EQ(idOf("slide_and_stop", "accept.rigor.energy_gain.most=0.5"), "override.unknown");
}

TEST(Overrides, TheTextKeepsThem) {
    const LoadedScenario loaded = with("slide_and_stop", {"bodies.block.velocity=[3.1,0,0.2]"});
    EXPECT_EQ(loadScenarioText(loaded.text, "again").scenario.bodies[1].velocity, (Vec3{3.1, 0.0, 0.2}));
}

TEST(Overrides, MistakesAreRefused) {
    EXPECT_EQ(idOf("slide_and_stop", "no equals sign"), "override.form");
    EXPECT_EQ(idOf("slide_and_stop", "=3"), "override.form");
    EXPECT_EQ(idOf("slide_and_stop", "bodies.brick.mass=3"), "override.unknown");
    EXPECT_EQ(idOf("slide_and_stop", "bodies.7.mass=3"), "override.unknown");
    EXPECT_EQ(idOf("slide_and_stop", "bodies.block.velocity=[2,0,-.7]"), "override.value");
    EXPECT_EQ(idOf("slide_and_stop", "title=\"half"), "override.value");
    EXPECT_EQ(idOf("slide_and_stop", "bodies.block.mas=3"), "schema.unknown_key");
    EXPECT_EQ(idOf("slide_and_stop", "bodies.block.mass=-3"), "value.range");
    EXPECT_EQ(idOf("slide_and_stop", "bodies.block.mass=heavy"), "schema.type");
    EXPECT_EQ(idOf("slide_and_stop", "bodies.block.mass=1e999"), "schema.type") << "no number, so a word";
}

}  // namespace
}  // namespace rigor::scenario
