// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Functions shared by importers: finding numbered recordings in a folder, reading their columns, names, and
// scenarios as JSON text.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "scenarios/model/math.hpp"
#include "validation/import/csv.hpp"

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

/// Frames per second of a table whose column `t` [s] rises steadily; what is within 0.1 % of a whole number
/// is that number. Throws LoadError: "import.time" (a line is off by more than a hundredth of a frame).
double steadyRate(const CsvTable& table);
/// Columns PREFIXx, PREFIXy, PREFIXz of a line.
scenario::Vec3 vectorAt(const CsvTable& table, std::size_t row, const std::string& prefix);
/// Columns PREFIXw, PREFIXx, PREFIXy, PREFIXz of a line, normalised. Throws LoadError: "import.quaternion"
/// (its length is off 1 by more than 0.001).
scenario::Quat unitQuaternionAt(const CsvTable& table, std::size_t row, const std::string& prefix);

nlohmann::ordered_json toJson(const scenario::Vec3& v);
nlohmann::ordered_json toJson(const scenario::Quat& q);  ///< w, x, y, z

/// Indented text of a scenario whose recording stands in reference.measured_motion: its lists of numbers on
/// one line each.
std::string scenarioText(nlohmann::ordered_json scenario);

}  // namespace rigor::validation
