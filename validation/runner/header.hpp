// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What a run says of itself before its first case: engines, scenarios, environment, commands.
#pragma once

#include "validation/runner/runner.hpp"

namespace rigor::validation {

/// What there is to know of the reference of every scenario of a plan, by its name: what the options have,
/// and for the others what a child finds.
std::map<std::string, ReferenceCheck> plannedReferences(const std::vector<CasePlan>& plan,
                                                        const RunOptions& options);

/// Engines of the plan and auditors, scenarios in plan order, environment.
results::Run runHeader(const std::vector<CasePlan>& plan, const RunOptions& options,
                       const std::vector<EngineDescription>& engines,
                       const std::map<std::string, ReferenceCheck>& references);

/// The command that prints the numbers of a case again. `fromLibrary`: the scenario is the library's own of
/// that name, otherwise the file stored with the run is named.
std::string reproduceCommand(const CasePlan& plan, const std::filesystem::path& run, bool fromLibrary);

/// Whether loading `name` from the library gives exactly this text.
bool isLibraryScenario(const std::string& name, const std::string& text);

/// Writes <run>/scenarios/<name>.json for every scenario of the plan.
void writeScenarioFiles(const std::vector<CasePlan>& plan, const std::filesystem::path& run);

}  // namespace rigor::validation
