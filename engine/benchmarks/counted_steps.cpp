// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <memory>

#include "engine/benchmarks/counted_work.hpp"
#include "engine/pipeline/benchmarks/scenes.hpp"
#include "engine/solvers/benchmarks/joint_problem.hpp"
#include "engine/solvers/joints/joint_system.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine::counted {
namespace {

using namespace benchmark_scene;

/// Ten iterations, from the same impulses and velocities, on the rows of a pyramid's step.
template <class S>
std::function<void()> solverWork(const AlgorithmEntry<SolverFactory<S>>& entry, int base) {
    struct Problem {
        FrozenRows<S> start, now;
        std::unique_ptr<Solver<S>> solver;
        test::QuietMonitor<S> monitor;
    };
    auto scene = pyramid<S>(base);
    const auto problem = std::make_shared<Problem>();
    problem->start = freeze<S>(scene, 5);
    problem->solver = entry.make();
    const auto friction = findAlgorithm(frictionTable<S>(), "friction", std::string("cone")).make;
    const auto solve = [problem, friction] {
        problem->now = problem->start;
        problem->solver->solve({problem->now.rows, problem->now.velocities, friction, problem->monitor, 10,
                                static_cast<typename S::Real>(kStep), false, typename S::Real(1e-6)});
    };
    solve();
    return solve;
}

template <class S>
std::function<void()> jointWork(bool net) {
    struct Problem {
        test::RowProblem<S> rows;
        std::vector<typename JointSystem<S>::Item> items;
        JointSystem<S> system;
    };
    const auto problem = std::make_shared<Problem>();
    problem->rows = jointProblem<S>(49, net);
    for (const Block<S>& block : problem->rows.rows.blocks)
        problem->items.push_back({&block, problem->rows.rows.rows.data() + block.first});
    const auto work = [problem] {
        problem->system.factor(problem->items);
        for (std::size_t i = 0; i < problem->items.size(); ++i)
            std::fill_n(problem->system.at(i), problem->items[i].block->rows, typename S::Real(1));
        problem->system.solve();
    };
    work();
    return work;
}

template <class S>
void addSolversOf(const std::string& space, std::vector<Work>& all) {
    for (const auto& entry : solverTable<S>()) {
        if (entry.make()->style().positions) continue;
        const std::string name = entry.name;
        const bool toTheEnd = solverTraits(name).stops == StopRule::Residual;
        const int base = toTheEnd ? 2 : (S::dim == 2 ? 8 : 3);
        all.push_back({"solver/" + name + "/" + space, [entry, base] { return solverWork<S>(entry, base); }});
    }
    for (const bool net : {false, true})
        all.push_back({std::string("joint_system/") + (net ? "net/" : "chain/") + space,
                       [net] { return jointWork<S>(net); }});
}

/// Three steps, after ten others.
template <class S>
std::function<void()> stepWork(SceneBuilder<S> (*make)(int, const WorldDef<S>&), int size,
                               const WorldDef<S>& def) {
    const auto scene = std::make_shared<SceneBuilder<S>>(make(size, def));
    const auto steps = [scene](int count) {
        for (int i = 0; i < count; ++i) scene->world.step(static_cast<typename S::Real>(kStep));
    };
    steps(10);
    return [steps] { steps(3); };
}

template <class S>
void addStepsOf(const std::string& space, const std::string& solver, std::vector<Work>& all) {
    WorldDef<S> def = onEarth<S>();
    if (!solver.empty()) def.solver = solver;
    const std::string what = solver.empty() ? "default" : solver;
    const auto add = [&](const char* name, auto make, int size) {
        all.push_back({"step/" + what + "/" + name + "/" + space,
                       [make, size, def] { return stepWork<S>(make, size, def); }});
    };
    add("pyramid", pyramid<S>, S::dim == 2 ? 8 : 4);
    add("pile", pile<S>, 40);
    add("chain", chain<S>, 20);
}

}  // namespace

void addSolvers(std::vector<Work>& all) {
    addSolversOf<Space3f>("3f", all);
    addSolversOf<Space3d>("3d", all);
    addSolversOf<Space2f>("2f", all);
}

void addSteps(std::vector<Work>& all) {
    for (const char* solver : {"", "tgs_soft"}) {
        addStepsOf<Space3f>("3f", solver, all);
        addStepsOf<Space3d>("3d", solver, all);
        addStepsOf<Space2f>("2f", solver, all);
    }
}

}  // namespace rigor::engine::counted
