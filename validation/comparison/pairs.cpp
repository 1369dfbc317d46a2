// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/pairs.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace rigor::validation {
namespace {

using results::CaseRow;
using results::Run;

/// True if no third case has a time step between those of the two; `a` is the coarser one.
bool areNeighbours(const CaseRow& a, const CaseRow& b, const std::vector<const CaseRow*>& all) {
    return a.dt > b.dt && std::none_of(all.begin(), all.end(), [&](const CaseRow* c) {
               return c->spec == a.spec && c->dt < a.dt && c->dt > b.dt;
           });
}

/// True if `a` is the case before `b` in their pair of one run.
bool comesFirst(const CaseRow& a, const CaseRow& b, PairBy by) {
    const auto rank = [&](const CaseRow& c) {
        return std::pair(by == PairBy::Spec && !results::isDefaultSpec(c), c.position);
    };
    return rank(a) < rank(b);
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

/// Specs of one engine in two runs are paired within a preset where that is possible: two solvers in four presets
/// are four pairs and not sixteen.
void keepPresets(std::vector<CasePair>& pairs) {
    const auto keyOf = [](const CasePair& pair) { return results::pairKey(*pair.before, PairBy::Spec); };
    const auto isOfOnePreset = [](const CasePair& pair) { return pair.before->preset == pair.after->preset; };
    std::set<results::PairKey> keys;
    for (const CasePair& pair : pairs)
        if (isOfOnePreset(pair)) keys.insert(keyOf(pair));
    std::erase_if(pairs,
                  [&](const CasePair& pair) { return !isOfOnePreset(pair) && keys.contains(keyOf(pair)); });
}

}  // namespace

bool isOneRun(const Run& before, const Run& after) {
    return &before == &after || (!before.directory.empty() && before.directory == after.directory);
}

std::vector<CasePair> pairCases(const Run& before, const Run& after, PairBy by) {
    const bool oneRun = by != PairBy::Nothing && isOneRun(before, after);
    const ByScenario others = byScenario(after);
    std::vector<CasePair> pairs;
    for (const CaseRow& a : before.cases) {
        const auto candidates = others.find(a.scenario);
        if (candidates == others.end()) continue;
        for (const CaseRow* b : candidates->second) {
            if (results::pairKey(a, by) != results::pairKey(*b, by) || !results::differBy(a, *b, by))
                continue;
            const bool isOnce =
                by == PairBy::TimeStep ? areNeighbours(a, *b, candidates->second) : comesFirst(a, *b, by);
            if (!oneRun || isOnce) pairs.push_back({&a, b});
        }
    }
    if (by == PairBy::Spec && !oneRun) keepPresets(pairs);
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
