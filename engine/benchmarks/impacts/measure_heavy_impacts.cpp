// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Measures the penetration of bodies in heavy impacts (heavy_scene.hpp):
//     engine_measure_heavy_impacts [KEY=VALUE ...]
//         scene=wall|tumbler  preset=default|fast  precision=f64|f32      each a list with commas
//         seeds=FIRST-LAST (0-0)  bodies=NUMBER (500)  speed=METRES_PER_SECOND (wall 15, tumbler 3)
//         duration=SECONDS (3)
//         settings=KEY=VALUE,...          settings of the world in place of the preset's
//         follow=1                        writes the largest penetration after every step
// A line for each case. The exit code is 2 for arguments that are not understood.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include "engine/benchmarks/arguments.hpp"
#include "engine/benchmarks/impacts/heavy_scene.hpp"

namespace rigor::engine::impacts {
namespace {

Arguments parse(int argc, char** argv) {
    return parseArguments(argc, argv,
                          {{"scene", "wall,tumbler"},
                           {"preset", "default,fast"},
                           {"precision", "f32"},
                           {"seeds", "0-0"},
                           {"bodies", "500"},
                           {"speed", ""},
                           {"duration", "3"},
                           {"settings", ""},
                           {"follow", "0"}});
}

void measure(const Arguments& arguments) {
    const std::string& seeds = arguments.at("seeds");
    const std::uint64_t first = std::stoull(seeds), last = std::stoull(seeds.substr(seeds.find('-') + 1));
    for (std::uint64_t seed = first; seed <= last; ++seed)
        for (const std::string& scene : split(arguments.at("scene")))
            for (const std::string& preset : split(arguments.at("preset")))
                for (const std::string& precision : split(arguments.at("precision"))) {
                    Case what;
                    what.seed = seed;
                    what.scene = choose<Scene>(scene, {"wall", "tumbler"});
                    what.fast = choose<bool>(preset, {"default", "fast"});
                    what.single = choose<bool>(precision, {"f64", "f32"});
                    what.bodies = std::stoi(arguments.at("bodies"));
                    what.duration = std::stod(arguments.at("duration"));
                    what.settings = arguments.at("settings");
                    const std::string& speed = arguments.at("speed");
                    what.speed = !speed.empty() ? std::stod(speed) : what.scene == Scene::Wall ? 15 : 3;
                    const Outcome outcome = run(what, arguments.at("follow") == "1");
                    std::printf("%s worst %.4f step %d %s mean %.4f ms %.3f\n", describe(what).c_str(),
                                outcome.worst, outcome.worstStep, outcome.worstPair.c_str(), outcome.mean,
                                1e3 * outcome.secondsPerStep);
                    std::fflush(stdout);
                }
}

}  // namespace
}  // namespace rigor::engine::impacts

int main(int argc, char** argv) {
    try {
        rigor::engine::impacts::measure(rigor::engine::impacts::parse(argc, argv));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
    return 0;
}
