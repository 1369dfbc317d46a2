// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Request to a child of the bench and its result, as JSON.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "validation/bench/timed_work.hpp"

namespace rigor::validation {

inline constexpr const char* kScenePart = "scene";

nlohmann::json repetitionToJson(const results::BenchRepetition& repetition);
results::BenchRepetition repetitionFromJson(const nlohmann::json& json);
nlohmann::json plannedToJson(const PlannedBench& planned);
PlannedBench plannedFromJson(const nlohmann::json& json);

/// A scene ready to be stepped; `text` is its scenario, `parameters` of `planned` hold spec and dt.
std::unique_ptr<TimedWork> makeSceneCase(const PlannedBench& planned, const std::string& text);

/// One repetition in this process: `rigor __bench <request.json>`.
int benchChild(const std::filesystem::path& request);

}  // namespace rigor::validation
