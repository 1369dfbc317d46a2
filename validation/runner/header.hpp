// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Header of a run, before its first case: engines, scenarios, environment, commands.
#pragma once

#include "validation/runner/runner.hpp"

namespace rigor::validation {

/// Keys of the environment of a shard: "2/8"; hash of the ids of the whole plan; number of its cases.
inline constexpr const char* kShardKey = "shard";
inline constexpr const char* kPlanKey = "shard_plan";
inline constexpr const char* kPlannedKey = "shard_planned";
/// Key of the version of the program that made a shard.
inline constexpr const char* kShardVersionKey = "shard_version";
/// Key of the machine that ran the cases (a hash of its name), and of those that ran earlier parts of the run.
inline constexpr const char* kMachineKey = "machine";
inline constexpr const char* kEarlierMachinesKey = "earlier_machines";

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

/// Marks the scenarios whose names, loaded from the library, give exactly their texts.
std::map<std::string, bool> inLibrary(const std::vector<results::ScenarioRow>& scenarios);

/// Writes <run>/scenarios/<name>.json for every scenario of the plan.
void writeScenarioFiles(const std::vector<CasePlan>& plan, const std::filesystem::path& run);

}  // namespace rigor::validation
