// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "scenarios/loader/loader.hpp"

namespace rigor::cli {
namespace {

int checkFiles(const std::vector<std::string>& files, const std::vector<std::string>& overrides, bool json) {
    std::vector<scenario::Problem> problems;
    for (const auto& file : files) {
        try {
            const auto loaded = loadWithReference(file, overrides, true);
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
