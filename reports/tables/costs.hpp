// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The cost of a step in the summary.
#pragma once

#include <string>

#include "reports/model/view_model.hpp"

namespace rigor::report {

/// Cost of a step for each engine, by median and by mean, the first step apart; empty if nothing was timed.
std::string costMarkdown(const ViewModel& view);

}  // namespace rigor::report
