// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "adapters/interface/capability_fields.hpp"
#include "adapters/interface/guest.hpp"
#include "adapters/interface/missing.hpp"
#include "adapters/interface/registry.hpp"
#include "cli/command.hpp"
#include "engine/constraints/joint.hpp"
#include "engine/pipeline/algorithms.hpp"
#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/study.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/references/reference.hpp"
#include "validation/runner/judge.hpp"
#include "validation/runner/runner.hpp"
#include "validation/symmetry/symmetry.hpp"

namespace rigor::cli {
namespace {

using Json = nlohmann::ordered_json;

Json optionJson(const adapter::Option& option, const std::vector<adapter::Preset>& own) {
    Json json{{"key", option.key},
              {"default", option.defaultValue},
              {"matched", option.matchedValue},
              {"help", option.help}};
    for (const auto& preset : own) json[preset.name] = adapter::presetValue(option, preset.name, own);
    if (option.values.empty())
        json["range"] = {option.min, option.max};
    else
        json["values"] = option.values;
    return json;
}

/// Capabilities as JSON; missing features are listed under the adapter or the library that lacks them.
Json capabilitiesJson(const adapter::Capabilities& c) {
    Json json = adapter::capabilitiesToJson<Json>(c);
    json.erase("library_lacks");
    json["not_in_adapter"] = adapter::notInAdapterYet(c);
    json["not_in_library"] = c.libraryLacks;
    return json;
}

/// A guest that is not installed, with the keys of one that is.
Json absentJson(const adapter::GuestManifest& guest) {
    const std::string how = guest.install.empty() ? guest.missing() + " is missing" : guest.install;
    return {{"name", guest.name},
            {"title", guest.title},
            {"version", ""},
            {"package", ""},
            {"precision", guest.precision},
            {"precisions", Json::array()},
            {"presets", Json::array()},
            {"build", ""},
            {"clock", ""},
            {"problem", "not installed (" + how + ")"},
            {"capabilities", Json::object()},
            {"options", Json::array()}};
}

Json engines() {
    Json list = Json::array();
    for (const auto& name : adapter::availableEngines()) {
        const auto d = validation::describeEngine(name, ownBinary());
        Json json{{"name", name},
                  {"title", d.info.title},
                  {"version", d.info.version},
                  {"package", d.info.package},
                  {"precision", d.info.precision}};
        json["precisions"] = d.precisions;
        json["presets"] = adapter::presetNames(d.presets);
        json["build"] = d.info.buildNotes;
        json["clock"] = d.info.clock;
        json["problem"] = d.problem;
        json["capabilities"] = capabilitiesJson(d.capabilities);
        json["options"] = Json::array();
        for (const auto& option : d.options) json["options"].push_back(optionJson(option, d.presets));
        list.push_back(std::move(json));
    }
    for (const auto& guest : adapter::absentGuests()) list.push_back(absentJson(guest));
    return list;
}

Json scenarios() {
    Json list = Json::array();
    auto entries = scenario::listScenarios();
    for (auto& entry : scenario::listBenchScenarios()) entries.push_back(std::move(entry));
    for (const auto& entry : entries) {
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

/// A choice of the in-house engine; `spec` is how a command line, a study or a suite names it, and with
/// "engines" a scenario.
Json choiceJson(const std::string& stage, const std::string& name, bool isDefault,
                const std::string& summary) {
    return {{"name", name},
            {"stage", stage},
            {"default", isDefault},
            {"summary", summary},
            {"spec", std::string(validation::kInHouseEngine) + ":" + stage + "=" + name}};
}

/// A feature that is requested by the content of a scenario (in C++ of the world), not by a key.
Json partJson(const char* stage, const std::string& name, const std::string& summary, const char* requested) {
    return {{"name", name}, {"stage", stage}, {"default", false}, {"summary", summary}, {"asked", requested}};
}

void appendParts(const adapter::Capabilities& capabilities, Json& list) {
    for (const std::string& shape : capabilities.shapes)
        list.push_back(partJson("shape", shape, "", "bodies[].shapes[] of a scenario; World::addShape"));
    list.push_back(partJson("shape", "compound",
                            "several shapes of one body, each with its pose and material",
                            "bodies[].shapes[] of a scenario; World::addShape"));
    for (const auto& joint : engine::jointTable<engine::Space3d>())
        list.push_back(
            partJson("joint", joint.name, joint.summary, "joints[].type of a scenario; World::addJoint"));
    for (const auto& [name, summary, requested] :
         {std::tuple{"ray_cast", "first or every shape that a ray meets", "engine/shapes/ray_cast.hpp"},
          std::tuple{"shape_cast", "first shape that a moving shape meets", "engine/queries/shape_cast.hpp"},
          std::tuple{"overlap", "shapes that overlap a shape or box", "engine/queries/world_queries.hpp"},
          std::tuple{"closest_points", "nearest points of a shape and the world's",
                     "engine/queries/world_queries.hpp; rigor collide"}})
        list.push_back(partJson("query", name, summary, requested));
}

Json algorithms() {
    const auto rigor = validation::describeEngine(validation::kInHouseEngine, ownBinary());
    Json list = Json::array();
    std::set<std::string> stages;
    for (const auto& family : engine::algorithmFamilies()) {
        stages.insert(family.name);
        std::set<std::string> own;
        for (const auto& algorithm : family.algorithms) {
            own.insert(algorithm.name);
            list.push_back(choiceJson(family.name, algorithm.name, algorithm.name == family.defaultChoice,
                                      algorithm.summary));
        }
        // Algorithms that other engines' modules provide.
        for (const auto& option : rigor.options)
            if (option.key == family.name)
                for (const auto& value : option.values)
                    if (!own.contains(value))
                        list.push_back(
                            choiceJson(family.name, value, false,
                                       value + "'s own, through its adapter, driving a solver of rigor"));
    }
    for (const auto& option : rigor.options) {
        if (stages.contains(option.key)) continue;
        for (const auto& value : option.values)
            list.push_back(choiceJson(option.key, value, value == option.defaultValue, option.help));
        if (option.key == "threads")
            list.push_back(choiceJson("threads", option.defaultValue, true, option.help));
    }
    appendParts(rigor.capabilities, list);
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
        list.push_back({{"name", r.name},
                        {"title", r.title},
                        {"formula", r.formula},
                        {"tex", r.tex},
                        {"source", r.source}});
    return list;
}

Json symmetries() {
    Json list = Json::array();
    for (const auto& s : validation::symmetryTable())
        list.push_back({{"name", s.name}, {"title", s.title}, {"formula", s.formula}});
    return list;
}

struct Listing {
    const char* name;
    const char* help;
    Json (*make)();
    std::vector<const char*> columns;  ///< columns of the table that is printed
};

const std::vector<Listing>& listings() {
    static const std::vector<Listing> table{
        {"engines",
         "Engines that are installed, with version, precision, options",
         engines,
         {"name", "version", "package", "precision", "title", "problem"}},
        {"scenarios", "Scenarios of the library", scenarios, {"name", "dimension", "reference", "title"}},
        {"suites", "Suites of scenarios", suites, {"name", "title"}},
        {"studies", "Studies: choices side by side", studies, {"name", "title"}},
        {"algorithms",
         "Choices at every stage of the in-house engine's step, its shapes, joints and queries",
         algorithms,
         {"stage", "name", "summary"}},
        {"metrics", "Metrics with unit and formula", metrics, {"name", "unit", "kind", "title"}},
        {"symmetries", "Symmetries that a study can hold engines to", symmetries, {"name", "title"}},
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

/// Prints the features of the format that engines refuse, those of adapters and those of libraries apart.
void printLacks(const Json& engineList) {
    for (const auto& engine : engineList) {
        if (!engine.at("problem").get<std::string>().empty()) continue;
        const Json &adapters = engine.at("capabilities").at("not_in_adapter"),
                   &librarys = engine.at("capabilities").at("not_in_library");
        if (adapters.empty() && librarys.empty()) continue;
        std::printf("\n%s refuses:\n", cellText(engine.at("name")).c_str());
        std::string names;
        for (const auto& name : adapters) names += " " + cellText(name);
        if (!names.empty()) std::printf("  not in the adapter yet:%s\n", names.c_str());
        for (const auto& [name, documentation] : librarys.items())
            std::printf("  not in the library: %s (%s)\n", name.c_str(), cellText(documentation).c_str());
    }
}

void printOptions(const Json& engineList) {
    for (const auto& engine : engineList) {
        if (engine.at("options").empty()) continue;
        const auto byPreset = [&](auto&& cell) {
            std::string line;
            for (const auto& preset : engine.at("presets"))
                line += (line.empty() ? "" : " | ") + cell(preset);
            return line;
        };
        std::printf("\n%s keys (%s):\n", cellText(engine.at("name")).c_str(),
                    byPreset([](const Json& preset) { return cellText(preset); }).c_str());
        for (const auto& o : engine.at("options")) {
            const std::string allowed =
                o.contains("values") ? cellText(o.at("values")) : cellText(o.at("range"));
            const std::string values =
                byPreset([&](const Json& preset) { return cellText(o.at(cellText(preset))); });
            std::printf("  %-28s %s   %s  %s\n", cellText(o.at("key")).c_str(), values.c_str(),
                        allowed.c_str(), cellText(o.at("help")).c_str());
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
                    if (std::string_view(listing.name) == "engines") {
                        printLacks(list);
                        printOptions(list);
                    }
                }
                return static_cast<int>(kOk);
            };
        });
    }
}

}  // namespace rigor::cli
