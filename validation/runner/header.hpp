// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Header of a run, before its first case: engines, scenarios, environment, commands.
#pragma once

#include "validation/runner/runner.hpp"

namespace rigor::validation {

/// Checks of the references of all scenarios of a plan, by scenario name: those of the options, and for the
/// others the results of a child.
std::map<std::string, ReferenceCheck> plannedReferences(const std::vector<CasePlan>& plan,
                                                        const RunOptions& options);

/// Engines of the plan and auditors, scenarios in plan order, environment.
results::Run runHeader(const std::vector<CasePlan>& plan, const RunOptions& options,
                       const std::vector<EngineDescription>& engines,
                       const std::map<std::string, ReferenceCheck>& references);

/// The command that prints the numbers of a case again. `fromLibrary`: the scenario is the library's own of
/// that name, otherwise the file stored with the run is named.
std::string reproduceCommand(const CasePlan& plan, const std::filesystem::path& run, bool fromLibrary);

/// True if loading `name` from the library gives exactly this text.
bool isLibraryScenario(const std::string& name, const std::string& text);

/// Writes <run>/scenarios/<name>.json for every scenario of the plan.
void writeScenarioFiles(const std::vector<CasePlan>& plan, const std::filesystem::path& run);

}  // namespace rigor::validation
