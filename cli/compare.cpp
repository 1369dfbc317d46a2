// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/compare.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "cli/command.hpp"
#include "cli/numbers.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/comparison/recorded.hpp"
#include "validation/results/files.hpp"
#include "validation/results/store.hpp"

namespace rigor::cli {
namespace {

namespace fs = std::filesystem;
using results::Run;

const std::string kRecorded = "recorded";

struct CompareArguments {
    std::string before, after;  ///< folders with commas between
    validation::CompareOptions options;
    std::size_t most = 20;
    std::string pairBy;
    bool json = false;
};

std::vector<Run> readRuns(const std::string& folders) {
    std::vector<Run> runs;
    std::istringstream list(folders);
    try {
        for (std::string folder; std::getline(list, folder, ',');) {
            runs.push_back(results::readRun(folder));
            if (!runs.back().damage.empty())
                throw results::EnvironmentError(runs.back().damage.front() + ". Nothing is compared with it");
        }
    } catch (const results::EnvironmentError&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw std::invalid_argument(error.what());
    }
    if (runs.empty()) throw std::invalid_argument("found no run folder, expected one or more");
    return runs;
}

/// Cases that differ on purpose: in one run, or in two.
validation::RunComparison pairedComparison(const CompareArguments& a) {
    validation::CompareOptions options = a.options;
    options.pairBy = *results::parsePairBy(a.pairBy);
    if (a.before == kRecorded || a.after == kRecorded)
        throw std::invalid_argument("--pair: found 'recorded', expected run folders");
    const auto before = readRuns(a.before);
    if (a.after.empty()) return validation::compareRuns(before, before, options);
    return validation::compareRuns(before, readRuns(a.after), options);
}

validation::RunComparison comparisonOf(const CompareArguments& a) {
    const auto after = readRuns(a.after);
    std::vector<Run> before;
    if (a.before == kRecorded) {
        std::vector<std::string> missing;
        before.push_back(validation::readRecorded(recordedFolder(), after.front(), missing));
        for (const auto& engine : missing)
            std::fprintf(stderr, "rigor: nothing is recorded for %s\n", engine.c_str());
    } else {
        before = readRuns(a.before);
    }
    return validation::compareRuns(before, after, a.options);
}

int compare(const CompareArguments& a) {
    if (a.after.empty() && a.pairBy.empty())
        throw std::invalid_argument(
            "compare: found one run, expected AFTER as well, or --pair engine|spec|dt");
    if (a.after == kRecorded && a.pairBy.empty())
        throw std::invalid_argument("compare: found 'recorded' as AFTER, expected it as BEFORE: compare " +
                                    kRecorded + " " + a.before);
    const auto comparison = a.pairBy.empty() ? comparisonOf(a) : pairedComparison(a);
    const auto text = a.json ? validation::comparisonJson(comparison)
                             : validation::comparisonText(comparison, a.options, a.most);
    std::fputs(text.c_str(), stdout);
    return a.pairBy.empty() && validation::becameWorse(comparison) ? kRed : kOk;
}

int record(const std::string& folder, const std::string& out, bool add) {
    const auto runs = readRuns(folder);
    for (const auto& file :
         validation::writeRecorded(runs.front(), out.empty() ? recordedFolder() : fs::path(out), add))
        std::printf("%s\n", file.string().c_str());
    return kOk;
}

}  // namespace

fs::path recordedFolder() {
    return scenario::libraryFolder() / kRecorded;
}

bool becameWorseThan(const std::string& baseline, const fs::path& run) {
    CompareArguments a;
    a.before = baseline;
    a.after = run.string();
    const auto comparison = comparisonOf(a);
    std::fprintf(stderr, "Against %s:\n%s", baseline.c_str(),
                 validation::comparisonText(comparison, a.options, a.most).c_str());
    return validation::becameWorse(comparison);
}

void checkBaseline(const std::string& baseline) {
    if (!baseline.empty() && baseline != kRecorded) (void)readRuns(baseline);
}

void addCompare(CLI::App& app, Action& action) {
    auto a = std::make_shared<CompareArguments>();
    auto* command = app.add_subcommand(
        "compare",
        "What became better or worse between runs, or differs between two engines, specs or time steps");
    command
        ->add_option("BEFORE", a->before,
                     "Run folder, several with commas between, or 'recorded': what the repository has on "
                     "record for the engine versions of AFTER")
        ->required();
    command->add_option("AFTER", a->after, "Run folder, or several; with --pair it may be left out");
    command
        ->add_option(
            "--pair", a->pairBy,
            "Compare what differs on purpose, in one run or two: engine (in one preset), spec (of one "
            "engine), dt (in one run each with the next finer)")
        ->check(CLI::IsMember({"engine", "spec", "dt"}));
    command
        ->add_option("--tolerance", a->options.tolerance,
                     "Errors that differ by a smaller share count as equal (default 0.01)")
        ->check(between(0.0, 10.0));
    command->add_option("--limit", a->most, "Lines of each list (default 20)");
    command->add_flag("--json", a->json, "Print the comparison as JSON");
    command->footer(
        "Exit codes: 0 no verdict and no error became worse (with --pair: there was something to compare), 1 "
        "some did,\n            2 bad command line, no run, or not one case to compare.");
    command->callback([a, &action] { action = [a] { return compare(*a); }; });
}

void addRecord(CLI::App& app, Action& action) {
    auto folder = std::make_shared<std::string>(), out = std::make_shared<std::string>();
    auto add = std::make_shared<bool>(false);
    auto* command = app.add_subcommand(
        "record",
        "Put the cases of a run on record: what `validate` and `compare recorded` hold later ones against");
    command->add_option("RUN", *folder, "Run folder")->required();
    command->add_option("--out", *out, "Folder of the records (default: the library's)");
    command->add_flag(
        "--add", *add,
        "Keep the numbers on record beside these: their range is then what counts as unchanged");
    command->callback(
        [folder, out, add, &action] { action = [folder, out, add] { return record(*folder, *out, *add); }; });
}

}  // namespace rigor::cli
