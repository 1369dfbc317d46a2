// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Numbers of the page's data, and parts of it that have a file of their own.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "reports/text.hpp"
#include "validation/results/types.hpp"

namespace rigor::report {

class ViewModel;
using Json = nlohmann::ordered_json;

/// All digits; what JSON lacks is "nan", "inf" or "-inf".
inline Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(fullNumber(value));
}
/// null where there is none.
inline Json number(const std::optional<double>& value) {
    return value ? number(*value) : Json(nullptr);
}

/// Observed orders of a scenario, and its place in the four ways to compare.
Json ordersJson(const results::Run& run, const std::string& scenario);
Json fairnessJson(const results::Run& run, const std::string& scenario);

/// Cases that depend on the order of insertion; null where every case was run in one.
Json insertionOrdersJson(const ViewModel& view);

/// The audit of a case; of what its run acted upon (null where that was not asked); per scenario and auditor
/// over all cases of a run.
Json auditJson(const results::CaseRow& row);
Json inRunJson(const results::CaseRow& row);
Json gatheredAudit(const results::Run& run);

}  // namespace rigor::report
