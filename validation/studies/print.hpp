// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A study's tables as text, JSON, CSV and Markdown.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "validation/studies/study.hpp"

namespace rigor::validation {

/// One table per part, then the symptoms with their verdicts.
std::string studyText(const StudyResult& result);
nlohmann::ordered_json studyJson(const StudyResult& result);

/// Writes study.csv, study.md and study.json into the run's folder. Throws std::runtime_error.
std::vector<std::filesystem::path> writeStudyFiles(const StudyResult& result,
                                                   const std::filesystem::path& folder,
                                                   const std::string& command);

}  // namespace rigor::validation
