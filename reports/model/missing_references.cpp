// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>

#include "reports/model/view_model.hpp"

namespace rigor::report {

std::vector<std::string> missingReferences(const results::Run& run) {
    std::vector<std::string> lines;
    for (const auto& scenario : run.scenarios) {
        const auto it = std::find_if(run.cases.begin(), run.cases.end(), [&](const results::CaseRow& c) {
            return c.scenario == scenario.name && c.verdict == results::Verdict::NoReference;
        });
        if (it != run.cases.end()) lines.push_back(scenario.name + ": " + it->reason);
    }
    return lines;
}

}  // namespace rigor::report
