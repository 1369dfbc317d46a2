// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Quality of states and contacts whose numbers are known, against bounds on both sides of them.
#include "validation/bench/quality.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "scenarios/loader/loader.hpp"

namespace rigor::validation {
namespace {

using adapter::BodyState;
using adapter::ContactPoint;

/// Two balls of 2 kg on a ball joint between them, at rest; gravity 10 m/s^2.
scenario::Scenario pair(const std::string& bounds) {
    return scenario::loadScenarioText(R"({"rigor": 1, "name": "pair", "title": "Two balls", "dimension": 3,
  "gravity": [0, -10, 0], "duration": 1, "dt": [0.01], "materials": {"steel": {}},
  "bench": {"warm_up_steps": 1, "timed_steps": 1, "quality": )" +
                                          bounds +
                                          R"(},
  "bodies": [
    {"name": "low", "mass": 2, "position": [0, 1, 0], "shapes": [{"sphere": {"radius": 0.5}}]},
    {"name": "high", "mass": 2, "position": [0, 2, 0], "shapes": [{"sphere": {"radius": 0.5}}]}],
  "joints": [{"name": "link", "type": "ball", "a": "low", "b": "high", "anchor": [0, 1.5, 0]}]})",
                                      "pair.json")
        .scenario;
}

std::vector<BodyState> atRest() {
    return {{{0, 1, 0}, {}, {}, {}}, {{0, 2, 0}, {}, {}, {}}};
}

ContactPoint contact(int a, int b, double depth) {
    ContactPoint c;
    c.bodyA = a;
    c.bodyB = b;
    c.depth = depth;
    return c;
}

std::map<std::string, results::BenchQuality> byName(const QualityMeter& meter) {
    std::map<std::string, results::BenchQuality> rows;
    for (const auto& q : meter.rows()) rows[q.name] = q;
    return rows;
}

TEST(BenchQuality, TheNumbersAreThoseOfTheStates) {
    auto scenario = pair(R"({"kinetic_energy": 2})");
    scenario.bench.reset();
    QualityMeter meter(scenario, atRest());
    auto states = atRest();
    states[1].velocity = {3, 0, 0};  // 9 J out of nothing, then gone again
    meter.sample(states);
    states = atRest();
    states[1].position = {0, 1.75, 0};  // 5 J of height lost, the anchors 0.25 m apart
    states[0].velocity = {0, 1, 0};     // 1 J
    meter.finish(states, {contact(0, 1, 0.25), contact(0, 1, 0.05), contact(0, 2, -0.1)});
    const auto rows = byName(meter);
    EXPECT_NEAR(rows.at("energy_gain").value, 9.0, 1e-12);
    EXPECT_NEAR(rows.at("kinetic_energy").value, 1.0, 1e-12);
    EXPECT_NEAR(rows.at("joint_gap").value, 0.25, 1e-12);
    EXPECT_NEAR(rows.at("max_penetration").value, 0.25, 1e-15);
    EXPECT_NEAR(rows.at("mean_penetration").value, 0.15, 1e-15);
    EXPECT_EQ(rows.at("contact_pairs").value, 2.0);
    EXPECT_NEAR(rows.at("top_height").value, 1.75, 1e-12);
    EXPECT_NEAR(rows.at("lowest_height").value, 1.0, 1e-12);
    for (const auto& [name, q] : rows) EXPECT_TRUE(q.ok && !q.min && !q.max) << name << " is not judged";
}

TEST(BenchQuality, BoundsAreTheScenarios) {
    const auto scenario = pair(
        R"({"max_penetration": 0.1, "kinetic_energy": 2, "top_height": {"min": 1.9, "max": 2.1},
            "contact_pairs": {"min": 1}, "joint_gap": 0.3})");
    QualityMeter meter(scenario, atRest());
    auto states = atRest();
    states[1].position = {0, 1.75, 0};
    meter.finish(states, {contact(0, 1, 0.25)});
    const auto rows = byName(meter);
    EXPECT_FALSE(rows.at("max_penetration").ok);
    EXPECT_FALSE(rows.at("top_height").ok);
    EXPECT_TRUE(rows.at("kinetic_energy").ok);
    EXPECT_TRUE(rows.at("contact_pairs").ok);
    EXPECT_TRUE(rows.at("joint_gap").ok);
    EXPECT_EQ(rows.at("top_height").min, 1.9);
    EXPECT_EQ(rows.at("top_height").max, 2.1);
    EXPECT_FALSE(rows.at("contact_pairs").max);
    EXPECT_TRUE(rows.at("lowest_height").ok);
}

TEST(BenchQuality, NotANumberIsWithinNoBounds) {
    const auto scenario = pair(R"({"kinetic_energy": 1e15})");
    QualityMeter meter(scenario, atRest());
    auto states = atRest();
    states[0].velocity = {std::numeric_limits<double>::quiet_NaN(), 0, 0};
    meter.sample(states);
    meter.finish(states, {});
    const auto rows = byName(meter);
    EXPECT_FALSE(rows.at("kinetic_energy").ok);
    EXPECT_FALSE(rows.at("energy_gain").ok) << "also where it is not judged";
    EXPECT_EQ(rows.at("max_penetration").value, 0.0);
}

}  // namespace
}  // namespace rigor::validation
