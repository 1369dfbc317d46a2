// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "scenarios/loader/loader.hpp"

namespace rigor::cli {
namespace {

struct CheckArguments {
    std::vector<std::string> files, overrides;
    validation::ReferenceLimits referenceLimits;
    bool json = false;
};

int checkFiles(const CheckArguments& a) {
    std::vector<scenario::Problem> problems;
    for (const auto& file : a.files) {
        try {
            const auto loaded = loadWithReference(file, a.overrides, a.referenceLimits, true);
            if (!a.json) std::printf("%s: ok (%s)\n", file.c_str(), loaded.scenario.name.c_str());
        } catch (const scenario::LoadError& error) {
            problems.insert(problems.end(), error.problems().begin(), error.problems().end());
        }
    }
    if (a.json || !problems.empty()) printProblems(scenario::LoadError(problems), a.json);
    if (problems.empty()) return kOk;
    return std::all_of(problems.begin(), problems.end(), isBrokenReference) ? kNoReference : kBadInput;
}

}  // namespace

void addCheck(CLI::App& app, Action& action) {
    auto arguments = std::make_shared<CheckArguments>();
    auto* command = app.add_subcommand("check", "Validate scenario files: schema, meaning, reference");
    offerNames(command->add_option("FILE", arguments->files, "Scenario files or names")->required(),
               kScenarioNames);
    command
        ->add_option("--set", arguments->overrides, "Override a value: KEY=VALUE, e.g. bodies.block.mass=2")
        ->allow_extra_args(false);
    command->add_flag("--json", arguments->json, "Problems as a JSON array on stdout");
    addReferenceLimit(*command, arguments->referenceLimits);
    command->footer(
        "Exit codes: 0 all is well, 2 bad input, 6 a reference did not finish, ran out of memory or "
        "crashed.");
    command->callback([arguments, &action] { action = [arguments] { return checkFiles(*arguments); }; });
}

}  // namespace rigor::cli
