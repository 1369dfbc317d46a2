// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Reads a fit file; what is wrong is said with file, line, pointer, found and expected.
#include <algorithm>
#include <cmath>
#include <set>

#include "scenarios/json/node.hpp"
#include "scenarios/loader/overrides.hpp"
#include "validation/fit/fit.hpp"
#include "validation/metrics/metric.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using namespace scenario;

FitParameter readParameter(const Node& node) {
    FitParameter p;
    if (!node.isObject({"name", "key", "range", "start"})) return p;
    if (const auto n = node.require("name")) p.name = n->name();
    if (const auto n = node.require("key")) p.key = n->text();
    if (const auto n = node.require("range")) {
        const auto range = n->numbers(2);
        if (range.size() == 2) {
            p.low = range[0];
            p.high = range[1];
        }
        if (!(p.low < p.high)) n->problem("fit.range", "a lower and a higher value");
    }
    p.start = 0.5 * (p.low + p.high);
    if (const auto n = node.find("start")) p.start = n->number(p.low, p.high);
    return p;
}

/// Scenarios and suites by name or file; files lie beside the fit file or are found from where we are.
std::vector<LoadedScenario> readPart(const Node& list, const fs::path& folder) {
    std::vector<LoadedScenario> scenarios;
    const auto placed = [&](const std::string& name) {
        const fs::path beside = folder / name;
        return name.ends_with(".json") && fs::exists(beside) ? beside.string() : name;
    };
    for (const Node& item : list.items()) {
        const std::string name = placed(item.text());
        std::vector<std::string> files{name};
        if (isSuiteFile(name)) files = loadSuite(name).scenarios;
        for (const std::string& file : files) scenarios.push_back(loadScenario(findScenario(file)));
    }
    if (scenarios.empty()) list.problem("value.range", "at least one scenario");
    return scenarios;
}

/// A recording that is fitted on may not be scored.
void requireApart(const Node& root, const FitTask& task) {
    std::set<std::string> names;
    for (const auto* part : {&task.train, &task.test})
        for (const LoadedScenario& s : *part)
            if (!names.insert(s.scenario.name).second)
                root.problem("fit.twice", "the scenario '" + s.scenario.name + "' a second time",
                             "each scenario once, in train or in test");
}

std::string readMetric(const Node& node) {
    const std::string name = node.text();
    if (findMetric(name) == nullptr) node.problem("fit.metric", "a metric of `rigor list metrics`");
    return name;
}

/// Every key has to lead somewhere and both ends of its range have to be a scenario.
void requireKeys(const Node& root, const FitTask& task) {
    for (const FitParameter& p : task.parameters)
        for (const double end : {p.low, p.high}) try {
                (void)loadScenarioText(task.train.front().text, task.train.front().scenario.name,
                                       {p.key + "=" + Json(end).dump()});
            } catch (const LoadError& error) {
                root.problem("fit.key", p.key + ": " + error.what(), "a value of the scenarios");
                break;
            }
}

void addSpecs(FitTask& task, const std::vector<adapter::EngineSpec>& specs) {
    for (const adapter::EngineSpec& spec : specs) {
        (void)adapter::moduleFor(spec);  // an engine that is not installed is said now
        for (const char* preset : {"default", "matched"}) {
            adapter::EngineSpec one = spec;
            one.options.emplace("preset", preset);
            const bool known = std::any_of(task.specs.begin(), task.specs.end(),
                                           [&](const auto& other) { return other.text() == one.text(); });
            if (!known) task.specs.push_back(one);
        }
    }
}

void readValues(const Node& root, FitTask& task, std::vector<adapter::EngineSpec>& specs) {
    if (const auto n = root.require("rigor_fit")) n->integer(1, 1);
    if (const auto n = root.require("name")) task.name = n->name();
    if (const auto n = root.find("title")) task.title = n->text();
    if (const auto n = root.require("parameters"))
        for (const Node& item : n->items()) task.parameters.push_back(readParameter(item));
    if (root.has("parameters") && (task.parameters.empty() || task.parameters.size() > 3))
        root["parameters"].problem("fit.parameters", "one to three parameters");
    if (const auto n = root.require("metric")) task.metric = readMetric(*n);
    if (const auto n = root.find("summary")) {
        const std::string word = n->text();
        if (word != "mean" && word != "median") n->problem("fit.summary", "mean or median");
        task.summary = word == "median" ? Summary::Median : Summary::Mean;
    }
    task.metrics = {task.metric};
    if (const auto n = root.find("report"))
        for (const Node& item : n->items()) {
            const std::string name = readMetric(item);
            if (std::find(task.metrics.begin(), task.metrics.end(), name) == task.metrics.end())
                task.metrics.push_back(name);
        }
    const int least = static_cast<int>(std::pow(3.0, task.parameters.size())) + 1;
    if (const auto n = root.find("budget")) task.budget = n->integer(least, 100000);
    if (const auto n = root.find("seed")) task.seed = n->integer(0, 2147483647);
    if (const auto n = root.find("dt")) task.dt = n->number(1e-7, 1.0);
    if (const auto n = root.require("engines"); n && specs.empty())
        for (const std::string& text : n->texts()) specs.push_back(adapter::parseSpec(text));
}

}  // namespace

const char* summaryName(Summary summary) {
    return summary == Summary::Median ? "median" : "mean";
}

FitTask loadFit(const fs::path& file, const std::vector<adapter::EngineSpec>& engines) {
    const JsonDocument document = parseDocument(readTextFile(file), file.string());
    ReadContext context{file.string(), &document, {}, 3};
    const Node root(document.value, "", context);
    FitTask task;
    std::vector<adapter::EngineSpec> specs = engines;
    const auto throwProblems = [&] {
        if (!context.problems.empty()) throw LoadError(std::move(context.problems));
    };
    root.isObject({"rigor_fit", "name", "title", "train", "test", "engines", "parameters", "metric",
                   "summary", "report", "budget", "seed", "dt"});
    throwProblems();
    readValues(root, task, specs);
    const auto train = root.require("train"), test = root.require("test");
    throwProblems();
    task.train = readPart(*train, file.parent_path());
    task.test = readPart(*test, file.parent_path());
    throwProblems();
    requireApart(root, task);
    requireKeys(root, task);
    throwProblems();
    addSpecs(task, specs);
    return task;
}

}  // namespace rigor::validation
