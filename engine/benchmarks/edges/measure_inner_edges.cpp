// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Measures the effect of inner edges on bodies that slide or roll over a plane made of pieces (slide.hpp):
//     engine_measure_inner_edges [KEY=VALUE ...]
//         ground=mesh|field|chain  body=sphere|box|capsule_along|capsule_across  preset=default|fast
//         precision=f64|f32  angle=RADIANS  slope=RADIANS  speed=METRES_PER_SECOND  squares=RATIO  friction=NUMBER
//         jitter=0|1                      each a list with commas
//         duration=SECONDS (1)
//         bound=NUMBER (1e-3)             greatest difference that is not counted
//         settings=KEY=VALUE,...          settings of the world in place of the preset's
//         follow=1                        writes every step
// A line for each case; the exit code is 1 where a difference of position or velocity is above the bound, 2
// for arguments that are not understood.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <vector>

#include "engine/benchmarks/arguments.hpp"
#include "engine/benchmarks/edges/slide.hpp"

namespace rigor::engine::edges {
namespace {

Arguments parse(int argc, char** argv) {
    return parseArguments(argc, argv,
                          {{"ground", "mesh,field,chain"},
                           {"body", "sphere,box,capsule_along,capsule_across"},
                           {"preset", "default,fast"},
                           {"precision", "f64,f32"},
                           {"angle", "0,0.4,0.785398"},
                           {"slope", "0"},
                           {"speed", "0.5,3,10"},
                           {"squares", "0.1,0.3,1,3,10"},
                           {"friction", "0,0.3"},
                           {"jitter", "0"},
                           {"duration", "1"},
                           {"bound", "1e-3"},
                           {"settings", ""},
                           {"follow", "0"}});
}

/// A key of the arguments, and how one of its values changes a case.
struct Key {
    const char* name;
    std::function<void(Case&, const std::string&)> set;
};

Key number(const char* name, double Case::*member) {
    return {name, [member](Case& what, const std::string& word) { what.*member = std::stod(word); }};
}

std::vector<Key> keys() {
    return {{"ground",
             [](Case& what, const std::string& word) {
                 what.ground = choose<Ground>(word, {"mesh", "field", "chain"});
             }},
            {"body",
             [](Case& what, const std::string& word) {
                 what.body = choose<Body>(word, {"sphere", "box", "capsule_along", "capsule_across"});
             }},
            number("angle", &Case::angle),
            number("slope", &Case::slope),
            number("speed", &Case::speed),
            number("squares", &Case::squares),
            number("friction", &Case::friction),
            {"jitter",
             [](Case& what, const std::string& word) {
                 what.jitter = choose<bool>(word, {"0", "1"});
             }},
            {"preset",
             [](Case& what, const std::string& word) {
                 what.fast = choose<bool>(word, {"default", "fast"});
             }},
            {"precision", [](Case& what, const std::string& word) {
                 what.single = choose<bool>(word, {"f64", "f32"});
             }}};
}

/// Cases that are the same as another one: a chain has one direction and no capsule across it, and a height
/// field no vertices that could be moved.
bool isRepeated(const Case& what) {
    if (what.ground == Ground::Chain) return what.angle != 0 || what.body == Body::CapsuleAcross;
    return what.ground == Ground::Field && what.jitter;
}

void forCases(const Arguments& arguments, const std::vector<Key>& all, std::size_t next, const Case& what,
              const std::function<void(const Case&)>& use) {
    if (next == all.size()) {
        if (!isRepeated(what)) use(what);
        return;
    }
    for (const std::string& word : split(arguments.at(all[next].name))) {
        Case one = what;
        all[next].set(one, word);
        forCases(arguments, all, next + 1, one, use);
    }
}

int measure(const Arguments& arguments) {
    Case what;
    what.duration = std::stod(arguments.at("duration"));
    what.settings = arguments.at("settings");
    const double bound = std::stod(arguments.at("bound"));
    int cases = 0, above = 0;
    forCases(arguments, keys(), 0, what, [&](const Case& one) {
        const Outcome outcome = run(one, arguments.at("follow") == "1");
        const bool fails = !(outcome.position <= bound && outcome.velocity <= bound);
        std::printf("%s position %.2e velocity %.2e spin %.2e pieces %d ms %.3f%s\n", describe(one).c_str(),
                    outcome.position, outcome.velocity, outcome.spin, outcome.pieces,
                    1e3 * outcome.secondsPerStep, fails ? " ABOVE" : "");
        std::fflush(stdout);
        ++cases;
        above += fails;
    });
    std::printf("%d of %d cases above %g\n", above, cases, bound);
    return above == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace rigor::engine::edges

int main(int argc, char** argv) {
    try {
        return rigor::engine::edges::measure(rigor::engine::edges::parse(argc, argv));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
