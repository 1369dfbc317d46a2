// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/header.hpp"

#include <set>

#include "scenarios/loader/data_folder.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/references/reference.hpp"
#include "validation/results/files.hpp"
#include "validation/results/values.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/environment.hpp"
#include "validation/runner/shell_word.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;

fs::path storedScenario(const std::string& name, const fs::path& run) {
    return run / "scenarios" / (name + ".json");
}

results::ScenarioRow scenarioRow(const CasePlan& plan, const ReferenceCheck& reference) {
    const scenario::Scenario& s = plan.scenario;
    results::ScenarioRow row;
    row.name = s.name;
    row.title = s.title;
    row.description = s.description;
    row.source = s.source;
    row.isolates = s.isolates;
    row.tags = s.tags;
    row.metrics = s.metrics;
    for (const int body : s.observed) row.observed.push_back(s.bodies[body].name);
    row.dimension = s.dimension;
    row.duration = s.duration;
    row.timeSteps = s.timeSteps;
    row.text = plan.scenarioText;
    row.referenceOutcome = referenceOutcomeName(reference.outcome);
    if (!s.reference) return row;
    row.reference = s.reference->name;
    if (const ReferenceEntry* entry = findReference(s.reference->name); entry != nullptr) {
        row.referenceTitle = entry->title;
        row.referenceFormula = entry->formula;
        row.referenceTex = entry->tex;
        row.referenceSource = entry->source;
    }
    row.referenceProblem = reference.problem;
    return row;
}

results::EngineRow engineRow(const EngineDescription& d) {
    return {d.info.name,       d.info.title, d.info.version,      d.info.precision,
            d.info.buildNotes, d.problem,    capabilitiesText(d), d.info.package};
}

}  // namespace

std::map<std::string, bool> inLibrary(const std::vector<results::ScenarioRow>& scenarios) {
    std::map<std::string, fs::path> files;
    for (const auto& list : {scenario::listScenarios(), scenario::listBenchScenarios()})
        for (const auto& entry : list) files.emplace(entry.name, entry.file);
    std::map<std::string, bool> found;
    for (const auto& s : scenarios) {
        const auto file = files.find(s.name);
        if (file == files.end()) continue;
        try {
            found[s.name] = scenario::loadScenario(file->second).text == s.text;
        } catch (const std::exception&) {  // an unreadable library: then the stored file is the one to name
        }
    }
    return found;
}

std::string reproduceCommand(const CasePlan& plan, const fs::path& run, bool fromLibrary) {
    const std::string scenario =
        fromLibrary ? plan.scenario.name : storedScenario(plan.scenario.name, run).string();
    return scenario::programName() + " run " + shellWord(scenario) + " --engine " +
           shellWord(plan.spec.text()) + " --dt " + results::exactText(plan.dt);
}

void writeScenarioFiles(const std::vector<CasePlan>& plan, const fs::path& run) {
    results::createFolders(run / "scenarios");
    std::set<std::string> written;
    for (const CasePlan& c : plan) {
        if (!written.insert(c.scenario.name).second) continue;
        results::replaceFile(storedScenario(c.scenario.name, run), c.scenarioText);
    }
}

std::map<std::string, ReferenceCheck> plannedReferences(const std::vector<CasePlan>& plan,
                                                        const RunOptions& options) {
    auto references = options.references;
    std::vector<ReferenceQuestion> queries;
    for (const CasePlan& c : plan)
        if (references.emplace(c.scenario.name, ReferenceCheck{}).second)
            queries.push_back({c.scenarioText, c.scenario.name, c.scenario.reference.has_value()});
    const auto checks = checkReferences(queries, options.referenceLimits, options.binary, options.jobs);
    for (std::size_t i = 0; i < queries.size(); ++i) references[queries[i].name] = checks[i];
    return references;
}

results::Run runHeader(const std::vector<CasePlan>& plan, const RunOptions& options,
                       const std::vector<EngineDescription>& engines,
                       const std::map<std::string, ReferenceCheck>& references) {
    results::Run run;
    run.suite = options.suite;
    run.command = options.command;
    run.started = isoTime();
    run.environment = describeEnvironment();
    run.environment["jobs"] = std::to_string(options.jobs);
    if (options.shard) {
        run.environment[kShardKey] =
            std::to_string(options.shard->number) + "/" + std::to_string(options.shard->count);
        run.environment[kPlanKey] = options.shard->plan;
        run.environment[kShardVersionKey] = RIGOR_VERSION;
        run.environment[kPlannedKey] = std::to_string(options.shard->planned);
    }
    for (const EngineDescription& d : engines) {
        run.engines.push_back(engineRow(d));
        if (d.problem.empty())
            run.environment["engine_" + d.info.name] =
                results::versionText(run.engines.back()) + " " + d.info.precision;
    }
    std::set<std::string> seen;
    for (const CasePlan& c : plan)
        if (seen.insert(c.scenario.name).second)
            run.scenarios.push_back(scenarioRow(c, references.at(c.scenario.name)));
    run.plannedCases = plan.size();
    return run;
}

}  // namespace rigor::validation
