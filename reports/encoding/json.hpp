// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Numbers in JSON.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "reports/encoding/text.hpp"

namespace rigor::report {

using Json = nlohmann::ordered_json;

/// All digits; what JSON lacks is "nan", "inf" or "-inf".
inline Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(fullNumber(value));
}
/// null where there is none.
inline Json number(const std::optional<double>& value) {
    return value ? number(*value) : Json(nullptr);
}

}  // namespace rigor::report
