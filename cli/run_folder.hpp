// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The folder of a run: chosen, checked and made before anything runs. Throws std::invalid_argument for what
// the caller has to change.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "validation/runner/runner.hpp"

namespace rigor::cli {

/// `out`, else runs/<title>-<UTC time>, or the latest of them to resume.
std::filesystem::path chooseRunFolder(const std::string& out, bool resume, const std::string& title);

/// A folder that can hold this run: said before anything runs.
void prepareRunFolder(const std::filesystem::path& directory, bool resume);

/// Resuming with other scenarios or engines would drop finished cases: that is refused. Other time steps or a
/// changed file are not.
void checkResumed(const std::filesystem::path& directory, const std::vector<validation::CasePlan>& plan);

/// Command that goes on with a run in `directory` that `command` had begun or, if `resumed`, gone on with. `namesFolder`: it
/// has `--out`.
std::string commandToGoOn(std::string command, const std::filesystem::path& directory, bool resumed,
                          bool namesFolder);

}  // namespace rigor::cli
