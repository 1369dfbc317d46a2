// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Time of a step of free flight (Google Benchmark): inertia, kick, move and finish of 1000 tumbling bodies,
// by integrator, rotation scheme and orientation update, the others being the world's defaults.
#include <benchmark/benchmark.h>

#include "engine/core/benchmarks/random.hpp"
#include "engine/core/benchmarks/register.hpp"
#include "engine/integrators/motion.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {
namespace {

constexpr std::size_t kBodies = 1000;

template <class S>
typename S::Ang random(benchmark_scene::Random& numbers, double size) {
    using R = typename S::Real;
    const auto one = [&] { return static_cast<R>(numbers.between(-size, size)); };
    if constexpr (S::dim == 2)
        return one();
    else
        return typename S::Ang(one(), one(), one());
}

template <class S>
BodyArrays<S> tumbling() {
    using R = typename S::Real;
    benchmark_scene::Random numbers(3);
    BodyArrays<S> bodies;
    for (std::size_t i = 0; i < kBodies; ++i) {
        BodyConstants<S> constants;
        constants.type = BodyType::Dynamic;
        constants.mass = 1;
        typename S::Inertia inverse;
        if constexpr (S::dim == 2) {
            constants.inertia = R(0.2);
            inverse = R(5);
        } else {
            constants.inertia = typename S::Vec(R(0.1), R(0.2), R(0.25)).asDiagonal();
            inverse = typename S::Vec(R(10), R(5), R(4)).asDiagonal();
        }
        bodies.pose.push_back({});
        bodies.velocity.push_back({S::Vec::Zero(), random<S>(numbers, 5)});
        bodies.wrench.push_back({});
        bodies.asleep.push_back(0);
        bodies.stillTime.push_back(0);
        bodies.constants.push_back(constants);
        bodies.invMass.push_back(1);
        bodies.invInertiaLocal.push_back(inverse);
        bodies.invInertia.push_back(inverse);
        bodies.id.push_back({});
    }
    return bodies;
}

template <class S>
void fly(benchmark::State& state, const WorldDef<S>& def) {
    BodyArrays<S> bodies = tumbling<S>();
    Motion<S> motion(
        findAlgorithm(integratorTable<S>(), "integrator", def.integrator).make(),
        findAlgorithm(rotationTable<S>(), "rotation", def.rotation).make(),
        findAlgorithm(orientationUpdateTable<S>(), "orientation_update", def.orientationUpdate).make());
    Load<S> load;
    load.gravity[1] = typename S::Real(-9.81);
    // Short steps: explicit schemes gain energy, and the numbers must not run away.
    const auto h = typename S::Real(1e-5);
    for (auto _ : state) {
        Motion<S>::setInertia(bodies);
        motion.kick(bodies, load, h);
        motion.move(bodies, h);
        motion.finish(bodies, h);
    }
    const auto done = static_cast<double>(state.iterations()) * static_cast<double>(kBodies);
    using benchmark::Counter;
    state.counters["s/body"] = Counter(done, Counter::kIsRate | Counter::kInvert);
}

template <class S>
void registerAll(const std::string& space) {
    const auto add = [&](const std::string& name, const WorldDef<S>& def) {
        benchmark::RegisterBenchmark((space + "/" + name).c_str(), [=](benchmark::State& state) {
            fly<S>(state, def);
        })->Unit(benchmark::kMicrosecond);
    };
    for (const auto& entry : integratorTable<S>()) {
        WorldDef<S> def;
        def.integrator = entry.name;
        add(std::string("integrator/") + entry.name, def);
    }
    for (const auto& entry : rotationTable<S>()) {
        WorldDef<S> def;
        def.rotation = entry.name;
        add(std::string("rotation/") + entry.name, def);
    }
    for (const auto& entry : orientationUpdateTable<S>()) {
        WorldDef<S> def;
        def.orientationUpdate = entry.name;
        add(std::string("orientation_update/") + entry.name, def);
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
