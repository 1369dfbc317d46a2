// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The contact audit as the page shows it: of one case, of the run itself, and gathered over a run.
#include "reports/page/audit_json.hpp"

#include <algorithm>

#include "reports/model/view_model.hpp"

namespace rigor::report {

using results::CaseRow;

namespace {

/// The array that the store holds as text; empty in runs before schema 11.
Json findingsOf(const results::AuditRow& row) {
    if (row.findings.empty()) return Json::array();
    return Json::parse(row.findings);
}

/// Places of the worst normals: of the deepest points, and of any point (the metric normal_error).
Json normalsOf(const results::AuditRow& row) {
    Json list = Json::array();
    for (const Json& found : findingsOf(row)) {
        const auto what = found.at("what").get<std::string>();
        if (!what.ends_with("normal")) continue;
        const Json& exact = found.at("exact");
        const auto name = [&](int side) { return found.at("names").at(side).get<std::string>(); };
        list.push_back({{"what", what},
                        {"error", found.at("error")},
                        {"pair", name(0) + "|" + name(1)},
                        {"time", found.at("time")},
                        {"step", found.at("step")},
                        {"contact", found.at("contact")},
                        {"distance", exact.is_null() ? Json(nullptr) : exact.at("distance")}});
    }
    return list;
}

}  // namespace

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
                        {"note", a.note},
                        {"findings", findingsOf(a)}});
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
            {"normals", normalsOf(*a)},
            {"normalFlicker", value("normal_flicker")},
            {"contactFlicker", value("contact_flicker")}};
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
