// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Imports as tests make them: a data set by name, its scenarios loaded, its refusals as text.
#pragma once

#include <map>
#include <string>

#include "scenarios/loader/loader.hpp"
#include "validation/import/importer.hpp"

namespace rigor::validation::testing {

inline Imported importFrom(const std::string& dataSet, const std::filesystem::path& folder,
                           const std::map<std::string, std::string>& options = {}) {
    const ImporterEntry& importer = findImporter(dataSet);
    return importer.read({folder, "all", "", resolveChoices(importer, options)});
}

inline scenario::Scenario loaded(const ImportedScenario& s) {
    return scenario::loadScenarioText(s.text, s.name).scenario;
}

inline std::string refusal(const std::string& dataSet, const std::filesystem::path& folder,
                           const std::map<std::string, std::string>& options = {}) {
    try {
        importFrom(dataSet, folder, options);
        return "";
    } catch (const std::exception& error) {
        return error.what();
    }
}

}  // namespace rigor::validation::testing
