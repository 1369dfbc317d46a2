// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/numbers.hpp"
#include "reports/encoding/text.hpp"
#include "reports/page/html.hpp"
#include "validation/contact_problems/solve.hpp"

namespace rigor::cli {
namespace {

struct SolveArguments {
    std::vector<std::string> files;
    std::string solvers, csv, out;
    validation::SolveOptions options;
    bool json = false, all = false, quiet = false;
};

void writePage(const std::vector<validation::SolvedProblem>& problems, const std::filesystem::path& folder) {
    const auto text =
        validation::solveJson(problems).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::filesystem::create_directories(folder);
    report::writeFile(folder / "index.html", report::htmlSolve(text));
}

int solve(SolveArguments a) {
    a.options.binary = ownBinary();
    std::sort(a.options.iterations.begin(), a.options.iterations.end());
    const std::vector<adapter::EngineSpec> requested =
        a.solvers.empty() ? std::vector<adapter::EngineSpec>{} : adapter::parseSpecList(a.solvers);
    const auto specs = validation::contactSolverSpecs(requested, a.options.binary);
    const std::atomic<bool>& interrupted = catchInterrupts({SIGINT});
    const bool live = !a.quiet && isTerminal(STDERR_FILENO);
    bool complete = false;
    const auto problems = validation::solveFiles(
        {a.files.begin(), a.files.end()}, specs, a.options,
        [live](const std::string& name) {
            if (live) std::fprintf(stderr, "\r\033[K%s", name.c_str());
        },
        interrupted, complete);
    if (live) std::fprintf(stderr, "\r\033[K");
    if (!complete) return kInterrupted;
    if (!a.csv.empty()) validation::writeSolveCsv(problems, a.csv);
    if (!a.out.empty()) writePage(problems, a.out);
    if (a.json)
        std::printf("%s\n", validation::solveJson(problems)
                                .dump(1, ' ', false, nlohmann::json::error_handler_t::replace)
                                .c_str());
    else
        std::printf("%s", validation::solveText(problems, a.all).c_str());
    return validation::solveIsGreen(problems) ? kOk : kRed;
}

}  // namespace

void addSolve(CLI::App& app, Action& action) {
    auto a = std::make_shared<SolveArguments>();
    auto* command = app.add_subcommand(
        "solve", "Put contact problems to the solvers: residual against iterations and time");
    command->add_option("FILE", a->files, "Problems: FCLIB's .hdf5, or .json")->required();
    auto* solvers = command->add_option(
        "-s,--solvers", a->solvers,
        "Specs, e.g. rigor:solver=nsgs,bullet; an engine without a solver means all of its "
        "solvers (default: of every engine that has some)");
    offerNames(solvers, kEngineNames);
    command
        ->add_option("--iterations", a->options.iterations,
                     "Numbers of iterations to allow, comma separated (default 1,2,5,...,2000)")
        ->delimiter(',')
        ->check(between(1, 100000000));
    command
        ->add_option("--tolerance", a->options.tolerance,
                     "At which solvers may stop, by their own measure, relative to max |q| (default 1e-14)")
        ->check(between(0.0, 1.0));
    command
        ->add_option("--seconds", a->options.seconds,
                     "No larger number of iterations after this time, per solver and file (default 10)")
        ->check(between(0.0, 1e6));
    command->add_option("-j,--jobs", a->options.jobs, "Children at a time (default 1: times are taken alone)")
        ->check(between(1, 1024));
    command->add_option("--csv", a->csv, "Write every number of iterations of every solver to this file");
    command->add_option("--out", a->out, "Folder for a page: residual over iterations and over time");
    command->add_flag("--all", a->all, "Print every number of iterations, not only the last");
    command->add_flag("--json", a->json, "Print the full record as JSON");
    command->add_flag("-q,--quiet", a->quiet, "No progress");
    command->footer(
        "Exit codes: 0 done, 1 an in-house solver crashed, ran out of time or left numbers that are not "
        "finite,\n"
        "            2 bad command line or file, 130 interrupted.");
    command->callback([a, &action] { action = [a] { return solve(*a); }; });
}

}  // namespace rigor::cli
