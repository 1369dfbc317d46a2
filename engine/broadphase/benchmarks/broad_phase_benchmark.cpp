// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Time per update of every broad phase of the table (Google Benchmark; scenes in moving_boxes.hpp). Moving
// the boxes is not timed.
#include <benchmark/benchmark.h>

#include "engine/broadphase/benchmarks/moving_boxes.hpp"
#include "engine/core/benchmarks/register.hpp"

namespace rigor::engine {
namespace {

using benchmark_scene::BoxOrder;
using benchmark_scene::MovingBoxes;

template <class S>
void update(benchmark::State& state, const AlgorithmEntry<BroadPhaseFactory<S>>& entry, const char* scene,
            std::size_t count, BoxOrder order) {
    const auto broadPhase = entry.make();
    MovingBoxes<S> world(scene, count, order);
    std::vector<ProxyPair> pairs;
    const auto once = [&] { broadPhase->update(world.boxes, world.movable, pairs); };
    for (int warmUp = 0; warmUp < 5; ++warmUp) {
        once();
        world.advance();
    }
    const std::size_t before = broadPhase->tests();
    double found = 0;
    for (auto _ : state) {
        once();
        state.PauseTiming();
        found += static_cast<double>(pairs.size());
        world.advance();
        state.ResumeTiming();
    }
    using benchmark::Counter;
    state.counters["pairs"] = Counter(found, Counter::kAvgIterations);
    state.counters["tests"] =
        Counter(static_cast<double>(broadPhase->tests() - before), Counter::kAvgIterations);
}

template <class S>
void registerAll(const std::string& space) {
    for (const auto& entry : broadPhaseTable<S>())
        for (const char* scene : {"uniform", "slow", "jump", "sizes"})
            for (const std::size_t count : {std::size_t{1000}, std::size_t{10000}, std::size_t{100000}})
                for (const BoxOrder order : {BoxOrder::Random, BoxOrder::Spatial}) {
                    const bool uniform = std::string(scene) == "uniform";
                    const bool large = count > 10000, spatial = order == BoxOrder::Spatial;
                    // n^2 tests; and one order and size will do for scenes of which the first says less.
                    if ((std::string(entry.name) == "brute_force" && count > 1000) ||
                        (!uniform && (large || spatial)))
                        continue;
                    const std::string name = space + "/" + entry.name + "/" + scene +
                                             (spatial ? "_spatial/" : "/") + std::to_string(count);
                    benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
                        update<S>(state, entry, scene, count, order);
                    })->Unit(benchmark::kMicrosecond);
                }
}

}  // namespace

void registerBenchmarks() {
    registerAll<Space3f>("3f");
    registerAll<Space3d>("3d");
    registerAll<Space2f>("2f");
}

}  // namespace rigor::engine
