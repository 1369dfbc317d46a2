// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Parts of a study.json as `rigor study` writes it.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace rigor::report::synthetic {

inline nlohmann::ordered_json studyRow(const std::string& scenario, const std::string& variant, double dt,
                                       const std::map<std::string, std::string>& parameters,
                                       const std::map<std::string, double>& metrics) {
    auto cells = nlohmann::ordered_json::object(), places = nlohmann::ordered_json::object();
    for (const auto& [key, value] : parameters) places[key] = value;
    for (const auto& [name, value] : metrics) cells[name] = {{"value", value}, {"unit", "m"}};
    return {{"scenario", scenario}, {"base", scenario},       {"parameters", places}, {"dt", dt},
            {"bodies", 3},          {"variant", variant},     {"spec", variant},      {"case", "0"},
            {"ran", true},          {"outcome", "completed"}, {"reason", ""},         {"metrics", cells}};
}

inline nlohmann::ordered_json studyPart(const std::string& name, const nlohmann::ordered_json& rows) {
    return {{"name", name}, {"title", "Part " + name}, {"description", "What it shows."}, {"rows", rows}};
}

}  // namespace rigor::report::synthetic
