// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Short names for engine specs in rows and legends: a spec with ten options is longer than a line.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace rigor::results {

/// Presets that every engine has (adapters/interface/presets.hpp): as it ships, and as near as it comes to
/// the settings common to all engines. Any other preset is an engine's own.
inline constexpr const char* kDefaultPreset = "default";
inline constexpr const char* kMatchedPreset = "matched";

/// A label for each of the specs, no two the same: the engine and the options in which specs of this list
/// differ. Left out are a preset that is common to all specs with one (unless that would make two specs one),
/// and options that all of an engine's specs have (if it has several). An option whose value is a word is
/// shown by the value alone: `rigor octree f32`. A label that would be longer than 36 characters is numbered:
/// `rigor[1]`, in the order of the list. Labels follow from the list alone; they are explained where they are
/// used.
std::map<std::string, std::string> specLabels(const std::vector<std::string>& specs);

}  // namespace rigor::results
