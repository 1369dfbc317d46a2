// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A finished set of queries as text, JSON, CSV and Markdown.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "validation/collide/collide.hpp"

namespace rigor::validation {

/// Everything that is known, every double with its round-trip digits.
nlohmann::ordered_json collideJson(const CollideRun& run);

/// One line per case and engine, then one per engine. `all`: also the right results, however many; otherwise
/// the wrong ones when there are more than a page of results.
std::string collideText(const CollideRun& run, bool all);

/// Writes collide.json, collide.csv and summary.md. Throws std::runtime_error.
std::vector<std::filesystem::path> writeCollideFiles(const CollideRun& run,
                                                     const std::filesystem::path& folder,
                                                     const std::string& command);

}  // namespace rigor::validation
