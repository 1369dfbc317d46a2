// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/state/settings.hpp"

#include <algorithm>
#include <sstream>

#include "engine/core/error.hpp"

namespace rigor::engine {
namespace {

/// "min..max" of numbers as they are written in settings.def.
template <class T>
void requireWithin(T value, bool within, const char* key, const char* min, const char* max) {
    if (within) return;
    std::ostringstream message;
    message << "found " << value << ", expected a number in " << min << ".." << max;
    throw EngineError(key, message.str());
}

/// False for NaN. The bounds are rounded to the precision of the value.
template <class T>
bool isWithin(T value, double min, double max) {
    return value >= static_cast<T>(min) && value <= static_cast<T>(max);
}

}  // namespace

const std::vector<SettingInfo>& settings() {
    static const std::vector<SettingInfo> all{
#define CHOICE(member, key, byDefault, help) {key, SettingKind::Algorithm, byDefault, 0, 0, help},
#define INTEGER(member, key, byDefault, min, max, help) \
    {key, SettingKind::Integer, #byDefault, min, max, help},
#define REAL(member, key, byDefault, min, max, help) {key, SettingKind::Real, #byDefault, min, max, help},
#define SWITCH(member, key, byDefault, help) \
    {key, SettingKind::Switch, (byDefault) ? "on" : "off", 0, 0, help},
#include "engine/state/settings.def"
    };
    return all;
}

const SettingInfo& setting(const std::string& key) {
    const auto found = std::find_if(settings().begin(), settings().end(),
                                    [&](const SettingInfo& info) { return info.key == key; });
    if (found == settings().end()) throw EngineError("setting_key", "no setting has the key " + key);
    return *found;
}

template <class S>
void checkSettings(const WorldDef<S>& def) {
#define INTEGER(member, key, byDefault, min, max, help) \
    requireWithin(def.member, isWithin(def.member, min, max), key, #min, #max);
#define REAL(member, key, byDefault, min, max, help) \
    requireWithin(def.member, isWithin(def.member, min, max), key, #min, #max);
#include "engine/state/settings.def"
    if (def.pyramidDirections % 2 != 0)
        throw EngineError("pyramid_directions", "pyramid_directions must be even");
}

#define RIGOR_INSTANTIATE(S) template void checkSettings<S>(const WorldDef<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
