// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What importers share: finding numbered recordings in a folder, names, and scenarios as JSON text.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "scenarios/model/math.hpp"

namespace rigor::validation {

/// The files PREFIX_NNN.csv of `from`, or of its sub-folder `inside` where there is one, by number; the table
/// PREFIX_OTHER.csv is passed over. Throws LoadError: "import.folder" (none), "import.name" (no number),
/// "import.duplicate" (a number twice).
std::map<int, std::filesystem::path> numberedRecordings(const std::filesystem::path& from,
                                                        const std::string& prefix,
                                                        const std::string& inside = "",
                                                        const std::string& other = "");
/// "PREFIX_007": at least `digits` digits.
std::string numberedName(const std::string& prefix, int number, std::size_t digits);

nlohmann::ordered_json toJson(const scenario::Vec3& v);
nlohmann::ordered_json toJson(const scenario::Quat& q);  ///< w, x, y, z

/// Indented text of a scenario whose recording stands in reference.measured_motion: its lists of numbers on
/// one line each.
std::string scenarioText(nlohmann::ordered_json scenario);

}  // namespace rigor::validation
