// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The library of scenarios and suites: <folder>/{2d,3d,bench}/*.json, and
// <folder>/{suites,collision,studies}/*.json.
#include <algorithm>
#include <cstdlib>
#include <optional>

#include "scenarios/json/node.hpp"
#include "scenarios/loader/collision_cases.hpp"
#include "scenarios/loader/data_folder.hpp"
#include "scenarios/loader/overrides.hpp"
#include "scenarios/loader/schema_check.hpp"
#include "scenarios/loader/study.hpp"
#include "scenarios/model/nearest.hpp"

namespace rigor::scenario {
namespace {

namespace fs = std::filesystem;

/// A file of the library; nothing if it has no name.
std::optional<LibraryEntry> entryOf(const fs::path& file) {
    const Json json = Json::parse(readTextFile(file), nullptr, false);
    if (!json.is_object() || !json.contains("name") || !json["name"].is_string()) return std::nullopt;
    return LibraryEntry{json["name"], json.value("title", ""), file};
}

std::vector<LibraryEntry> entriesOf(const std::vector<fs::path>& folders) {
    std::vector<LibraryEntry> entries;
    for (const fs::path& folder : folders) {
        std::error_code error;
        for (const auto& file : fs::directory_iterator(folder, error)) {
            if (file.path().extension() != ".json") continue;
            if (auto entry = entryOf(file.path())) entries.push_back(*std::move(entry));
        }
    }
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return entries;
}

fs::path findEntry(const std::vector<fs::path>& folders, const std::string& nameOrPath,
                   const std::string& kind) {
    std::error_code error;
    const bool isFile = fs::is_regular_file(nameOrPath, error);
    if (isFile && fs::path(nameOrPath).has_parent_path()) return nameOrPath;
    // Most files are called like their entry: no other one has to be read.
    for (const fs::path& folder : folders) {
        const fs::path file = folder / (nameOrPath + ".json");
        if (!fs::is_regular_file(file, error)) continue;
        if (const auto entry = entryOf(file); entry && entry->name == nameOrPath) return file;
    }
    std::vector<std::string> known;
    for (const LibraryEntry& entry : entriesOf(folders)) {
        if (entry.name == nameOrPath) return entry.file;
        known.push_back(entry.name);
    }
    if (isFile) return nameOrPath;
    throw LoadError({{kind + ".not_found", nameOrPath, "", 0, "no " + kind + " or file of this name",
                      "a file, or a name of the library" + didYouMean(nameOrPath, known)}});
}

}  // namespace

fs::path libraryFolder() {
    if (const char* variable = std::getenv("RIGOR_SCENARIOS"); variable != nullptr && *variable != '\0')
        return variable;
    std::error_code error;
    const fs::path folder = dataFolder() / "scenarios";
    const fs::path target = fs::canonical(folder, error);  // a build folder links to the source tree
    return error ? folder : target;
}

std::vector<LibraryEntry> listScenarios() {
    return entriesOf({libraryFolder() / "2d", libraryFolder() / "3d"});
}
std::vector<LibraryEntry> listBenchScenarios() {
    return entriesOf({libraryFolder() / "bench"});
}
std::vector<LibraryEntry> listSuites() {
    return entriesOf({libraryFolder() / "suites"});
}
std::vector<LibraryEntry> listCollisionFiles() {
    return entriesOf({libraryFolder() / "collision"});
}
std::vector<LibraryEntry> listStudies() {
    return entriesOf({libraryFolder() / "studies"});
}
fs::path findScenario(const std::string& nameOrPath) {
    return findEntry({libraryFolder() / "2d", libraryFolder() / "3d", libraryFolder() / "bench"}, nameOrPath,
                     "scenario");
}
fs::path findSuite(const std::string& nameOrPath) {
    return findEntry({libraryFolder() / "suites"}, nameOrPath, "suite");
}
fs::path findCollisionFile(const std::string& nameOrPath) {
    return findEntry({libraryFolder() / "collision"}, nameOrPath, "collision");
}
fs::path findStudy(const std::string& nameOrPath) {
    return findEntry({libraryFolder() / "studies"}, nameOrPath, "study");
}

bool isSuiteFile(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return false;
    const Json json = Json::parse(readTextFile(file), nullptr, false);
    return json.is_object() && json.contains("rigor_suite");
}

Suite loadSuite(const fs::path& file) {
    const JsonDocument document = parseDocument(readTextFile(file), file.string());
    ReadContext context{file.string(), &document, {}, 3};
    const Node root(document.value, "", context);
    Suite suite;
    root.isObject({"rigor_suite", "name", "title", "scenarios", "engines", "dt", "max_time_steps", "orders"});
    if (document.value.is_object()) {
        if (const auto n = root.require("rigor_suite")) n->integer(1, 1);
        if (const auto n = root.require("name")) suite.name = n->name();
        if (const auto n = root.find("title")) suite.title = n->text();
        if (const auto n = root.require("scenarios")) suite.scenarios = n->texts();
        if (const auto n = root.find("engines")) suite.engines = n->texts();
        if (const auto n = root.find("dt"))
            for (const Node& item : n->items()) suite.timeSteps.push_back(item.timeStep());
        if (const auto n = root.find("max_time_steps")) suite.maxTimeSteps = n->integer(1, 1000);
        if (const auto n = root.find("orders")) suite.orders = n->integer(1, 1000);
    }
    if (!context.problems.empty()) throw LoadError(std::move(context.problems));
    checkSuiteSchema(document, file.string());
    if (suite.scenarios == std::vector<std::string>{"*"}) {
        suite.scenarios.clear();
        for (const LibraryEntry& entry : listScenarios()) suite.scenarios.push_back(entry.name);
    }
    // Paths are relative to the suite's own file; names stay names.
    for (std::string& name : suite.scenarios)
        if (const fs::path beside = file.parent_path() / name; name.ends_with(".json") && fs::exists(beside))
            name = beside.string();
    return suite;
}

}  // namespace rigor::scenario
