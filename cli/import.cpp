// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "cli/command.hpp"
#include "cli/import_model.hpp"
#include "scenarios/exchange/common/formats.hpp"
#include "scenarios/loader/data_folder.hpp"
#include "validation/import/importer.hpp"
#include "validation/results/counted.hpp"

namespace rigor::cli {
namespace {

struct ImportArguments {
    ModelArguments model;
    std::string dataSet, from, out, select = "all", train;
    std::vector<std::string> options;
};

int runImport(const ImportArguments& a) {
    if (isModelFormat(a.dataSet)) return importModel(a.dataSet, a.from, a.out, a.model);
    const auto& importer = validation::findImporter(a.dataSet);
    std::map<std::string, std::string> given;
    for (const auto& option : a.options) {
        const auto equals = option.find('=');
        if (equals == std::string::npos)
            throw std::invalid_argument("--option: found '" + option + "', expected KEY=VALUE");
        given[option.substr(0, equals)] = option.substr(equals + 1);
    }
    const auto choices = validation::resolveChoices(importer, given);
    const auto from = validation::dataFolder(a.dataSet, a.from);
    const auto imported = importer.read({from, a.select, a.train, choices});
    std::string name = a.dataSet;
    std::replace(name.begin(), name.end(), '-', '_');
    const std::filesystem::path folder = a.out.empty() ? name : a.out;
    validation::writeImported(imported, name, folder);
    const auto train = std::count_if(imported.scenarios.begin(), imported.scenarios.end(),
                                     [](const auto& s) { return s.train; });
    const auto test = static_cast<std::ptrdiff_t>(imported.scenarios.size()) - train;
    std::printf("%s in %s", results::counted(imported.scenarios.size(), "scenario").c_str(), folder.c_str());
    if (train > 0) std::printf(": %td to fit on (train.json)", train);
    if (test > 0) std::printf("%s %td to score on (test.json)", train > 0 ? "," : ":", test);
    std::printf("\n");
    for (const auto& study : imported.studies)
        std::printf("Findings: %s study %s\n", scenario::programName().c_str(),
                    (folder / (study.name + ".json")).c_str());
    if (std::filesystem::exists(folder / "fit.json"))
        std::printf("Fit and score: %s fit %s\n", scenario::programName().c_str(),
                    (folder / "fit.json").c_str());
    return kOk;
}

std::string footer() {
    std::string text = "Model files:\n";
    for (const auto& format : models::formats())
        text += "  " + std::string(format.name) + ": " + format.title + "\n";
    text += "Data sets and their --option KEY=VALUE (the first is the default):\n";
    for (const auto& entry : validation::importerTable()) {
        text += "  " + std::string(entry.name) + ": " + entry.title + "\n    " + entry.source + "\n";
        for (const auto& choice : entry.choices())
            for (const auto& [value, meaning] : choice.values)
                text += "    " + choice.key + "=" + value + ": " + meaning + "\n";
    }
    return text;
}

}  // namespace

void addImport(CLI::App& app, Action& action) {
    auto a = std::make_shared<ImportArguments>();
    auto* command =
        app.add_subcommand("import", "Turn models of other simulators, or measured data, into scenarios");
    command->add_option("KIND", a->dataSet, "Which model format or data set, see below")->required();
    command
        ->add_option(
            "FROM", a->from,
            "The model file; or the folder of the data set, or one that has a folder of its name inside")
        ->required();
    command->add_option(
        "--out", a->out,
        "The scenario's file (default: standard output); or a new folder for the scenarios of a data set "
        "(default: its name)");
    command->add_option("--select", a->select, "Only the recordings of this CSV file (column id), or all");
    command->add_option("--train", a->train,
                        "Recordings to fit on: a CSV file (column id) or a share; the others are scored. "
                        "Default: half, spread evenly");
    command->add_option("--option", a->options, "A choice of the data set's: KEY=VALUE")
        ->allow_extra_args(false);
    addModelOptions(*command, a->model);
    command->footer(footer());
    command->callback([a, &action] { action = [a] { return runImport(*a); }; });
}

}  // namespace rigor::cli
