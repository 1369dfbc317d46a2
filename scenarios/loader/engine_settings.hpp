// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Settings that a scenario file may give for engines by name, as in a spec. They are no part of the scenario
// model, which knows no engine.
#pragma once

#include <map>
#include <string>

namespace rigor::scenario {

class Node;

/// The settings of `engine` in a scenario's text as loaded: {"solver": "pgs"} for
/// "engines": { "rigor": { "solver": "pgs" } }. Empty where it has none.
std::map<std::string, std::string> engineSettings(const std::string& text, const std::string& engine);

/// Checks the form of "engines"; whether an engine has such a key is for the engine to say.
void checkEngineSettings(const Node& engines);

}  // namespace rigor::scenario
