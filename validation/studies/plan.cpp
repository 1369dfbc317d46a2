// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <map>

#include "validation/studies/columns.hpp"
#include "validation/studies/derived_runs.hpp"

namespace rigor::validation {
namespace {

using Assignment = std::vector<std::pair<std::string, std::string>>;

/// Every combination of values, the last key fastest.
std::vector<Assignment> combinations(
    const std::vector<std::pair<std::string, std::vector<std::string>>>& grid) {
    std::vector<Assignment> all{{}};
    for (const auto& [key, values] : grid) {
        std::vector<Assignment> longer;
        for (const Assignment& start : all)
            for (const std::string& value : values) {
                longer.push_back(start);
                longer.back().emplace_back(key, value);
            }
        all = std::move(longer);
    }
    return all;
}

adapter::EngineSpec specOf(const scenario::StudyVariant& variant, const Assignment& options) {
    adapter::EngineSpec spec = adapter::parseSpec(variant.engine);
    for (const auto& [key, value] : options) spec.options[key] = value;
    spec.options.emplace("preset", "default");
    (void)adapter::moduleFor(spec);  // an engine that is not installed is said now
    return spec;
}

/// A scenario with the values of one place of the grid.
struct Placed {
    scenario::LoadedScenario loaded;
    std::string base;
    Assignment parameters;
};

int movingBodies(const scenario::Scenario& s) {
    return std::count_if(s.bodies.begin(), s.bodies.end(),
                         [](const scenario::Body& b) { return b.type == scenario::BodyType::Dynamic; });
}

/// `base` as the file has it where nothing is changed, else with the part's name and the place in the grid:
/// results go by the name.
std::string placedName(const std::string& base, const scenario::StudyPart& part, std::size_t place,
                       bool many) {
    constexpr std::size_t kMost = 64;
    const std::string tail = "." + part.name + (many ? "-" + std::to_string(place + 1) : "");
    return base.substr(0, kMost - std::min(kMost - 1, tail.size())) + tail.substr(0, kMost - 1);
}

std::vector<Placed> placeScenarios(const scenario::StudyPart& part, const ScenarioLoader& load) {
    std::vector<Placed> all;
    const auto grid = combinations(part.parameters);
    for (const std::string& name : part.scenarios) {
        const std::string base = load(name, {}).scenario.name;
        for (std::size_t place = 0; place < grid.size(); ++place) {
            std::vector<std::string> overrides = part.overrides;
            for (const auto& [key, value] : grid[place]) overrides.push_back(key + "=" + value);
            if (!overrides.empty())
                overrides.push_back("name=" + placedName(base, part, place, grid.size() > 1));
            all.push_back({load(name, overrides), base, grid[place]});
        }
    }
    return all;
}

void planPart(const scenario::StudyPart& part, std::size_t index, const ScenarioLoader& load, StudyPlan& plan,
              DerivedRunPlanner& derived) {
    for (const std::string& metric : part.metrics) checkColumn(part, metric);
    const auto options = combinations(part.options);
    for (const Placed& placed : placeScenarios(part, load)) {
        const scenario::Scenario& s = placed.loaded.scenario;
        const std::vector<double> first{s.timeSteps.front()};
        for (const double dt : part.timeSteps.empty() ? first : part.timeSteps)
            for (const Assignment& chosen : options)
                for (const scenario::StudyVariant& variant : part.variants) {
                    const adapter::EngineSpec spec = specOf(variant, chosen);
                    const auto cases = planCases({{s, placed.loaded.text}}, {spec}, {dt});
                    Assignment parameters = placed.parameters;
                    parameters.insert(parameters.end(), chosen.begin(), chosen.end());
                    plan.rows.push_back({index,
                                         s.name,
                                         placed.base,
                                         parameters,
                                         variant.name,
                                         cases.front().spec.text(),
                                         cases.front().id,
                                         dt,
                                         movingBodies(s),
                                         "",
                                         {},
                                         {}});
                    derived.add(cases.front());
                    derived.addTo(plan.rows.back(), part, cases.front());
                }
    }
}

}  // namespace

StudyPlan planStudy(const scenario::Study& study, const ScenarioLoader& load, const OptionLookup& options) {
    StudyPlan plan;
    plan.study = study;
    DerivedRunPlanner derived(plan, options);
    for (std::size_t i = 0; i < study.parts.size(); ++i) {
        nameSymmetries(plan.study.parts[i]);
        planPart(plan.study.parts[i], i, load, plan, derived);
    }
    // The runner audits a scenario after its last case: cases of one scenario stand together.
    std::map<std::string, std::size_t> place;
    for (const CasePlan& c : plan.cases) place.emplace(c.scenario.name, place.size());
    std::stable_sort(plan.cases.begin(), plan.cases.end(), [&](const CasePlan& a, const CasePlan& b) {
        return place.at(a.scenario.name) < place.at(b.scenario.name);
    });
    return plan;
}

}  // namespace rigor::validation
