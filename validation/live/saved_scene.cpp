// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/live/saved_scene.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "scenarios/loader/loader.hpp"

namespace rigor::validation {
namespace {

using Json = nlohmann::ordered_json;

std::string inSeconds(double time) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", time);
    return text;
}

/// Value of an option as in a file: a number if the option is one.
Json optionValue(const std::string& text) {
    const Json parsed = Json::parse(text, nullptr, false);
    return parsed.is_number() ? parsed : Json(text);
}

}  // namespace

std::string savedName(const std::string& scenario, double time) {
    constexpr std::size_t kMost = 64;  // maximum length of a name in the format
    const std::string end = "_at_" + inSeconds(time) + "s";
    return scenario.substr(0, kMost - end.size()) + end;
}

std::string savedScenario(const SeenScene& seen, const std::string& original) {
    Json out = Json::parse(seen.text);
    const Json from = Json::parse(original);
    const std::string name = out.at("name"), title = out.at("title");
    out["name"] = savedName(name, seen.time);
    out["title"] = title + ", seen at t = " + inSeconds(seen.time) + " s";
    std::string description = "The scene of '" + name + "' as " + seen.spec.text() + " had it after " +
                              inSeconds(seen.time) + " s.";
    for (const std::string& note : seen.notes) description += " Not kept: " + note + ".";
    out["description"] = description;
    Json engines = from.value("engines", Json::object());
    for (const auto& [key, value] : seen.spec.options)
        if (key != "preset" && key != "precision") engines[seen.spec.engine][key] = optionValue(value);
    if (!engines.empty()) out["engines"] = engines;
    const std::string text = out.dump(1) + "\n";
    (void)scenario::loadScenarioText(text, out["name"].get<std::string>() + ".json");
    return text;
}

}  // namespace rigor::validation
