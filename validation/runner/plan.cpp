// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <map>
#include <set>
#include <stdexcept>

#include "validation/hash.hpp"
#include "validation/runner/runner.hpp"
#include "validation/runner/scenario_settings.hpp"

namespace rigor::validation {
namespace {

std::vector<adapter::EngineSpec> withPresets(const std::vector<adapter::EngineSpec>& specs) {
    std::vector<adapter::EngineSpec> expanded;
    std::set<std::string> seen;
    const auto add = [&](adapter::EngineSpec spec) {
        if (seen.insert(spec.text()).second) expanded.push_back(std::move(spec));
    };
    for (const auto& spec : specs) {
        if (spec.options.contains("preset")) {
            add(spec);
            continue;
        }
        for (const char* preset : {"default", "matched"}) {
            adapter::EngineSpec one = spec;
            one.options["preset"] = preset;
            add(std::move(one));
        }
    }
    return expanded;
}

/// The same work has the same id, today and in another run; another version of the harness is other work.
std::string caseId(const std::string& scenarioText, const std::string& spec, double dt) {
    Fnv1a hash;
    hash.text(RIGOR_VERSION);
    hash.text(scenarioText);
    hash.text(spec);
    hash.number(dt);
    return hash.hex();
}

}  // namespace

std::vector<CasePlan> planCases(
    const std::vector<std::pair<scenario::Scenario, std::string>>& scenariosAndTexts,
    const std::vector<adapter::EngineSpec>& specs, const std::vector<double>& timeSteps) {
    const auto expanded = withPresets(specs);
    std::vector<CasePlan> plan;
    std::map<std::string, std::string> textOf;
    for (const auto& [scenario, text] : scenariosAndTexts) {
        const auto [it, isNew] = textOf.emplace(scenario.name, text);
        if (!isNew && it->second != text)
            throw std::invalid_argument("two different scenarios are named '" + scenario.name + "'");
        if (!isNew) continue;
        std::set<double> done;
        for (const double dt : timeSteps.empty() ? scenario.timeSteps : timeSteps) {
            if (!done.insert(dt).second) continue;
            for (const auto& requested : expanded) {
                const adapter::EngineSpec spec = withScenarioSettings(requested, text);
                plan.push_back({caseId(text, spec.text(), dt), text, scenario, spec, dt});
            }
        }
    }
    return plan;
}

}  // namespace rigor::validation
