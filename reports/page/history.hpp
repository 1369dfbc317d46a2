// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Several runs of the same scenarios after each other: each error and each time of a step over the runs.
#pragma once

#include <string>
#include <vector>

#include "reports/page/history_replays.hpp"
#include "validation/results/types.hpp"

namespace rigor::report {

/// The page. `comparisons`: what changed from each run to the next (`rigor compare --json`), "" where the two
/// have no case in common. `replays`: those that are beside the page.
std::string historyPage(const std::vector<results::Run>& runs, const std::vector<std::string>& comparisons,
                        const HistoryReplays& replays = {});

/// A row for each case of each run: run, started, scenario, spec, dt, metric, error, relative error, grade,
/// outcome, median time of a step with its interval.
std::string historyCsv(const std::vector<results::Run>& runs);

}  // namespace rigor::report
