// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <set>

#include "reports/writers.hpp"

namespace rigor::report {

results::Run withoutCompanions(results::Run run) {
    std::set<std::string> companions;
    for (const auto& s : run.scenarios)
        if (std::find(s.tags.begin(), s.tags.end(), "companion") != s.tags.end()) companions.insert(s.name);
    const auto isOfCompanion = [&](const auto& row) { return companions.contains(row.scenario); };
    run.plannedCases -= std::count_if(run.cases.begin(), run.cases.end(), isOfCompanion);
    std::erase_if(run.scenarios, [&](const auto& s) { return companions.contains(s.name); });
    std::erase_if(run.cases, isOfCompanion);
    std::erase_if(run.orders, isOfCompanion);
    std::erase_if(run.fairness, isOfCompanion);
    return run;
}

}  // namespace rigor::report
