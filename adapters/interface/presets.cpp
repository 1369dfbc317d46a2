// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/presets.hpp"

namespace rigor::adapter {

const std::vector<std::string>& usualPresets() {
    static const std::vector<std::string> names{"default", "matched"};
    return names;
}

std::vector<Preset> ownPresets(const Engine& engine) {
    const auto* with = dynamic_cast<const EngineWithPresets*>(&engine);
    return with == nullptr ? std::vector<Preset>{} : with->presets();
}

std::vector<std::string> presetNames(const std::vector<Preset>& own) {
    std::vector<std::string> names = usualPresets();
    for (const Preset& preset : own) names.push_back(preset.name);
    return names;
}

const std::string& presetValue(const Option& option, const std::string& preset,
                               const std::vector<Preset>& own) {
    if (preset == "default") return option.defaultValue;
    for (const Preset& p : own)
        if (p.name == preset)
            if (const auto value = p.values.find(option.key); value != p.values.end()) return value->second;
    return option.matchedValue;
}

}  // namespace rigor::adapter
