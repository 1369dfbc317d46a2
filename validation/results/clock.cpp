// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/clock.hpp"

#include <nlohmann/json.hpp>

namespace rigor::results {

std::string clockOf(const EngineRow& engine) {
    const auto features = nlohmann::json::parse(engine.capabilities, nullptr, false);
    if (!features.is_object()) return "";
    const auto clock = features.find("clock");
    return clock != features.end() && clock->is_string() ? clock->get<std::string>() : "";
}

}  // namespace rigor::results
