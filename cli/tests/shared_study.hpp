// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A study that is run in shards, and what its tables have to have in common with those of the whole study.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace rigor::cli_test {

/// Two scenarios on two engines, with runs that are derived from them.
constexpr const char* kSharedStudy = R"({"rigor_study": 1, "name": "shared", "parts": [
    {"name": "masses", "scenarios": ["slide_and_stop", "free_flight"], "dt": [0.01],
     "metrics": ["position_final", "time.step"], "variants": ["rigor", "ode:preset=matched"],
     "symmetries": ["mirror", "time_reversal"]}]})";

/// Tables without what differs from run to run.
inline nlohmann::json timeless(const std::string& text) {
    nlohmann::json parts = nlohmann::json::parse(text).at("parts");
    for (nlohmann::json& part : parts)
        for (nlohmann::json& row : part.at("rows")) row.at("metrics").erase("time.step");
    return parts;
}

}  // namespace rigor::cli_test
