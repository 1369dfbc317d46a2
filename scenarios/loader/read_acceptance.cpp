// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The reference, the bounds that engines have to keep, and the recorded deviations.
#include <algorithm>
#include <limits>

#include "scenarios/loader/read_parts.hpp"

namespace rigor::scenario {
namespace {

constexpr double kLargestBound = 1e12;

/// "rigor", "bullet@matched", "*", "*@default" -> engine and preset.
std::pair<std::string, std::string> splitTarget(const Node& node, const std::string& target) {
    const auto at = target.find('@');
    const std::string engine = target.substr(0, at),
                      preset = at == std::string::npos ? "" : target.substr(at + 1);
    if (engine.empty() || (at != std::string::npos && preset != "default" && preset != "matched"))
        node.problem("accept.engine", "the key '" + target + "'",
                     "engine, engine@default, engine@matched or *");
    return {engine, preset};
}

void readBounds(const Node& node, Scenario& scenario) {
    for (const auto& [target, metrics] : node.members()) {
        const auto [engine, preset] = splitTarget(metrics, target);
        for (const auto& [metric, value] : metrics.members()) {
            Bound bound{engine, preset, metric, 0.0, 0.0};
            if (value.json().is_object()) {
                value.isObject({"min", "max", "order"});
                if (const auto n = value.find("min")) bound.min = n->number(0.0, kLargestBound);
                if (const auto n = value.require("max")) bound.max = n->number(0.0, kLargestBound);
                if (const auto n = value.find("order")) bound.order = n->number(0.0, 8.0);
                if (bound.min > bound.max) value.problem("accept.bound", "min not above max");
            } else {
                bound.max = value.number(0.0, kLargestBound);
            }
            scenario.accept.push_back(bound);
        }
    }
}

void readDeviations(const Node& list, Scenario& scenario) {
    for (const Node& node : list.items()) {
        node.isObject({"engine", "preset", "metric", "max", "reason", "evidence"});
        KnownDeviation deviation;
        if (const auto n = node.require("engine")) deviation.engine = n->name();
        if (const auto n = node.find("preset")) {
            deviation.preset = n->text();
            if (deviation.preset != "default" && deviation.preset != "matched")
                n->problem("accept.preset", "default or matched");
        }
        if (const auto n = node.require("metric")) deviation.metric = n->name();
        deviation.max = std::numeric_limits<double>::infinity();
        if (const auto n = node.find("max")) deviation.max = n->number(0.0, kLargestBound);
        if (const auto n = node.require("reason")) {
            deviation.reason = n->text();
            if (deviation.reason.size() < 10) n->problem("deviation.reason", "a sentence that says why");
        }
        if (const auto n = node.find("evidence")) {
            const std::string evidence = n->text();
            if (evidence != "experiment" && evidence != "inferred")
                n->problem("deviation.evidence", "experiment or inferred");
            deviation.reason +=
                evidence == "experiment" ? " (isolated by experiment)" : " (inferred, not isolated)";
        }
        scenario.knownDeviations.push_back(deviation);
    }
}

ParameterValue readParameter(const Node& node) {
    const Json& json = node.json();
    if (json.is_boolean()) return json.get<bool>();
    if (json.is_number()) return node.number(-1e15, 1e15);
    if (json.is_string()) return json.get<std::string>();
    const auto all = [&](auto&& test) {
        return json.is_array() && std::all_of(json.begin(), json.end(), test);
    };
    if (all([](const Json& v) { return v.is_string(); })) return node.texts();
    if (all([](const Json& v) { return v.is_number(); })) return node.numbers(json.size());
    node.problem("reference.parameter", "number, string, boolean or a list of numbers or strings");
    return 0.0;
}

}  // namespace

std::optional<ReferenceSpec> readReference(const Node& node) {
    if (node.json() == "none") return std::nullopt;
    if (!node.json().is_object() || node.json().size() != 1) {
        node.problem("reference.form", "an object with one key, the name of the reference, or \"none\"");
        return std::nullopt;
    }
    const auto [name, parameters] = node.members().front();
    ReferenceSpec spec{name, {}};
    for (const auto& [key, value] : parameters.members()) spec.parameters[key] = readParameter(value);
    return spec;
}

void readAcceptance(const Node& root, Scenario& scenario) {
    if (const auto n = root.find("accept")) readBounds(*n, scenario);
    if (const auto n = root.find("known_deviations")) readDeviations(*n, scenario);
}

}  // namespace rigor::scenario
