// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/references/reference.hpp"

namespace rigor::cli {
namespace {

/// The scenario's reference is checked as well: its name, its bodies and whether its assumptions hold.
void checkReference(const scenario::Scenario& scenario, const std::string& file) {
    try {
        (void)validation::makeReference(scenario);
    } catch (const validation::AssumptionViolated& error) {
        throw scenario::LoadError({{"reference.assumption", file, "/reference", 0, error.what(),
                                    "values for which the reference holds"}});
    } catch (const std::invalid_argument& error) {
        throw scenario::LoadError({{"reference.invalid", file, "/reference", 0, error.what(),
                                    "a reference of `rigor list references`"}});
    }
}

int checkFiles(const std::vector<std::string>& files, const std::vector<std::string>& overrides, bool json) {
    std::vector<scenario::Problem> problems;
    for (const auto& file : files) {
        try {
            const auto path = scenario::findScenario(file);
            const auto loaded = scenario::loadScenario(path, overrides);
            checkReference(loaded.scenario, path.string());
            if (!json) std::printf("%s: ok (%s)\n", file.c_str(), loaded.scenario.name.c_str());
        } catch (const scenario::LoadError& error) {
            problems.insert(problems.end(), error.problems().begin(), error.problems().end());
        }
    }
    if (json || !problems.empty()) printProblems(scenario::LoadError(problems), json);
    return problems.empty() ? kOk : kBadInput;
}

}  // namespace

void addCheck(CLI::App& app, Action& action) {
    struct Arguments {
        std::vector<std::string> files, overrides;
        bool json = false;
    };
    auto arguments = std::make_shared<Arguments>();
    auto* command = app.add_subcommand("check", "Validate scenario files: schema, meaning, reference");
    command->add_option("FILE", arguments->files, "Scenario files or names")->required();
    command
        ->add_option("--set", arguments->overrides, "Override a value: KEY=VALUE, e.g. bodies.block.mass=2")
        ->allow_extra_args(false);
    command->add_flag("--json", arguments->json, "Problems as a JSON array on stdout");
    command->callback([arguments, &action] {
        action = [arguments] { return checkFiles(arguments->files, arguments->overrides, arguments->json); };
    });
}

}  // namespace rigor::cli
