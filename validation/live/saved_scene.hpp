// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Writes the displayed scene as a scenario file: named after its origin, with the settings of its engine.
#pragma once

#include <string>
#include <vector>

#include "adapters/interface/registry.hpp"

namespace rigor::validation {

struct SeenScene {
    std::string text;                ///< the scene of the moment (scene_now.hpp) as a scenario
    std::vector<std::string> notes;  ///< properties that could not be kept
    adapter::EngineSpec spec;        ///< spec of the engine that ran it
    double time = 0.0;               ///< [s] since the start of the scenario
};

/// A scenario file of its own: name, title and description say what it is, "engines" has the spec's options
/// (preset and precision apart, which belong to the command) beside those that `original`, the text of the
/// scenario that was opened, has for other engines. Throws scenario::LoadError where the scene is no valid
/// scenario any more (a body has left the range of the format).
std::string savedScenario(const SeenScene& seen, const std::string& original);

/// "slide_and_stop_at_1.25s": of the file that savedScenario makes.
std::string savedName(const std::string& scenario, double time);

}  // namespace rigor::validation
