// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Many worlds of one small scene, as sweeps of parameters, fits and learning have them. The time is that of one body in
// one step: its inverse is the throughput in body-steps a second. Engines that step worlds side by side
// (adapters/interface/batch.hpp) do so on the requested threads; the worlds of the others are stepped one after the
// other by one. The worlds are built alike and must end as a world does that is stepped alone, to the bit.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "adapters/interface/batch.hpp"
#include "adapters/interface/prepared_engine.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/bench/parts/engines.hpp"
#include "validation/statistics/quantile.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;

struct BatchScene {
    const char* name;
    const char* scenario;                ///< scenario of the library
    std::vector<std::string> overrides;  ///< overrides of the scenario
};
const std::vector<BatchScene>& scenes() {
    static const std::vector<BatchScene> all{
        {"pendulum", "physical_pendulum", {}},
        {"stack of 10 boxes", "box_stack", {}},
        {"ragdoll", "bench_ragdolls", {"size=1", "generators.0.repeat.counts=[1,1,1]"}},
        {"100 balls", "bench_sphere_pile", {"size=100"}},
    };
    return all;
}

constexpr int kFirstSteps = 60, kStepsAtOnce = 10;
constexpr std::size_t kLeastRounds = 5, kMost = 30;
/// Separator of a scene's name and the clock of its times, where that is not this program's.
constexpr const char* kClockBegins = " (";
/// Time of batches of steps after which no further one is begun [s].
constexpr double kLongestRounds = 0.5;

class BatchBench final : public TimedWork {
  public:
    explicit BatchBench(const PlannedBench& planned)
        : spec_(adapter::parseSpec(planned.engine)),
          worlds_(static_cast<std::size_t>(std::llround(planned.size))),
          threads_(planned.threads) {
        for (const BatchScene& scene : scenes())
            if (scene.name == planned.name.substr(0, planned.name.find(kClockBegins)))
                scenario_ =
                    scenario::loadScenario(scenario::findScenario(scene.scenario), scene.overrides).scenario;
        dt_ = scenario_.timeSteps.front();
    }

    results::BenchRepetition run(int) override {
        const adapter::PreparedEngine engine = adapter::prepareEngine(spec_, scenario_, dt_);
        const GrownMemory memory;
        const auto batch = makeBatch(engine);
        batch->step(kFirstSteps);
        int steps = kFirstSteps;
        CountingStopwatch watch(kMost);
        const double bodySteps = static_cast<double>(worlds_ * moving() * kStepsAtOnce);
        double spent = 0.0;
        for (std::size_t k = 0; k < kMost && (k < kLeastRounds || spent < kLongestRounds);
             ++k, steps += kStepsAtOnce) {
            watch.time([&] { batch->step(kStepsAtOnce); }, bodySteps);
            if (const double own = batch->ownSeconds(); own >= 0.0) watch.correctLast(own / bodySteps);
            spent += watch.samples().cpu.back() * bodySteps;
        }
        results::BenchRepetition done;
        memory.write(done);
        fillTimes(watch, false, done);
        done.counts = {{"worlds", static_cast<double>(worlds_)},
                       {"moving_bodies", static_cast<double>(moving())},
                       {"body_steps_per_s", 1.0 / done.wall}};
        done.quality = {judged("differs_from_alone", "m", distanceFromAlone(engine, *batch, steps), 0.0)};
        return done;
    }

  private:
    std::unique_ptr<adapter::BatchWorlds> makeBatch(const adapter::PreparedEngine& engine) const {
        if (const auto* batching = dynamic_cast<const adapter::BatchingEngine*>(engine.engine->dynamics()))
            return batching->buildBatch(scenario_, dt_, engine.settings, worlds_, threads_);
        if (threads_ > 1) throw adapter::Unsupported(spec_.engine + " steps its worlds one after the other");
        std::vector<std::unique_ptr<adapter::World>> worlds;
        for (std::size_t i = 0; i < worlds_; ++i) worlds.push_back(engine.build(scenario_, dt_));
        return std::make_unique<adapter::LoopedWorlds>(std::move(worlds));
    }
    std::size_t moving() const {
        return std::count_if(
            scenario_.bodies.begin(), scenario_.bodies.end(),
            [](const scenario::Body& body) { return body.type == scenario::BodyType::Dynamic; });
    }
    /// Largest distance between a body of the first or last world and the same body of a world stepped alone [m].
    double distanceFromAlone(const adapter::PreparedEngine& engine, const adapter::BatchWorlds& batch,
                             int steps) const {
        const auto alone = engine.build(scenario_, dt_);
        for (int k = 0; k < steps; ++k) alone->step();
        std::vector<adapter::BodyState> expected(scenario_.bodies.size()), states(expected);
        alone->readStates(expected);
        double worst = 0.0;
        for (const std::size_t world : {std::size_t(0), batch.size() - 1}) {
            batch.readStates(world, states);
            for (std::size_t i = 0; i < states.size(); ++i) {
                const double distance = scenario::norm(states[i].position - expected[i].position);
                if (!(distance <= worst)) worst = distance;
            }
        }
        return worst;
    }

    adapter::EngineSpec spec_;
    scenario::Scenario scenario_;
    double dt_ = 0.0;
    std::size_t worlds_;
    int threads_;
};

}  // namespace

std::vector<PlannedBench> planBatches(const BenchRequest& request) {
    std::vector<PlannedBench> all;
    std::vector<double> sizes = request.sizes;
    if (sizes.empty())
        sizes = request.full ? std::vector<double>{1, 10, 100, 1000} : std::vector<double>{1, 100};
    for (const BatchScene& scene : scenes()) {
        if (!isWanted(request, scene.name)) continue;
        for (const double size : sizes)
            for (const PartEngine& engine : partEngines(request)) {
                if (!engine.description.capabilities.dynamics) continue;
                for (const int threads : request.threads) {
                    PlannedBench planned;
                    planned.part = "batch";
                    // Times of another clock are a group of their own: no ratio joins them with the others.
                    const std::string& clock = engine.description.info.clock;
                    planned.name = scene.name + (clock.empty() ? "" : kClockBegins + clock + ")");
                    planned.engine = engine.spec.text();
                    planned.sizeUnit = "worlds";
                    planned.size = size;
                    planned.threads = threads;
                    planned.operation = "body-step";
                    planned.command = partCommand(planned, request);
                    if (threads != 1) planned.command += " --threads " + std::to_string(threads);
                    all.push_back(std::move(planned));
                }
            }
    }
    return all;
}

std::unique_ptr<TimedWork> makeBatch(const PlannedBench& planned) {
    return std::make_unique<BatchBench>(planned);
}

}  // namespace rigor::validation
