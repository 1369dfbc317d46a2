// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "adapters/interface/registry.hpp"
#include "cli/command.hpp"
#include "engine/pipeline/algorithms.hpp"
#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/study.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/references/reference.hpp"
#include "validation/runner/runner.hpp"

namespace rigor::cli {
namespace {

using Json = nlohmann::ordered_json;

Json optionJson(const adapter::Option& option) {
    Json json{{"key", option.key},
              {"default", option.defaultValue},
              {"matched", option.matchedValue},
              {"help", option.help}};
    if (option.values.empty())
        json["range"] = {option.min, option.max};
    else
        json["values"] = option.values;
    return json;
}

Json capabilitiesJson(const adapter::Capabilities& c) {
    return {{"dynamics", c.dynamics},
            {"collision", c.collision},
            {"broad_phase", c.broadPhase},
            {"dimensions", c.dimensions},
            {"planar", c.planar},
            {"shapes", c.shapes},
            {"joints", c.joints},
            {"contact_impulses", c.contactImpulses},
            {"signed_distance", c.signedDistance}};
}

Json engines() {
    Json list = Json::array();
    for (const auto& name : adapter::availableEngines()) {
        const auto d = validation::describeEngine(name, ownBinary());
        Json json{{"name", name},
                  {"title", d.info.title},
                  {"version", d.info.version},
                  {"precision", d.info.precision}};
        json["precisions"] = d.precisions;
        json["build"] = d.info.buildNotes;
        json["problem"] = d.problem;
        json["capabilities"] = capabilitiesJson(d.capabilities);
        json["options"] = Json::array();
        for (const auto& option : d.options) json["options"].push_back(optionJson(option));
        list.push_back(std::move(json));
    }
    return list;
}

Json scenarios() {
    Json list = Json::array();
    for (const auto& entry : scenario::listScenarios()) {
        const auto s = scenario::loadScenario(entry.file).scenario;
        list.push_back({{"name", s.name},
                        {"title", s.title},
                        {"dimension", s.dimension},
                        {"duration", s.duration},
                        {"dt", s.timeSteps},
                        {"bodies", s.bodies.size()},
                        {"isolates", s.isolates},
                        {"tags", s.tags},
                        {"reference", s.reference ? s.reference->name : ""},
                        {"file", entry.file.string()}});
    }
    return list;
}

Json suites() {
    Json list = Json::array();
    for (const auto& entry : scenario::listSuites()) {
        const auto suite = scenario::loadSuite(entry.file);
        list.push_back({{"name", suite.name},
                        {"title", suite.title},
                        {"scenarios", suite.scenarios},
                        {"engines", suite.engines}});
    }
    return list;
}

Json studies() {
    Json list = Json::array();
    for (const auto& entry : scenario::listStudies()) {
        const auto study = scenario::loadStudy(entry.file);
        Json parts = Json::array();
        for (const auto& part : study.parts) parts.push_back(part.name);
        list.push_back(
            {{"name", study.name}, {"title", study.title}, {"parts", parts}, {"file", entry.file.string()}});
    }
    return list;
}

Json algorithms() {
    Json list = Json::array();
    for (const auto& family : engine::algorithmFamilies())
        for (const auto& algorithm : family.algorithms)
            list.push_back({{"name", algorithm.name},
                            {"stage", family.name},
                            {"default", algorithm.name == family.defaultChoice},
                            {"summary", algorithm.summary}});
    return list;
}

Json metrics() {
    Json list = Json::array();
    for (const auto& m : validation::metricTable())
        list.push_back({{"name", m.name},
                        {"title", m.title},
                        {"unit", m.unit},
                        {"kind", validation::metricKindName(m.kind)},
                        {"formula", m.formula}});
    return list;
}

Json references() {
    Json list = Json::array();
    for (const auto& r : validation::referenceTable())
        list.push_back({{"name", r.name}, {"title", r.title}, {"formula", r.formula}, {"source", r.source}});
    return list;
}

struct Listing {
    const char* name;
    const char* help;
    Json (*make)();
    std::vector<const char*> columns;  ///< of the table for people
};

const std::vector<Listing>& listings() {
    static const std::vector<Listing> table{
        {"engines",
         "Engines that are installed, with version, precision, options",
         engines,
         {"name", "version", "precision", "title", "problem"}},
        {"scenarios", "Scenarios of the library", scenarios, {"name", "dimension", "reference", "title"}},
        {"suites", "Suites of scenarios", suites, {"name", "title"}},
        {"studies", "Studies: choices side by side", studies, {"name", "title"}},
        {"algorithms",
         "Choices at every stage of the in-house engine's step",
         algorithms,
         {"stage", "name", "summary"}},
        {"metrics", "Metrics with unit and formula", metrics, {"name", "unit", "kind", "title"}},
        {"references",
         "Reference solutions with formula and source",
         references,
         {"name", "title", "source"}}};
    return table;
}

std::string cellText(const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

void printTable(const Json& list, const std::vector<const char*>& columns) {
    std::vector<std::size_t> widths;
    for (const char* column : columns) {
        std::size_t width = std::string(column).size();
        for (const auto& row : list) width = std::max(width, cellText(row.at(column)).size());
        widths.push_back(width);
    }
    const auto printRow = [&](auto&& cell) {
        std::string line;
        for (std::size_t i = 0; i < columns.size(); ++i) {
            std::string text = cell(columns[i]);
            text.resize(std::max(text.size(), widths[i]), ' ');
            line += text + "  ";
        }
        line.erase(line.find_last_not_of(' ') + 1);
        std::printf("%s\n", line.c_str());
    };
    printRow([](const char* column) { return std::string(column); });
    for (const auto& row : list) printRow([&](const char* column) { return cellText(row.at(column)); });
}

void printOptions(const Json& engineList) {
    for (const auto& engine : engineList) {
        if (engine.at("options").empty()) continue;
        std::printf("\n%s keys (default | matched):\n", cellText(engine.at("name")).c_str());
        for (const auto& o : engine.at("options")) {
            const std::string allowed =
                o.contains("values") ? cellText(o.at("values")) : cellText(o.at("range"));
            std::printf("  %-28s %s | %s   %s  %s\n", cellText(o.at("key")).c_str(),
                        cellText(o.at("default")).c_str(), cellText(o.at("matched")).c_str(), allowed.c_str(),
                        cellText(o.at("help")).c_str());
        }
    }
}

}  // namespace

void addList(CLI::App& app, Action& action) {
    auto* command = app.add_subcommand("list", "List what there is");
    command->require_subcommand(1);
    for (const auto& listing : listings()) {
        auto json = std::make_shared<bool>(false);
        auto* sub = command->add_subcommand(listing.name, listing.help);
        sub->add_flag("--json", *json, "A JSON array of objects");
        sub->callback([&listing, json, &action] {
            action = [&listing, json] {
                const Json list = listing.make();
                if (*json) {
                    std::printf("%s\n", list.dump(2).c_str());
                } else {
                    printTable(list, listing.columns);
                    if (std::string_view(listing.name) == "engines") printOptions(list);
                }
                return static_cast<int>(kOk);
            };
        });
    }
}

}  // namespace rigor::cli
