// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A whole scene: some steps to warm up, then steps that are timed one by one, then on to the step at which
// its quality is read. Forces, reading of states and everything else of the harness is outside of the times.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "adapters/interface/prepared_engine.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/bench/exchange.hpp"
#include "validation/bench/meter.hpp"
#include "validation/bench/quality.hpp"
#include "validation/bench/scenes.hpp"
#include "validation/bench/stopwatch.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/stepper.hpp"
#include "validation/statistics/quantile.hpp"

namespace rigor::validation {
namespace {

using results::BenchRepetition;

/// Steps between two readings in a timed round. Reading changes the caches that the next step uses: the
/// median step is none of those. The look reads after every step.
constexpr std::size_t kReadEvery = 10;

/// Work in the timed steps by the engine's own counters and the contacts.
class WorkMeter {
  public:
    void count(const adapter::StepCounters& c) {
        add("broad_phase_pairs", c.pairs);
        add("box_tests", c.pairTests);
        add("narrow_phase_queries", c.narrowPhaseQueries);
        add("solver_iterations", c.solverIterations);
        add("islands", c.islands);
        for (const auto& [phase, seconds] : c.phaseSeconds) phases_[phase].push_back(seconds);
    }
    void look(const adapter::World& world, std::size_t bodies,
              const std::vector<adapter::ContactPoint>& contacts) {
        double asleep = 0.0;
        for (std::size_t i = 0; i < bodies; ++i) asleep += world.isAsleep(i) ? 1.0 : 0.0;
        sums_["asleep"].add(asleep);
        sums_["contacts"].add(contacts.size());
        sums_["touching_pairs"].add(touchingPairs(contacts));
    }
    void write(BenchRepetition& done) const {
        for (const auto& [name, mean] : sums_) done.counts.push_back({name, mean.sum / mean.samples});
        for (const auto& [name, seconds] : phases_) done.phases.push_back({name, median(seconds)});
    }

  private:
    struct Mean {
        double sum = 0.0, samples = 0.0;
        void add(double value) {
            sum += value;
            samples += 1.0;
        }
    };
    void add(const char* name, std::int64_t value) {
        if (value >= 0) sums_[name].add(value);
    }
    std::map<std::string, Mean> sums_;
    std::map<std::string, std::vector<double>> phases_;
};

/// Times a step; where the engine is in another process, by its own clock.
template <class Watch>
void timeStep(Watch& watch, adapter::World& world) {
    watch.time([&] { world.step(); });
    if (const double own = world.counters().stepSeconds; own >= 0.0) watch.correctLast(own);
}

/// CPU time of the longest step [s].
template <class Watch>
double longest(const Watch& watch) {
    const std::vector<double>& times = watch.samples().cpu;
    return times.empty() ? 0.0 : *std::max_element(times.begin(), times.end());
}

class SceneCase final : public TimedWork {
  public:
    SceneCase(const PlannedBench& planned, const std::string& text)
        : scenario_(scenario::loadScenarioText(text, planned.name).scenario) {
        const auto parameters = nlohmann::json::parse(planned.parameters);
        dt_ = numberFromJson(parameters.at("dt"));
        spec_ = adapter::parseSpec(parameters.at("spec").get<std::string>());
    }

    BenchRepetition run(int round) override {
        const adapter::PreparedEngine engine = adapter::prepareEngine(spec_, scenario_, dt_);
        const GrownMemory memory;
        const auto world = engine.build(scenario_, dt_);
        return drive(*world, round == 0 ? 1 : kReadEvery, memory);
    }

  private:
    BenchRepetition drive(adapter::World& world, std::size_t readEvery, const GrownMemory& memory) const {
        const SceneSteps steps = sceneSteps(scenario_, dt_);
        BenchRepetition done;
        Stepper stepper(scenario_, dt_, world);
        QualityMeter quality(scenario_, stepper.states());
        WorkMeter work;
        CountingStopwatch watch(steps.timed);
        std::vector<adapter::ContactPoint> contacts;
        const auto step = [&](auto&& take) {
            stepper.begin();
            take();
            stepper.end();
            if (stepper.steps() % readEvery == 0) quality.sample(stepper.states());
        };
        Stopwatch warmUp;
        warmUp.reserve(steps.warmUp);
        while (stepper.steps() < steps.warmUp) step([&] { timeStep(warmUp, world); });
        while (stepper.steps() < steps.warmUp + steps.timed) {
            step([&] { timeStep(watch, world); });
            work.count(world.counters());
            if (stepper.steps() % readEvery != 0 && stepper.steps() != steps.warmUp + steps.timed) continue;
            world.readContacts(contacts);
            work.look(world, scenario_.bodies.size(), contacts);
        }
        memory.write(done);
        while (stepper.steps() < steps.quality) step([&] { world.step(); });
        world.readContacts(contacts);
        quality.finish(stepper.states(), contacts);

        const ClockSamples& times = watch.samples();
        done.wall = median(times.wall);
        done.cpu = median(times.cpu);
        done.samples = times.wall.size();
        // The allocations of an engine in another process are not counted here.
        if (world.counters().stepSeconds < 0.0) watch.writeAllocations(done);
        work.write(done);
        done.counts.push_back({"longest_ms", 1e3 * std::max(longest(warmUp), longest(watch))});
        done.quality = quality.rows();
        done.stateHash = stepper.stateHash();
        if (const std::string problem = stepper.nonFinite(); !problem.empty()) {
            done.outcome = "non_finite";
            done.reason = problem;
        }
        return done;
    }

    scenario::Scenario scenario_;
    double dt_ = 0.0;
    adapter::EngineSpec spec_;
};

}  // namespace

std::unique_ptr<TimedWork> makeSceneCase(const PlannedBench& planned, const std::string& text) {
    return std::make_unique<SceneCase>(planned, text);
}

}  // namespace rigor::validation
