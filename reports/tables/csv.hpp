// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// All numbers of a run as one CSV file.
#pragma once

#include <string>

#include "validation/results/types.hpp"

namespace rigor::report {

/// One row per case x metric and per case x quantity; columns in FORMATS.md.
std::string csvReport(const results::Run& run);

}  // namespace rigor::report
