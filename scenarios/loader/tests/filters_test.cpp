// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Layers and groups from files: what bodies and shapes get, and what is said of bad ones.
#include <gtest/gtest.h>

#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/write.hpp"

namespace rigor::scenario {
namespace {

std::string filterFile(const std::string& layers, const std::string& body, const std::string& shape) {
    return R"({ "rigor": 1, "name": "s", "title": "t", "dimension": 2, "gravity": [0, -9.81], "duration": 1, "dt": [0.01],
  "materials": { "m": { "friction": 0.5, "restitution": 0 } }, )" +
           layers + R"(
  "bodies": [ { "name": "b", "mass": 1, )" +
           body + R"("shapes": [ { "circle": { "radius": 0.1 })" + shape +
           R"( }, { "circle": { "radius": 0.2 } } ] } ] })";
}
std::string refusalOf(const std::string& text) {
    try {
        (void)loadScenarioText(text, "s.json");
    } catch (const LoadError& error) {
        return error.what();
    }
    return "loaded";
}

TEST(Filters, AreThoseOfTheBodyWhereAShapeHasNone) {
    const Scenario s =
        loadScenarioText(filterFile(R"("layers": ["floor", "debris"],)",
                                    R"("layers": ["debris"], "collides_with": ["floor"], "group": -2, )",
                                    R"(, "layers": ["default", "floor"], "collides_with": [])"),
                         "s.json")
            .scenario;
    EXPECT_EQ(s.layers, (std::vector<std::string>{"default", "floor", "debris"}));
    EXPECT_EQ(s.bodies[0].shapes[0].filter, (ContactFilter{3, 0, -2}));
    EXPECT_EQ(s.bodies[0].shapes[1].filter, (ContactFilter{4, 2, -2}));
    EXPECT_FALSE(mayTouch(s.bodies[0].shapes[0], s.bodies[0].shapes[1]));
}

TEST(Filters, AreTheDefaultWithoutLayersAndWrittenAsTheyAreRead) {
    const Scenario plain = loadScenarioText(filterFile("", "", ""), "s.json").scenario;
    EXPECT_TRUE(plain.layers.empty());
    EXPECT_EQ(plain.bodies[0].shapes[0].filter, ContactFilter{});
    const Scenario s =
        loadScenarioText(filterFile(R"("layers": ["floor"],)", R"("layers": ["floor"], "group": 7, )",
                                    R"(, "collides_with": ["default"])"),
                         "s.json")
            .scenario;
    const Scenario again = loadScenarioText(scenarioText(s), "again.json").scenario;
    EXPECT_EQ(again.layers, s.layers);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_EQ(again.bodies[0].shapes[i].filter, s.bodies[0].shapes[i].filter);
}

TEST(Filters, BadOnesAreRefusedWithTheReason) {
    std::string many = "\"layers\": [\"l0\"";
    for (int i = 1; i < 16; ++i) many += ", \"l" + std::to_string(i) + "\"";
    many += "],";
    struct BadFilter {
        std::string layers, body, shape;
        const char *id, *reason;
    };
    const BadFilter all[] = {
        {R"("layers": ["floor"],)", R"("layers": ["flor"], )", "", "layer.unknown", "default, floor"},
        {R"("layers": ["floor"],)", "", R"(, "collides_with": ["sky"])", "layer.unknown", "default, floor"},
        {"", R"("layers": ["floor"], )", "", "layer.unknown", "names none"},
        {R"("layers": ["floor", "floor"],)", "", "", "layer.duplicate", "once"},
        {R"("layers": ["default"],)", "", "", "layer.duplicate", "every file has"},
        {many, "", "", "layer.count", "at most 16"},
        {R"("layers": ["floor"],)", R"("layers": [], )", "", "layer.none", "at least one"},
        {"", R"("group": 40000, )", "", "value.range", "32767"},
        {"", R"("group": 0.5, )", "", "value", "integer"}};
    for (const BadFilter& bad : all) {
        const std::string text = refusalOf(filterFile(bad.layers, bad.body, bad.shape));
        EXPECT_NE(text.find(bad.id), std::string::npos) << text;
        EXPECT_NE(text.find(bad.reason), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace rigor::scenario
