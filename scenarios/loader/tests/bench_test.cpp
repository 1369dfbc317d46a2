// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenes of the bench: the plan of their timing, numbers that grow with their size, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/write.hpp"

namespace rigor::scenario {
namespace {

std::string scene(const std::string& size, const std::string& bench,
                  const std::string& rows = "{\"size\": 1}") {
    return R"({"rigor": 1, "name": "t", "title": "t", "dimension": 2, "gravity": [0, -9.81], "duration": 1,
"dt": [0.01], "materials": {"m": {}},
)" + size + R"("generators": [{"pyramid": {"name": "p", "rows": )" +
           rows + R"(, "spacing": [1, 1],
  "body": {"shapes": [{"circle": {"radius": 0.5}}]}}}],
"bench": )" +
           bench + "}";
}

const char* const kPlan = R"({"warm_up_steps": 20, "timed_steps": 10, "quality_step": 40, "sizes": [2, 4, 8],
"quality": {"kinetic_energy": 0.5, "top_height": {"min": {"size": 1, "plus": -0.5}},
            "contact_pairs": {"min": 3, "max": {"size": 0.5, "power": 3}}}})";

Scenario load(const std::string& text, const std::vector<std::string>& overrides = {}) {
    return loadScenarioText(text, "t.json", overrides).scenario;
}
std::string firstProblem(const std::string& text) {
    try {
        (void)loadScenarioText(text, "t.json");
    } catch (const LoadError& error) {
        return error.what();
    }
    return "";
}

TEST(BenchPlan, IsReadWithItsBounds) {
    const Scenario s = load(scene("\"size\": 4, ", kPlan));
    ASSERT_TRUE(s.bench);
    EXPECT_EQ(s.size, 4);
    EXPECT_EQ(s.bench->warmUpSteps, 20);
    EXPECT_EQ(s.bench->timedSteps, 10);
    EXPECT_EQ(s.bench->qualityStep, 40);
    EXPECT_THAT(s.bench->sizes, testing::ElementsAre(2, 4, 8));
    ASSERT_EQ(s.bench->quality.size(), 3u);
    for (const QualityBound& bound : s.bench->quality) {
        const std::string_view key = nameOf(bound.quantity).key;
        if (key == "kinetic_energy") {
            EXPECT_EQ(bound.max, 0.5);
            EXPECT_TRUE(std::isinf(bound.min));
            EXPECT_TRUE(bound.holds(0.5));
            EXPECT_FALSE(bound.holds(0.51));
        } else if (key == "top_height") {
            EXPECT_EQ(bound.min, 3.5);
            EXPECT_TRUE(std::isinf(bound.max));
            EXPECT_FALSE(bound.holds(3.4));
        } else {
            EXPECT_EQ(key, "contact_pairs");
            EXPECT_EQ(bound.min, 3.0);
            EXPECT_EQ(bound.max, 32.0);
        }
        EXPECT_FALSE(bound.holds(std::nan("")));
    }
}

TEST(BenchPlan, QualityIsTestedAfterTheTimedStepsByDefault) {
    const Scenario s =
        load(scene("", R"({"warm_up_steps": 7, "timed_steps": 5, "quality": {"joint_gap": 1}})", "2"));
    EXPECT_EQ(s.bench->qualityStep, 12);
    EXPECT_FALSE(s.size);
    EXPECT_TRUE(s.bench->sizes.empty());
    EXPECT_FALSE(
        load(R"({"rigor": 1, "name": "t", "title": "t", "dimension": 2, "gravity": [0, 0], "duration": 1,
        "dt": [0.01], "bodies": [{"name": "a", "mass": 1, "inertia": 1}]})")
            .bench);
}

TEST(BenchPlan, EveryQuantityHasItsNameAndUnit) {
    EXPECT_EQ(qualityNames().size(), 8u);
    for (const QualityName& name : qualityNames()) {
        EXPECT_EQ(nameOf(name.quantity).key, name.key);
        const std::string plan = R"({"warm_up_steps": 0, "timed_steps": 1, "quality": {")" +
                                 std::string(name.key) + R"(": {"min": 1, "max": 2}}})";
        const Scenario s = load(scene("", plan, "2"));
        ASSERT_EQ(s.bench->quality.size(), 1u);
        EXPECT_EQ(s.bench->quality[0].quantity, name.quantity);
    }
}

TEST(Size, SetsTheNumberOfBodies) {
    const std::string text = scene("\"size\": 4, ", kPlan);
    EXPECT_EQ(load(text).bodies.size(), 10u);
    const Scenario grown = load(text, {"size=8"});
    EXPECT_EQ(grown.bodies.size(), 36u);
    EXPECT_EQ(grown.size, 8);
    for (const QualityBound& bound : grown.bench->quality) {
        if (bound.quantity == Quality::TopHeight) {
            EXPECT_EQ(bound.min, 7.5);
        }
    }
    // 1.4 * 2^0.5 + 1 = 2.98, to the nearest
    EXPECT_EQ(load(scene("\"size\": 2, ", kPlan, R"({"size": 1.4, "power": 0.5, "plus": 1})")).bodies.size(),
              6u);
}

TEST(Size, IsWrittenAndReadBack) {
    const Scenario a = load(scene("\"size\": 4, ", kPlan));
    const Scenario b = load(scenarioText(a));
    EXPECT_EQ(a.size, b.size);
    ASSERT_TRUE(b.bench);
    EXPECT_EQ(a.bench->sizes, b.bench->sizes);
    EXPECT_EQ(a.bench->qualityStep, b.bench->qualityStep);
    ASSERT_EQ(a.bench->quality.size(), b.bench->quality.size());
    for (const QualityBound& one : a.bench->quality)
        EXPECT_TRUE(std::any_of(b.bench->quality.begin(), b.bench->quality.end(),
                                [&](const QualityBound& other) {
                                    return one.quantity == other.quantity && one.min == other.min &&
                                           one.max == other.max;
                                }))
            << nameOf(one.quantity).key;
}

struct Bad {
    const char *size, *rows, *bench, *message;
};

TEST(BenchPlan, MistakesAreNamed) {
    const char* const good = R"({"warm_up_steps": 0, "timed_steps": 1, "quality": {"joint_gap": 1}})";
    const Bad table[] = {
        {"", R"({"size": 1})", good,
         R"(t.json:3: /generators/0/pyramid/rows: found a number of the scene's size, expected a number, or the key 'size' in the scenario [size.missing])"},
        {"\"size\": 4, ", R"({"size": 100})", good,
         R"(t.json:3: /generators/0/pyramid/rows: found 400 at size 4, expected integer from 1 to 315 [value.range])"},
        {"\"size\": 4, ", R"({"size": 1, "pover": 2})", good,
         R"(t.json:3: /generators/0/pyramid/rows/pover: found the key 'pover', expected one of size, power, plus [schema.unknown_key])"},
        {"\"size\": 0, ", "2", good,
         R"(t.json:3: /size: found number 0, expected integer from 1 to 1000000 [value.range])"},
        {"", "2", R"({"timed_steps": 1, "quality": {"joint_gap": 1}})",
         R"(t.json:5: /bench: found no key 'warm_up_steps', expected the key 'warm_up_steps' [schema.missing_key])"},
        {"", "2", R"({"warm_up_steps": 0, "timed_steps": 0, "quality": {"joint_gap": 1}})",
         R"(t.json:5: /bench/timed_steps: found number 0, expected integer from 1 to 1000000 [value.range])"},
        {"", "2",
         R"({"warm_up_steps": 9, "timed_steps": 2, "quality_step": 10, "quality": {"joint_gap": 1}})",
         R"(t.json:5: /bench/quality_step: found number 10, expected integer from 11 to 2000000 [value.range])"},
        {"", "2", R"({"warm_up_steps": 0, "timed_steps": 1, "quality": {}})",
         R"(t.json:5: /bench/quality: found object with 0 keys, expected at least one bound: a timing without quality says nothing [bench.quality])"},
        {"", "2", R"({"warm_up_steps": 0, "timed_steps": 1, "quality": {"speed": 1}})",
         R"(t.json:5: /bench/quality/speed: found the key 'speed', expected one of max_penetration, mean_penetration, kinetic_energy, energy_gain, joint_gap, top_height, lowest_height, contact_pairs [schema.unknown_key])"},
        {"", "2", R"({"warm_up_steps": 0, "timed_steps": 1, "quality": {"joint_gap": {}}})",
         R"(t.json:5: /bench/quality/joint_gap: found object with 0 keys, expected min, max or both [bench.bound])"},
        {"", "2", R"({"warm_up_steps": 0, "timed_steps": 1, "quality": {"joint_gap": {"min": 2, "max": 1}}})",
         R"(t.json:5: /bench/quality/joint_gap: found object with 2 keys, expected min not above max [bench.bound])"},
        {"", "2", R"({"warm_up_steps": 0, "timed_steps": 1, "sizes": [1], "quality": {"joint_gap": 1}})",
         R"(t.json:5: /bench/sizes: found sizes of a scene that has none, expected the key 'size' in the scenario [size.missing])"},
        {"\"size\": 4, ", "2",
         R"({"warm_up_steps": 0, "timed_steps": 1, "sizes": [3, 3], "quality": {"joint_gap": 1}})",
         R"(t.json:5: /bench/sizes/1: found number 3, expected sizes that rise [bench.sizes])"},
    };
    for (const Bad& bad : table) EXPECT_EQ(firstProblem(scene(bad.size, bad.bench, bad.rows)), bad.message);
}

}  // namespace
}  // namespace rigor::scenario
