// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/page/history.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "cli/command.hpp"
#include "reports/encoding/text.hpp"
#include "validation/comparison/compare.hpp"
#include "validation/results/store.hpp"

namespace rigor::cli {
namespace {

namespace fs = std::filesystem;
using results::Run;

struct HistoryArguments {
    std::vector<std::string> runs;
    std::string out, pairBy;
    std::size_t replays = 2;
};

/// Changes from each run to the next; "" where the two have nothing to compare. Throws std::invalid_argument where the
/// runs are to differ on purpose and no two do.
std::vector<std::string> changesOf(const std::vector<Run>& runs, results::PairBy by) {
    validation::CompareOptions options;
    options.pairBy = by;
    std::vector<std::string> changes, refusals;
    for (std::size_t i = 1; i < runs.size(); ++i) {
        try {
            const auto comparison = validation::compareRuns({runs[i - 1]}, {runs[i]}, options);
            changes.push_back(validation::comparisonJson(comparison));
        } catch (const std::invalid_argument& error) {
            changes.emplace_back();
            refusals.push_back("runs " + std::to_string(i) + " and " + std::to_string(i + 1) + ": " +
                               error.what());
        }
    }
    if (by != results::PairBy::Nothing && refusals.size() == changes.size())
        throw std::invalid_argument("history --pair " + std::string(results::pairByName(by)) + ": " +
                                    refusals.front());
    for (const auto& refusal : refusals) std::fprintf(stderr, "rigor: %s\n", refusal.c_str());
    return changes;
}

std::vector<Run> readHistory(const std::vector<std::string>& folders, results::PairBy by) {
    if (folders.size() < 2)
        throw std::invalid_argument("history: found " + std::to_string(folders.size()) +
                                    " run, expected two or more, the oldest first");
    std::vector<Run> runs;
    try {
        for (const auto& folder : folders) runs.push_back(results::readRun(folder));
    } catch (const std::runtime_error& error) {
        throw std::invalid_argument(error.what());
    }
    for (std::size_t i = 1; i < runs.size(); ++i)
        for (std::size_t before = 0; before < i; ++before)
            if (fs::equivalent(runs[before].directory, runs[i].directory))
                throw std::invalid_argument("history: found " + runs[i].directory +
                                            " twice, expected folders of different runs" +
                                            (by == results::PairBy::Nothing
                                                 ? ""
                                                 : "; `rigor compare --pair` compares cases within a run"));
    return runs;
}

int history(const HistoryArguments& a) {
    const results::PairBy by = *results::parsePairBy(a.pairBy);
    const std::vector<Run> runs = readHistory(a.runs, by);
    const std::string csv = report::historyCsv(runs, by);
    const auto changes = changesOf(runs, by);
    const auto replays = report::historyReplays(runs, a.replays, by);
    const fs::path out(a.out);
    fs::create_directories(out);
    report::writeHistoryReplays(replays, out / "data");
    report::writeFile(out / "index.html", report::historyPage(runs, changes, replays, by));
    report::writeFile(out / "history.csv", csv);
    std::printf("%s\n%s\n", (out / "index.html").c_str(), (out / "history.csv").c_str());
    return kOk;
}

}  // namespace

void addHistory(CLI::App& app, Action& action) {
    auto a = std::make_shared<HistoryArguments>();
    auto* command =
        app.add_subcommand("history", "Errors and times over several runs on one page, with what changed");
    command->add_option("RUN", a->runs, "Run folders, the oldest first")
        ->required()
        ->check(CLI::ExistingDirectory);
    command->add_option("--out", a->out, "Folder of the page")->required();
    command
        ->add_option("--pair", a->pairBy,
                     "Runs that differ on purpose, each from the next: engine (in one preset), spec (of one "
                     "engine), dt; each run has one case of a kind")
        ->check(CLI::IsMember({"engine", "spec", "dt"}));
    command
        ->add_option(
            "--replays", a->replays,
            "Newest runs whose replays are copied beside the page, to be shown side by side; 0: none")
        ->capture_default_str();
    command->callback([a, &action] { action = [a] { return history(*a); }; });
}

}  // namespace rigor::cli
