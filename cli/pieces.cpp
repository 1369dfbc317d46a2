// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>

#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/numbers.hpp"
#include "cli/progress.hpp"
#include "cli/run_folder.hpp"
#include "reports/report.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/runner.hpp"

namespace rigor::cli {
namespace {

struct PiecesArguments {
    std::vector<std::string> scenarios, overrides, timeSteps;
    std::vector<int> every{1, 8, 64};
    std::string engines, out;
    validation::ReferenceLimits referenceLimits;
    int jobs = 1;
    bool quiet = false;
};

std::vector<adapter::EngineSpec> chooseSpecs(const PiecesArguments& a) {
    if (!a.engines.empty()) return adapter::parseSpecList(a.engines);
    std::vector<adapter::EngineSpec> specs;
    for (const auto& name : adapter::availableEngines())
        if (validation::describeEngine(name, ownBinary()).capabilities.dynamics) specs.push_back({name, {}});
    return specs;
}

const results::MetricRow* pieceRow(const results::CaseRow& c, const std::string& name, int every) {
    const std::string subject = "every " + std::to_string(every) + " ";
    for (const auto& m : c.metrics)
        if (m.name == name && m.subject.starts_with(subject)) return &m;
    return nullptr;
}

/// One line of a case: the median error of a piece and its worst, for every number of steps.
void printCase(const results::CaseRow& c, const std::vector<int>& every) {
    std::printf("%-24s %-32s dt=%-9.6g", c.scenario.c_str(), c.spec.c_str(), c.dt);
    std::string note;
    for (const int k : every) {
        const auto *middle = pieceRow(c, "piece_error", k), *worst = pieceRow(c, "piece_error_worst", k);
        if (middle == nullptr || worst == nullptr || std::isnan(middle->value))
            std::printf("  %22s", "-");
        else
            std::printf("  %10.3g (%9.3g)", middle->value, worst->value);
        if (middle != nullptr) note = middle->note;
    }
    const bool ran = c.outcome == results::Outcome::Completed;
    std::printf("  %s\n", ran ? note.c_str() : (results::outcomeName(c.outcome) + (": " + c.reason)).c_str());
}

int pieces(const PiecesArguments& a) {
    validation::RunOptions options;
    options.referenceLimits = a.referenceLimits;
    std::vector<std::pair<scenario::Scenario, std::string>> scenarios;
    for (const auto& name : scenarioNames(a.scenarios)) {
        validation::ReferenceCheck reference;
        auto loaded = loadWithReference(name, a.overrides, a.referenceLimits, false, &reference);
        options.references[loaded.scenario.name] = reference;
        options.suite += (options.suite.empty() ? "" : " ") + loaded.scenario.name;
        if (a.timeSteps.empty()) loaded.scenario.timeSteps.resize(1);
        scenarios.emplace_back(std::move(loaded.scenario), std::move(loaded.text));
    }
    std::vector<double> timeSteps;
    for (const auto& text : a.timeSteps) timeSteps.push_back(parseTimeStep(text));
    const auto plan = validation::planCases(scenarios, chooseSpecs(a), timeSteps);
    validation::checkPlan(plan, ownBinary());
    options.directory = chooseRunFolder(a.out, false, "pieces");
    prepareRunFolder(options.directory, false);
    options.binary = ownBinary();
    options.jobs = a.jobs;
    options.audit = false;
    options.pieces = a.every;
    options.command = ownCommandLine();
    const std::atomic<bool>& interrupted = catchInterrupts();
    ProgressLine line(a.quiet);
    const auto run = validation::runCases(
        plan, options, [&](const validation::Progress& p) { line.update(p); }, interrupted);
    line.finish();
    if (interrupted) return kInterrupted;
    releaseInterrupts();
    report::writeReports(options.directory);
    std::printf("Error of one piece [m]: median over the pieces (worst)\n%-24s %-32s %-12s", "scenario",
                "engine", "");
    for (const int k : a.every) std::printf("  %22s", ("every " + std::to_string(k)).c_str());
    std::printf("\n");
    bool broke = false;
    for (const auto& c : run.cases) {
        printCase(c, a.every);
        broke =
            broke || (c.outcome != results::Outcome::Completed && c.outcome != results::Outcome::Unsupported);
    }
    std::printf("Report: %s\n", (options.directory / "index.html").c_str());
    return broke ? kRed : kOk;
}

}  // namespace

void addPieces(CLI::App& app, Action& action) {
    auto a = std::make_shared<PiecesArguments>();
    auto* command = app.add_subcommand(
        "pieces", "Put bodies back on the truth every k steps and measure one piece: fair in chaos too");
    auto* what =
        command->add_option("SCENARIO", a->scenarios, "Scenarios or suites, names or files")->required();
    offerNames(offerNames(what, kSuiteNames), kScenarioNames);
    command->add_option("--every", a->every, "Steps of a piece: K1,K2,... (default 1,8,64)")
        ->delimiter(',')
        ->check(between(1, 1000000));
    addEngines(*command, a->engines, "Engine specs, comma separated; default: all installed, both presets");
    command
        ->add_option("--dt", a->timeSteps,
                     "Time steps in seconds (0.004 or 1/240); default: the first of each scenario")
        ->delimiter(',');
    command->add_option("--set", a->overrides, "Override a scenario value: KEY=VALUE")
        ->allow_extra_args(false);
    command->add_option("-j,--jobs", a->jobs, "Cases at a time (default 1)")->check(between(1, 1024));
    command->add_option("--out", a->out, "Run folder (default: runs/pieces-<time>)");
    addReferenceLimit(*command, a->referenceLimits);
    command->add_flag("-q,--quiet", a->quiet, "No progress");
    command->footer(
        "The truth is the reference where it knows every body at every step, else the engine's own run at "
        "dt/16.\nThe numbers are the metrics piece_error, piece_error_worst, piece_turn, piece_turn_worst of "
        "the "
        "run.\nExit codes: 0 measured, 1 a case broke, 2 bad command line or file, 130 interrupted.");
    command->callback([a, &action] { action = [a] { return pieces(*a); }; });
}

}  // namespace rigor::cli
