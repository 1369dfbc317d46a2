// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <filesystem>
#include <string>

#include "scenarios/json/json_text.hpp"

namespace rigor::scenario {

/// Replaces or adds one value: "bodies.block.velocity=[3.1,0,0.2]". Array elements are found by index or by
/// their "name"; keys that themselves hold dots are tried longest first. Throws LoadError (id "override.*").
void applyOverride(JsonDocument& document, const std::string& text, const std::string& fileName);

std::string readTextFile(const std::filesystem::path& file);

}  // namespace rigor::scenario
