// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/merge.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "cli/command.hpp"
#include "reports/report.hpp"
#include "reports/summaries/terminal.hpp"
#include "validation/runner/runner.hpp"

namespace rigor::cli {
namespace {

int merge(const validation::MergeOptions& options) {
    const auto run = validation::mergeShards(options);
    report::writeReports(options.out);
    std::printf(
        "%s\n",
        report::terminalSummary(run, 40, terminalColumns(STDOUT_FILENO), wantsColour(STDOUT_FILENO)).c_str());
    if (const auto it = run.environment.find("merged"); run.finished.empty() && it != run.environment.end())
        std::fprintf(stderr, "rigor: merged %s\n", it->second.c_str());
    return endOfRun(run);
}

}  // namespace

void addMerge(CLI::App& app, Action& action) {
    auto a = std::make_shared<validation::MergeOptions>();
    auto* command = app.add_subcommand(
        "merge", "Make one run of the shards of `rigor validate --shard K/N`, with its report");
    command->add_option("SHARD", a->shards, "Run folders of the shards")->required();
    command->add_option("--out", a->out, "Run folder; one of an interrupted merge goes on")->required();
    command->add_flag("--partial", a->partial,
                      "Merge although shards are missing or unfinished; the run stays unfinished");
    command->footer(
        "Exit codes: 0 merged and green, 1 merged and something is red, 2 the shards do not fit together,\n"
        "            4 every case is unsupported, 6 as of `validate`, 7 the environment failed (no space, "
        "damaged files).");
    command->callback([a, &action] {
        action = [a] {
            a->command = ownCommandLine();
            return merge(*a);
        };
    });
}

}  // namespace rigor::cli
