// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <string>

#include "scenarios/json/json_text.hpp"

namespace rigor::scenario {

/// Holds a document against scenarios/schema/scenario.schema.json (built into the program). Throws LoadError
/// ("schema.violation").
void checkScenarioSchema(const JsonDocument& document, const std::string& fileName);
/// The same checks against suite.schema.json, collision.schema.json and study.schema.json.
void checkSuiteSchema(const JsonDocument& document, const std::string& fileName);
void checkCollisionSchema(const JsonDocument& document, const std::string& fileName);
void checkStudySchema(const JsonDocument& document, const std::string& fileName);

}  // namespace rigor::scenario
