// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Counts the bodies that get through meshes, height fields and chains, over many cases (rain.hpp):
//     engine_count_lost_bodies [KEY=VALUE ...]
//         ground=mesh|field|chain|plate  motion=drop|pile|roll|slide|shoot  preset=default|fast
//         precision=f64|f32  ccd=none|conservative_advancement|speculative
//         form=flat|rough|slope|ridges|slivers  squares=RATIO
//                             each a list with commas; by default all but plate, shoot and those of ccd, and
//                             of form and squares those that belong to the seed; a plate is flat or a slope
//         seeds=FIRST-LAST (0-19)  bodies=NUMBER (1000)  duration=SECONDS (3)
//         follow=BODY         of a single case: writes the state of the body, step by step
// A line for each case, with what is lost as BODY@STEP:SHAPE, and what is sunk at the end as BODY~SHAPE:HEIGHT in
// inner radii. A line can be given again as arguments. The
// exit code is 1 where something was lost, 2 for arguments that are not understood.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>

#include "engine/benchmarks/arguments.hpp"
#include "engine/benchmarks/lost/rain.hpp"

namespace rigor::engine::lost {
namespace {

Arguments parse(int argc, char** argv) {
    return parseArguments(argc, argv,
                          {{"ground", "mesh,field,chain"},
                           {"motion", "drop,pile,roll,slide"},
                           {"preset", "default,fast"},
                           {"precision", "f64,f32"},
                           {"ccd", "none"},
                           {"form", ""},
                           {"squares", ""},
                           {"seeds", "0-19"},
                           {"seed", ""},
                           {"bodies", "1000"},
                           {"duration", "3"},
                           {"follow", "-1"}});
}

void forSeeds(const Arguments& arguments, const std::function<void(std::uint64_t)>& use) {
    if (!arguments.at("seed").empty()) return use(std::stoull(arguments.at("seed")));
    const std::string& range = arguments.at("seeds");
    const std::size_t dash = range.find('-');
    const std::uint64_t first = std::stoull(range);
    const std::uint64_t last = dash == std::string::npos ? first : std::stoull(range.substr(dash + 1));
    for (std::uint64_t seed = first; seed <= last; ++seed) use(seed);
}

/// The cases of one seed, ground and motion.
void forSettings(const Arguments& arguments, Case what, const std::function<void(const Case&)>& use) {
    const auto given = [&](const char* key, const std::string& own) {
        return arguments.at(key).empty() ? std::vector{own} : split(arguments.at(key));
    };
    setGroundOfSeed(what);
    const Case own = what;
    for (const std::string& form : given("form", "own"))
        for (const std::string& squares : given("squares", "own"))
            for (const std::string& preset : split(arguments.at("preset")))
                for (const std::string& precision : split(arguments.at("precision")))
                    for (const std::string& ccd : split(arguments.at("ccd"))) {
                        what.form = form == "own"
                                        ? own.form
                                        : choose<Form>(form, {"flat", "rough", "slope", "ridges", "slivers"});
                        what.squares = squares == "own" ? own.squares : std::stod(squares);
                        what.fast = choose<bool>(preset, {"default", "fast"});
                        what.single = choose<bool>(precision, {"f64", "f32"});
                        what.continuous =
                            choose<Continuous>(ccd, {"none", "conservative_advancement", "speculative"});
                        use(what);
                    }
}

int count(const Arguments& arguments) {
    std::size_t lost = 0, cases = 0;
    forSeeds(arguments, [&](std::uint64_t seed) {
        for (const std::string& ground : split(arguments.at("ground")))
            for (const std::string& motion : split(arguments.at("motion"))) {
                Case what;
                what.seed = seed;
                what.ground = choose<Ground>(ground, {"mesh", "field", "chain", "plate"});
                what.motion = choose<Motion>(motion, {"drop", "pile", "roll", "slide", "shoot"});
                what.bodies = std::stoi(arguments.at("bodies"));
                what.duration = std::stod(arguments.at("duration"));
                forSettings(arguments, what, [&](const Case& one) {
                    const Outcome outcome = run(one, std::stoi(arguments.at("follow")));
                    std::printf("%s lost %zu sunk %zu away %d ms %.2f", describe(one).c_str(),
                                outcome.lost.size(), outcome.sunk.size(), outcome.away,
                                1e3 * outcome.secondsPerStep);
                    for (const Loss& loss : outcome.lost)
                        std::printf(" %d@%d:%s", loss.body, loss.step, loss.shape.c_str());
                    for (const Sunk& sunk : outcome.sunk)
                        std::printf(" %d~%s:%.2f", sunk.body, sunk.shape.c_str(), sunk.height);
                    std::printf("\n");
                    std::fflush(stdout);
                    lost += outcome.lost.size();
                    ++cases;
                });
            }
    });
    std::printf("%zu bodies lost in %zu cases\n", lost, cases);
    return lost == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace rigor::engine::lost

int main(int argc, char** argv) {
    try {
        return rigor::engine::lost::count(rigor::engine::lost::parse(argc, argv));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
