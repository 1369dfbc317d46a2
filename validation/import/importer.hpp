// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Measured data sets become scenarios: one file per data set and one line in importers.def. An importer reads
// a folder of the user's and returns scenario texts whose reference is `measured_motion`; writing them, with
// suites for the part to fit on and the part to score on and a fit file ready to use, is the same for all.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "validation/results/judgement.hpp"

namespace rigor::validation {

/// A choice that an importer leaves to the caller, the default first.
struct ImportChoice {
    std::string key;
    std::vector<std::pair<std::string, std::string>> values;  ///< value and what it means
};

struct ImportRequest {
    std::filesystem::path from;  ///< folder of the data set
    std::string select = "all";  ///< "all", or a CSV file with a column `id`
    std::string train;           ///< a CSV file with a column `id`, or a fraction in (0, 1); "": half
    std::map<std::string, std::string> choices;  ///< complete: every key of the table's choices
};

struct ImportedScenario {
    std::string name;  ///< name, also of the file
    std::string text;  ///< JSON
    bool train = false;
};
/// A value of the scenarios that a fit may change.
struct FitProposal {
    std::string name, key;
    double low, high, start;
};
/// A study of the scenarios with judged findings, ready for `rigor study`.
struct ImportedStudy {
    std::string name;  ///< name, also of the file
    std::string text;  ///< JSON; names the scenarios by their files
};
struct Imported {
    std::string title;
    std::vector<ImportedScenario> scenarios;  ///< scenarios, at least one
    std::vector<FitProposal> parameters;      ///< parameters; none: there is nothing to fit
    std::string metric;                       ///< metric that a fit minimises
    std::vector<std::string> report;          ///< other metrics that it scores
    std::vector<std::string> engines{results::kInHouseEngine, "bullet",
                                     "ode"};  ///< engines that a fit is proposed for
    std::vector<ImportedStudy> studies;
    std::filesystem::path licence;  ///< licence to keep with everything made from the data; may be empty
};

struct ImporterEntry {
    const char* name;  ///< "cube-toss"
    const char* title;
    const char* source;
    const std::vector<ImportChoice>& (*choices)();
    Imported (*read)(const ImportRequest&);
};
const std::vector<ImporterEntry>& importerTable();
/// Throws std::invalid_argument naming the known ones.
const ImporterEntry& findImporter(const std::string& name);

/// The folder of a data set in what the user named: itself, or the one of the data set's name in it or in one
/// of its folders, so that the folder of all data does. Throws LoadError for what is no folder, and for the
/// folder of another data set.
std::filesystem::path dataFolder(const std::string& dataSet, const std::filesystem::path& given);

/// Defaults for keys not given; throws std::invalid_argument for unknown keys and values.
std::map<std::string, std::string> resolveChoices(const ImporterEntry& importer,
                                                  const std::map<std::string, std::string>& given);

/// Recordings of `ids` that the request selects, and those of them for the fit: the listed ones, or a
/// fraction of them spread evenly, half by default. Throws LoadError for ids that a list names and the data
/// set does not have, or that it names twice.
struct Chosen {
    int id;
    bool train;
};
std::vector<Chosen> chooseRecordings(const std::vector<int>& ids, const ImportRequest& request);

/// Writes the scenarios, `train.json`, `test.json` (suites) and `fit.json` to `folder`, which must be new or
/// empty; every scenario is loaded first. Throws LoadError, std::invalid_argument.
void writeImported(const Imported& imported, const std::string& name, const std::filesystem::path& folder);

}  // namespace rigor::validation
