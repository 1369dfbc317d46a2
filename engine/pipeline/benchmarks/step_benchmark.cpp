// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Time of a whole step (Google Benchmark; scenes in scenes.hpp), after it has settled: with each solver of
// the table in single precision, and with the default one in both. `rigor bench` compares engines; this is to
// see what a change of one part does to the whole.
#include <benchmark/benchmark.h>

#include "engine/core/benchmarks/register.hpp"
#include "engine/pipeline/benchmarks/scenes.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {
namespace {

using benchmark_scene::SceneBuilder;

template <class S>
void step(benchmark::State& state, SceneBuilder<S> scene) {
    const auto h = static_cast<typename S::Real>(benchmark_scene::kStep);
    for (int i = 0; i < 120; ++i) scene.world.step(h);
    double contacts = 0;
    for (auto _ : state) contacts += static_cast<double>(scene.world.step(h).contacts);
    using benchmark::Counter;
    state.counters["contacts"] = Counter(contacts, Counter::kAvgIterations);
    state.counters["bodies"] = static_cast<double>(scene.world.bodyCount());
}

template <class S>
void registerWith(const std::string& space, const WorldDef<S>& def) {
    const auto add = [&](const std::string& scene, auto make) {
        benchmark::RegisterBenchmark((space + "/" + def.solver + "/" + scene).c_str(),
                                     [=](benchmark::State& state) { step<S>(state, make(def)); })
            ->Unit(benchmark::kMicrosecond);
    };
    add("pyramid_8", [](const WorldDef<S>& d) { return benchmark_scene::pyramid<S>(8, d); });
    add("pile_200", [](const WorldDef<S>& d) { return benchmark_scene::pile<S>(200, d); });
    add("chain_50", [](const WorldDef<S>& d) { return benchmark_scene::chain<S>(50, d); });
}

template <class S>
void registerAll(const std::string& space, bool everySolver) {
    const WorldDef<S> standard = benchmark_scene::onEarth<S>();
    for (const auto& entry : solverTable<S>()) {
        const std::string name = entry.name;
        // A solver that solves hundreds of contacts to a residual takes seconds per step.
        if (solverTraits(name).stops == StopRule::Residual) continue;
        if (!everySolver && name != standard.solver) continue;
        WorldDef<S> def = standard;
        def.solver = name;
        registerWith<S>(space, def);
    }
}

}  // namespace

void registerBenchmarks() {
    registerAll<Space3f>("3f", true);
    registerAll<Space3d>("3d", false);
    registerAll<Space2f>("2f", true);
    registerAll<Space2d>("2d", false);
}

}  // namespace rigor::engine
