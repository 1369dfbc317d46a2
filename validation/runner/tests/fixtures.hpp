// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenarios, plans and folders for the runner's tests. Engines are the test doubles, found through
// RIGOR_ADAPTER_PATH; the binary is runner_child.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/loader/loader.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/runner.hpp"

namespace rigor::validation::fixtures {

namespace fs = std::filesystem;

inline fs::path buildFolder() {
    return RIGOR_BINARY_DIR;
}

/// A thrown ball over a floor that is too far away to matter.
inline std::string thrownBall(const std::string& name, const std::string& extra = "") {
    return R"({"rigor": 1, "name": ")" + name + R"(", "title": "A thrown ball", "dimension": 3,
  "isolates": ["integrator"], "source": "Galilei 1638", "gravity": [0.5, -3.75, 0.25], "duration": 0.5, "dt": [0.0078125],
  "materials": {"steel": {"friction": 0.1, "restitution": 0.5}},
  "bodies": [
    {"name": "floor", "type": "static", "position": [0, -20, 0], "shapes": [{"half_space": {"normal": [0, 1, 0]}}]},
    {"name": "ball", "mass": 2, "position": [1, 2, 3], "velocity": [4, 5, -6],
     "shapes": [{"sphere": {"radius": 0.1}}]}],
  "observe": ["ball"], "reference": {"free_flight": {"body": "ball"}}, "metrics": ["position_final"])" +
           extra + "}";
}

/// Two balls that fly through each other and a floor: an engine without contacts, but much to audit.
inline std::string crossingBalls() {
    return R"({"rigor": 1, "name": "crossing_balls", "title": "Balls that cross", "dimension": 3,
  "isolates": ["contacts"], "source": "none", "gravity": [0, 0, 0], "duration": 1, "dt": [0.0078125],
  "materials": {"steel": {"friction": 0.1, "restitution": 0.5}},
  "bodies": [
    {"name": "floor", "type": "static", "position": [0, 0, 0], "shapes": [{"half_space": {"normal": [0, 1, 0]}}]},
    {"name": "left", "mass": 1, "position": [-0.5, 0.24, 0], "velocity": [1, 0, 0],
     "shapes": [{"sphere": {"radius": 0.25}}]},
    {"name": "right", "mass": 1, "position": [0.5, 0.26, 0.1], "velocity": [-1, 0, 0],
     "shapes": [{"sphere": {"radius": 0.25}}]}],
  "observe": ["left", "right"], "metrics": ["momentum_drift"]})";
}

inline std::pair<scenario::Scenario, std::string> load(const std::string& text) {
    auto loaded = scenario::loadScenarioText(text, "test.json");
    return {std::move(loaded.scenario), std::move(loaded.text)};
}

inline std::vector<CasePlan> plan(const std::vector<std::string>& texts, const std::string& specs) {
    std::vector<std::pair<scenario::Scenario, std::string>> scenarios;
    for (const auto& text : texts) scenarios.push_back(load(text));
    return planCases(scenarios, adapter::parseSpecList(specs), {});
}

class RunnerTest : public testing::Test {
  protected:
    void SetUp() override { setenv("RIGOR_ADAPTER_PATH", (buildFolder() / "tests/doubles").c_str(), 1); }

    RunOptions options(const std::string& folder = "run") const {
        RunOptions o;
        o.directory = scratch_.path() / folder;
        o.binary = buildFolder() / "tests/runner_child";
        o.audit = false;
        o.suite = "test";
        o.command = "test";
        return o;
    }
    static results::Run run(const std::vector<CasePlan>& cases, const RunOptions& o) {
        const std::atomic<bool> never{false};
        return runCases(cases, o, {}, never);
    }

    ScratchFolder scratch_;
};

}  // namespace rigor::validation::fixtures
