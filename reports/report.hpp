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

/// Writes index.html, results.csv, summary.md, junit.xml into the run folder; returns the files written. What is damaged
/// or missing in the store and among the trajectories costs its own part of the reports; a sentence about each goes into
/// `problems`, and into summary.md.
std::vector<std::filesystem::path> writeReports(const std::filesystem::path& runDirectory,
                                                std::vector<std::string>* problems = nullptr);

}  // namespace rigor::report
