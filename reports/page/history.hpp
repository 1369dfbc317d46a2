// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Several runs of the same scenarios after each other: each error and each time of a step over the runs.
#pragma once

#include <string>
#include <vector>

#include "reports/page/history_replays.hpp"
#include "validation/results/pairing.hpp"
#include "validation/results/types.hpp"

namespace rigor::report {

/// The page. `comparisons`: what changed from each run to the next (`rigor compare --json`), "" where the two
/// have nothing to compare. `replays`: those that are beside the page. `by`: the deliberate difference of the runs; throws
/// as historiesOf().
std::string historyPage(const std::vector<results::Run>& runs, const std::vector<std::string>& comparisons,
                        const HistoryReplays& replays = {}, results::PairBy by = results::PairBy::Nothing);

/// A row for each case of each run (reports/FORMATS.md).
std::string historyCsv(const std::vector<results::Run>& runs, results::PairBy by = results::PairBy::Nothing);

}  // namespace rigor::report
