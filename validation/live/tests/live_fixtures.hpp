// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Engines and scenarios for the tests of instances and sessions.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>

#include "adapters/interface/registry.hpp"

namespace rigor::validation::fixtures {

/// The engines of this build and the test doubles.
inline void useEngines() {
    setenv("RIGOR_ADAPTER_PATH", RIGOR_BINARY_DIR "/bin/adapters:" RIGOR_BINARY_DIR "/tests/doubles", 1);
}

inline bool hasEngine(const std::string& name) {
    useEngines();
    const auto all = adapter::availableEngines();
    return std::find(all.begin(), all.end(), name) != all.end();
}

inline std::string childProgram() {
    return RIGOR_BINARY_DIR "/tests/live_child";
}

/// A block that slides over a floor, and a ball that falls beside it.
inline std::string slidingBlock() {
    return R"({"rigor": 1, "name": "slide", "title": "A block slides", "dimension": 3, "isolates": ["friction"],
  "source": "none", "gravity": [0, -9.81, 0], "duration": 2, "dt": [0.008333333333333333],
  "materials": {"wood": {"friction": 0.4, "restitution": 0.0}},
  "bodies": [
    {"name": "floor", "type": "static", "position": [0, -0.5, 0],
     "shapes": [{"box": {"half_extents": [20, 0.5, 20]}, "material": "wood"}]},
    {"name": "block", "mass": 2, "position": [0, 0.25, 0], "velocity": [2, 0, 0],
     "shapes": [{"box": {"half_extents": [0.25, 0.25, 0.25]}, "material": "wood"}]},
    {"name": "ball", "mass": 1, "position": [0, 3, 2], "shapes": [{"sphere": {"radius": 0.2}, "material": "wood"}]}],
  "reference": {"sliding_stop": {"body": "block", "on": "floor"}}, "accept": {"rigor": {"position_final": 0.02}}})";
}

/// Waits for `condition`, at most 20 s.
inline bool eventually(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (std::chrono::steady_clock::now() < end) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
}

}  // namespace rigor::validation::fixtures
