// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/bench/scenes.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "scenarios/loader/data_folder.hpp"
#include "validation/bench/exchange.hpp"
#include "validation/comparison/compare.hpp"
#include "validation/hash.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/scenario_settings.hpp"
#include "validation/runner/shell_word.hpp"
#include "validation/runner/simulate.hpp"

namespace rigor::validation {
namespace {

using adapter::EngineSpec;

const std::string kThreads = "threads";

bool hasThreads(const EngineDescription& engine) {
    return std::any_of(engine.options.begin(), engine.options.end(),
                       [](const adapter::Option& o) { return o.key == kThreads; });
}

bool couldRun(const EngineDescription& engine, const scenario::Scenario& scenario) {
    if (!engine.problem.empty()) return true;  // the problem is reported when it runs
    const auto& c = engine.capabilities;
    const bool native =
        std::find(c.dimensions.begin(), c.dimensions.end(), scenario.dimension) != c.dimensions.end();
    return c.dynamics && (native || (scenario.dimension == 2 && c.planar));
}

double movingBodies(const scenario::Scenario& scenario) {
    return std::count_if(scenario.bodies.begin(), scenario.bodies.end(),
                         [](const scenario::Body& body) { return body.type == scenario::BodyType::Dynamic; });
}

/// The same physics is the same work, whatever else is said of it.
std::string identityOf(const std::string& text) {
    Fnv1a hash;
    hash.text(physicsOf(text));
    return hash.hex();
}

}  // namespace

SceneSteps sceneSteps(const scenario::Scenario& scenario, double dt) {
    if (scenario.bench) {
        const auto count = [](int steps) { return static_cast<std::size_t>(std::max(0, steps)); };
        const scenario::BenchPlan& plan = *scenario.bench;
        return {count(plan.warmUpSteps), count(plan.timedSteps), count(plan.qualityStep)};
    }
    const std::size_t all = stepCount(scenario, dt), timed = std::max<std::size_t>(1, all / 3);
    return {all - timed, timed, all};
}

std::vector<ThreadedSpec> threadedSpecs(const EngineSpec& spec, const std::string& preset,
                                        const std::vector<int>& threads, const EngineDescription& engine) {
    EngineSpec named = spec;
    if (!named.options.contains("preset")) named.options["preset"] = preset;
    std::vector<ThreadedSpec> specs;
    if (const auto own = named.options.find(kThreads); own != named.options.end()) {
        const int count = std::max(1, std::atoi(own->second.c_str()));
        specs.push_back({named.text(), named.text(), count});
        return specs;
    }
    if (!hasThreads(engine)) return {{named.text(), named.text(), 1}};
    for (const int count : threads) {
        EngineSpec given = named;
        given.options[kThreads] = std::to_string(count);
        specs.push_back({named.text(), given.text(), count});
    }
    return specs;
}

std::vector<BenchWork> planScenes(const SceneRequest& request,
                                  const std::vector<EngineDescription>& engines) {
    std::vector<BenchWork> work;
    for (const SceneRequest::Scene& scene : request.scenes) {
        const double dt = request.dt > 0.0 ? request.dt : scene.scenario.timeSteps.front();
        for (const EngineSpec& requested : request.specs) {
            const auto engine = std::find_if(engines.begin(), engines.end(),
                                             [&](const auto& d) { return d.info.name == requested.engine; });
            if (engine == engines.end() || !couldRun(*engine, scene.scenario)) continue;
            EngineSpec spec = withScenarioSettings(requested, scene.text);
            spec.options.emplace("preset", request.preset);
            if (engine->problem.empty()) checkSettings(spec, *engine);
            for (const auto& threaded : threadedSpecs(spec, request.preset, request.threads, *engine)) {
                PlannedBench planned;
                planned.part = kScenePart;
                // Times of another clock are a group of their own: no ratio joins them with the others.
                const std::string& clock = engine->info.clock;
                planned.name = scene.scenario.name + (clock.empty() ? "" : " (" + clock + ")");
                planned.engine = threaded.name;
                planned.threads = threaded.threads;
                planned.size = movingBodies(scene.scenario);
                planned.sizeUnit = "bodies";
                planned.operation = "step";
                planned.timeLimit = scene.scenario.timeLimit;
                planned.parameters =
                    nlohmann::json{
                        {"spec", threaded.given}, {"dt", numberToJson(dt)}, {"scene", identityOf(scene.text)}}
                        .dump();
                planned.command = scenario::programName() + " bench " + scene.arguments + " --engines " +
                                  shellWord(threaded.name) + " --threads " + std::to_string(threaded.threads);
                work.push_back({std::move(planned), scene.text, scene.scenario});
            }
        }
    }
    return work;
}

}  // namespace rigor::validation
