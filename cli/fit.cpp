// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/numbers.hpp"
#include "cli/progress.hpp"
#include "cli/run_folder.hpp"
#include "reports/report.hpp"
#include "validation/fit/fit.hpp"
#include "validation/runner/describe.hpp"

namespace rigor::cli {
namespace {

namespace fs = std::filesystem;

struct FitArguments {
    std::string file, engines, out;
    int jobs = 0, budget = 0;
    bool resume = false, noRuns = false, json = false, quiet = false;
};

/// A folder that holds no fit yet, or with --resume one that does.
void prepareFolder(const fs::path& folder, bool resume) {
    const bool holds = fs::exists(folder / "evaluations.jsonl");
    if (resume && !holds) throw std::invalid_argument("--resume: '" + folder.string() + "' holds no fit");
    if (!resume && holds)
        throw std::invalid_argument("--out: '" + folder.string() +
                                    "' holds a fit already; add --resume or choose another folder");
}

int runFit(const FitArguments& a) {
    std::vector<adapter::EngineSpec> engines;
    if (!a.engines.empty()) engines = adapter::parseSpecList(a.engines);
    validation::FitTask task = validation::loadFit(a.file, engines);
    validation::checkSpecs(task.specs, ownBinary());
    if (a.budget > 0) task.budget = a.budget;
    validation::FitOptions options;
    options.directory = chooseRunFolder(a.out, a.resume, "fit-" + task.name);
    prepareFolder(options.directory, a.resume);
    options.binary = ownBinary();
    options.resume = a.resume;
    options.runs = !a.noRuns;
    options.jobs = a.jobs > 0 ? a.jobs : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    options.command = ownCommandLine();
    const std::atomic<bool>& interrupted = catchInterrupts();
    ProgressLine line(a.quiet);
    std::string said;
    const auto outcome = validation::runFit(
        task, options,
        [&](const validation::FitProgress& p) {
            validation::Progress shown;
            shown.done = p.done;
            shown.total = p.total;
            shown.etaSeconds = p.etaSeconds;
            shown.current = p.current;
            line.update(shown);
            if (!a.quiet && !isTerminal(2) && p.current != said)
                std::fprintf(stderr, "%s\n", (said = p.current).c_str());
        },
        interrupted);
    line.finish();
    if (!outcome.complete) {
        std::fprintf(stderr, "Interrupted: what was evaluated is kept. Go on with --resume --out %s\n",
                     options.directory.c_str());
        return kInterrupted;
    }
    releaseInterrupts();
    for (const auto& folder : outcome.runFolders) report::writeReports(folder);
    if (a.json)
        std::printf("%s\n", validation::fitToJson(outcome.result).dump(1).c_str());
    else
        std::printf("%sTables: %s\n", validation::fitText(outcome.result).c_str(),
                    (options.directory / "fit.md").c_str());
    return kOk;
}

}  // namespace

void addFit(CLI::App& app, Action& action) {
    auto a = std::make_shared<FitArguments>();
    auto* command = app.add_subcommand(
        "fit", "Fit values of scenarios to measured motions on one part, score engines on the other");
    command->add_option("FILE", a->file, "Fit file; `rigor import` writes one")
        ->required()
        ->check(CLI::ExistingFile);
    addEngines(*command, a->engines, "Engine specs instead of the file's; both presets where none is named");
    command->add_option("--out", a->out, "Folder (default: runs/fit-<name>-<time>)");
    command
        ->add_option("--budget", a->budget, "Points per engine at which the training part is run (file: 140)")
        ->check(between(10, 100000));
    command->add_option("-j,--jobs", a->jobs, "Processes at a time (default: all cores)")
        ->check(between(1, 1024));
    command->add_flag("--resume", a->resume, "Go on with an interrupted fit (--out, or the latest)");
    command->add_flag("--no-runs", a->noRuns, "Scores alone: no run folders with reports of the scored part");
    command->add_flag("--json", a->json, "Print the result as JSON");
    command->add_flag("-q,--quiet", a->quiet, "No progress");
    command->footer(
        "The folder: fit.md, fit.csv, fit.json; evaluations.jsonl (every evaluation); test/ENGINE, a run "
        "folder each.");
    command->callback([a, &action] { action = [a] { return runFit(*a); }; });
}

}  // namespace rigor::cli
