// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The contact audit as the page shows it: of one case, of the run itself, and gathered over a run.
#include <algorithm>
#include <cmath>

#include "reports/page_json.hpp"
#include "reports/view_model.hpp"
#include "validation/results/values.hpp"

namespace rigor::report {

using results::CaseRow;

Json auditJson(const CaseRow& row) {
    Json list = Json::array();
    for (const auto& a : row.audit)
        list.push_back({{"auditor", a.auditor},
                        {"outcome", a.outcome},
                        {"frames", a.frames},
                        {"queries", a.queries},
                        {"overlapping", a.overlapping},
                        {"missed", a.missed},
                        {"spurious", a.spurious},
                        {"undecided", a.undecided},
                        {"normalErrorMax", number(a.normalErrorMax)},
                        {"normalErrorMedian", number(a.normalErrorMedian)},
                        {"depthErrorMax", number(a.depthErrorMax)},
                        {"depthErrorMedian", number(a.depthErrorMedian)},
                        {"pointErrorMax", number(a.pointErrorMax)},
                        {"worst", a.worst},
                        {"note", a.note}});
    return list;
}

Json inRunJson(const CaseRow& row) {
    const auto a = std::find_if(row.audit.begin(), row.audit.end(),
                                [](const auto& r) { return r.auditor == "in_run" && r.queries > 0; });
    if (a == row.audit.end()) return nullptr;
    const auto value = [&](const char* metric) {
        const auto* m = findMetric(row, metric);
        return m ? number(m->value) : Json(nullptr);
    };
    return {{"queries", a->queries},
            {"overlapping", a->overlapping},
            {"missed", a->missed},
            {"spurious", a->spurious},
            {"normal", number(a->normalErrorMax)},
            {"depth", number(a->depthErrorMax)},
            {"point", number(a->pointErrorMax)},
            {"worst", a->worst},
            {"normalFlicker", value("normal_flicker")},
            {"contactFlicker", value("contact_flicker")}};
}

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

Json gatheredAudit(const results::Run& run) {
    Json list = Json::array();
    for (const auto& gathered : gatherAudit(run)) {
        CaseRow holder;
        holder.audit = gathered.rows;
        list.push_back({{"scenario", gathered.scenario}, {"rows", auditJson(holder)}});
    }
    return list;
}

}  // namespace rigor::report
