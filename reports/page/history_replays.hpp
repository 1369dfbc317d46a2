// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Replays of a history: those that the reports of its newest runs have of the same scenario at the same time step. They
// are copied beside the page of the history, which shows them side by side; one copy serves all runs where it is the same.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "validation/results/pairing.hpp"
#include "validation/results/types.hpp"

namespace rigor::report {

struct HistoryReplays {
    struct File {
        std::filesystem::path from;  ///< data file of a run's report
        std::string name;            ///< its name beside the page of the history
    };
    std::vector<File> files;
    std::map<std::tuple<std::size_t, std::string, double>, std::string>
        names;                                  ///< names of replays by run, scenario, dt
    std::map<std::string, std::string> scenes;  ///< names of the data files of scenarios
    std::map<std::string, std::string> texts;   ///< the scenario files, by the names of their data files
};

/// Replays of the `newest` last runs that at least two of them have: of the same scenario at the same time step, or at
/// any where the runs differ in that. Throws std::runtime_error where one cannot be read.
HistoryReplays historyReplays(const std::vector<results::Run>& runs, std::size_t newest,
                              results::PairBy by = results::PairBy::Nothing);

/// Copies the files and writes the scenarios. Throws std::runtime_error where one cannot be read or written.
void writeHistoryReplays(const HistoryReplays& replays, const std::filesystem::path& folder);

}  // namespace rigor::report
