// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Measures how the cost of a step grows with the number of bodies in one world:
//     engine_measure_growth [KEY=VALUE ...]
//         scene=spheres|boxes|boxes_2d  preset=default|fast  precision=f64|f32      each a list with commas
//         bodies=NUMBER,... (1000,10000)
//         fall=STEPS (100)                steps of 1/60 s before the pile is measured
//         settings=KEY=VALUE,...          settings of the world in place of the preset's
// A grid of bodies falls 2 m into a box that it fills. Measured are the first step, steps in free fall and steps of the
// pile: CPU time of this thread, each phase the least of several steps, so that other processes on the machine disturb
// little. Beside each time stands the exponent k of its growth from the number of bodies before, time ~ bodies^k. The
// exit code is 2 for arguments that are not understood.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <limits>
#include <map>
#include <vector>

#include "engine/benchmarks/arguments.hpp"
#include "engine/benchmarks/settings_text.hpp"
#include "engine/core/benchmarks/random.hpp"
#include "engine/embedding/solid_body.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::engine::growth {
namespace {

constexpr double kStep = 1.0 / 60;
constexpr int kMeasured = 6;

struct Case {
    std::string scene, settings;
    bool fast = false;
    int bodies = 0, fall = 0;
};

/// Phases of a step, and at last all that is between them.
using Times = std::array<double, kPhases + 1>;

struct Outcome {
    double first = 0;  ///< [s]
    Times falling{}, pile{};
    double bytes = 0;  ///< resident memory of the world and its scratch, for a body
    std::size_t pairs = 0, queries = 0, contacts = 0;  ///< counts of the last step of the pile
};

double cpuNow() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
double residentBytes() {
    std::ifstream statm("/proc/self/statm");
    double total = 0, resident = 0;
    statm >> total >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

template <class S>
void addStaticBox(World<S>& world, std::array<double, 3> center, std::array<double, 3> half) {
    BodyDef<S> def;
    def.type = BodyType::Static;
    Box<S> box;
    for (int k = 0; k < S::dim; ++k) {
        def.pose.p[k] = static_cast<typename S::Real>(center[static_cast<std::size_t>(k)]);
        box.halfExtents[k] = static_cast<typename S::Real>(half[static_cast<std::size_t>(k)]);
    }
    addSolid<S>(world, {{box}}, def);
}

/// A grid as wide as high, a twentieth of a body apart, in a box with walls.
template <class S>
void fill(World<S>& world, const Case& what) {
    using R = typename S::Real;
    constexpr double kPitch = 1.05, kDrop = 2;
    const int side = static_cast<int>(std::ceil(std::pow(what.bodies, 1.0 / S::dim)));
    const double half = 0.5 * kPitch * side + 0.1, high = 2.0 * side + kDrop;
    addStaticBox<S>(world, {0, -1, 0}, {half + 2, 1, half + 2});
    for (const double sign : {-1.0, 1.0}) {
        addStaticBox<S>(world, {sign * (half + 1), high / 2, 0}, {1, high / 2, half + 2});
        if (S::dim == 3) addStaticBox<S>(world, {0, high / 2, sign * (half + 1)}, {half, high / 2, 1});
    }
    benchmark_scene::Random random(12345);
    for (int i = 0; i < what.bodies; ++i) {
        const int x = i % side, y = S::dim == 2 ? i / side : i / (side * side), z = i / side % side;
        BodyDef<S> def;
        for (int k = 0; k < S::dim; ++k) {
            const double cell = k == 0 ? x : k == 1 ? y : z;
            const double place = k == 1 ? 0.5 + kDrop + kPitch * cell : kPitch * (cell - 0.5 * (side - 1));
            def.pose.p[k] = static_cast<R>(place + (k == 1 ? 0.0 : random.between(-0.02, 0.02)));
        }
        if (what.scene == "spheres")
            addSolid<S>(world, {{Sphere<S>{R(0.5)}}}, def);
        else
            addSolid<S>(world, {{Box<S>{S::Vec::Constant(R(0.5))}}}, def);
    }
}

/// Steps phase by phase and keeps the least time of each.
template <class S>
Times leastTimes(World<S>& world, int steps) {
    Times least;
    least.fill(std::numeric_limits<double>::infinity());
    for (int i = 0; i < steps; ++i) {
        Times times{};
        const double start = cpuNow();
        double phases = 0;
        world.beginStep(static_cast<typename S::Real>(kStep));
        while (world.stepping()) {
            const auto phase = static_cast<std::size_t>(world.nextPhase());
            const double before = cpuNow();
            world.runPhase();
            const double inside = cpuNow() - before;
            times[phase] += inside;
            phases += inside;
        }
        times[kPhases] = cpuNow() - start - phases;
        for (std::size_t k = 0; k < times.size(); ++k) least[k] = std::min(least[k], times[k]);
    }
    return least;
}

double sum(const Times& times) {
    double all = 0;
    for (const double time : times) all += time;
    return all;
}

template <class S>
Outcome run(const Case& what) {
    using R = typename S::Real;
    const double empty = residentBytes();
    WorldDef<S> def;
    def.gravity[1] = R(-9.81);
    if (what.fast) preferSpeed(def);
    applySettings<S>(what.settings, def);
    World<S> world(def);
    fill(world, what);
    Outcome outcome;
    outcome.first = sum(leastTimes(world, 1));
    outcome.falling = leastTimes(world, kMeasured);
    for (int i = 1 + kMeasured; i < what.fall; ++i) world.step(R(kStep));
    outcome.pile = leastTimes(world, kMeasured);
    outcome.pairs = world.lastStep().pairs;
    outcome.queries = world.lastStep().narrowPhaseCalls;
    outcome.contacts = world.lastStep().contacts;
    outcome.bytes = (residentBytes() - empty) / what.bodies;
    return outcome;
}

void print(const char* name, double now, double before, double growth) {
    if (now < 1e-7) return;
    std::printf("    %-14s %10.4f ms", name, 1e3 * now);
    if (before > 1e-7) std::printf("   ^%.2f", std::log(now / before) / std::log(growth));
    std::printf("\n");
}

void printTimes(const char* title, const Times& now, const Times* before, double growth) {
    std::printf("  %s\n", title);
    print("step", sum(now), before ? sum(*before) : 0, growth);
    for (std::size_t k = 0; k < kPhases; ++k)
        print(phaseName(static_cast<Phase>(k)), now[k], before ? (*before)[k] : 0, growth);
    print("between", now[kPhases], before ? before->back() : 0, growth);
}

void measure(const Arguments& arguments) {
    for (const std::string& scene : split(arguments.at("scene")))
        for (const std::string& preset : split(arguments.at("preset")))
            for (const std::string& precision : split(arguments.at("precision"))) {
                Outcome before;
                int fewer = 0;
                for (const std::string& bodies : split(arguments.at("bodies"))) {
                    const bool single = choose<bool>(precision, {"f64", "f32"});
                    choose<int>(scene, {"spheres", "boxes", "boxes_2d"});
                    const Case what{scene, arguments.at("settings"),
                                    choose<bool>(preset, {"default", "fast"}), std::stoi(bodies),
                                    std::stoi(arguments.at("fall"))};
                    const Outcome outcome = scene == "boxes_2d"
                                                ? (single ? run<Space2f>(what) : run<Space2d>(what))
                                                : (single ? run<Space3f>(what) : run<Space3d>(what));
                    const double growth = fewer > 0 ? double(what.bodies) / fewer : 0;
                    std::printf("%s preset=%s precision=%s bodies=%d: %.0f bytes a body\n", scene.c_str(),
                                preset.c_str(), precision.c_str(), what.bodies, outcome.bytes);
                    std::printf("  in the pile: %zu pairs, %zu narrow-phase queries, %zu contacts\n",
                                outcome.pairs, outcome.queries, outcome.contacts);
                    print("first step", outcome.first, before.first, growth);
                    printTimes("falling", outcome.falling, fewer > 0 ? &before.falling : nullptr, growth);
                    printTimes("pile", outcome.pile, fewer > 0 ? &before.pile : nullptr, growth);
                    std::fflush(stdout);
                    before = outcome;
                    fewer = what.bodies;
                }
            }
}

}  // namespace
}  // namespace rigor::engine::growth

int main(int argc, char** argv) {
    using namespace rigor::engine;
    try {
        growth::measure(parseArguments(argc, argv,
                                       {{"scene", "spheres,boxes,boxes_2d"},
                                        {"preset", "default,fast"},
                                        {"precision", "f32"},
                                        {"bodies", "1000,10000"},
                                        {"fall", "100"},
                                        {"settings", ""}}));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
    return 0;
}
