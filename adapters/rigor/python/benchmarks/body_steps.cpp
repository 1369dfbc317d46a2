// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Steps worlds of a scenario without Python, for body_steps.py to compare with:
//     python_body_steps SCENARIO SPEC DT STEPS [WORLDS THREADS]
// Makes one world, or a batch of copies of it, and then answers lines of the standard input. "step" makes STEPS steps and
// "each" the same, with a look at the height of the last body after each; both answer with processor time and time of the
// clock [s]. "hash" answers with the state hash of the (first) world. The exit code is 2 for arguments that are not
// understood.
#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <string>

#include "adapters/rigor/native_world.hpp"
#include "adapters/rigor/python/spec_settings.hpp"
#include "engine/embedding/world_batch.hpp"
#include "scenarios/loader/loader.hpp"

namespace rigor::adapter {
namespace {

struct Request {
    std::string scenario, spec;
    double dt = 0;
    int steps = 0, worlds = 0, threads = 1;  ///< no worlds: one, without a batch
};

double processorTime() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class Work>
void answerTimes(const Work& work) {
    const double processor = processorTime();
    const auto clock = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - clock;
    std::printf("%.9g %.9g\n", processorTime() - processor, wall.count());
}

template <class Work, class Look, class Hash>
void answer(const Work& work, const Look& look, const Hash& hash) {
    for (std::string line; std::getline(std::cin, line);) {
        if (line == "step")
            answerTimes(work);
        else if (line == "each")
            answerTimes(look);
        else
            std::printf("%" PRIu64 "\n", hash());
        std::fflush(stdout);
    }
}

template <class S>
void serveWorld(NativeWorld<S>& native, const Request& request) {
    engine::World<S>& world = native.world;
    const auto h = static_cast<typename S::Real>(request.dt);
    double lowest = 0;
    answer(
        [&] {
            for (int k = 0; k < request.steps; ++k) world.step(h);
        },
        [&] {
            for (int k = 0; k < request.steps; ++k) {
                world.step(h);
                lowest = std::min(lowest, static_cast<double>(world.pose(native.bodies.back()).p[1]));
            }
        },
        [&] { return world.stateHash(); });
    std::fprintf(stderr, "lowest place %g m\n", lowest);
}

template <class S>
void serve(const Scenario& scenario, const Settings& settings, const Request& request) {
    if (!scenario.events.empty()) throw BadInput("a scenario with scheduled impulses is not stepped here");
    NativeWorld<S> native = makeNativeWorld<S>(scenario, request.dt, settings);
    if (request.worlds == 0) return serveWorld<S>(native, request);
    engine::WorldBatch<S> batch(native.world, static_cast<std::size_t>(request.worlds), {request.threads});
    const auto work = [&] { batch.step(static_cast<typename S::Real>(request.dt), request.steps); };
    answer(work, work, [&] { return batch.world(0).stateHash(); });
}

int run(int argc, char** argv) {
    if (argc != 5 && argc != 7) throw BadInput("expected SCENARIO SPEC DT STEPS [WORLDS THREADS]");
    Request request{argv[1], argv[2], std::stod(argv[3]), std::stoi(argv[4])};
    if (argc == 7) {
        request.worlds = std::stoi(argv[5]);
        request.threads = std::stoi(argv[6]);
    }
    const scenario::LoadedScenario loaded = scenario::loadScenario(scenario::findScenario(request.scenario));
    const Settings settings = settingsOf(request.spec, loaded.text);
    const bool single = textSetting(settings, "precision") == "f32", flat = loaded.scenario.dimension == 2;
    if (flat && single) serve<engine::Space2f>(loaded.scenario, settings, request);
    if (flat && !single) serve<engine::Space2d>(loaded.scenario, settings, request);
    if (!flat && single) serve<engine::Space3f>(loaded.scenario, settings, request);
    if (!flat && !single) serve<engine::Space3d>(loaded.scenario, settings, request);
    return 0;
}

}  // namespace
}  // namespace rigor::adapter

int main(int argc, char** argv) {
    try {
        return rigor::adapter::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "python_body_steps: %s\n", error.what());
        return 2;
    }
}
