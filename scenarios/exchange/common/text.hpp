// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Numbers and scenarios as people write them.
#pragma once

#include <initializer_list>
#include <string>

namespace rigor::models {

/// The shortest decimals that give the same numbers, with spaces between; no negative zero.
std::string digits(std::initializer_list<double> values);

/// A scenario's text without the keys that have their default values, lists of numbers on one line.
std::string tidied(const std::string& scenario);

}  // namespace rigor::models
