// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Writes the reports of a stored run. Reads the results store alone; never runs a simulation.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "validation/results/types.hpp"

namespace rigor::report {

/// Beyond these a text is for programs alone, and compressed.
struct ReportLimits {
    std::size_t casesInPage =
        2000;  ///< the cases of the overview move to data/cases-<n>.js (about 4.5 KB a case), its lists to data/lists.js
    /// results.csv and fairness.csv become .csv.gz (about 14 KB a case uncompressed); tables of single scenarios are CSV
    /// alone, plots have no PDF (about 15 KB a plot)
    std::size_t cases = 5000;
    std::size_t tableRows = 2000;  ///< NAME.csv, .md and .tex of a table become NAME.csv.gz
};

/// Writes index.html, results.csv, summary.md, junit.xml into the run folder; returns the files written. What is damaged
/// or missing in the store and among the trajectories costs its own part of the reports; a sentence about each goes into
/// `problems`, and into summary.md.
std::vector<std::filesystem::path> writeReports(const std::filesystem::path& runDirectory,
                                                std::vector<std::string>* problems = nullptr,
                                                const ReportLimits& limits = {});

}  // namespace rigor::report
