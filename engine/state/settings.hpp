// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The settings of a world as data (settings.def): for programs that offer them to people.
#pragma once

#include <string>
#include <vector>

#include "engine/state/world_def.hpp"

namespace rigor::engine {

enum class SettingKind { Algorithm, Integer, Real, Switch };

struct SettingInfo {
    std::string key;  ///< "velocity_iterations"
    SettingKind kind = SettingKind::Real;
    std::string byDefault;    ///< a name, a number as it is written in settings.def, or "on", "off"
    double min = 0, max = 0;  ///< range of numbers, inclusive
    std::string help;
};

/// All of them, in the order of settings.def.
const std::vector<SettingInfo>& settings();

/// The setting of that key. Throws EngineError "setting_key".
const SettingInfo& setting(const std::string& key);

/// Throws an EngineError whose id is the key of the first number that is not within its range.
template <class S>
void checkSettings(const WorldDef<S>& def);

/// Sets every setting by `get`: get.text(key), get.integer(key), get.real(key), get.on(key).
template <class S, class Get>
void assignSettings(WorldDef<S>& def, const Get& get) {
    using Real = typename S::Real;
#define CHOICE(member, key, byDefault, help) def.member = get.text(key);
#define INTEGER(member, key, byDefault, min, max, help) def.member = get.integer(key);
#define REAL(member, key, byDefault, min, max, help) def.member = static_cast<Real>(get.real(key));
#define SWITCH(member, key, byDefault, help) def.member = get.on(key);
#include "engine/state/settings.def"
}

}  // namespace rigor::engine
