// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A spec's settings as the engine's WorldDef, and what they mean for the parity ledger.
#pragma once

#include <vector>

#include "adapters/interface/types.hpp"
#include "adapters/rigor/convert_shape.hpp"
#include "adapters/rigor/foreign_narrow_phase.hpp"
#include "engine/state/settings.hpp"

namespace rigor::adapter {

Capabilities rigorCapabilities();

/// A spec's settings, as engine::assignSettings reads them.
struct SpecSettings {
    const Settings& settings;
    std::string text(const char* key) const { return textSetting(settings, key); }
    int integer(const char* key) const { return integerSetting(settings, key); }
    double real(const char* key) const { return numberSetting(settings, key); }
    bool on(const char* key) const { return textSetting(settings, key) == "on"; }
};

/// Throws BadInput for settings that are missing or malformed.
template <class S>
engine::WorldDef<S> toWorldDef(const Scenario& scenario, const Settings& settings) {
    engine::WorldDef<S> def;
    def.gravity = toEngineVec<S>(scenario.gravity);
    engine::assignSettings(def, SpecSettings{settings});
    if (isForeignNarrowPhase(def.narrowPhase)) {
        if constexpr (S::dim == 3)
            def.customNarrowPhase = makeForeignNarrowPhase<S>(def.narrowPhase);
        else
            throw notInAdapter("rigor", "narrow_phase=" + def.narrowPhase + " in 2D");
    }
    return def;
}

/// True if the combine rules of the settings are those of the scenario format, sqrt(mu_a mu_b) and min(e_a,
/// e_b).
bool combinesAsScenarios(const Settings& settings);

/// The ledger that follows from the settings. `bounces`: some pair has a restitution above zero; `substep`:
/// what the solver steps by [s].
std::vector<LedgerEntry> settingsLedger(const Scenario& scenario, const Settings& settings, bool bounces,
                                        double substep);

}  // namespace rigor::adapter
