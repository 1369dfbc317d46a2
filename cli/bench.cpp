// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/numbers.hpp"
#include "cli/run_folder.hpp"
#include "reports/report.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/bench/print.hpp"
#include "validation/bench/run_bench.hpp"
#include "validation/bench/summary.hpp"
#include "validation/results/store.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/shell_word.hpp"

namespace rigor::cli {
namespace {

namespace fs = std::filesystem;
using validation::BenchWork;
using validation::EngineDescription;

const std::string kDefaultBenchSuite = "bench";
constexpr double kPartsBudget = 480.0;  ///< [s]

struct BenchArguments {
    std::vector<std::string> what, overrides, parts, only;
    std::vector<int> threads{1}, sizes;
    std::string engines, out, base, baseline, dt, preset = "matched";
    validation::BenchTarget target;
    validation::BaselineOptions held;
    std::optional<double> budget;
    bool growth = false, full = false, resume = false, json = false, quiet = false, slowBuild = false;
};

std::vector<std::string> sceneNames(const BenchArguments& a) {
    std::vector<std::string> what = a.what;
    if (what.empty() && a.parts.empty()) what.push_back(kDefaultBenchSuite);
    return scenarioNames(what);
}

/// The command line's overrides, as it takes them again.
std::string again(const std::vector<std::string>& overrides) {
    std::string text;
    for (const auto& value : overrides) text += " --set " + validation::shellWord(value);
    return text;
}

/// `size` 0: the scenario's own.
validation::SceneRequest::Scene loadScene(const std::string& name, int size, const BenchArguments& a) {
    auto overrides = a.overrides;
    std::string arguments = validation::shellWord(name) + again(a.overrides);
    if (size > 0) {
        overrides.push_back("size=" + std::to_string(size));
        arguments += " --size " + std::to_string(size);
    }
    auto loaded = loadWithReference(name, overrides, {});
    if (!a.dt.empty()) arguments += " --dt " + a.dt;
    return {std::move(loaded.scenario), std::move(loaded.text), std::move(arguments)};
}

/// A scene at the requested sizes: --size, with --growth its own list, else as it is.
void addScenes(const std::string& name, const BenchArguments& a, validation::SceneRequest& request) {
    auto scene = loadScene(name, 0, a);
    std::vector<int> sizes = a.sizes;
    if (sizes.empty() && a.growth && scene.scenario.bench) sizes = scene.scenario.bench->sizes;
    if (sizes.empty()) {
        request.scenes.push_back(std::move(scene));
        return;
    }
    if (!scene.scenario.size)
        throw std::invalid_argument("--size: '" + name +
                                    "' has no size; scenes that grow have the key `size`");
    for (const int size : sizes) request.scenes.push_back(loadScene(name, size, a));
}

std::vector<adapter::EngineSpec> chooseSpecs(const BenchArguments& a) {
    if (!a.engines.empty()) return adapter::parseSpecList(a.engines);
    std::vector<adapter::EngineSpec> specs;
    for (const auto& name : adapter::availableEngines()) specs.push_back({name, {}});
    return specs;
}

std::vector<EngineDescription> describe(const std::vector<adapter::EngineSpec>& specs) {
    std::vector<std::string> names;
    for (const auto& spec : specs) {
        (void)adapter::moduleFor(spec);  // an engine that is not installed is said now
        if (std::find(names.begin(), names.end(), spec.engine) == names.end()) names.push_back(spec.engine);
    }
    return validation::describeEngines(names, ownBinary(), 1);
}

bool isRequested(const BenchArguments& a, const std::string& part) {
    return std::any_of(a.parts.begin(), a.parts.end(),
                       [&](const std::string& requested) { return requested == "all" || requested == part; });
}

/// No further round after so many seconds. The usual cases of the parts are to be done in ten minutes, the
/// last round, of a minute or so, included.
double budgetOf(const BenchArguments& a) {
    const bool usualParts = !a.parts.empty() && a.what.empty() && !a.full;
    return a.budget.value_or(usualParts ? kPartsBudget : a.target.budget);
}

/// Cases of the isolated parts that are requested. Throws std::invalid_argument where --only names none.
std::vector<BenchWork> planParts(const BenchArguments& a, validation::BenchRequest request) {
    std::vector<BenchWork> work;
    for (const auto& family : validation::benchFamilies()) {
        if (!isRequested(a, family.name)) continue;
        for (auto& planned : family.plan(request)) work.push_back({std::move(planned), "", {}});
    }
    const auto missing = std::ranges::find_if(a.only, [&](const std::string& name) {
        return std::ranges::none_of(work, [&](const auto& w) { return w.planned.name == name; });
    });
    if (missing == a.only.end() || request.only.empty()) return work;
    request.only.clear();
    request.full = true;
    std::string known;
    for (const auto& w : planParts(a, request))
        if (known.find("'" + w.planned.name + "'") == std::string::npos)
            known += (known.empty() ? "'" : ", '") + w.planned.name + "'";
    throw std::invalid_argument("--only: found '" + *missing + "', expected " +
                                (known.empty() ? "none, as no part has cases" : "one of " + known));
}

std::vector<BenchWork> planAll(const BenchArguments& a) {
    validation::SceneRequest request;
    for (const auto& name : sceneNames(a)) addScenes(name, a, request);
    request.specs = chooseSpecs(a);
    request.preset = a.preset;
    request.threads = a.threads;
    if (!a.dt.empty()) request.dt = parseTimeStep(a.dt);
    const auto engines = describe(request.specs);
    for (const auto& spec : request.specs)
        for (const auto& d : engines)
            if (d.info.name == spec.engine && d.problem.empty()) validation::checkSettings(spec, d);
    auto work = validation::planScenes(request, engines);
    validation::BenchRequest parts;
    if (!a.engines.empty())
        for (const auto& spec : request.specs) parts.engines.push_back(spec.text());
    parts.sizes.assign(a.sizes.begin(), a.sizes.end());
    parts.only = a.only;
    parts.full = a.full;
    parts.preset = a.preset;
    parts.threads = a.threads;
    parts.seed = a.target.seed;
    parts.binary = ownBinary().string();
    for (auto& part : planParts(a, parts)) work.push_back(std::move(part));
    // An engine may be named twice: by itself and by its preset.
    std::set<std::string> known;
    std::erase_if(work,
                  [&](const BenchWork& w) { return !known.insert(validation::benchId(w.planned)).second; });
    if (work.empty()) throw std::invalid_argument("bench: no engine can run any of this");
    return work;
}

void checkParts(const BenchArguments& a) {
    if (a.parts.empty() && !a.only.empty()) throw std::invalid_argument("--only: goes with --parts");
    if (a.parts.empty() && a.full) throw std::invalid_argument("--full: goes with --parts");
    std::string known = "all";
    for (const auto& family : validation::benchFamilies()) known += ", " + family.name;
    for (const auto& part : a.parts) {
        const auto& families = validation::benchFamilies();
        if (part != "all" && std::none_of(families.begin(), families.end(),
                                          [&](const auto& family) { return family.name == part; }))
            throw std::invalid_argument("--parts: found '" + part + "', expected one of " + known);
    }
}

/// A killed run goes on with its stored request: the cases must be the same.
void checkSameBench(const fs::path& directory, const std::vector<BenchWork>& work) {
    const auto stored = results::readRun(directory);
    for (const auto& c : stored.bench.cases) {
        const bool planned = std::any_of(work.begin(), work.end(), [&](const BenchWork& w) {
            return validation::benchId(w.planned) == c.id;
        });
        if (!planned)
            throw std::invalid_argument(
                "--resume: '" + directory.string() + "' holds " + validation::benchCaseName(c) +
                ", which this command does not request; it was started by: " + stored.command);
    }
}

std::string clockText(double seconds) {
    const long total = std::lround(seconds);
    char text[32];
    std::snprintf(text, sizeof text, "%ld:%02ld", total / 60, total % 60);
    return text;
}

/// A live line on a terminal, a line for each repetition elsewhere.
void showProgress(const validation::BenchProgress& p, bool live) {
    const std::string eta = p.etaSeconds >= 0.0 ? "  ETA " + clockText(p.etaSeconds) : "";
    if (live) {
        std::string line = std::to_string(p.done) + " repetitions, about " + std::to_string(p.coming) +
                           " to come" + eta + "  " + p.current;
        const auto columns = static_cast<std::size_t>(std::max(20, terminalColumns(STDERR_FILENO) - 1));
        std::fprintf(stderr, "\r\033[K%s", line.substr(0, columns).c_str());
        std::fflush(stderr);
    } else if (p.finished != nullptr) {
        const auto& r = p.finished->repetitions.back();
        std::fprintf(stderr, "[%lld/%lld] %s  round %lld  %s  %.4g ms%s\n", static_cast<long long>(p.done),
                     static_cast<long long>(p.done + p.coming),
                     validation::benchCaseName(*p.finished).c_str(), static_cast<long long>(r.round),
                     r.outcome.c_str(), 1e3 * r.cpu, eta.c_str());
    }
}

results::Run readBaseline(const std::string& folder) {
    try {
        auto run = results::readRun(folder);
        for (const std::string& damage : run.damage) say(damage);
        if (run.bench.empty()) throw std::invalid_argument("--baseline: '" + folder + "' holds no bench");
        return run;
    } catch (const std::runtime_error& error) {
        throw std::invalid_argument(std::string("--baseline: ") + error.what());
    }
}

/// Compares, stores what changed, and says so. True when something became slower.
bool compareWithBaseline(const BenchArguments& a, const results::Run& baseline, results::Run& run) {
    run.bench.changes = validation::changesSince(baseline.bench, run.bench, a.held);
    run.bench.settings["baseline"] = a.baseline;
    results::RunWriter writer(run.directory, true);
    writer.writeBenchPlan(run.bench);
    writer.writeBenchAnalysis(run.bench);
    std::fputs(validation::changesText(run, a.baseline, validation::otherMachine(baseline, run)).c_str(),
               stderr);
    return validation::becameSlower(run.bench.changes);
}

int interruptedAt(const BenchArguments& a, const validation::BenchOptions& options) {
    const std::string command =
        commandToGoOn(options.command, options.directory, options.resume, !a.out.empty());
    std::fprintf(stderr, "Interrupted; what was measured is stored. Go on with: %s\n", command.c_str());
    return kInterrupted;
}

/// Something crashed, or nothing at all can be used.
bool isBroken(const results::Bench& bench) {
    bool anyValid = false;
    for (const auto& c : bench.cases) {
        anyValid = anyValid || c.summary.valid;
        for (const auto& r : c.repetitions)
            if (r.outcome != "completed" && r.outcome != "unsupported") return true;
    }
    return !anyValid;
}

int bench(const BenchArguments& a) {
    checkParts(a);
    if (const auto slow = validation::slowBuild(); !slow.empty() && !a.slowBuild)
        throw std::invalid_argument("bench: this program was " + slow +
                                    ", its times would say nothing; --any-build times it all the same");
    std::optional<results::Run> baseline;
    if (!a.baseline.empty()) baseline = readBaseline(a.baseline);
    const auto work = planAll(a);

    validation::BenchOptions options;
    options.directory = chooseRunFolder(a.out, a.resume, "bench");
    prepareRunFolder(options.directory, a.resume);
    if (a.resume && results::holdsStore(options.directory)) checkSameBench(options.directory, work);
    options.binary = ownBinary();
    options.resume = a.resume;
    options.target = a.target;
    options.target.budget = budgetOf(a);
    options.base = a.base;
    options.command = ownCommandLine();
    for (const auto& name : a.what) options.suite += (options.suite.empty() ? "" : " ") + name;
    if (options.suite.empty()) options.suite = kDefaultBenchSuite;

    const std::atomic<bool>& interrupted = catchInterrupts();
    const bool live = canRewriteLines(STDERR_FILENO);
    auto run = validation::runBench(
        work, options,
        [&](const validation::BenchProgress& p) {
            if (!a.quiet) showProgress(p, live);
        },
        interrupted);
    if (live && !a.quiet) std::fprintf(stderr, "\r\033[K");
    if (interrupted) return interruptedAt(a, options);
    releaseInterrupts();
    const bool slower = baseline && compareWithBaseline(a, *baseline, run);
    report::writeReports(options.directory);
    if (a.json) {
        auto json = validation::benchJson(run);
        json["run"] = options.directory.string();
        std::printf("%s\n", json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    } else {
        std::printf("%sReport: %s\n", validation::benchText(run, wantsColour(STDOUT_FILENO)).c_str(),
                    (options.directory / "index.html").string().c_str());
    }
    return slower || isBroken(run.bench) ? kRed : kOk;
}

void addWhat(CLI::App& command, BenchArguments& a) {
    auto* what = command.add_option("WHAT", a.what,
                                    "Suites or scenarios (names or files); default: the suite 'bench'");
    offerNames(offerNames(what, kSuiteNames), kScenarioNames);
    command
        .add_option("--parts", a.parts,
                    "Isolated parts: their names with commas between, or 'all'; without WHAT no scenes")
        ->delimiter(',');
    command
        .add_option("--only", a.only,
                    "A case of the parts by its name; may be given more than once; default: all")
        ->allow_extra_args(false);
    command.add_flag(
        "--full", a.full,
        "Parts with all their sizes, orders, kinds of pairs and residuals: hundreds of cases more");
    addEngines(command, a.engines, "Engine specs, comma separated; default: all installed");
    command.add_option("--preset", a.preset, "Of specs that name none (default: matched)");
    command
        .add_option("--threads", a.threads, "Numbers of threads for engines that have them (default 1): 1,2")
        ->delimiter(',')
        ->check(between(1, 1024));
    auto* size = command
                     .add_option("--size", a.sizes,
                                 "Sizes of scenes that have one, and of parts: 5,10,20 (a growth curve)")
                     ->delimiter(',')
                     ->check(between(1, 1000000));
    command.add_flag("--growth", a.growth, "Every scene at all the sizes it lists")->excludes(size);
    command.add_option("--set", a.overrides, "Override a scenario value: KEY=VALUE")->allow_extra_args(false);
    command.add_option("--dt", a.dt,
                       "Time step in seconds (0.004 or 1/240) instead of each scenario's first");
}

void addMethod(CLI::App& command, BenchArguments& a) {
    auto& t = a.target;
    command
        .add_option(
            "--width", t.width,
            "Repeat until the 95 % interval of each median is narrower than this share (default 0.05)")
        ->check(between(0.0, 10.0));
    command.add_option("--least", t.least, "Repetitions at least (default 6: fewer have no interval)")
        ->check(between(1, 10000));
    command.add_option("--most", t.most, "Repetitions at most (default 30)")->check(between(1, 10000));
    command
        .add_option(
            "--budget", a.budget,
            "No further round after so many seconds (default 1800; of parts alone, without --full, 480)")
        ->check(between(0.0, 1e7));
    command.add_option("--seed", t.seed, "Of the order of engines (default 1)");
    command
        .add_option("--clock", t.clock,
                    "What intervals and ratios are of: cpu, wall, auto (cpu for one thread, wall for more)")
        ->check(CLI::IsMember({"auto", "cpu", "wall"}));
    command.add_option("--base", a.base, "Spec or engine that ratios are to (default: the first valid one)");
    command.add_option("--baseline", a.baseline, "Run folder of an earlier bench: what became slower?");
    command
        .add_option("--threshold", a.held.threshold,
                    "Of --baseline: slower by a smaller share is no slow-down (default 0.05)")
        ->check(between(0.0, 1000.0));
    command.add_flag("--any-build", a.slowBuild, "Time a build without optimisation, or with sanitizers");
}

}  // namespace

void addBench(CLI::App& app, Action& action) {
    auto a = std::make_shared<BenchArguments>();
    auto* command = app.add_subcommand(
        "bench", "Time scenes and parts on every engine, interleaved, with intervals and quality");
    addWhat(*command, *a);
    addMethod(*command, *a);
    command->add_option("--out", a->out, "Run folder (default: runs/bench-<time>)");
    command->add_flag("--resume", a->resume, "Go on with a run that was interrupted");
    command->add_flag("--json", a->json, "Print every repetition as JSON");
    command->add_flag("-q,--quiet", a->quiet, "No progress");
    command->footer(
        "Exit codes: 0 measured, 1 slower than --baseline beyond chance and threshold, or something crashed, "
        "or "
        "no timing is valid,\n            2 bad command line or file, 130 interrupted (--resume goes on).");
    command->callback([a, &action] { action = [a] { return bench(*a); }; });
}

}  // namespace rigor::cli
