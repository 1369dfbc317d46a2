// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Time per pair of every narrow phase of the table, by pair kind and precision, and of the closest points
// (Google Benchmark; pairs in shape_pairs.hpp). `first`: nothing is remembered of the pair, as at its first
// contact; `again`: with the memory of the same pair, as in the steps after it.
#include <benchmark/benchmark.h>

#include "engine/core/benchmarks/register.hpp"
#include "engine/narrowphase/benchmarks/shape_pairs.hpp"
#include "engine/narrowphase/narrowphases.hpp"

namespace rigor::engine {
namespace {

using benchmark_scene::PairKind;
using benchmark_scene::ShapePair;

constexpr std::size_t kPairs = 1000;

void report(benchmark::State& state, double contacts) {
    using benchmark::Counter;
    const auto pairs = static_cast<double>(state.iterations()) * static_cast<double>(kPairs);
    state.counters["pairs/s"] = Counter(pairs, Counter::kIsRate);
    state.counters["s/pair"] = Counter(pairs, Counter::kIsRate | Counter::kInvert);
    state.counters["points"] = contacts / pairs;
}

template <class S>
void collide(benchmark::State& state, const char* name, const PairKind& kind, bool remembers) {
    const auto pairs = benchmark_scene::shapePairs<S>(kind, kPairs);
    const CollideFunction<S> function = findNarrowPhase<S>(name);
    std::vector<Manifold<S>> manifolds(pairs.size());
    double contacts = 0;
    for (auto _ : state)
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            if (!remembers) manifolds[i].memory = {};
            const ShapePair<S>& p = pairs[i];
            function(p.a, p.Xa, p.b, p.Xb, typename S::Real(1e-3), manifolds[i]);
            contacts += manifolds[i].count;
        }
    report(state, contacts);
}

template <class S>
void closest(benchmark::State& state, const PairKind& kind) {
    const auto pairs = benchmark_scene::shapePairs<S>(kind, kPairs);
    double inside = 0;
    for (auto _ : state)
        for (const ShapePair<S>& p : pairs) inside += closestPoints<S>(p.a, p.Xa, p.b, p.Xb).distance < 0;
    report(state, inside);
}

template <class S>
void registerAll(const std::string& space) {
    for (const PairKind& kind : benchmark_scene::pairKinds(S::dim)) {
        const auto add = [&](const std::string& what, auto run) {
            benchmark::RegisterBenchmark((space + "/" + what + "/" + kind.name()).c_str(), run)
                ->Unit(benchmark::kMicrosecond);
        };
        for (const NarrowPhaseEntry& entry : narrowPhases())
            for (const bool again : {false, true})
                add(std::string(entry.name) + (again ? "/again" : "/first"),
                    [=](benchmark::State& state) { collide<S>(state, entry.name, kind, again); });
        add("closest_points", [=](benchmark::State& state) { closest<S>(state, kind); });
    }
}

}  // namespace

void registerBenchmarks() {
    registerAll<Space3f>("3f");
    registerAll<Space3d>("3d");
    registerAll<Space2f>("2f");
    registerAll<Space2d>("2d");
}

}  // namespace rigor::engine
