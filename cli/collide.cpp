// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/numbers.hpp"
#include "reports/encoding/text.hpp"
#include "reports/page/html.hpp"
#include "scenarios/loader/collision_cases.hpp"
#include "validation/collide/print.hpp"
#include "validation/collide/random_pairs.hpp"

namespace rigor::cli {
namespace {

struct CollideArguments {
    std::vector<std::string> files;
    std::string engines, out;
    validation::CollideTolerance tolerance;
    int jobs = 0;
    bool suite = false, json = false, all = false, quiet = false;
    validation::RandomPairs random{0, 1, 3, {}, {}, {}};  ///< count 0: none
    std::string save;
};

std::vector<scenario::CollisionFile> loadFiles(const CollideArguments& a) {
    std::vector<scenario::CollisionFile> files;
    if (a.suite)
        for (const auto& entry : scenario::listCollisionFiles())
            files.push_back(scenario::loadCollisionFile(entry.file));
    for (const auto& name : a.files)
        files.push_back(scenario::loadCollisionFile(scenario::findCollisionFile(name)));
    if (a.random.count > 0) {
        files.push_back(validation::makeRandomPairs(a.random));
        if (!a.save.empty()) validation::writeCollisionFile(files.back(), a.save);
    }
    if (files.empty())
        throw std::invalid_argument("collide: name a file of cases, or give --suite or --random");
    return files;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

std::vector<adapter::EngineSpec> chooseSpecs(const CollideArguments& a, int jobs) {
    if (a.engines.empty()) return validation::allCollisionSpecs(ownBinary(), jobs);
    auto specs = adapter::parseSpecList(a.engines);
    for (const auto& spec : specs) validation::checkCollisionSpec(spec, ownBinary());
    return specs;
}

/// Cases of a page: all of them, or the wrong ones and as many others as a browser bears.
nlohmann::ordered_json pageRecord(const validation::CollideRun& run) {
    constexpr std::size_t kMost = 2000;
    auto record = validation::collideJson(run);
    auto& cases = record["cases"];
    if (cases.size() <= kMost) return record;
    const auto isWrong = [](const auto& c) {
        return std::any_of(c["answers"].begin(), c["answers"].end(), [](const auto& answer) {
            return answer["verdict"] != "ok" && answer["verdict"] != "unsupported";
        });
    };
    auto kept = nlohmann::ordered_json::array();
    for (const auto& c : cases)
        if (kept.size() < kMost && isWrong(c)) kept.push_back(c);
    for (const auto& c : cases)
        if (kept.size() < kMost && !isWrong(c)) kept.push_back(c);
    record["left_out"] = cases.size() - kept.size();
    cases = std::move(kept);
    return record;
}

void writePage(const validation::CollideRun& run, const std::filesystem::path& folder) {
    const auto text = pageRecord(run).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    report::writeFile(folder / "index.html", report::htmlCollide(text));
}

int collide(const CollideArguments& a) {
    const auto files = loadFiles(a);
    validation::CollideOptions options;
    options.binary = ownBinary();
    options.tolerance = a.tolerance;
    options.jobs = a.jobs > 0 ? a.jobs : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    const auto specs = chooseSpecs(a, options.jobs);
    const std::atomic<bool>& interrupted = catchInterrupts({SIGINT});
    const bool live = !a.quiet && isTerminal(STDERR_FILENO);
    const auto run = validation::runCollide(
        files, specs, options,
        [live](std::int64_t done, std::int64_t total) {
            if (live)
                std::fprintf(stderr, "\r\033[K%lld/%lld results", static_cast<long long>(done),
                             static_cast<long long>(total));
        },
        interrupted);
    if (live) std::fprintf(stderr, "\r\033[K");
    if (!run.complete) return kInterrupted;
    if (!a.out.empty()) {
        const auto written = validation::writeCollideFiles(run, a.out, ownCommandLine());
        writePage(run, a.out);
        if (!a.json)
            for (const auto& file : written) std::printf("%s\n", file.string().c_str());
    }
    if (a.json)
        std::printf("%s\n", validation::collideJson(run)
                                .dump(1, ' ', false, nlohmann::json::error_handler_t::replace)
                                .c_str());
    else
        std::printf("%s", validation::collideText(run, a.all).c_str());
    return validation::collideIsGreen(run) ? kOk : kRed;
}

void addRandom(CLI::App& command, CollideArguments& a) {
    auto* random =
        command.add_option("--random", a.random.count, "So many random pairs, exact results by the oracle")
            ->check(between(1, 10000000));
    const auto of = [&](const char* name, auto& value, const std::string& help) {
        return command.add_option(name, value, "Of --random: " + help)->needs(random);
    };
    of("--seed", a.random.seed, "the same pairs for the same seed (default 1)");
    of("--dimension", a.random.dimension, "2 or 3 (default 3)")->check(between(2, 3));
    of("--kinds", a.random.kinds, joined(validation::randomPairKinds()))->delimiter(',');
    of("--shapes", a.random.shapes,
       "every two of " + joined(validation::randomPairShapes(3)) + "; in 2D of " +
           joined(validation::randomPairShapes(2)))
        ->delimiter(',');
    of("--pairs", a.random.pairs, "box-hull,hull-hull,... instead of --shapes")->delimiter(',');
    of("--save", a.save, "write the pairs as a file of cases");
}

}  // namespace

void addCollide(CLI::App& app, Action& action) {
    auto a = std::make_shared<CollideArguments>();
    auto* command =
        app.add_subcommand("collide", "Put collision queries to every engine and the exact oracle");
    auto* files = command->add_option(
        "FILE", a->files,
        "Files of cases (rigor_collision JSON, or one query per line), or names of the library");
    offerNames(files, kCollisionNames);
    command->add_flag("--suite", a->suite, "All case files of the library");
    addRandom(*command, *a);
    addEngines(*command, a->engines,
               "Specs, e.g. rigor:narrow_phase=gjk_epa,fcl (default: every engine, every algorithm)",
               "-e,--engines");
    command->add_option("--out", a->out, "Folder for a page, collide.json, collide.csv and summary.md");
    command->add_option("-j,--jobs", a->jobs, "Children at a time (default: processors)")
        ->check(between(1, 1024));
    command
        ->add_option("--touch", a->tolerance.touch,
                     "Distance from touching below which either verdict is right [m] (default 1e-9)")
        ->check(between(0.0, 1.0));
    command
        ->add_option("--relative", a->tolerance.relative,
                     "Tolerance of depths and distances, relative to them (default 1e-6)")
        ->check(between(0.0, 1.0));
    command
        ->add_option("--angle", a->tolerance.angle,
                     "Tolerance of normals, from the nearest minimiser [rad] (default 1e-6)")
        ->check(between(0.0, 3.2));
    command->add_flag("--all", a->all, "Print every result, not only the wrong ones of a large file");
    command->add_flag("--json", a->json, "Print the full record as JSON");
    command->add_flag("-q,--quiet", a->quiet, "No progress");
    command->footer(
        "Exit codes: 0 no result of the in-house engine is wrong or missing and the oracle agrees with the "
        "files,\n"
        "            1 otherwise (other engines' errors are reported and do not count), 2 bad command line "
        "or\n"
        "            file, 130 interrupted.");
    command->callback([a, &action] { action = [a] { return collide(*a); }; });
}

}  // namespace rigor::cli
