// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The engine's settings of a spec and a scenario, for worlds that are made outside a run.
#pragma once

#include <string>

#include "adapters/interface/registry.hpp"
#include "adapters/rigor/parts.hpp"
#include "scenarios/loader/engine_settings.hpp"

namespace rigor::adapter {

/// `spec` is 'rigor' with keys and values; those that the scenario has for this engine (`scenarioText`, its JSON) hold
/// where the spec has none. Throws BadInput for another engine, an unknown key or value.
inline Settings settingsOf(const std::string& spec, const std::string& scenarioText) {
    EngineSpec parsed = parseSpec(spec);
    if (parsed.engine != "rigor")
        throw BadInput("found the engine '" + parsed.engine +
                       "', expected rigor: other engines run in processes of their own (rigor.validate)");
    for (const auto& [key, value] : scenario::engineSettings(scenarioText, parsed.engine))
        parsed.options.emplace(key, value);
    return resolveSettings(parsed, *makeRigorEngine());
}

}  // namespace rigor::adapter
