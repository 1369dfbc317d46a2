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

/// Changes from each run to the next; "" where the two have no case in common.
std::vector<std::string> changesOf(const std::vector<Run>& runs) {
    std::vector<std::string> changes;
    for (std::size_t i = 1; i < runs.size(); ++i) {
        try {
            changes.push_back(
                validation::comparisonJson(validation::compareRuns({runs[i - 1]}, {runs[i]}, {})));
        } catch (const std::invalid_argument&) {
            changes.emplace_back();
        }
    }
    return changes;
}

int history(const std::vector<std::string>& folders, const fs::path& out, std::size_t newest) {
    if (folders.size() < 2)
        throw std::invalid_argument("history: found " + std::to_string(folders.size()) +
                                    " run, expected two or more, the oldest first");
    std::vector<Run> runs;
    try {
        for (const auto& folder : folders) runs.push_back(results::readRun(folder));
    } catch (const std::runtime_error& error) {
        throw std::invalid_argument(error.what());
    }
    fs::create_directories(out);
    const auto replays = report::historyReplays(runs, newest);
    report::writeHistoryReplays(replays, out / "data");
    report::writeFile(out / "index.html", report::historyPage(runs, changesOf(runs), replays));
    report::writeFile(out / "history.csv", report::historyCsv(runs));
    std::printf("%s\n%s\n", (out / "index.html").c_str(), (out / "history.csv").c_str());
    return kOk;
}

}  // namespace

void addHistory(CLI::App& app, Action& action) {
    struct Arguments {
        std::vector<std::string> runs;
        std::string out;
        std::size_t replays = 2;
    };
    auto a = std::make_shared<Arguments>();
    auto* command =
        app.add_subcommand("history", "Errors and times over several runs on one page, with what changed");
    command->add_option("RUN", a->runs, "Run folders, the oldest first")
        ->required()
        ->check(CLI::ExistingDirectory);
    command->add_option("--out", a->out, "Folder of the page")->required();
    command
        ->add_option(
            "--replays", a->replays,
            "Newest runs whose replays are copied beside the page, to be shown side by side; 0: none")
        ->capture_default_str();
    command->callback([a, &action] { action = [a] { return history(a->runs, a->out, a->replays); }; });
}

}  // namespace rigor::cli
