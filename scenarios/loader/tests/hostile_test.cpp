// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Files that mean harm: control characters, and sizes that no memory holds.
#include <gtest/gtest.h>

#include <ctime>
#include <filesystem>
#include <fstream>

#include "scenarios/generators/generator.hpp"
#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/study.hpp"

namespace rigor::scenario {
namespace {

/// A scenario with this text where its bodies stand.
std::string sceneWith(const std::string& bodies) {
    return R"({"rigor": 1, "name": "hostile", "title": "Hostile", "dimension": 3, "gravity": [0, -9.81, 0],
  "duration": 1, "dt": [0.01], "materials": {"wood": {"friction": 0.5, "restitution": 0}}, )" +
           bodies + "}";
}

std::string hostileRefusal(const std::string& text) {
    try {
        (void)loadScenarioText(text, "hostile.json");
    } catch (const LoadError& error) {
        return error.problems().front().text();
    }
    return "no problem";
}

double secondsOf(const std::string& text, std::size_t bodies) {
    const std::clock_t begin = std::clock();
    EXPECT_EQ(loadScenarioText(text, "hostile.json").scenario.bodies.size(), bodies);
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

const std::string kBall = R"("bodies": [{"name": "ball", "shapes": [{"sphere": {"radius": 1}}]}])";

TEST(HostileFiles, ControlCharactersAreRefusedWithTheirPlace) {
    EXPECT_EQ(hostileRefusal(sceneWith(kBall)), "no problem");
    EXPECT_EQ(
        hostileRefusal(sceneWith(kBall + R"(, "rig\u0000or": 1)")),
        "hostile.json:2: /rig\\x00or: found the control character U+0000 in a key, expected keys without "
        "control characters [json.control_character]");
    EXPECT_EQ(hostileRefusal(sceneWith(kBall + R"(, "description": "\u001b]0;title\u0007")")),
              "hostile.json:2: /description: found the control character U+001B in a string, expected text "
              "without control characters but line breaks and tabs [json.control_character]");
    EXPECT_EQ(
        hostileRefusal(sceneWith(kBall + R"(, "source": "\u009b2J")")),
        "hostile.json:2: /source: found the control character U+009B in a string, expected text without "
        "control characters but line breaks and tabs [json.control_character]");
    EXPECT_EQ(hostileRefusal(sceneWith(kBall + R"(, "description": "one\n\ttwo")")), "no problem");
    const std::string raw = hostileRefusal(sceneWith(kBall + ", \"\x1b[2J\": 1"));
    EXPECT_EQ(raw.find('\x1b'), std::string::npos) << "a message of the parser";
    EXPECT_NE(raw.find("json.syntax"), std::string::npos);
}

/// Time that grows as the net does: no search through all bodies or joints for each joint.
TEST(HostileFiles, TheTimeOfANetGrowsAsItsJointsDo) {
    const auto net = [](int columns, int rows) {
        return sceneWith(R"("generators": [{"net": {"name": "n", "counts": [)" + std::to_string(columns) +
                         ", " + std::to_string(rows) +
                         R"(], "across": [1, 0, 0], "down": [0, 0, 1], "joint": "ball",
  "body": {"collides": false, "shapes": [{"sphere": {"radius": 0.2}}]}}}])");
    };
    const double few = secondsOf(net(40, 40), 1600), many = secondsOf(net(160, 160), 25600);
    EXPECT_LT(many, 6 * 16 * few + 0.2) << "16 times the bodies; a search would take 256 times as long";
    EXPECT_NE(hostileRefusal(net(1000, 1000))
                  .find("/generators/0/net/counts: found array of 2, expected at most 200000"),
              std::string::npos)
        << hostileRefusal(net(1000, 1000));
}

/// Values are counted before anything is made of them, and what stands on one line has one place.
TEST(HostileFiles, MillionsOfValuesAreRefused) {
    const auto field = [](int rows, int columns) {
        std::string row = "[0", text = "[";
        for (int i = 1; i < columns; ++i) row += ",0";
        for (int i = 0; i < rows; ++i) text += (i > 0 ? "," : "") + row + "]";
        return sceneWith(
            R"("bodies": [{"name": "ground", "type": "static", "shapes": [{"height_field": {"spacing": [1, 1],
  "heights": )" +
            text + "]}}]}, " + kBall.substr(kBall.find('{')));
    };
    EXPECT_EQ(hostileRefusal(field(100, 100)), "no problem");
    EXPECT_NE(hostileRefusal(field(2000, 2500)).find("found 5002"), std::string::npos)
        << hostileRefusal(field(2000, 2500));
    EXPECT_NE(hostileRefusal(field(2000, 2500)).find("expected at most 5000000 [json.values]"),
              std::string::npos);
}

/// A grid of 1e9 runs is refused before any of it is made.
TEST(HostileFiles, AGridOfARunTooManyIsRefused) {
    const auto file = std::filesystem::path(testing::TempDir()) / "grid.json";
    const auto problemOf = [&](int values, int variants) {
        std::string list = "0";
        for (int i = 1; i < values; ++i) list += ", " + std::to_string(i);
        std::string names = "\"rigor\"";
        for (int i = 1; i < variants; ++i)
            names += R"(, {"name": "v)" + std::to_string(i) + R"(", "engine": "rigor"})";
        std::ofstream(file)
            << R"({"rigor_study": 1, "name": "grid", "parts": [{"name": "p", "scenarios": ["ball"],
  "parameters": {"x": [)"
            << list << R"(], "y": [)" << list << R"(], "z": [)" << list << R"(]}, "variants": [)" << names
            << R"(], "metrics": ["energy_drift"]}]})";
        try {
            (void)loadStudy(file);
        } catch (const LoadError& error) {
            return error.problems().front().text();
        }
        return std::string("no problem");
    };
    EXPECT_EQ(problemOf(1000, 1), file.string() +
                                      ":1: /parts/0: found a grid of 1e+09 runs, expected at most " +
                                      std::to_string(kMaxStudyRuns) + " in all parts [study.size]");
    EXPECT_EQ(problemOf(20, 25), "no problem") << "200 000";
    EXPECT_NE(problemOf(20, 26), "no problem") << "208 000";
}

}  // namespace
}  // namespace rigor::scenario
