// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Checks of numeric options. Their messages name what was found and what is expected; the parser puts the option before
// them.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <string>
#include <type_traits>

namespace rigor::cli {

template <class Number>
std::string numberText(Number value) {
    if constexpr (std::is_integral_v<Number>) return std::to_string(value);
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", static_cast<double>(value));
    return text;
}

/// Check of a number, `isAllowed`. `expected` follows "a number" or "a whole number"; `help` stands in the help.
template <class Number, class Allowed>
CLI::Validator numberCheck(const std::string& expected, const std::string& help, Allowed isAllowed) {
    const std::string kind = std::is_integral_v<Number> ? "a whole number" : "a number";
    return CLI::Validator(
        [kind, expected, isAllowed](std::string& text) {
            Number value{};
            const bool wraps = std::is_unsigned_v<Number> && text.starts_with('-');
            const bool isNumber = !wraps && CLI::detail::lexical_cast(text, value);
            if (isNumber && isAllowed(value)) return std::string();
            return "found '" + text + "', expected " + kind + expected;
        },
        help);
}

/// Check of a number from `low` to `high`, both included.
template <class Number>
CLI::Validator between(Number low, Number high) {
    const std::string a = numberText(low), b = numberText(high);
    return numberCheck<Number>(" from " + a + " to " + b,
                               std::string(CLI::detail::type_name<Number>()) + " in [" + a + " - " + b + "]",
                               [low, high](Number value) { return value >= low && value <= high; });
}

inline CLI::Validator positiveNumber() {
    return numberCheck<double>(" greater than 0", "POSITIVE",
                               [](double value) { return value > 0.0 && std::isfinite(value); });
}

inline CLI::Validator nonNegativeNumber() {
    return numberCheck<double>(", 0 or greater", "NONNEGATIVE",
                               [](double value) { return value >= 0.0 && std::isfinite(value); });
}

/// Check of a finite number; of a type without a sign, 0 or greater.
template <class Number>
CLI::Validator anyNumber() {
    return numberCheck<Number>(std::is_unsigned_v<Number> ? ", 0 or greater" : "", "",
                               [](Number value) { return std::isfinite(static_cast<double>(value)); });
}

}  // namespace rigor::cli
