// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Results of a child process for its parent, as JSON files that are either whole or not there.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "validation/results/types.hpp"

namespace rigor::validation {

/// Every double comes back with the same value: NaN and infinities as text.
nlohmann::json caseToJson(const results::CaseRow& row);
results::CaseRow caseFromJson(const nlohmann::json& json);
nlohmann::json auditToJson(const results::AuditRow& row);
results::AuditRow auditFromJson(const nlohmann::json& json);

/// A double as JSON: a number, or "nan", "inf", "-inf".
nlohmann::json numberToJson(double value);
double numberFromJson(const nlohmann::json& json);
/// A double in a file for other programs: a number, or null where it is not finite.
nlohmann::json finiteToJson(double value);

/// Writes beside the target and renames. Throws results::EnvironmentError.
void writeJsonFile(const std::filesystem::path& file, const nlohmann::json& json);
/// Empty when there is no file or it is no JSON. Throws results::EnvironmentError if the system refuses to read it.
std::optional<nlohmann::json> readJsonFile(const std::filesystem::path& file);

}  // namespace rigor::validation
