// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The clock of an engine's times, from its declared features.
#include <nlohmann/json.hpp>

#include "reports/model/view_model.hpp"

namespace rigor::report {

std::string clockOf(const results::EngineRow& engine) {
    const auto features = nlohmann::json::parse(engine.capabilities, nullptr, false);
    if (!features.is_object()) return "";
    const auto clock = features.find("clock");
    return clock != features.end() && clock->is_string() ? clock->get<std::string>() : "";
}

}  // namespace rigor::report
