// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/loader/study.hpp"

#include <algorithm>
#include <cstdio>

#include "scenarios/json/node.hpp"
#include "scenarios/loader/overrides.hpp"
#include "scenarios/loader/schema_check.hpp"

namespace rigor::scenario {
namespace {

namespace fs = std::filesystem;

std::string valueText(const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

/// {"key": [value, ...]}: each value as the text that stands behind KEY=.
std::vector<std::pair<std::string, std::vector<std::string>>> readGrid(const Node& node) {
    std::vector<std::pair<std::string, std::vector<std::string>>> grid;
    for (const auto& [key, list] : node.members()) {
        std::vector<std::string> values;
        for (const Node& item : list.items()) values.push_back(valueText(item.json()));
        if (list.json().is_array() && values.empty()) list.problem("value.range", "at least one value");
        grid.emplace_back(key, std::move(values));
    }
    return grid;
}

StudyVariant readVariant(const Node& node) {
    StudyVariant variant;
    if (node.json().is_string()) {
        variant.name = variant.engine = node.text();
        return variant;
    }
    if (!node.isObject({"name", "engine"})) return variant;
    if (const auto n = node.require("name")) variant.name = n->text();
    if (const auto n = node.require("engine")) variant.engine = n->text();
    return variant;
}

/// The value of `key`: the name of a variant of the part.
std::string readVariantName(const Node& node, const char* key, const StudyPart& part) {
    const auto n = node.require(key);
    if (!n) return {};
    const std::string name = n->text();
    const bool known = std::any_of(part.variants.begin(), part.variants.end(),
                                   [&](const StudyVariant& v) { return v.name == name; });
    if (!known) n->problem("study.unknown_variant", "the name of a variant of this part");
    return name;
}

/// A value that is judged has a column.
void showMetric(StudyPart& part, const std::string& metric) {
    if (std::find(part.metrics.begin(), part.metrics.end(), metric) == part.metrics.end())
        part.metrics.push_back(metric);
}

StudyFinding readFinding(const Node& node, const StudyPart& part) {
    StudyFinding finding;
    if (!node.isObject({"statement", "source", "variant", "metric", "where", "at_least", "at_most"}))
        return finding;
    if (const auto n = node.require("statement")) finding.statement = n->text();
    if (const auto n = node.find("source")) finding.source = n->text();
    finding.variant = readVariantName(node, "variant", part);
    if (const auto n = node.require("metric")) finding.metric = n->text();
    if (const auto n = node.find("where"))
        for (const auto& [key, value] : n->members()) {
            const auto isKey = [&, name = key](const auto& axis) { return axis.first == name; };
            if (key != "scenario" && key != "dt" &&
                std::none_of(part.parameters.begin(), part.parameters.end(), isKey) &&
                std::none_of(part.options.begin(), part.options.end(), isKey))
                value.problem("study.unknown_key", "scenario, dt, or a key of parameters or options");
            finding.where.emplace_back(key, valueText(value.json()));
        }
    if (const auto n = node.find("at_least")) finding.atLeast = n->number(-1e15, 1e15);
    if (const auto n = node.find("at_most")) finding.atMost = n->number(-1e15, 1e15);
    if (!node.has("at_least") && !node.has("at_most"))
        node.problem("study.finding", "neither at_least nor at_most", "one of them or both");
    else if (finding.atLeast && finding.atMost && *finding.atLeast > *finding.atMost)
        node.problem("study.finding", "at_least above at_most", "a range");
    return finding;
}

StudySymptom readSymptom(const Node& node, const StudyPart& part) {
    StudySymptom symptom;
    if (!node.isObject({"fault", "cure", "metric", "growth", "fault_at_least", "cure_at_most"}))
        return symptom;
    symptom.fault = readVariantName(node, "fault", part);
    symptom.cure = readVariantName(node, "cure", part);
    if (const auto n = node.require("metric")) symptom.metric = n->text();
    if (const auto n = node.find("growth")) symptom.growth = n->boolean();
    if (const auto n = node.require("fault_at_least")) symptom.faultAtLeast = n->number(-1e15, 1e15);
    if (const auto n = node.require("cure_at_most")) symptom.cureAtMost = n->number(-1e15, 1e15);
    if (node.has("fault_at_least") && node.has("cure_at_most") &&
        !(symptom.cureAtMost < symptom.faultAtLeast))
        node.problem("study.symptom", "cure_at_most not below fault_at_least",
                     "a gap between fault and cure");
    return symptom;
}

StudyEnsemble readEnsemble(const Node& node) {
    StudyEnsemble ensemble;
    if (!node.isObject({"members", "seed", "position", "angle", "velocity", "spin"})) return ensemble;
    if (const auto n = node.require("members")) ensemble.members = n->integer(2, 1000);
    if (const auto n = node.require("seed")) ensemble.seed = n->integer(0, 2000000000);
    if (const auto n = node.find("position")) ensemble.position = n->number(0.0, 10.0);
    if (const auto n = node.find("angle")) ensemble.angle = n->number(0.0, 3.2);
    if (const auto n = node.find("velocity")) ensemble.velocity = n->number(0.0, 100.0);
    if (const auto n = node.find("spin")) ensemble.spin = n->number(0.0, 100.0);
    if (ensemble.position + ensemble.angle + ensemble.velocity + ensemble.spin <= 0.0)
        node.problem("study.ensemble", "nothing to be different",
                     "one of position, angle, velocity, spin above 0");
    return ensemble;
}

StudyPart readPart(const Node& node) {
    StudyPart part;
    if (!node.isObject({"name", "title", "description", "scenarios", "set", "parameters", "options",
                        "variants", "dt", "metrics", "symmetries", "ensemble", "divergence_threshold",
                        "symptom", "findings"}))
        return part;
    if (const auto n = node.require("name")) part.name = n->name();
    if (const auto n = node.find("title")) part.title = n->text();
    if (const auto n = node.find("description")) part.description = n->text();
    if (const auto n = node.require("scenarios")) part.scenarios = n->texts();
    if (const auto n = node.find("set")) part.overrides = n->texts();
    if (const auto n = node.find("parameters")) part.parameters = readGrid(*n);
    if (const auto n = node.find("options")) part.options = readGrid(*n);
    if (const auto n = node.require("variants"))
        for (const Node& item : n->items()) {
            StudyVariant variant = readVariant(item);
            for (const StudyVariant& other : part.variants)
                if (other.name == variant.name)
                    item.problem("study.duplicate", "the name '" + variant.name + "' a second time",
                                 "each variant once");
            part.variants.push_back(std::move(variant));
        }
    if (const auto n = node.find("dt"))
        for (const Node& item : n->items()) part.timeSteps.push_back(item.timeStep());
    if (const auto n = node.require("metrics")) part.metrics = n->texts();
    if (const auto n = node.find("symmetries")) part.symmetries = n->texts();
    if (const auto n = node.find("ensemble")) part.ensemble = readEnsemble(*n);
    if (const auto n = node.find("divergence_threshold")) part.divergenceThreshold = n->number(1e-12, 100.0);
    if (const auto n = node.find("symptom")) {
        part.symptom = readSymptom(*n, part);
        if (std::find(part.metrics.begin(), part.metrics.end(), part.symptom->metric) == part.metrics.end())
            part.metrics.insert(part.metrics.begin(), part.symptom->metric);
    }
    if (const auto list = node.find("findings"))
        for (const Node& item : list->items()) {
            part.findings.push_back(readFinding(item, part));
            showMetric(part, part.findings.back().metric);
        }
    return part;
}

/// Product of the numbers of values.
double placesOf(const std::vector<std::pair<std::string, std::vector<std::string>>>& grid) {
    double places = 1.0;
    for (const auto& [key, values] : grid) places *= static_cast<double>(values.size());
    return places;
}

/// Runs of a part, those of an ensemble's members included.
double runsOf(const StudyPart& part) {
    const double steps = std::max<double>(1.0, static_cast<double>(part.timeSteps.size()));
    const double starts = part.ensemble ? 1.0 + part.ensemble->members : 1.0;
    return static_cast<double>(part.scenarios.size()) * static_cast<double>(part.variants.size()) * steps *
           starts * placesOf(part.parameters) * placesOf(part.options);
}

/// Refuses a grid before anything of it is written out. `runs` counts those of the parts before.
void checkSize(const Node& node, const StudyPart& part, double& runs) {
    runs += runsOf(part);
    if (runs <= kMaxStudyRuns) return;
    char found[64];
    std::snprintf(found, sizeof found, "a grid of %.4g runs", runs);
    node.problem("study.size", found, "at most " + std::to_string(kMaxStudyRuns) + " in all parts");
    runs = 0.0;
}

}  // namespace

Study loadStudy(const fs::path& file) {
    const JsonDocument document = parseDocument(readTextFile(file), file.string());
    ReadContext context{file.string(), &document, {}, 3};
    const Node root(document.value, "", context);
    Study study;
    study.file = file;
    root.isObject({"rigor_study", "name", "title", "description", "leave_out_absent", "parts"});
    if (document.value.is_object()) {
        if (const auto n = root.require("rigor_study")) n->integer(1, 1);
        if (const auto n = root.require("name")) study.name = n->name();
        if (const auto n = root.find("title")) study.title = n->text();
        if (const auto n = root.find("description")) study.description = n->text();
        if (const auto n = root.find("leave_out_absent")) study.leaveOutAbsent = n->boolean();
        double runs = 0.0;
        if (const auto list = root.require("parts"))
            for (const Node& item : list->items()) {
                StudyPart part = readPart(item);
                checkSize(item, part, runs);
                for (const StudyPart& other : study.parts)
                    if (!part.name.empty() && other.name == part.name)
                        item.problem("study.duplicate", "the name '" + part.name + "' a second time",
                                     "each part once");
                study.parts.push_back(std::move(part));
            }
    }
    if (!context.problems.empty()) throw LoadError(std::move(context.problems));
    checkStudySchema(document, file.string());
    for (StudyPart& part : study.parts)
        for (std::string& name : part.scenarios)
            if (const fs::path beside = file.parent_path() / name;
                name.ends_with(".json") && fs::exists(beside))
                name = beside.string();
    return study;
}

}  // namespace rigor::scenario
