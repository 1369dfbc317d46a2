// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/loader/engine_settings.hpp"

#include "scenarios/json/node.hpp"

namespace rigor::scenario {

std::map<std::string, std::string> engineSettings(const std::string& text, const std::string& engine) {
    std::map<std::string, std::string> settings;
    if (text.find("\"engines\"") == std::string::npos) return settings;
    const Json document = Json::parse(text, nullptr, false);
    if (!document.is_object() || !document.contains("engines")) return settings;
    const Json& engines = document["engines"];
    if (!engines.is_object() || !engines.contains(engine)) return settings;
    for (const auto& [key, value] : engines[engine].items())
        settings[key] = value.is_string() ? value.get<std::string>() : value.dump();
    return settings;
}

void checkEngineSettings(const Node& engines) {
    for (const auto& [engine, settings] : engines.members())
        for (const auto& [key, value] : settings.members())
            if (!value.json().is_string() && !value.json().is_number())
                value.problem("engines.value", "a word or a number, as in a spec: \"solver\": \"pgs\"");
}

}  // namespace rigor::scenario
