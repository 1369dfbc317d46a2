// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/scenario_settings.hpp"

#include "scenarios/loader/engine_settings.hpp"

namespace rigor::validation {

adapter::EngineSpec withScenarioSettings(adapter::EngineSpec spec, const std::string& scenarioText) {
    for (const auto& [key, value] : scenario::engineSettings(scenarioText, spec.engine))
        spec.options.emplace(key, value);
    return spec;
}

}  // namespace rigor::validation
