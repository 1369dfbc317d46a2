// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// All numbers of a run as one CSV file.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "validation/results/types.hpp"

namespace rigor::report {

/// One row per case x metric and per case x quantity; columns in FORMATS.md. `write` gets the text in pieces of whole
/// lines: that of a large run does not fit into the memory of a small machine.
void csvReport(const results::Run& run, const std::function<void(std::string_view)>& write);
/// The whole text.
std::string csvReport(const results::Run& run);

}  // namespace rigor::report
