// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/json/node.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "scenarios/model/time_step.hpp"

namespace rigor::scenario {
namespace {

std::string shown(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

}  // namespace

void Node::problem(const std::string& id, const std::string& found, const std::string& expected) const {
    const int line = context_->document != nullptr ? context_->document->lineOf(pointer_) : 0;
    context_->problems.push_back({id, context_->file, pointer_, line, found, expected});
}

bool Node::isObject(std::initializer_list<const char*> keys) const {
    std::string known;
    for (const char* key : keys) known += (known.empty() ? "" : ", ") + std::string(key);
    if (!value_->is_object()) {
        problem("schema.type", "object with keys among " + known);
        return false;
    }
    bool clean = true;
    for (const auto& [key, value] : value_->items()) {
        if (std::any_of(keys.begin(), keys.end(), [&key = key](const char* k) { return key == k; })) continue;
        (*this)[key].problem("schema.unknown_key", "the key '" + key + "'", "one of " + known);
        clean = false;
    }
    return clean;
}

bool Node::isArray() const {
    if (!value_->is_array()) problem("schema.type", "array");
    return value_->is_array();
}

Node Node::operator[](const std::string& key) const {
    return {value_->at(key), pointer_ + "/" + escapeToken(key), *context_};
}
Node Node::operator[](std::size_t index) const {
    return {value_->at(index), pointer_ + "/" + std::to_string(index), *context_};
}

std::optional<Node> Node::find(const char* key) const {
    if (!has(key)) return std::nullopt;
    return (*this)[key];
}

std::optional<Node> Node::require(const char* key) const {
    if (!has(key))
        problem("schema.missing_key", "no key '" + std::string(key) + "'",
                "the key '" + std::string(key) + "'");
    return find(key);
}

std::vector<Node> Node::items() const {
    std::vector<Node> nodes;
    if (!isArray()) return nodes;
    for (std::size_t i = 0; i < value_->size(); ++i) nodes.push_back((*this)[i]);
    return nodes;
}

std::vector<std::pair<std::string, Node>> Node::members() const {
    std::vector<std::pair<std::string, Node>> nodes;
    if (!value_->is_object()) {
        problem("schema.type", "object");
        return nodes;
    }
    for (const auto& [key, value] : value_->items()) nodes.emplace_back(key, (*this)[key]);
    return nodes;
}

double Node::number(double min, double max) const {
    const std::string range = "number from " + shown(min) + " to " + shown(max);
    if (!value_->is_number()) {
        problem("schema.type", range);
        return min;
    }
    const double value = value_->get<double>();
    if (std::isfinite(value) && value >= min && value <= max) return value;
    problem("value.range", range);
    return min;
}

double Node::timeStep() const {
    constexpr double kLeast = 1e-7, kMost = 1.0;
    if (!value_->is_string()) return number(kLeast, kMost);
    const std::optional<double> value = parseTimeStep(value_->get<std::string>());
    if (value && *value >= kLeast && *value <= kMost) return *value;
    problem("value.range", "seconds from 1e-7 to 1 such as 0.004 or \"1/240\"");
    return kLeast;
}

double Node::positive() const {
    if (value_->is_number() && value_->get<double>() <= 0.0) {
        problem("value.range", "number > 0");
        return 1.0;
    }
    return number(1e-12, kLargestNumber);
}

int Node::integer(int min, int max) const {
    if (!value_->is_number_integer() || value_->get<double>() < min || value_->get<double>() > max) {
        problem(value_->is_number() ? "value.range" : "schema.type",
                "integer from " + std::to_string(min) + " to " + std::to_string(max));
        return min;
    }
    return value_->get<int>();
}

bool Node::boolean() const {
    if (value_->is_boolean()) return value_->get<bool>();
    problem("schema.type", "true or false");
    return false;
}

std::string Node::text() const {
    if (value_->is_string()) return value_->get<std::string>();
    problem("schema.type", "string");
    return {};
}

std::string Node::name() const {
    const std::string text = value_->is_string() ? value_->get<std::string>() : "";
    const bool legal =
        !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
                   c == '-' || c == '.';
        });
    if (!legal)
        problem(value_->is_string() ? "value.name" : "schema.type",
                "name of 1 to 64 letters, digits, '_', '-', '.'");
    return text;
}

std::vector<std::string> Node::texts() const {
    std::vector<std::string> list;
    for (const Node& item : items()) list.push_back(item.text());
    return list;
}

std::vector<double> Node::numbers(std::size_t count) const {
    if (!value_->is_array() || value_->size() != count) {
        problem("schema.type", "array of " + std::to_string(count) + " numbers");
        return std::vector<double>(count, 0.0);
    }
    std::vector<double> list;
    for (const Node& item : items()) list.push_back(item.number(-kLargestNumber, kLargestNumber));
    return list;
}

Vec3 Node::vector() const {
    const auto v = numbers(static_cast<std::size_t>(dimension()));
    return {v[0], v[1], dimension() == 3 ? v[2] : 0.0};
}

Vec3 Node::unitVector() const {
    const Vec3 v = vector();
    const double length = norm(v);
    if (length < 1e-9) {
        problem("value.direction", "vector that is not zero");
        return {0.0, 1.0, 0.0};
    }
    return v / length;
}

Vec3 Node::angularVector() const {
    if (dimension() == 2) return {0.0, 0.0, number(-kLargestNumber, kLargestNumber)};
    return vector();
}

}  // namespace rigor::scenario
