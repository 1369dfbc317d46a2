// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Time of the solvers on the rows of one step of a pyramid (Google Benchmark): ten iterations of those that
// iterate, whole solutions by the direct ones, without making the rows and without moving bodies; and of the
// joint system, factors and solution apart. Putting impulses and velocities back between two runs is not
// timed.
#include <benchmark/benchmark.h>
#include <algorithm>

#include "engine/core/benchmarks/register.hpp"
#include "engine/pipeline/benchmarks/scenes.hpp"
#include "engine/solvers/benchmarks/joint_problem.hpp"
#include "engine/solvers/joints/joint_system.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {
namespace {

constexpr int kIterations = 10;

template <class S>
void solve(benchmark::State& state, const AlgorithmEntry<SolverFactory<S>>& entry, int base) {
    auto scene = benchmark_scene::pyramid<S>(base);
    const auto frozen = benchmark_scene::freeze<S>(scene, 30);
    auto rows = frozen.rows;
    auto velocities = frozen.velocities;
    const auto solver = entry.make();
    test::QuietMonitor<S> monitor;
    const auto friction = findAlgorithm(frictionTable<S>(), "friction", std::string("cone")).make;
    for (auto _ : state) {
        solver->solve({rows, velocities, friction, monitor, kIterations,
                       static_cast<typename S::Real>(benchmark_scene::kStep), false,
                       typename S::Real(1e-10)});
        state.PauseTiming();
        rows.rows = frozen.rows.rows;
        velocities = frozen.velocities;
        state.ResumeTiming();
    }
    using benchmark::Counter;
    state.counters["rows"] = static_cast<double>(rows.rows.size());
    state.counters["s/row/iteration"] = Counter(static_cast<double>(rows.rows.size()) * monitor.iterations,
                                                Counter::kIsRate | Counter::kInvert);
}

template <class S>
void joints(benchmark::State& state, int links, bool net, bool factors) {
    const auto problem = benchmark_scene::jointProblem<S>(links, net);
    std::vector<typename JointSystem<S>::Item> items;
    for (const Block<S>& block : problem.rows.blocks)
        items.push_back({&block, problem.rows.rows.data() + block.first});
    JointSystem<S> system;
    if (!system.factor(items)) return state.SkipWithError("nearly dense");
    for (auto _ : state) {
        if (factors) {
            benchmark::DoNotOptimize(system.factor(items));
            continue;
        }
        for (std::size_t i = 0; i < items.size(); ++i)
            std::fill_n(system.at(i), items[i].block->rows, typename S::Real(1));
        system.solve();
        benchmark::DoNotOptimize(system.at(0));
    }
    state.counters["joints"] = static_cast<double>(items.size());
}

template <class S>
void registerAll(const std::string& space) {
    const auto add = [&](const std::string& name, auto run) {
        benchmark::RegisterBenchmark((space + "/" + name).c_str(), run)->Unit(benchmark::kMicrosecond);
    };
    for (const auto& entry : solverTable<S>()) {
        if (entry.make()->style().positions) continue;  // no solver of rows
        const int base = solverTraits(entry.name).stops == StopRule::Residual ? (S::dim == 2 ? 4 : 2)
                                                                              : (S::dim == 2 ? 30 : 8);
        add(std::string(entry.name) + "/pyramid_" + std::to_string(base),
            [=](benchmark::State& state) { solve<S>(state, entry, base); });
    }
    for (const bool net : {false, true})
        for (const bool factors : {true, false})
            add(std::string("joint_system/") + (factors ? "factor/" : "solve/") +
                    (net ? "net_100" : "chain_100"),
                [=](benchmark::State& state) { joints<S>(state, 100, net, factors); });
}

}  // namespace

void registerBenchmarks() {
    registerAll<Space3f>("3f");
    registerAll<Space3d>("3d");
    registerAll<Space2f>("2f");
    registerAll<Space2d>("2d");
}

}  // namespace rigor::engine
