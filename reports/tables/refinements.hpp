// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Observed orders of convergence and the four ways to compare: as CSV, as JSON and in the summary.
#pragma once

#include <string>

#include "reports/encoding/json.hpp"
#include "reports/model/view_model.hpp"

namespace rigor::report {

/// Observed orders, and the four ways to compare; a header alone where nothing was run at three time steps.
std::string ordersCsv(const results::Run& run);
std::string fairnessCsv(const results::Run& run);
/// The orders of each scenario's main metric as a section of the summary; empty without any.
std::string ordersMarkdown(const ViewModel& view);

/// Observed orders of a scenario, and its place in the four ways to compare.
Json ordersJson(const results::Run& run, const std::string& scenario);
Json fairnessJson(const results::Run& run, const std::string& scenario);

}  // namespace rigor::report
