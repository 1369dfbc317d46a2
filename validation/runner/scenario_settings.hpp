// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <string>

#include "adapters/interface/registry.hpp"

namespace rigor::validation {

/// `spec` with the settings that the scenario's text has for its engine, where the spec says nothing itself.
adapter::EngineSpec withScenarioSettings(adapter::EngineSpec spec, const std::string& scenarioText);

}  // namespace rigor::validation
