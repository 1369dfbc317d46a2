// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Results that depend on the order of insertion: in the summary and as JSON.
#pragma once

#include <string>

#include "reports/encoding/json.hpp"
#include "reports/model/view_model.hpp"

namespace rigor::report {

/// Cases whose result depends on the order of insertion; empty where none was run in several.
std::string insertionOrdersMarkdown(const ViewModel& view);
/// Cases that depend on the order of insertion; null where every case was run in one.
Json insertionOrdersJson(const ViewModel& view);

}  // namespace rigor::report
