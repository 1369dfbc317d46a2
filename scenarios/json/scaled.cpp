// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Numbers that grow with the scene: {"size": f, "power": p, "plus": c} is f N^p + c, N the scene's "size".
#include <cmath>
#include <sstream>

#include "scenarios/json/node.hpp"

namespace rigor::scenario {
namespace {

std::string shownNumber(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

}  // namespace

std::optional<double> Node::ofSize() const {
    const std::size_t before = context_->problems.size();
    isObject({"size", "power", "plus"});
    const auto factor = require("size"), power = find("power"), plus = find("plus");
    if (!context_->size)
        problem("size.missing", "a number of the scene's size",
                "a number, or the key 'size' in the scenario");
    const double f = factor ? factor->number(-kLargestNumber, kLargestNumber) : 0.0,
                 p = power ? power->number(-4.0, 4.0) : 1.0,
                 c = plus ? plus->number(-kLargestNumber, kLargestNumber) : 0.0;
    if (context_->problems.size() > before) return std::nullopt;
    return f * std::pow(*context_->size, p) + c;
}

double Node::scaled(double min, double max) const {
    if (!value_->is_object()) return number(min, max);
    const auto value = ofSize();
    if (!value || (*value >= min && *value <= max)) return value.value_or(min);
    problem("value.range", shownNumber(*value) + " at size " + std::to_string(*context_->size),
            "number from " + shownNumber(min) + " to " + shownNumber(max));
    return min;
}

int Node::scaledInteger(int min, int max) const {
    if (!value_->is_object()) return integer(min, max);
    const auto value = ofSize();
    if (!value) return min;
    const double whole = std::round(*value);
    if (whole >= min && whole <= max) return static_cast<int>(whole);
    problem("value.range", shownNumber(*value) + " at size " + std::to_string(*context_->size),
            "integer from " + std::to_string(min) + " to " + std::to_string(max));
    return min;
}

Vec3 Node::scaledVector() const {
    const auto count = static_cast<std::size_t>(dimension());
    if (!value_->is_array() || value_->size() != count) return vector();  // vector() reports it
    const auto component = [&](std::size_t i) { return (*this)[i].scaled(-kLargestNumber, kLargestNumber); };
    return {component(0), component(1), count == 3 ? component(2) : 0.0};
}

}  // namespace rigor::scenario
