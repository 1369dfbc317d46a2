// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Writes the reports of a stored run. Reads the results store alone; never runs a simulation.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "validation/results/types.hpp"

namespace rigor::report {

/// Writes index.html, results.csv, summary.md, junit.xml into the run folder; returns the files written.
std::vector<std::filesystem::path> writeReports(const std::filesystem::path& runDirectory);

/// The same story for a terminal: at most `lines` lines, ANSI colours only when `colour`.
std::string terminalSummary(const results::Run& run, int lines, int columns, bool colour);

}  // namespace rigor::report
