// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/model/derived_runs.hpp"

#include <algorithm>
#include <set>

namespace rigor::report {

results::Run withoutDerivedRuns(results::Run run) {
    // Runs of version 0.1 have the tag "companion".
    const auto marksDerived = [](const std::string& tag) { return tag == "derived" || tag == "companion"; };
    std::set<std::string> derived;
    for (const auto& s : run.scenarios)
        if (std::any_of(s.tags.begin(), s.tags.end(), marksDerived)) derived.insert(s.name);
    const auto isDerived = [&](const auto& row) { return derived.contains(row.scenario); };
    run.plannedCases -= std::count_if(run.cases.begin(), run.cases.end(), isDerived);
    std::erase_if(run.scenarios, [&](const auto& s) { return derived.contains(s.name); });
    std::erase_if(run.cases, isDerived);
    std::erase_if(run.orders, isDerived);
    std::erase_if(run.fairness, isDerived);
    return run;
}

}  // namespace rigor::report
