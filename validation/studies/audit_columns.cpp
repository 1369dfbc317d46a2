// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Columns of a study from the contact audit: what the run acted upon, held against the exact oracle.
#include "validation/studies/audit_columns.hpp"
#include "validation/runner/audit.hpp"

namespace rigor::validation {
namespace {

using results::AuditRow;

struct AuditField {
    const char* name;
    const char* unit;
    std::optional<double> (*of)(const AuditRow& row);
};

constexpr AuditField kFields[]{
    {"overlapping", "1", [](const AuditRow& r) { return std::optional<double>(r.overlapping); }},
    {"missed", "1", [](const AuditRow& r) { return std::optional<double>(r.missed); }},
    {"spurious", "1", [](const AuditRow& r) { return std::optional<double>(r.spurious); }},
    {"normal_error_max", "rad", [](const AuditRow& r) { return r.normalErrorMax; }},
    {"normal_error_median", "rad", [](const AuditRow& r) { return r.normalErrorMedian; }},
    {"depth_error_max", "m", [](const AuditRow& r) { return r.depthErrorMax; }},
    {"depth_error_median", "m", [](const AuditRow& r) { return r.depthErrorMedian; }},
    {"point_error_max", "m", [](const AuditRow& r) { return r.pointErrorMax; }},
};

}  // namespace

std::vector<std::string> auditFields() {
    std::vector<std::string> names;
    for (const AuditField& field : kFields) names.emplace_back(field.name);
    return names;
}

bool requestsAudit(const scenario::Study& study) {
    for (const auto& part : study.parts)
        for (const auto& metric : part.metrics)
            if (metric.starts_with(kAuditPrefix)) return true;
    return false;
}

StudyValue auditValue(const results::CaseRow& row, const std::string& field) {
    for (const AuditField& known : kFields) {
        if (field != known.name) continue;
        for (const AuditRow& a : row.audit)
            if (a.auditor == kInRun && a.queries > 0) return {known.of(a), known.unit};
        return {std::nullopt, known.unit};
    }
    return {};
}

}  // namespace rigor::validation
