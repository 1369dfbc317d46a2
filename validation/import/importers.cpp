// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The table of importers, and their common functions: choices, selections, the files that are written.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "validation/import/csv.hpp"
#include "validation/import/importer.hpp"
#include "validation/table.hpp"

namespace rigor::validation {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using scenario::LoadError;
using scenario::Problem;

#define IMPORTER(name, choices, read, title, source) \
    const std::vector<ImportChoice>& choices();      \
    Imported read(const ImportRequest&);
#include "validation/import/importers.def"
#undef IMPORTER

const std::vector<ImporterEntry>& importerTable() {
    static const std::vector<ImporterEntry> table{
#define IMPORTER(name, choices, read, title, source) {name, title, source, &choices, &read},
#include "validation/import/importers.def"
#undef IMPORTER
    };
    return table;
}

const ImporterEntry& findImporter(const std::string& name) {
    if (const ImporterEntry* found = findEntry(importerTable(), name)) return *found;
    throw std::invalid_argument("no data set '" + name + "' is known; known: " + namesOf(importerTable()));
}

namespace {

/// "a folder", "a file", or "nothing" with what is there instead.
std::string foundAt(const fs::path& given) {
    if (fs::is_directory(given)) return "a folder";
    if (fs::exists(given)) return "a file";
    fs::path parent = given;
    while (parent.has_parent_path() && parent != parent.parent_path() && !fs::is_directory(parent))
        parent = parent.parent_path();
    std::set<std::string> names;
    std::error_code unreadable;
    for (const auto& entry : fs::directory_iterator(parent.empty() ? "." : parent, unreadable))
        if (entry.is_directory()) names.insert(entry.path().filename().string());
    std::string text;
    for (const std::string& name : names) {
        if (text.size() > 200) return "nothing; in " + parent.string() + " are " + text + ", ...";
        text += (text.empty() ? "" : ", ") + name;
    }
    return "nothing" + (text.empty() ? "" : "; in " + parent.string() + " are " + text);
}

/// The name of the last folder of a path, be it written with a slash behind it or with dots.
std::string folderName(const fs::path& path) {
    const fs::path whole = fs::absolute(path).lexically_normal();
    return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

}  // namespace

fs::path dataFolder(const std::string& dataSet, const fs::path& given) {
    const auto refuse = [&](const std::string& found) {
        throw LoadError({{"import.folder", given.string(), "", 0, found,
                          "the folder of the data set, " + dataSet + ", or one that has it inside"}});
    };
    if (!fs::is_directory(given)) refuse(foundAt(given));
    const std::string name = folderName(given);
    if (name == dataSet) return given;
    if (fs::is_directory(given / dataSet)) return given / dataSet;
    std::error_code unreadable;
    for (const auto& entry : fs::directory_iterator(given, unreadable))
        if (entry.is_directory() && fs::is_directory(entry.path() / dataSet)) return entry.path() / dataSet;
    for (const ImporterEntry& other : importerTable())
        if (name == other.name) refuse("the folder of " + name);
    return given;
}

std::map<std::string, std::string> resolveChoices(const ImporterEntry& importer,
                                                  const std::map<std::string, std::string>& given) {
    std::map<std::string, std::string> resolved;
    for (const ImportChoice& choice : importer.choices()) resolved[choice.key] = choice.values.front().first;
    for (const auto& [key, value] : given) {
        std::string known;
        const ImportChoice* found = nullptr;
        for (const ImportChoice& choice : importer.choices()) {
            if (choice.key == key) found = &choice;
            known += (known.empty() ? "" : ", ") + choice.key;
        }
        if (found == nullptr)
            throw std::invalid_argument("--option: found '" + key + "', expected one of " + known);
        known.clear();
        for (const auto& [one, meaning] : found->values) known += (known.empty() ? "" : ", ") + one;
        if (std::none_of(found->values.begin(), found->values.end(),
                         [&](const auto& v) { return v.first == value; }))
            throw std::invalid_argument("--option " + key + ": found '" + value + "', expected one of " +
                                        known);
        resolved[key] = value;
    }
    return resolved;
}

namespace {

/// The ids that a list names, each once and each in the data set.
std::set<int> readIds(const fs::path& file, const std::vector<int>& known) {
    const CsvTable table(file, {"id"});
    std::set<int> ids;
    std::vector<Problem> problems;
    for (std::size_t row = 0; row < table.size(); ++row) {
        const int id = table.integer(row, "id");
        if (!ids.insert(id).second)
            problems.push_back(table.problem("import.duplicate", table.line(row),
                                             "recording " + std::to_string(id) + " a second time",
                                             "each once"));
        else if (std::find(known.begin(), known.end(), id) == known.end())
            problems.push_back(
                table.problem("import.unknown", table.line(row), "recording " + std::to_string(id),
                              "one of the " + std::to_string(known.size()) + " that are there"));
    }
    if (!problems.empty()) throw LoadError(std::move(problems));
    return ids;
}

double readShare(const std::string& text) {
    double share = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), share);
    if (error != std::errc{} || end != text.data() + text.size() || !(share > 0.0 && share < 1.0))
        throw std::invalid_argument("--train: found '" + text +
                                    "', expected a CSV file with a column id, or a share between 0 and 1");
    return share;
}

void writeFile(const fs::path& file, const std::string& text) {
    std::ofstream out(file, std::ios::binary);
    out << text;
    if (!out.flush()) throw std::invalid_argument("--out: cannot write '" + file.string() + "'");
}

ordered_json suiteJson(const Imported& imported, const std::string& name, bool train) {
    ordered_json files = ordered_json::array();
    for (const ImportedScenario& s : imported.scenarios)
        if (s.train == train) files.push_back(s.name + ".json");
    return {{"rigor_suite", 1},
            {"name", name + (train ? "-train" : "-test")},
            {"title", imported.title + (train ? ": the part to fit on" : ": the part to score on")},
            {"scenarios", files}};
}

ordered_json fitJson(const Imported& imported, const std::string& name) {
    ordered_json parameters = ordered_json::array();
    for (const FitProposal& p : imported.parameters)
        parameters.push_back(
            {{"name", p.name}, {"key", p.key}, {"range", {p.low, p.high}}, {"start", p.start}});
    return {{"rigor_fit", 1},
            {"name", name},
            {"title", imported.title},
            {"train", {"train.json"}},
            {"test", {"test.json"}},
            {"engines", imported.engines},
            {"parameters", parameters},
            {"metric", imported.metric},
            {"summary", "mean"},
            {"report", imported.report},
            {"seed", 1}};
}

}  // namespace

std::vector<Chosen> chooseRecordings(const std::vector<int>& ids, const ImportRequest& request) {
    std::vector<int> selected = ids;
    if (request.select != "all") {
        const std::set<int> wanted = readIds(request.select, ids);
        std::erase_if(selected, [&](int id) { return wanted.count(id) == 0; });
    }
    std::set<int> train;
    if (!request.train.empty() && fs::exists(request.train))
        train = readIds(request.train, ids);
    else {
        // Spread evenly: neighbours were recorded in one session.
        const double share = request.train.empty() ? 0.5 : readShare(request.train);
        for (std::size_t k = 0; k < selected.size(); ++k)
            if (std::floor((k + 1) * share) > std::floor(k * share)) train.insert(selected[k]);
    }
    std::vector<Chosen> chosen;
    for (const int id : selected) chosen.push_back({id, train.count(id) > 0});
    return chosen;
}

void writeImported(const Imported& imported, const std::string& name, const fs::path& folder) {
    for (const ImportedScenario& s : imported.scenarios)
        (void)scenario::loadScenarioText(s.text, s.name + ".json");
    if (fs::exists(folder) && !(fs::is_directory(folder) && fs::is_empty(folder)))
        throw std::invalid_argument("--out: '" + folder.string() +
                                    "' is there already; choose another folder");
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw std::invalid_argument("--out: cannot make '" + folder.string() + "': " + error.message());
    for (const ImportedScenario& s : imported.scenarios) writeFile(folder / (s.name + ".json"), s.text);
    const auto count = [&](bool train) {
        return std::count_if(imported.scenarios.begin(), imported.scenarios.end(),
                             [&](const ImportedScenario& s) { return s.train == train; });
    };
    for (const bool train : {true, false})
        if (count(train) > 0)
            writeFile(folder / (train ? "train.json" : "test.json"),
                      suiteJson(imported, name, train).dump(2) + "\n");
    for (const ImportedStudy& study : imported.studies)
        writeFile(folder / (study.name + ".json"), study.text);
    if (!imported.parameters.empty() && count(true) > 0 && count(false) > 0)
        writeFile(folder / "fit.json", fitJson(imported, name).dump(2) + "\n");
    if (!imported.licence.empty()) fs::copy_file(imported.licence, folder / "LICENSE", error);
}

}  // namespace rigor::validation
