// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shorthands for an adapter's table of options and its ledger.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "adapters/interface/types.hpp"

namespace rigor::adapter {

/// A key with named values.
inline Option choice(const char* key, std::vector<std::string> values, const char* byDefault,
                     const char* matched, const char* help) {
    return {key, std::move(values), 0.0, 0.0, false, byDefault, matched, help};
}

/// A key with a real number from min to max.
inline Option number(const char* key, double min, double max, const char* byDefault, const char* matched,
                     const char* help) {
    return {key, {}, min, max, false, byDefault, matched, help};
}

/// A key with a whole number from min to max.
inline Option integer(const char* key, double min, double max, const char* byDefault, const char* matched,
                      const char* help) {
    return {key, {}, min, max, true, byDefault, matched, help};
}

/// Six significant digits, for ledger lines.
std::string shown(double value);

/// True if a shape of one of the kinds may touch something in the scenario.
template <class... Kinds>
bool hasCollidingShape(const Scenario& scenario) {
    for (const auto& body : scenario.bodies)
        for (const auto& shape : body.shapes)
            if (body.collides && (std::holds_alternative<Kinds>(shape.geometry) || ...)) return true;
    return false;
}

}  // namespace rigor::adapter
