// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor new scenario`: a scenario of the library under a new name, to be changed. It runs as it is, with its reference and
// its bounds.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <regex>

#include "cli/command.hpp"
#include "scenarios/loader/data_folder.hpp"
#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/overrides.hpp"
#include "validation/runner/shell_word.hpp"

namespace rigor::cli {
namespace {

namespace fs = std::filesystem;

struct NewScenarioArguments {
    std::string name, from = "slide_and_stop";
    fs::path out;
};

void checkScenarioName(const std::string& name) {
    const bool allowed = std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '_' || c == '.' || c == '-';
    });
    if (name.empty() || name.size() > 64 || !allowed)
        throw std::invalid_argument("the name of a scenario: found '" + name +
                                    "', expected 1 to 64 letters, digits, '_', '.' or '-'");
}

int newScenario(const NewScenarioArguments& a) {
    checkScenarioName(a.name);
    const auto known = scenario::listScenarios();
    if (std::any_of(known.begin(), known.end(), [&](const auto& entry) { return entry.name == a.name; }))
        throw std::invalid_argument("the library has a scenario '" + a.name + "' already: it would be meant");
    const fs::path file = a.out.empty() ? fs::path(a.name + ".json") : a.out;
    if (fs::exists(file)) throw std::invalid_argument(file.string() + " is there already");
    const std::string text = scenario::readTextFile(scenario::findScenario(a.from));
    // The first of the file's names is its own: those of bodies and joints come later.
    static const std::regex ownName(R"re("name"\s*:\s*"[^"]*")re");
    std::ofstream out(file);
    out << std::regex_replace(text, ownName, "\"name\": \"" + a.name + "\"",
                              std::regex_constants::format_first_only);
    if (!out.flush())
        throw std::invalid_argument("cannot write " + file.string() + ": " + std::strerror(errno));
    const std::string program = scenario::programName(), argument = validation::shellWord(file.string());
    std::printf("%s\nnext: %s check %s && %s validate %s\n", file.c_str(), program.c_str(), argument.c_str(),
                program.c_str(), argument.c_str());
    return kOk;
}

}  // namespace

void addNewScenario(CLI::App& command, Action& action) {
    auto a = std::make_shared<NewScenarioArguments>();
    auto* scenario = command.add_subcommand(
        "scenario", "A scenario file that runs, with a reference and bounds, to be changed");
    scenario->add_option("name", a->name, "Name of the scenario")->required();
    offerNames(scenario->add_option("--from", a->from, "Scenario to begin with")->capture_default_str(),
               kScenarioNames);
    scenario->add_option("--out", a->out, "The file; default: its name and .json");
    scenario->callback([a, &action] { action = [a] { return newScenario(*a); }; });
}

}  // namespace rigor::cli
