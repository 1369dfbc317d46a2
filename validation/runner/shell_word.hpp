// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <string>

namespace rigor::validation {

/// A word as a shell takes it: as it is where nothing in it means something to a shell, else in quotes.
std::string shellWord(const std::string& word);

}  // namespace rigor::validation
