// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cases through several runs: the same case of each run, or cases that differ on purpose from run to run.
#pragma once

#include <string>
#include <vector>

#include "reports/model/view_model.hpp"
#include "validation/results/pairing.hpp"

namespace rigor::report {

/// A case through the runs; null where a run does not have it.
struct CaseHistory {
    const results::ScenarioRow* scenario = nullptr;
    MainMetric metric;
    std::vector<const results::CaseRow*> cases;  ///< one for each run

    /// The case of the last run that has one.
    const results::CaseRow& newest() const;
};

/// Histories in the order in which they first appear, one for each results::pairKey. Specs that differ on purpose
/// are followed within their preset where a run has several of an engine. Throws std::invalid_argument, with the
/// scenario, the run and its cases, where a run has several cases for one history: which of them belongs to which
/// case of another run is not known.
std::vector<CaseHistory> historiesOf(const std::vector<results::Run>& runs, results::PairBy by);

/// The folder's own name, also of "runs/first/".
std::string folderName(const results::Run& run);

}  // namespace rigor::report
