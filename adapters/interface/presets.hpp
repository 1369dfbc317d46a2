// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Presets: names for whole sets of option values, the value of a spec's key "preset". Every engine has
// "default", as it ships, and "matched", as near as it comes to the settings common to all engines; Option
// holds their values. An engine that is meant to be used in further ways is an EngineWithPresets (found by
// dynamic_cast).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "adapters/interface/engine.hpp"

namespace rigor::adapter {

/// A preset of an engine's own.
struct Preset {
    std::string name;                           ///< snake_case, not one of usualPresets()
    std::map<std::string, std::string> values;  ///< values by key of Option; other keys have their matched
                                                ///< values
};

class EngineWithPresets : public Engine {
  public:
    virtual std::vector<Preset> presets() const = 0;
};

/// "default" and "matched". Bounds and recorded deviations of scenarios are written for these alone.
const std::vector<std::string>& usualPresets();

/// The engine's own presets; empty for most engines.
std::vector<Preset> ownPresets(const Engine& engine);

/// The usual names, then the own ones in their order.
std::vector<std::string> presetNames(const std::vector<Preset>& own);

/// Value of an option in a preset that is one of presetNames(own).
const std::string& presetValue(const Option& option, const std::string& preset,
                               const std::vector<Preset>& own);

}  // namespace rigor::adapter
