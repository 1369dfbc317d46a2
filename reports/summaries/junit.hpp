// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A run as JUnit XML.
#pragma once

#include <string>

#include "validation/results/types.hpp"

namespace rigor::report {

/// JUnit XML: one testcase per case.
std::string junitReport(const results::Run& run);

}  // namespace rigor::report
