// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What is often asked of a case, and numbers as text.
#pragma once

#include <optional>
#include <string>

#include "validation/results/types.hpp"

namespace rigor::results {

/// The metric of the whole scene; null when the case has none.
const MetricRow* wholeScene(const CaseRow& row, const std::string& metric);

/// Wall time of all steps [s]: the median of a step times their number. Empty where it was not measured.
std::optional<double> steppingTime(const CaseRow& row);

/// The shortest text that reads back as the same double; "nan", "inf", "-inf".
std::string exactText(double value);

}  // namespace rigor::results
