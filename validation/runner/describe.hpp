// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "validation/runner/runner.hpp"
#include "validation/runner/scratch_folder.hpp"

namespace rigor::validation {

/// The child's side of describeEngine: `__describe SPEC ANSWER_FILE`.
int describeChild(const std::string& engine, const std::filesystem::path& answer);

/// Capabilities, options and presets as the store and the live view have them
/// (results::EngineRow::capabilities): {"capabilities": {...}, "presets": [names], "options": [{"key", "values",
/// "min", "max", "integer", "help", "presets": {name: value}}]}. A limit that is not there is null. "" for an
/// engine that could not be loaded.
std::string capabilitiesText(const EngineDescription& description);

/// Describes several engines, `jobs` at a time. This process describes a module once, unless its file has changed
/// since.
std::vector<EngineDescription> describeEngines(const std::vector<std::string>& engines,
                                               const std::filesystem::path& binary, int jobs);

/// Specs that name no preset, once for every preset of their engine; for engines that can not be described
/// the usual ones.
std::vector<adapter::EngineSpec> withAllPresets(const std::vector<adapter::EngineSpec>& specs,
                                                const std::filesystem::path& binary);

/// Throws BadInput for keys and values of a spec that the described engine does not have; no library is
/// loaded.
void checkSettings(const adapter::EngineSpec& spec, const EngineDescription& description);

/// Throws BadInput for an engine that is not installed, and for a key or value of a spec that its engine does
/// not have. An engine that can not be described is left to its cases, which report what became of it.
void checkSpecs(const std::vector<adapter::EngineSpec>& specs, const std::filesystem::path& binary);

/// The same of every spec of a plan, with the settings that scenarios give engines; to be called before
/// anything is run or written.
void checkPlan(const std::vector<CasePlan>& plan, const std::filesystem::path& binary);

}  // namespace rigor::validation
