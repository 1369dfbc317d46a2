// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A whole scene: some steps to warm up, then steps that are timed one by one, then on to the step at which
// its quality is read. Forces, reading of states and everything else of the harness is outside of the times.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "adapters/interface/input_check.hpp"
#include "adapters/interface/registry.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/bench/exchange.hpp"
#include "validation/bench/process_memory.hpp"
#include "validation/bench/quality.hpp"
#include "validation/bench/scenes.hpp"
#include "validation/bench/stopwatch.hpp"
#include "validation/comparison/statistics.hpp"
#include "validation/hash.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/stepper.hpp"

namespace rigor::validation {
namespace {

using adapter::BodyState;
using results::BenchRepetition;

/// Steps between two readings in a timed round. Reading touches what the next step wants in its caches: the
/// median step is none of those. The look reads after every step.
constexpr std::size_t kReadEvery = 10;

std::string hashOf(std::span<const BodyState> states) {
    Fnv1a hash;
    for (const BodyState& s : states)
        for (const double v : {s.position.x, s.position.y, s.position.z, s.orientation.w, s.orientation.x,
                               s.orientation.y, s.orientation.z, s.velocity.x, s.velocity.y, s.velocity.z,
                               s.angularVelocity.x, s.angularVelocity.y, s.angularVelocity.z})
            hash.number(v);
    return hash.hex();
}

/// What the engine's own counters and the contacts say of the timed steps.
class WorkMeter {
  public:
    void count(const adapter::StepCounters& c) {
        add("broad_phase_pairs", c.pairs), add("box_tests", c.pairTests);
        add("solver_iterations", c.solverIterations), add("islands", c.islands);
        for (const auto& [phase, seconds] : c.phaseSeconds) phases_[phase].push_back(seconds);
    }
    void look(const std::vector<adapter::ContactPoint>& contacts) {
        sums_["contacts"].add(static_cast<double>(contacts.size()));
        sums_["touching_pairs"].add(touchingPairs(contacts));
    }
    void write(BenchRepetition& done) const {
        for (const auto& [name, mean] : sums_) done.counts.push_back({name, mean.sum / mean.samples});
        for (const auto& [name, seconds] : phases_) done.phases.push_back({name, median(seconds)});
    }

  private:
    struct Mean {
        double sum = 0.0, samples = 0.0;
        void add(double value) { sum += value, samples += 1.0; }
    };
    void add(const char* name, std::int64_t value) {
        if (value >= 0) sums_[name].add(static_cast<double>(value));
    }
    std::map<std::string, Mean> sums_;
    std::map<std::string, std::vector<double>> phases_;
};

class SceneCase final : public BenchCase {
  public:
    SceneCase(const PlannedBench& planned, const std::string& text)
        : scenario_(scenario::loadScenarioText(text, planned.name).scenario) {
        const auto parameters = nlohmann::json::parse(planned.parameters);
        dt_ = numberFromJson(parameters.at("dt"));
        spec_ = adapter::parseSpec(parameters.at("spec").get<std::string>());
    }

    BenchRepetition run(int round) override {
        const adapter::LoadedEngine engine = adapter::loadEngine(spec_);
        if (engine->dynamics() == nullptr)
            throw adapter::Unsupported("engine '" + spec_.engine + "' has no dynamics");
        const adapter::Settings settings = adapter::resolveSettings(spec_, *engine);
        adapter::checkScenarioInput(scenario_, dt_);
        adapter::checkSupported(scenario_, engine->capabilities(), spec_.engine);
        forgetPeak();
        const std::int64_t before = residentKiB();
        const auto world = engine->dynamics()->build(scenario_, dt_, settings);
        BenchRepetition done = drive(*world, round == 0 ? 1 : kReadEvery, before);
        return done;
    }

  private:
    BenchRepetition drive(adapter::World& world, std::size_t readEvery, std::int64_t before) const {
        const SceneSteps steps = sceneSteps(scenario_, dt_);
        BenchRepetition done;
        Stepper stepper(scenario_, dt_, world);
        QualityMeter quality(scenario_, stepper.states());
        WorkMeter work;
        Stopwatch watch;
        watch.reserve(steps.timed);
        std::vector<adapter::ContactPoint> contacts;
        const auto step = [&](auto&& take) {
            stepper.begin();
            take();
            stepper.end();
            if (stepper.steps() % readEvery == 0) quality.sample(stepper.states());
        };
        while (stepper.steps() < steps.warmUp) step([&] { world.step(); });
        Allocations counted;
        while (stepper.steps() < steps.warmUp + steps.timed) {
            step([&] { timeStep(world, watch, counted); });
            work.count(world.counters());
            if (stepper.steps() % readEvery != 0 && stepper.steps() != steps.warmUp + steps.timed) continue;
            world.readContacts(contacts);
            work.look(contacts);
        }
        done.peakMemoryKiB = peakResidentKiB();
        done.ownMemoryKiB = std::max<std::int64_t>(0, done.peakMemoryKiB - before);
        while (stepper.steps() < steps.quality) step([&] { world.step(); });
        world.readContacts(contacts);
        quality.finish(stepper.states(), contacts);

        const ClockSamples& times = watch.samples();
        done.wall = median(times.wall), done.cpu = median(times.cpu);
        done.samples = static_cast<std::int64_t>(times.wall.size());
        if (allocationsSoFar()) {
            done.allocations = static_cast<double>(counted.calls) / static_cast<double>(steps.timed);
            done.allocatedBytes = static_cast<double>(counted.bytes) / static_cast<double>(steps.timed);
        }
        work.write(done);
        done.quality = quality.rows();
        done.stateHash = hashOf(stepper.states());
        if (const std::string problem = stepper.nonFinite(); !problem.empty())
            done.outcome = "non_finite", done.reason = problem;
        return done;
    }

    /// One step, its times, and what it asked of the allocator where that is counted.
    static void timeStep(adapter::World& world, Stopwatch& watch, Allocations& counted) {
        const auto before = allocationsSoFar();
        watch.time([&] { world.step(); });
        const auto after = allocationsSoFar();
        if (!before || !after) return;
        counted.calls += after->calls - before->calls;
        counted.bytes += after->bytes - before->bytes;
    }

    scenario::Scenario scenario_;
    double dt_ = 0.0;
    adapter::EngineSpec spec_;
};

}  // namespace

std::unique_ptr<BenchCase> makeSceneCase(const PlannedBench& planned, const std::string& text) {
    return std::make_unique<SceneCase>(planned, text);
}

}  // namespace rigor::validation
