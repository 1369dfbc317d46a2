// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The contact audit, gathered over a run.
#include <algorithm>
#include <cmath>

#include "reports/model/view_model.hpp"
#include "validation/results/values.hpp"

namespace rigor::report {

std::vector<GatheredAudit> gatherAudit(const results::Run& run) {
    std::vector<GatheredAudit> list;
    const auto worst = [](std::optional<double>& into, const std::optional<double>& value) {
        if (value && (!into || *value > *into || std::isnan(*value))) into = value;
    };
    for (const auto& scenario : run.scenarios) {
        std::vector<results::AuditRow> rows;
        for (const auto& row : run.cases) {
            if (row.scenario != scenario.name) continue;
            for (const auto& a : row.audit) {
                if (a.auditor.find('|') != std::string::npos) continue;  // pairs are on the scenario's page
                auto it = std::find_if(rows.begin(), rows.end(),
                                       [&](const auto& r) { return r.auditor == a.auditor; });
                if (it == rows.end()) {
                    rows.push_back({});
                    it = rows.end() - 1;
                    it->auditor = a.auditor;
                    it->outcome = a.outcome;
                }
                if (a.outcome != "completed") {
                    it->outcome = a.outcome;
                    it->note = a.note;
                }
                it->frames += a.frames;
                it->queries += a.queries;
                it->overlapping += a.overlapping;
                it->missed += a.missed;
                it->spurious += a.spurious;
                it->undecided += a.undecided;
                if (a.normalErrorMax && (!it->normalErrorMax || *a.normalErrorMax > *it->normalErrorMax))
                    it->worst = a.worst + " (" + row.spec + ") (dt=" + results::exactText(row.dt) + ")";
                worst(it->normalErrorMax, a.normalErrorMax);
                worst(it->depthErrorMax, a.depthErrorMax);
                worst(it->pointErrorMax, a.pointErrorMax);
            }
        }
        if (!rows.empty()) list.push_back({scenario.name, rows});
    }
    return list;
}

}  // namespace rigor::report
