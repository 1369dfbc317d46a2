// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Recorded expectations: what each version of each engine gave, as text files in the repository, one per
// engine and version. A change in either direction is seen against them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "validation/results/types.hpp"

namespace rigor::validation {

/// Writes `<engine>-<version>.csv` for every engine of the run that has cases: whole-scene values of the
/// metrics that each scenario names, verdicts, and a hash of the scenario's physics. Returns the files.
std::vector<std::filesystem::path> writeRecorded(const results::Run& run,
                                                 const std::filesystem::path& folder);

/// The records of the engine versions that took part in `run`, as a run to compare it with. Engines without
/// a record are in `missing` ("bullet 3.25"). Throws std::runtime_error for a damaged file.
results::Run readRecorded(const std::filesystem::path& folder, const results::Run& run,
                          std::vector<std::string>& missing);

}  // namespace rigor::validation
