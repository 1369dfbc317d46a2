// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <thread>

#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/numbers.hpp"
#include "cli/progress.hpp"
#include "cli/reference_checks.hpp"
#include "cli/run_folder.hpp"
#include "reports/report.hpp"
#include "reports/summaries/terminal.hpp"
#include "scenarios/loader/loader.hpp"
#include "scenarios/model/nearest.hpp"
#include "validation/results/insertion_orders.hpp"
#include "validation/results/judgement.hpp"
#include "validation/results/store.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/runner.hpp"

namespace rigor::cli {
namespace {

namespace fs = std::filesystem;

struct ValidateArguments {
    std::vector<std::string> what, overrides, timeSteps;
    std::string engines, out, baseline, shard;
    int jobs = 0, orders = 0;
    std::vector<int> pieces;
    validation::ReferenceLimits referenceLimits;
    bool resume = false, noAudit = false, json = false, quiet = false;
};

const std::string kDefaultSuite = "standard";

/// Content of the positional arguments, flattened: scenarios with their text, the engines and steps that a
/// suite requests.
struct Selection {
    std::vector<std::pair<scenario::Scenario, std::string>> scenarios;
    std::vector<std::string> engines;
    std::vector<double> timeSteps;
    ReferenceChecks references;
    std::string title;
    int orders = 1;
    std::optional<validation::Shard> shard;
};

void addScenario(Selection& selection, const std::string& name, const ValidateArguments& arguments,
                 int maxTimeSteps) {
    // The other shards compute the references of their own scenarios.
    const bool isOwn = !selection.shard || selection.shard->hasScenario(selection.scenarios.size());
    auto loaded = isOwn ? selection.references.load(name, arguments.overrides)
                        : scenario::loadScenario(scenario::findScenario(name), arguments.overrides);
    auto& steps = loaded.scenario.timeSteps;
    if (maxTimeSteps > 0 && steps.size() > static_cast<std::size_t>(maxTimeSteps)) steps.resize(maxTimeSteps);
    for (auto& present : selection.scenarios) {
        if (present.first.name != loaded.scenario.name) continue;
        if (present.second != loaded.text)
            throw std::invalid_argument("'" + name + "': another scenario of this run has the name '" +
                                        loaded.scenario.name + "'; rename one or use two runs");
        if (steps.size() > present.first.timeSteps.size()) present.first.timeSteps = steps;
        return;  // the longer list of time steps is run of a scenario that is given twice
    }
    selection.scenarios.emplace_back(std::move(loaded.scenario), std::move(loaded.text));
}

/// A misspelt suite is said as one: what is no file may be meant as either.
void checkName(const std::string& name) {
    if (fs::exists(name)) return;
    std::vector<std::string> known;
    for (const auto& list :
         {scenario::listScenarios(), scenario::listBenchScenarios(), scenario::listSuites()})
        for (const auto& entry : list) {
            if (entry.name == name) return;
            known.push_back(entry.name);
        }
    throw std::invalid_argument("no scenario, suite or file has the name '" + name + "'" +
                                scenario::didYouMean(name, known));
}

Selection select(const ValidateArguments& arguments) {
    Selection selection;
    if (!arguments.shard.empty()) selection.shard = validation::parseShard(arguments.shard);
    for (const auto& name : arguments.what) {
        selection.title += (selection.title.empty() ? "" : " ") + fs::path(name).stem().string();
        if (!isSuite(name)) {
            checkName(name);
            addScenario(selection, name, arguments, 0);
            continue;
        }
        const auto suite = scenario::loadSuite(scenario::findSuite(name));
        for (const auto& scenarioName : suite.scenarios)
            addScenario(selection, scenarioName, arguments, suite.maxTimeSteps);
        selection.orders = std::max(selection.orders, suite.orders);
        selection.engines.insert(selection.engines.end(), suite.engines.begin(), suite.engines.end());
        selection.timeSteps.insert(selection.timeSteps.end(), suite.timeSteps.begin(), suite.timeSteps.end());
    }
    return selection;
}

/// Every installed engine that can step a world.
std::vector<adapter::EngineSpec> allDynamicEngines(int jobs) {
    std::vector<adapter::EngineSpec> specs;
    for (const auto& d : validation::describeEngines(adapter::availableEngines(), ownBinary(), jobs)) {
        if (!d.problem.empty())
            say("engine " + d.info.name + " left out: " + d.problem);
        else if (d.capabilities.dynamics)
            specs.push_back({d.info.name, {}});
    }
    return specs;
}

std::vector<adapter::EngineSpec> chooseEngines(const ValidateArguments& arguments,
                                               const Selection& selection) {
    std::vector<adapter::EngineSpec> specs;
    if (!arguments.engines.empty())
        specs = adapter::parseSpecList(arguments.engines);
    else if (!selection.engines.empty())
        for (const auto& text : selection.engines) specs.push_back(adapter::parseSpec(text));
    else
        specs = allDynamicEngines(std::max(1, arguments.jobs));
    for (const auto& spec : specs)
        (void)adapter::moduleFor(spec);  // an engine that is not installed is said now
    return specs;
}

nlohmann::ordered_json caseJson(const results::CaseRow& c) {
    nlohmann::ordered_json metrics = nlohmann::ordered_json::array();
    for (const auto& m : c.metrics) {
        metrics.push_back({{"name", m.name},
                           {"subject", m.subject},
                           {"kind", m.kind},
                           {"value", m.value},
                           {"unit", m.unit}});
        if (m.bound) metrics.back()["bound"] = *m.bound;
        if (m.boundMin) metrics.back()["bound_min"] = *m.boundMin;
        metrics.back()["verdict"] = results::verdictName(m.verdict);
        if (m.relative) metrics.back()["relative"] = *m.relative;
        if (m.ideal) metrics.back()["ideal"] = *m.ideal;
        if (m.recorded) metrics.back()["recorded"] = *m.recorded;
        if (!m.note.empty()) metrics.back()["note"] = m.note;
        if (m.orderCount)
            metrics.back()["orders"] = {{"min", *m.orderMin}, {"max", *m.orderMax}, {"count", *m.orderCount}};
    }
    nlohmann::ordered_json orders = nullptr;
    if (c.orders.run)
        orders = {{"run", *c.orders.run},
                  {"completed", *c.orders.completed},
                  {"dependent", results::orderDependenceName(results::orderDependence(c))},
                  {"verdicts", c.orders.verdicts},
                  {"grade_best", results::gradeName(c.orders.best)},
                  {"grade_worst", results::gradeName(c.orders.worst)},
                  {"note", c.orders.note}};
    return {{"name", c.scenario},
            {"id", c.id},
            {"spec", c.spec},
            {"dt", c.dt},
            {"outcome", results::outcomeName(c.outcome)},
            {"verdict", results::verdictName(c.verdict)},
            {"reason", c.reason},
            {"grade", results::gradeName(c.accuracy.grade)},
            {"graded_by", c.accuracy.metric},
            {"regression", results::regressionName(c.regression)},
            {"regression_reason", c.regressionReason},
            {"red", results::isRed(c)},
            {"orders", orders},
            {"command", c.command},
            {"metrics", metrics}};
}

std::string resultText(const results::Run& run, const fs::path& directory, bool json) {
    if (!json)
        return report::terminalSummary(run, 40, terminalColumns(STDOUT_FILENO), wantsColour(STDOUT_FILENO));
    nlohmann::ordered_json out{{"run", directory.string()},
                               {"green", validation::runIsGreen(run) && !validation::judgesNothing(run)},
                               {"cases", nlohmann::json::array()}};
    for (const auto& c : run.cases) out["cases"].push_back(caseJson(c));
    return out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Text and verdicts of a run, which are left of it at its end. The report reads the run again, and two of a large one
/// would be in memory.
struct Ending {
    std::string text;
    int code = kOk;  ///< exit code of the run by itself, without a baseline
    bool missesByOtherValues = false;
};

Ending endingOf(const results::Run& run, const ValidateArguments& arguments, const fs::path& directory) {
    Ending ending;
    ending.text = !arguments.shard.empty() && !arguments.json
                      ? "Shard " + arguments.shard + ": " + std::to_string(run.cases.size()) +
                            " cases are stored in " + directory.string()
                      : resultText(run, directory, arguments.json);
    ending.missesByOtherValues = std::any_of(run.cases.begin(), run.cases.end(), [&](const auto& c) {
        return missesByOtherValues(c, arguments.overrides);
    });
    return ending;
}

/// Positional arguments of the run that is resumed.
std::vector<std::string> resumedWhat(const ValidateArguments& arguments) {
    const fs::path directory = chooseRunFolder(arguments.out, arguments.resume, "");
    prepareRunFolder(directory, true);
    std::istringstream words(results::readOutline(directory).suite);
    return {std::istream_iterator<std::string>(words), {}};
}

int validate(const ValidateArguments& given) {
    ValidateArguments arguments = given;
    if (arguments.what.empty())
        arguments.what = arguments.resume ? resumedWhat(arguments) : std::vector{kDefaultSuite};
    checkBaseline(arguments.baseline);
    Selection selection = select(arguments);
    const int jobs = std::max(1, arguments.jobs);
    const auto references = selection.references.check(arguments.referenceLimits, jobs);
    const auto specs = validation::withAllPresets(chooseEngines(arguments, selection), ownBinary());
    std::vector<double> timeSteps = selection.timeSteps;
    if (!arguments.timeSteps.empty()) timeSteps.clear();
    for (const auto& text : arguments.timeSteps) timeSteps.push_back(parseTimeStep(text));
    auto plan = validation::planCases(selection.scenarios, specs, timeSteps);
    validation::checkPlan(plan, ownBinary());
    if (selection.shard) plan = validation::casesOfShard(plan, *selection.shard);

    validation::RunOptions options;
    options.directory = chooseRunFolder(arguments.out, arguments.resume, selection.title);
    prepareRunFolder(options.directory, arguments.resume);
    options.binary = ownBinary();
    options.jobs = jobs;
    options.resume = arguments.resume;
    options.audit = !arguments.noAudit;
    options.records = recordedFolder();
    options.suite = selection.title;
    options.pieces = arguments.pieces;
    options.orders = arguments.orders > 0 ? arguments.orders : selection.orders;
    options.referenceLimits = arguments.referenceLimits;
    options.references = references;
    options.shard = selection.shard;
    options.command = ownCommandLine();

    if (options.resume) checkResumed(options.directory, plan);
    const std::atomic<bool>& interrupted = catchInterrupts();
    ProgressLine line(arguments.quiet);
    const auto again = [&] {
        return commandToGoOn(options.command, options.directory, options.resume, !arguments.out.empty());
    };
    std::optional<results::Run> run = orStopped(line, again, [&] {
        return validation::runCases(
            plan, options, [&](const validation::Progress& p) { line.update(p); }, interrupted);
    });
    if (interrupted) {
        std::fprintf(stderr, "Interrupted: %zu of %zu cases are stored. Go on with: %s\n",
                     results::readOutline(options.directory).cases.size(), plan.size(), again().c_str());
        return kInterrupted;
    }
    releaseInterrupts();
    Ending ending = endingOf(*run, arguments, options.directory);
    // A shard of which nothing is supported is one like others: `rigor merge` judges them together.
    ending.code = options.shard && validation::judgesNothing(*run) ? kOk : endOfRun(*run);
    if (!options.shard && !arguments.engines.empty()) sayIdleEngines(*run);
    run.reset();
    if (!options.shard) report::writeReports(options.directory);  // `rigor merge` writes one for all shards
    std::printf("%s\n", ending.text.c_str());
    if (ending.missesByOtherValues) std::fprintf(stderr, "note: %s\n", kBoundsNote);
    const bool worse = !arguments.baseline.empty() && becameWorseThan(arguments.baseline, options.directory);
    return worse ? kRed : ending.code;
}

}  // namespace

void addValidate(CLI::App& app, Action& action) {
    auto a = std::make_shared<ValidateArguments>();
    auto* command = app.add_subcommand(
        "validate", "Run scenarios on engines, compare with the references, write the report");
    auto* what = command->add_option("WHAT", a->what,
                                     "Suites or scenarios (names or files); default: the suite 'standard'");
    offerNames(offerNames(what, kSuiteNames), kScenarioNames);
    addEngines(*command, a->engines,
               "Engine specs, comma separated; default: all installed, each in all of its presets");
    command
        ->add_option("--dt", a->timeSteps,
                     "Time steps in seconds (0.004 or 1/240) instead of the scenarios' own")
        ->delimiter(',');
    command->add_option("--set", a->overrides, "Override a scenario value: KEY=VALUE")
        ->allow_extra_args(false);
    command->add_option("-j,--jobs", a->jobs, "Cases at a time (default 1: timings are taken alone)")
        ->check(between(1, 1024));
    command->add_option("--out", a->out, "Run folder (default: runs/<suite>-<time>)");
    command->add_flag("--resume", a->resume, "Go on with an interrupted run (--out, or the latest)");
    command->add_option("--baseline", a->baseline,
                        "Also compare with an earlier run, or with 'recorded'; worse is red");
    command
        ->add_option("--pieces", a->pieces,
                     "Also put the bodies back on the truth every K1,K2,... steps and measure one piece (see "
                     "`rigor pieces`)")
        ->delimiter(',')
        ->check(between(1, 1000000));
    command
        ->add_option("--orders", a->orders,
                     "Run every case in so many orders of insertion (bodies, shapes, joints, forces): as "
                     "written, reversed, shuffled; ranges stand beside the values (default: the suite's, 1)")
        ->check(between(1, 1000));
    command->add_option("--shard", a->shard,
                        "Run the K-th of N parts of the plan (K/N), without a report: for many machines; "
                        "`rigor merge` makes one run of them");
    addReferenceLimit(*command, a->referenceLimits);
    command->add_flag("--no-audit", a->noAudit, "Leave out the contact audit");
    command->add_flag("--json", a->json, "Print the results as JSON");
    command->add_flag("-q,--quiet", a->quiet, "No progress");
    command->footer(
        "Exit codes: 0 something was judged and nothing is red, 1 something is red, 2 bad command line or "
        "input file,\n"
        "            3 internal error, 4 nothing was judged: every case is unsupported, 6 nothing is red, "
        "but a reference\n"
        "            did not finish, ran out of memory or crashed, 7 the environment failed (no space, no "
        "permission,\n"
        "            killed from outside, damaged files), 130 interrupted (go on with --resume).");
    command->callback([a, &action] { action = [a] { return validate(*a); }; });
}

}  // namespace rigor::cli
