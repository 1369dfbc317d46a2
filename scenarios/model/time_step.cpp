// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/model/time_step.hpp"

#include <charconv>
#include <cmath>

namespace rigor::scenario {
namespace {

std::optional<double> parseNumber(std::string_view text) {
    double value = 0.0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, value);
    if (error != std::errc{} || end != last || !std::isfinite(value)) return std::nullopt;
    return value;
}

}  // namespace

std::optional<double> parseTimeStep(std::string_view text) {
    const std::size_t slash = text.find('/');
    if (slash == std::string_view::npos) return parseNumber(text);
    const std::optional<double> above = parseNumber(text.substr(0, slash)),
                                below = parseNumber(text.substr(slash + 1));
    if (!above || !below || *below == 0.0) return std::nullopt;
    return *above / *below;
}

}  // namespace rigor::scenario
