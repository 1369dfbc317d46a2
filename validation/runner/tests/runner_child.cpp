// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The smallest program that can be a run's binary: what `rigor` does with `__case`, `__audit`, `__describe`,
// `__reference`, with references that break down beside the real ones. `__run` makes a whole run in a process of its own.
#include <nlohmann/json.hpp>

#include "adapters/interface/registry.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/runner.hpp"
#include "validation/runner/tests/reference_doubles.hpp"

namespace {

using namespace rigor;

int wholeRun(const std::filesystem::path& requestFile) {
    const auto request = validation::readJsonFile(requestFile);
    if (!request) return 2;
    std::vector<std::pair<scenario::Scenario, std::string>> scenarios;
    for (const auto& text : request->at("texts")) {
        auto loaded = scenario::loadScenarioText(text.get<std::string>(), "test.json");
        scenarios.emplace_back(std::move(loaded.scenario), std::move(loaded.text));
    }
    validation::RunOptions options;
    options.directory = request->at("folder").get<std::string>();
    options.binary = "/proc/self/exe";
    options.resume = request->at("resume");
    options.suite = options.command = "test";
    options.binary = std::filesystem::read_symlink(options.binary);
    const auto plan =
        validation::planCases(scenarios, adapter::parseSpecList(request->at("specs").get<std::string>()), {});
    const std::atomic<bool> never{false};
    const auto run = validation::runCases(plan, options, {}, never);
    return run.finished.empty() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
    return validation::childMain({argv + 1, argv + argc}, {{"__run", wholeRun}}, doubles::makeReference);
}
