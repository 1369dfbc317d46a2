// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scene that is saved in the middle has the same future as the run that it comes from.
#include "validation/live/scene_now.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/write.hpp"
#include "validation/live/instance_world.hpp"
#include "validation/live/tests/live_fixtures.hpp"

namespace rigor::validation {
namespace {

using scenario::Scenario;

/// The largest difference of positions and velocities between a run that goes on and one that starts from its
/// scene after `before` steps, over `after` steps more.
double divergenceOf(const std::string& text, const std::string& spec, double dt, std::size_t before,
                    std::size_t after, std::vector<std::string>* notes = nullptr) {
    fixtures::useEngines();
    const Scenario s = scenario::loadScenarioText(text, "test.json").scenario;
    InstanceWorld original(s, adapter::parseSpec(spec), dt);
    original.advance(before, 1e9);
    const SceneNow seen = original.now();
    if (notes != nullptr) *notes = seen.notes;
    const std::string saved = scenario::scenarioText(seen.scenario);
    InstanceWorld again(scenario::loadScenarioText(saved, "saved.json").scenario, adapter::parseSpec(spec),
                        dt);
    double worst = 0.0;
    for (std::size_t i = 0; i < after; ++i) {
        original.advance(1, 1e9);
        again.advance(1, 1e9);
        for (std::size_t b = 0; b < s.bodies.size(); ++b) {
            const adapter::BodyState &x = original.states()[b], &y = again.states()[b];
            worst = std::max({worst, norm(x.position - y.position), norm(x.velocity - y.velocity),
                              norm(x.angularVelocity - y.angularVelocity)});
        }
    }
    return worst;
}

std::string scene(const std::string& parts, int dimension = 3) {
    return R"({"rigor": 1, "name": "scene", "title": "A scene", "dimension": )" + std::to_string(dimension) +
           R"(, "isolates": ["joints"], "source": "none", "duration": 4, "dt": [0.005],
           "materials": {"wood": {"friction": 0.4, "restitution": 0.0}}, )" +
           parts + "}";
}

const std::string kRod =
    R"("shapes": [{"box": {"half_extents": [0.5, 0.1, 0.1]}, "material": "wood"}], "collides": false)";

TEST(SceneNow, AFreeBodyFliesOn) {
    EXPECT_LT(divergenceOf(scene(R"("gravity": [0, -9.81, 0], "bodies": [{"name": "stone", "mass": 2,
        "velocity": [3, 4, 0], "angular_velocity": [1, 2, 3], "orientation": [0.5, 0.5, 0.5, 0.5], )" +
                                 kRod + "}]"),
                           "rigor", 0.005, 100, 200),
              1e-9);
}

/// A scene has no memory of the midpoint before, and the midpoint rule is of first order where limits are hit.
constexpr const char* kEuler = "rigor:integrator=symplectic_euler";

/// Limits are counted from the poses of the file: the stops stay where they are.
TEST(SceneNow, AHingeMeetsItsStopsWhereTheyWere) {
    const std::string text = scene(R"("gravity": [0, -9.81, 0], "bodies": [{"name": "arm", "mass": 1,
        "position": [0.5, 0, 0], )" +
                                   kRod +
                                   R"(}],
        "joints": [{"name": "pivot", "type": "hinge", "a": "world", "b": "arm", "anchor": [0, 0, 0],
        "axis": [0, 0, 1], "limits": [-2, 0.5]}])");
    std::vector<std::string> notes;
    EXPECT_LT(divergenceOf(text, kEuler, 0.005, 70, 300, &notes), 1e-6);
    EXPECT_THAT(notes, testing::IsEmpty());
}

TEST(SceneNow, AnglesAreCountedOverTurns) {
    const std::string text = scene(R"("gravity": [0, 0, 0], "bodies": [{"name": "arm", "mass": 1,
        "position": [0.5, 0, 0], "velocity": [0, 5, 0], "angular_velocity": [0, 0, 10], )" +
                                   kRod + R"(}],
        "joints": [{"name": "pivot", "type": "hinge", "a": "world", "b": "arm", "anchor": [0, 0, 0],
        "axis": [0, 0, 1], "limits": [null, 12]}])");
    // The body has turned by 7.5 rad at step 150 and reaches its stop at step 240.
    EXPECT_LT(divergenceOf(text, kEuler, 0.005, 150, 150), 1e-6);
}

TEST(SceneNow, ASliderKeepsItsSpring) {
    const std::string text = scene(R"("gravity": [0, 0, 0], "bodies": [
        {"name": "base", "mass": 5, "position": [0, 0, 0], "angular_velocity": [0, 0.4, 0], )" +
                                   kRod + R"(},
        {"name": "sled", "mass": 1, "position": [0, 1, 0], )" +
                                   kRod + R"(}],
        "joints": [{"name": "rail", "type": "slider", "a": "base", "b": "sled", "anchor": [0, 0.5, 0],
        "axis": [1, 0, 0], "spring": {"stiffness": 20, "damping": 0.5, "target": 0.4}}])");
    EXPECT_LT(divergenceOf(text, "rigor", 0.005, 90, 200), 1e-5);
}

TEST(SceneNow, AWheelKeepsItsSuspension) {
    const std::string text = scene(R"("gravity": [0, -9.81], "bodies": [
        {"name": "car", "mass": 5, "angular_velocity": 0.3, "collides": false,
         "shapes": [{"box": {"half_extents": [1, 0.2]}, "material": "wood"}]},
        {"name": "wheel", "mass": 1, "position": [0.5, -0.5], "angular_velocity": 2, "collides": false,
         "shapes": [{"circle": {"radius": 0.3}, "material": "wood"}]}],
        "joints": [{"name": "axle", "type": "wheel", "a": "car", "b": "wheel", "anchor": [0.5, -0.5],
        "axis": [0, 1], "axes": {"travel": {"spring": {"stiffness": 80, "damping": 2, "target": -0.1}}}}])",
                                   2);
    EXPECT_LT(divergenceOf(text, "rigor", 0.005, 60, 200), 1e-5);
}

TEST(SceneNow, SixDofAndDistanceGoOn) {
    const std::string text = scene(R"("gravity": [0, -1, 0], "bodies": [
        {"name": "box", "mass": 2, "velocity": [0.5, 0, 0], )" +
                                   kRod + R"(},
        {"name": "bob", "mass": 1, "position": [0, -1, 0], "velocity": [1, 0, 0], )" +
                                   kRod + R"(}],
        "joints": [
        {"name": "table", "type": "six_dof", "a": "world", "b": "box", "anchor": [0, 0, 0], "axis": [1, 0, 0],
         "normal": [0, 1, 0], "axes": {"x": {"limits": [-0.5, 0.6]}, "y": {"spring": {"stiffness": 30,
         "damping": 1}}, "swing_z": {"limits": [-0.4, 0.4]}}},
        {"name": "rod", "type": "distance", "a": "box", "b": "bob", "anchor_a": [0, 0, 0],
         "anchor_b": [0, 0, 0], "length": 1}])");
    EXPECT_LT(divergenceOf(text, "rigor", 0.005, 100, 200), 1e-4);
}

TEST(SceneNow, ForcesAndEventsAreThoseToCome) {
    const std::string text =
        scene(R"("gravity": [0, 0, 0], "bodies": [{"name": "stone", "mass": 2, )" + kRod +
              R"(}],
        "forces": [{"constant": {"body": "stone", "force": [1, 0, 0], "start": 0.1, "end": 0.8}},
                   {"constant": {"body": "stone", "force": [0, 5, 0], "end": 0.2}},
                   {"drag": {"body": "stone", "coefficient": 0.3}}],
        "events": [{"time": 0.2, "body": "stone", "impulse": [0, 0, 3]},
                   {"time": 0.5, "body": "stone", "impulse": [0, 0, 1]},
                   {"time": 0.6, "body": "stone", "impulse": [0, 2, 0]}])");
    // The first event is over after 100 steps, at 0.5 s; the second is that of the next step.
    EXPECT_LT(divergenceOf(text, "rigor", 0.005, 100, 100), 1e-9);
    if (fixtures::hasEngine("ode")) {
        EXPECT_LT(divergenceOf(text, "ode", 0.005, 100, 100), 1e-9);
    }
}

/// The warm start is lost; a resting stack stays at rest all the same.
TEST(SceneNow, AStackStaysAStack) {
    const auto loaded = scenario::loadScenario(scenario::findScenario("box_stack"));
    EXPECT_LT(divergenceOf(loaded.text, "rigor", loaded.scenario.timeSteps.front(), 60, 60), 1e-2);
}

TEST(SceneNow, ABrokenJointIsLeftOut) {
    const std::string text = scene(R"("gravity": [0, -9.81, 0], "bodies": [{"name": "arm", "mass": 1,
        "position": [0.5, 0, 0], )" +
                                   kRod +
                                   R"(}],
        "joints": [{"name": "pivot", "type": "hinge", "a": "world", "b": "arm", "anchor": [0, 0, 0],
        "axis": [0, 0, 1], "break_force": 15}])");
    std::vector<std::string> notes;
    EXPECT_LT(divergenceOf(text, "rigor", 0.005, 200, 50, &notes), 1e-9);
    EXPECT_THAT(notes, testing::ElementsAre(testing::HasSubstr("pivot has broken")));
}

TEST(SceneNow, WhatCanNotBeKeptIsSaid) {
    const std::string text = scene(R"("gravity": [0, -9.81, 0], "bodies": [{"name": "arm", "mass": 1,
        "position": [0.5, 0, 0], )" +
                                   kRod +
                                   R"(}],
        "joints": [{"name": "cone", "type": "ball", "a": "world", "b": "arm", "anchor": [0, 0, 0],
        "axis": [1, 0, 0], "axes": {"swing": {"limits": [null, 1]}}}],
        "reference": {"free_flight": {"body": "arm"}}, "accept": {"*": {"position_final": 0.1}})");
    fixtures::useEngines();
    const Scenario s = scenario::loadScenarioText(text, "test.json").scenario;
    InstanceWorld instance(s, adapter::parseSpec("rigor"), 0.005);
    instance.advance(20, 1e9);
    const SceneNow seen = instance.now();
    EXPECT_FALSE(seen.scenario.reference.has_value());
    EXPECT_THAT(seen.notes, testing::Contains(testing::HasSubstr("cone: swing")));
    EXPECT_THAT(seen.notes, testing::Contains(testing::HasSubstr("free_flight")));
    EXPECT_NEAR(seen.scenario.duration, 3.9, 1e-12);
}

}  // namespace
}  // namespace rigor::validation
