// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/view/site.hpp"

#include <charconv>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace rigor::view {

double Request::number(const std::string& key, double otherwise, double min, double max) const {
    const auto it = query.find(key);
    if (it == query.end()) return otherwise;
    const std::string& text = it->second;
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value >= min && value <= max))
        throw std::invalid_argument(key + ": a number out of range, or none");
    return value;
}

Reply json(const std::string& text) {
    return {200, "application/json", text};
}

Reply problem(int status, const std::string& message) {
    return {
        status, "application/json",
        nlohmann::json{{"error", message}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)};
}

Reply notFound() {
    return problem(404, "there is nothing of this name");
}

}  // namespace rigor::view
