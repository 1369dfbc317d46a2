// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenes as cases of a bench: which steps are timed, and every requested engine at every number of threads it
// can have.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "adapters/interface/registry.hpp"
#include "scenarios/model/scenario.hpp"
#include "validation/bench/timed_work.hpp"
#include "validation/runner/runner.hpp"

namespace rigor::validation {

/// Numbers of steps from the start.
struct SceneSteps {
    std::size_t warmUp = 0;   ///< steps before the timed ones
    std::size_t timed = 1;    ///< >= 1
    std::size_t quality = 1;  ///< number of steps after which the quality is read; >= warmUp + timed
};
/// Steps to time as the scenario gives them, by default its last third.
SceneSteps sceneSteps(const scenario::Scenario& scenario, double dt);

/// A case with what its child needs.
struct BenchWork {
    PlannedBench planned;
    std::string text;             ///< scenario of a scene, as loaded
    scenario::Scenario scenario;  ///< scenario of a scene
};

struct SceneRequest {
    struct Scene {
        scenario::Scenario scenario;
        std::string text;
        std::string arguments;  ///< arguments that name it on the command line: "box_pyramid --size 10"
    };
    std::vector<Scene> scenes;
    std::vector<adapter::EngineSpec> specs;
    std::string preset = "matched";  ///< preset of specs that name none
    std::vector<int> threads{1};
    double dt = 0.0;  ///< [s]; 0: the first of each scenario
};

/// Engines of another dimension than a scene's are left out of it; an engine that lacks something else says
/// so when it runs. Engines without the option `threads` run on one. Throws BadInput for settings that an
/// engine does not have.
std::vector<BenchWork> planScenes(const SceneRequest& request, const std::vector<EngineDescription>& engines);

/// A spec with `threads` and `preset` in their place: what the case is called, and what its engine is given.
struct ThreadedSpec {
    std::string name, given;
    int threads = 1;
};
std::vector<ThreadedSpec> threadedSpecs(const adapter::EngineSpec& spec, const std::string& preset,
                                        const std::vector<int>& threads, const EngineDescription& engine);

}  // namespace rigor::validation
