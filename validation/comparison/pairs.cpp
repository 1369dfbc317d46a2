// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/pairs.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <map>
#include <set>

namespace rigor::validation {
namespace {

using results::CaseRow;
using results::Run;

bool arePaired(const CaseRow& a, const CaseRow& b, PairBy by) {
    const bool sameStep = a.dt == b.dt, sameSpec = a.spec == b.spec;
    switch (by) {
        case PairBy::Nothing:
            return sameSpec && sameStep;
        case PairBy::Engine:
            return sameStep && a.engine != b.engine && a.preset == b.preset;
        case PairBy::Spec:
            return sameStep && !sameSpec;
        case PairBy::TimeStep:
            return sameSpec && !sameStep;
    }
    return false;
}

/// True if no third case has a time step between those of the two; `a` is the coarser one.
bool areNeighbours(const CaseRow& a, const CaseRow& b, const std::vector<const CaseRow*>& all) {
    return a.dt > b.dt && std::none_of(all.begin(), all.end(), [&](const CaseRow* c) {
               return c->spec == a.spec && c->dt < a.dt && c->dt > b.dt;
           });
}

using ByScenario = std::map<std::string, std::vector<const CaseRow*>>;

ByScenario byScenario(const Run& run) {
    ByScenario cases;
    for (const CaseRow& c : run.cases) cases[c.scenario].push_back(&c);
    return cases;
}

/// "a, b, c and 5 more".
std::string listed(const std::set<std::string>& names) {
    constexpr std::size_t kMost = 6;
    std::string text;
    std::size_t count = 0;
    for (const std::string& name : names) {
        if (count++ == kMost) break;
        text += (text.empty() ? "" : ", ") + name;
    }
    if (names.size() > kMost) text += " and " + std::to_string(names.size() - kMost) + " more";
    return text.empty() ? "none" : text;
}

}  // namespace

const char* pairByName(PairBy by) {
    constexpr const char* kNames[] = {"", "engine", "spec", "dt"};
    return kNames[static_cast<std::size_t>(by)];
}

std::optional<PairBy> parsePairBy(const std::string& name) {
    for (const PairBy by : {PairBy::Nothing, PairBy::Engine, PairBy::Spec, PairBy::TimeStep})
        if (name == pairByName(by)) return by;
    return std::nullopt;
}

std::vector<CasePair> pairCases(const Run& before, const Run& after, PairBy by) {
    const bool oneRun =
        &before == &after || (!before.directory.empty() && before.directory == after.directory);
    const ByScenario others = byScenario(after);
    std::vector<CasePair> pairs;
    for (const CaseRow& a : before.cases) {
        const auto candidates = others.find(a.scenario);
        if (candidates == others.end()) continue;
        for (const CaseRow* b : candidates->second) {
            if (!arePaired(a, *b, by)) continue;
            if (oneRun && by == PairBy::TimeStep && !areNeighbours(a, *b, candidates->second)) continue;
            if (oneRun && (by == PairBy::Engine || by == PairBy::Spec) && a.position >= b->position) continue;
            pairs.push_back({&a, b});
        }
    }
    return pairs;
}

std::string contentsOf(const Run& run) {
    std::set<std::string> scenarios, specs, steps;
    for (const CaseRow& c : run.cases) {
        char dt[32];
        std::snprintf(dt, sizeof dt, "%.6g", c.dt);
        scenarios.insert(c.scenario);
        specs.insert(c.spec);
        steps.insert(dt);
    }
    return "scenarios: " + listed(scenarios) + "; engines: " + listed(specs) + "; dt: " + listed(steps);
}

}  // namespace rigor::validation
