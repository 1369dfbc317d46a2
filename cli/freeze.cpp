// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>

#include "cli/command.hpp"
#include "cli/numbers.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/contact_problems/export_step.hpp"
#include "validation/results/counted.hpp"
#include "validation/runner/judge.hpp"
#include "validation/runner/scenario_settings.hpp"
#include "validation/runner/simulate.hpp"

namespace rigor::cli {
namespace {

struct FreezeArguments {
    std::string scenario, engine = validation::kInHouseEngine, dt, out;
    std::vector<std::string> overrides;
    std::size_t step = 0;
    double time = -1.0;
};

int exportStep(const FreezeArguments& a) {
    const auto loaded = loadWithReference(a.scenario, a.overrides, {});
    validation::ExportRequest request;
    request.scenarioText = loaded.text;
    request.scenarioName = loaded.scenario.name;
    request.spec = validation::withScenarioSettings(adapter::parseSpec(a.engine), loaded.text);
    request.dt = a.dt.empty() ? loaded.scenario.timeSteps.front() : parseTimeStep(a.dt);
    request.step = validation::stepCount(loaded.scenario, request.dt);
    if (a.step > 0) request.step = a.step;
    if (a.time >= 0.0)
        request.step = static_cast<std::size_t>(std::max(1.0, std::round(a.time / request.dt)));
    const validation::ExportSummary summary = validation::exportToFile(request, ownBinary(), a.out);
    std::printf("%s: step %zu of %s by %s, to t = %g s: %s, %s", a.out.c_str(), request.step,
                loaded.scenario.name.c_str(), request.spec.text().c_str(), summary.time,
                results::counted(summary.contacts, "contact").c_str(),
                (summary.bodies == 1 ? "1 body" : std::to_string(summary.bodies) + " bodies").c_str());
    if (summary.storedResidual >= 0.0)
        std::printf(", natural map of the engine's own solution %.1e", summary.storedResidual);
    std::printf("\n");
    return kOk;
}

}  // namespace

void addFreeze(CLI::App& app, Action& action) {
    auto a = std::make_shared<FreezeArguments>();
    auto* command =
        app.add_subcommand("freeze", "Write one step of a run as a contact problem (FCLIB's HDF5 layout)");
    offerNames(command->add_option("SCENARIO", a->scenario, "Name or file")->required(), kScenarioNames);
    offerNames(command->add_option("-e,--engine", a->engine, "Engine spec (default: rigor)"), kEngineNames);
    command->add_option("--dt", a->dt,
                        "Time step in seconds (0.004 or 1/240); default: the scenario's first");
    auto* step = command->add_option("--step", a->step, "The step, from 1 (default: the last)")
                     ->check(between(std::size_t{1}, std::size_t{1000000000}));
    command->add_option("--time", a->time, "The step that ends nearest to this time [s]")
        ->check(nonNegativeNumber())
        ->excludes(step);
    command->add_option("--set", a->overrides, "Override a scenario value: KEY=VALUE");
    command->add_option("--out", a->out, "The file, .hdf5")->required();
    command->footer(
        "Exit codes: 0 written, 2 bad command line or scenario, or a step without contacts, 3 the engine "
        "crashed,\n"
        "            4 the engine lacks what the scenario needs, or the step has what the form has no place "
        "for.");
    command->callback([a, &action] { action = [a] { return exportStep(*a); }; });
}

}  // namespace rigor::cli
