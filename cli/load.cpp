// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "cli/command.hpp"
#include "cli/numbers.hpp"
#include "cli/reference_checks.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/results/types.hpp"

namespace rigor::cli {
namespace {

using validation::ReferenceOutcome;

/// "reference.timeout" of "reference_timeout".
std::string problemId(ReferenceOutcome outcome) {
    std::string id = validation::referenceOutcomeName(outcome);
    std::replace(id.begin(), id.begin() + (id.find('_') + 1), '_', '.');
    return id;
}

const char* expectedOf(ReferenceOutcome outcome) {
    switch (outcome) {
        case ReferenceOutcome::Assumption:
            return "values for which the reference holds";
        case ReferenceOutcome::Timeout:
            return "a solution in that time; --reference-limit SECONDS gives it more";
        case ReferenceOutcome::Invalid:
            return "a reference of `rigor list references`";
        default:
            return "a solution";
    }
}

}  // namespace

bool isSuite(const std::string& name) {
    for (const auto& suite : scenario::listSuites())
        if (suite.name == name || suite.file == name) return true;
    return scenario::isSuiteFile(name);
}

std::vector<std::string> scenarioNames(const std::vector<std::string>& given) {
    std::vector<std::string> names;
    for (const auto& name : given) {
        if (!isSuite(name)) {
            names.push_back(name);
            continue;
        }
        const auto suite = scenario::loadSuite(scenario::findSuite(name));
        names.insert(names.end(), suite.scenarios.begin(), suite.scenarios.end());
    }
    return names;
}

scenario::LoadedScenario loadWithReference(const std::string& nameOrFile,
                                           const std::vector<std::string>& overrides,
                                           const validation::ReferenceLimits& limits, bool mustHold,
                                           validation::ReferenceCheck* found) {
    ReferenceChecks checks;
    auto loaded = checks.load(nameOrFile, overrides);
    const auto result = checks.check(limits, 1, mustHold);
    if (found != nullptr) *found = result.at(loaded.scenario.name);
    return loaded;
}

scenario::LoadedScenario ReferenceChecks::load(const std::string& nameOrFile,
                                               const std::vector<std::string>& overrides) {
    const auto file = scenario::findScenario(nameOrFile);
    auto loaded = scenario::loadScenario(file, overrides);
    const std::string& name = loaded.scenario.name;
    if (const auto last = last_.find(name);
        last != last_.end() && questions_[last->second].text == loaded.text)
        return loaded;
    last_[name] = questions_.size();
    loaded_.push_back({file, loaded.referenceLine});
    questions_.push_back({loaded.text, name, loaded.scenario.reference.has_value()});
    return loaded;
}

std::map<std::string, validation::ReferenceCheck> ReferenceChecks::check(
    const validation::ReferenceLimits& limits, int jobs, bool mustHold,
    const std::set<std::string>* only) const {
    std::vector<validation::ReferenceQuestion> requested;
    std::vector<Loaded> loaded;
    for (std::size_t i = 0; i < questions_.size(); ++i)
        if (only == nullptr || only->contains(questions_[i].name)) {
            requested.push_back(questions_[i]);
            loaded.push_back(loaded_[i]);
        }
    const auto checks = validation::checkReferences(requested, limits, ownBinary(), jobs);
    std::map<std::string, validation::ReferenceCheck> byName;
    for (std::size_t i = 0; i < checks.size(); ++i) {
        const auto& check = checks[i];
        byName[requested[i].name] = check;
        if (check.problem.empty()) continue;
        const scenario::Problem problem{
            problemId(check.outcome), loaded[i].file.string(), "/reference",
            loaded[i].line,           check.problem,           expectedOf(check.outcome)};
        if (mustHold || check.outcome == ReferenceOutcome::Invalid) throw scenario::LoadError({problem});
        std::fprintf(stderr, "%s; it runs without a reference\n", problem.text().c_str());
    }
    return byName;
}

bool isBrokenReference(const scenario::Problem& problem) {
    return problem.id == problemId(ReferenceOutcome::Timeout) ||
           problem.id == problemId(ReferenceOutcome::OutOfMemory) ||
           problem.id == problemId(ReferenceOutcome::Crashed);
}

void addEngines(CLI::App& command, std::string& engines, const std::string& help, const std::string& flags) {
    offerNames(command.add_option(flags, engines, help), kEngineNames)->check([](const std::string& text) {
        const bool empty = text.find_first_not_of(" ,") == std::string::npos;
        return empty ? "found '" + text + "', expected engine specs (`rigor list engines`)" : std::string();
    });
}

void addReferenceLimit(CLI::App& command, validation::ReferenceLimits& limits) {
    command
        .add_option(
            "--reference-limit", limits.seconds,
            "Time that the reference of a scenario may take [s] (default 20); beyond it the case runs "
            "without one")
        ->check(positiveNumber());
}

bool missesByOtherValues(const results::CaseRow& row, const std::vector<std::string>& overrides) {
    const bool isOther = std::any_of(overrides.begin(), overrides.end(),
                                     [](const std::string& text) { return !text.starts_with("accept"); });
    return isOther && std::any_of(row.metrics.begin(), row.metrics.end(), [](const results::MetricRow& m) {
               return m.verdict == results::Verdict::Fail && (m.kind == "exact" || m.kind == "scheme_exact");
           });
}

}  // namespace rigor::cli
