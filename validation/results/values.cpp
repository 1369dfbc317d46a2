// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/values.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace rigor::results {

const MetricRow* wholeScene(const CaseRow& row, const std::string& metric) {
    for (const MetricRow& m : row.metrics)
        if (m.name == metric && m.subject.empty()) return &m;
    return nullptr;
}

const ScenarioRow* scenarioOf(const Run& run, const std::string& name) {
    for (const ScenarioRow& scenario : run.scenarios)
        if (scenario.name == name) return &scenario;
    return nullptr;
}

bool isError(const MetricRow& metric, const ScenarioRow& scenario) {
    if (metric.kind == "cost" || metric.kind == "outcome") return false;
    return metric.kind != "rest" || !scenario.reference.empty() || metric.bound.has_value() ||
           std::find(scenario.metrics.begin(), scenario.metrics.end(), metric.name) != scenario.metrics.end();
}

std::optional<double> steppingTime(const CaseRow& row) {
    for (const TimingRow& t : row.timings)
        if (t.phase == "step") return t.median * row.steps;
    return std::nullopt;
}

std::string versionText(const EngineRow& engine) {
    return engine.version + (engine.package.empty() ? "" : " (package " + engine.package + ")");
}

const char* nonFiniteWords(double value) {
    if (std::isnan(value)) return "not a number";
    if (std::isinf(value)) return value > 0.0 ? "infinite" : "minus infinite";
    return "";
}

std::string exactText(double value) {
    if (std::isnan(value)) return "nan";  // to_chars writes its sign
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string finiteText(double value) {
    return std::isfinite(value) ? exactText(value) : "";
}

std::string finiteText(const std::optional<double>& value) {
    return value ? finiteText(*value) : "";
}

std::string programOf(const Run& run) {
    return run.command.starts_with("rigor ") ? run.command.substr(0, run.command.find(' ')) : "./rigor";
}

std::string nonFiniteNote(std::initializer_list<NamedNumber> numbers) {
    std::string note;
    for (const auto& [name, value] : numbers)
        if (value && !std::isfinite(*value))
            note += (note.empty() ? "" : "; ") + std::string(name) + " is " + nonFiniteWords(*value);
    return note;
}

}  // namespace rigor::results
