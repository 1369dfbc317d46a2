// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/numbers.hpp"
#include "cli/progress.hpp"
#include "cli/reference_checks.hpp"
#include "cli/run_folder.hpp"
#include "reports/report.hpp"
#include "validation/runner/describe.hpp"
#include "validation/studies/print.hpp"

namespace rigor::cli {
namespace {

struct StudyArguments {
    std::string study, out, shard;
    std::vector<std::string> parts;
    validation::ReferenceLimits referenceLimits;
    int jobs = 1, orders = 1;
    bool resume = false, audit = false, json = false, quiet = false;
};

scenario::Study chosenParts(scenario::Study study, const std::vector<std::string>& names) {
    if (names.empty()) return study;
    std::string known;
    for (const auto& part : study.parts) known += (known.empty() ? "" : ", ") + part.name;
    std::vector<scenario::StudyPart> parts;
    for (const auto& name : names) {
        const auto it = std::find_if(study.parts.begin(), study.parts.end(),
                                     [&](const auto& p) { return p.name == name; });
        if (it == study.parts.end())
            throw std::invalid_argument("--part: found '" + name + "', expected one of " + known);
        parts.push_back(*it);
    }
    study.parts = std::move(parts);
    return study;
}

/// Shows the progress of `work`, which gets the function for it and the flag of Ctrl-C. Empty after Ctrl-C.
template <class Work>
std::optional<results::Run> runInterruptibly(const StudyArguments& a, const validation::RunOptions& options,
                                             std::size_t cases, Work work) {
    const std::atomic<bool>& interrupted = catchInterrupts();
    ProgressLine line(a.quiet);
    const auto again = [&] {
        return commandToGoOn(options.command, options.directory, options.resume, !a.out.empty());
    };
    auto run = orStopped(line, again, [&] {
        return work([&](const validation::Progress& p) { line.update(p); }, interrupted);
    });
    if (!interrupted) {
        releaseInterrupts();
        return run;
    }
    std::fprintf(stderr, "Interrupted: %zu of %zu cases are stored. Go on with --resume --out %s\n",
                 results::readOutline(options.directory).cases.size(), cases, options.directory.c_str());
    return std::nullopt;
}

/// Runs the cases of a shard. What they mean together is said when all shards are merged.
int runShard(const std::vector<validation::CasePlan>& cases, const StudyArguments& a,
             const validation::RunOptions& options) {
    if (options.resume) checkResumed(options.directory, cases);
    const auto run =
        runInterruptibly(a, options, cases.size(), [&](const auto& onProgress, const auto& interrupted) {
            return validation::runCases(cases, options, onProgress, interrupted);
        });
    if (!run) return kInterrupted;
    std::printf(
        "Shard %s: %zu cases are stored in %s. `rigor merge` makes one run of all shards, and `rigor study "
        "%s --resume --out RUN` its tables\n",
        a.shard.c_str(), run->cases.size(), options.directory.c_str(), a.study.c_str());
    return kOk;
}

int runStudy(const StudyArguments& a) {
    auto study = chosenParts(scenario::loadStudy(scenario::findStudy(a.study)), a.parts);
    for (const std::string& line : validation::leaveOutAbsent(study))
        std::fprintf(stderr, "rigor: %s\n", line.c_str());
    validation::RunOptions options;
    options.referenceLimits = a.referenceLimits;
    ReferenceChecks references;
    auto plan = validation::planStudy(
        study,
        [&](const std::string& name, const std::vector<std::string>& set) {
            return references.load(name, set);
        },
        [](const std::string& engine) { return validation::describeEngine(engine, ownBinary()).options; });
    validation::checkPlan(plan.cases, ownBinary());
    std::set<std::string> scenarios;
    if (!a.shard.empty()) {
        options.shard = validation::parseShard(a.shard);
        plan.cases = validation::casesOfShard(plan.cases, *options.shard);
        for (const auto& c : plan.cases) scenarios.insert(c.scenario.name);
    }
    options.references =
        references.check(a.referenceLimits, a.jobs, false, a.shard.empty() ? nullptr : &scenarios);

    options.directory = chooseRunFolder(a.out, a.resume, study.name);
    prepareRunFolder(options.directory, a.resume);
    options.binary = ownBinary();
    options.jobs = a.jobs;
    options.resume = a.resume;
    options.audit = a.audit || validation::requestsAudit(study);
    options.suite = study.name;
    options.command = ownCommandLine();
    options.orders = a.orders;
    if (options.shard) return runShard(plan.cases, a, options);
    if (options.resume) {
        validation::extendFromFolder(plan, options.directory);
        checkResumed(options.directory, plan.cases);
    }
    const auto run =
        runInterruptibly(a, options, plan.cases.size(), [&](const auto& onProgress, const auto& interrupted) {
            return validation::runStudyCases(plan, options, onProgress, interrupted);
        });
    if (!run) return kInterrupted;
    const auto result = validation::evaluateStudy(plan, *run);
    validation::writeStudyFiles(result, options.directory, options.command);
    report::writeReports(options.directory);
    if (a.json) {
        auto out = validation::studyJson(result);
        out["run"] = options.directory.string();
        std::printf("%s\n", out.dump(1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    } else {
        std::printf("%sTables: %s  Report: %s\n", validation::studyText(result).c_str(),
                    (options.directory / "study.md").c_str(), (options.directory / "index.html").c_str());
    }
    return validation::studyIsGreen(result) ? kOk : kRed;
}

}  // namespace

void addStudy(CLI::App& app, Action& action) {
    auto a = std::make_shared<StudyArguments>();
    auto* command = app.add_subcommand("study", "Run a grid of choices and show them side by side");
    offerNames(
        command->add_option("STUDY", a->study, "Study file, or a name of `rigor list studies`")->required(),
        kStudyNames);
    command->add_option("--part", a->parts, "Only these parts")->delimiter(',');
    command->add_option("--out", a->out, "Run folder (default: runs/<study>-<time>)");
    command->add_option("-j,--jobs", a->jobs, "Cases at a time (default 1: timings are taken alone)")
        ->check(between(1, 1024));
    command
        ->add_option(
            "--orders", a->orders,
            "Run every case in so many orders of insertion; ranges stand in the store and the report")
        ->check(between(1, 1000));
    command->add_option(
        "--shard", a->shard,
        "Run the K-th of N parts of the plan (K/N), without tables and report: for many machines; "
        "`rigor merge` makes one run of them, and --resume --out RUN the tables of that");
    addReferenceLimit(*command, a->referenceLimits);
    command->add_flag("--resume", a->resume, "Go on with an interrupted run (--out, or the latest)");
    command->add_flag("--audit", a->audit,
                      "Also the contact audit of `validate` (on where a column needs it)");
    command->add_flag("--json", a->json, "Print the tables as JSON");
    command->add_flag("-q,--quiet", a->quiet, "No progress");
    command->footer(
        "Exit codes: 0 every symptom is shown by its fault and cured by its cure, and every run that is not "
        "a fault\n"
        "            ended well, 1 otherwise, 2 bad command line or file, 130 interrupted.");
    command->callback([a, &action] { action = [a] { return runStudy(*a); }; });
}

}  // namespace rigor::cli
