// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A run on a terminal.
#pragma once

#include <string>

#include "validation/results/types.hpp"

namespace rigor::report {

/// The same story for a terminal: at most `lines` lines, ANSI colours only when `colour`.
std::string terminalSummary(const results::Run& run, int lines, int columns, bool colour);

}  // namespace rigor::report
