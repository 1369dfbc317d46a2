// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// JSON text with the place of every value, so that a message can name the line of what is wrong.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scenarios/json/problem.hpp"

namespace rigor::scenario {

using Json = nlohmann::json;

/// Deeper files are refused before anything parses them: a scenario needs about ten levels.
inline constexpr int kMaxDepth = 64;
inline constexpr std::size_t kMaxBytes = 64u << 20;
inline constexpr std::size_t kMaxValues = 5000000;  ///< more than a height field of 2000 x 2000 has

struct JsonDocument {
    Json value;
    std::map<std::string, int> lines;  ///< JSON pointer -> 1-based line where the value starts
    /// Line of the value or, where it has none, of the nearest enclosing one.
    int lineOf(std::string pointer) const;
};

/// Parses strict JSON. Throws LoadError: "json.depth", "json.size", "json.syntax", "json.number",
/// "json.duplicate_key".
JsonDocument parseDocument(const std::string& text, const std::string& fileName);

/// One token of a JSON pointer, escaped (RFC 6901).
std::string escapeToken(const std::string& token);

/// Type and value for a message, shortened: `string "abc"`, `number 7`, `array of 3`.
std::string describe(const Json& value);

}  // namespace rigor::scenario
