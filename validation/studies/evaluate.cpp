// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "validation/comparison/order.hpp"
#include "validation/studies/audit_columns.hpp"
#include "validation/studies/columns.hpp"
#include "validation/studies/derived_columns.hpp"
#include "validation/studies/study.hpp"

namespace rigor::validation {
namespace {

using results::CaseRow;
using results::Outcome;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The run ended badly: the worst value any metric can show.
bool broke(Outcome outcome) {
    return outcome == Outcome::Crashed || outcome == Outcome::Timeout || outcome == Outcome::NonFinite ||
           outcome == Outcome::OutOfMemory;
}

double judged(const StudyResultRow& row, std::size_t metric) {
    if (row.ran && broke(row.outcome)) return kInfinity;
    return row.values[metric].value.value_or(kNaN);
}

/// Least-squares slope of log(value) over log(bodies).
double growthExponent(const std::vector<std::pair<int, double>>& points) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const auto& [bodies, value] : points) {
        if (!(value > 0.0) || bodies < 1) return kNaN;
        const double x = std::log(bodies), y = std::log(value);
        n += 1;
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    const double spread = n * sxx - sx * sx;
    return spread > 0.0 ? (n * sxy - sx * sy) / spread : kNaN;
}

/// Value of a variant: its worst row, or how its rows grow.
double shownBy(const StudyResult& result, std::size_t part, const std::string& variant) {
    const scenario::StudySymptom& symptom = *result.study.parts[part].symptom;
    const auto& metrics = result.study.parts[part].metrics;
    const auto metric =
        static_cast<std::size_t>(std::find(metrics.begin(), metrics.end(), symptom.metric) - metrics.begin());
    std::vector<std::pair<int, double>> points;
    for (const StudyResultRow& row : result.rows)
        if (row.row.part == part && row.row.variant == variant)
            points.emplace_back(row.row.bodies, judged(row, metric));
    if (points.empty()) return kNaN;
    if (symptom.growth) return growthExponent(points);
    double worst = points.front().second;
    for (const auto& point : points)
        if (std::isnan(point.second) || point.second > worst) worst = point.second;
    return worst;
}

/// "key: one -> other" for every setting in which two cases differ.
std::vector<std::string> differences(const CaseRow& fault, const CaseRow& cure) {
    std::vector<std::string> list;
    for (const auto& [key, value] : fault.settings) {
        const auto it = cure.settings.find(key);
        if (it == cure.settings.end() || it->second == value) continue;
        list.push_back(key + ": " + value + " -> " + it->second);
    }
    if (fault.engine != cure.engine) list.push_back("engine: " + fault.engine + " -> " + cure.engine);
    return list;
}

const CaseRow* caseOf(const std::map<std::string, const CaseRow*>& cases, const StudyPlan& plan,
                      std::size_t part, const std::string& variant) {
    for (const StudyRow& row : plan.rows)
        if (row.part == part && row.variant == variant)
            if (const auto it = cases.find(row.caseId); it != cases.end()) return it->second;
    return nullptr;
}

/// True if both rows are at the same place of the grid except for the time step.
bool sameRefinement(const StudyRow& a, const StudyRow& b) {
    return a.part == b.part && a.base == b.base && a.parameters == b.parameters && a.variant == b.variant;
}

/// Columns "order.METRIC": the observed order of the time-step refinement that a row belongs to.
void fillOrders(StudyResult& result, const std::map<std::string, const CaseRow*>& cases) {
    for (StudyResultRow& row : result.rows) {
        const auto& metrics = result.study.parts[row.row.part].metrics;
        for (std::size_t i = 0; i < metrics.size(); ++i) {
            if (!metrics[i].starts_with(kOrderPrefix)) continue;
            std::vector<RefinementPoint> refinement;
            for (const StudyResultRow& other : result.rows) {
                if (!sameRefinement(row.row, other.row)) continue;
                const auto it = cases.find(other.row.caseId);
                if (it == cases.end() || it->second->outcome != Outcome::Completed) continue;
                const auto value = studyValue(*it->second, metrics[i].substr(kOrderPrefix.size()));
                if (value.value) refinement.push_back({other.row.dt, *value.value});
            }
            if (const auto fit = observedOrder(refinement)) row.values[i] = {fit->order, "1", ""};
        }
    }
}

bool isAbout(const scenario::StudyFinding& finding, const StudyRow& row) {
    if (row.variant != finding.variant) return false;
    return std::all_of(finding.where.begin(), finding.where.end(), [&](const auto& condition) {
        const auto& [key, value] = condition;
        if (key == "scenario") return row.base == value;
        if (key == "dt") return std::abs(std::stod(value) - row.dt) <= 1e-9 * row.dt;
        return std::find(row.parameters.begin(), row.parameters.end(), condition) != row.parameters.end();
    });
}

FindingVerdict judgeFinding(const StudyResult& result, std::size_t part, std::size_t index) {
    const auto& finding = result.study.parts[part].findings[index];
    const auto& metrics = result.study.parts[part].metrics;
    const auto metric =
        static_cast<std::size_t>(std::find(metrics.begin(), metrics.end(), finding.metric) - metrics.begin());
    FindingVerdict verdict;
    verdict.part = part;
    verdict.finding = index;
    verdict.holds = true;
    for (const StudyResultRow& row : result.rows) {
        if (row.row.part != part || !isAbout(finding, row.row)) continue;
        const double value = judged(row, metric);
        if (std::isnan(value)) verdict.holds = false;
        if (std::isnan(value)) continue;
        verdict.least = std::min(value, verdict.least.value_or(value));
        verdict.greatest = std::max(value, verdict.greatest.value_or(value));
    }
    if (!verdict.least) verdict.holds = false;
    if (verdict.least && finding.atLeast && *verdict.least < *finding.atLeast) verdict.holds = false;
    if (verdict.greatest && finding.atMost && *verdict.greatest > *finding.atMost) verdict.holds = false;
    return verdict;
}

/// A run that a finding says does not survive.
bool mayBreak(const scenario::StudyPart& part, const StudyRow& row) {
    if (part.symptom && part.symptom->fault == row.variant) return true;
    return std::any_of(part.findings.begin(), part.findings.end(), [&](const auto& finding) {
        return isAbout(finding, row) && finding.atLeast && !finding.atMost;
    });
}

/// "1e-05 .. 0.02 over 3 orders" where the order of insertion makes a difference that is shown; else "".
std::string orderRange(const results::MetricRow& m) {
    if (!m.orderMin || !m.orderMax || !m.orderCount) return "";
    char least[32], greatest[32];
    std::snprintf(least, sizeof least, "%.4g", *m.orderMin);
    std::snprintf(greatest, sizeof greatest, "%.4g", *m.orderMax);
    if (std::string(least) == greatest) return "";
    return std::string(least) + " .. " + greatest + " over " + std::to_string(*m.orderCount) + " orders";
}

}  // namespace

StudyValue studyValue(const CaseRow& row, const std::string& metric) {
    const std::string timePrefix = "time.";
    if (metric.starts_with(timePrefix)) {
        for (const auto& t : row.timings)
            if (t.phase == metric.substr(timePrefix.size()) && t.samples > 0) return {t.median, "s", ""};
        return {std::nullopt, "s", ""};
    }
    if (metric.starts_with(kAuditPrefix)) return auditValue(row, metric.substr(kAuditPrefix.size()));
    const std::string quantityPrefix = "quantity.";
    if (metric.starts_with(quantityPrefix)) {
        for (const auto& q : row.quantities)
            if (q.name == metric.substr(quantityPrefix.size())) return {q.measured, q.unit, ""};
        return {};
    }
    const auto colon = metric.find(':');
    const std::string name = metric.substr(0, colon);
    const std::string subject = colon == std::string::npos ? "" : metric.substr(colon + 1);
    for (const auto& m : row.metrics)
        if (m.name == name && m.subject == subject) return {m.value, m.unit, orderRange(m)};
    return {};
}

StudyResult evaluateStudy(const StudyPlan& plan, const results::Run& run) {
    StudyResult result;
    result.study = plan.study;
    std::map<std::string, const CaseRow*> cases;
    for (const CaseRow& c : run.cases) cases[c.id] = &c;
    for (const StudyRow& row : plan.rows) {
        StudyResultRow shown;
        shown.row = row;
        const auto& metrics = plan.study.parts[row.part].metrics;
        shown.values.resize(metrics.size());
        if (const auto it = cases.find(row.caseId); it != cases.end()) {
            shown.ran = true;
            shown.outcome = it->second->outcome;
            shown.reason = it->second->reason;
            for (std::size_t i = 0; i < metrics.size(); ++i)
                if (columnOf(metrics[i]).kind == Column::Kind::OfCase)
                    shown.values[i] = studyValue(*it->second, metrics[i]);
        }
        result.rows.push_back(std::move(shown));
    }
    fillOrders(result, cases);
    fillDerivedColumns(result, plan, run);
    for (std::size_t part = 0; part < plan.study.parts.size(); ++part)
        for (std::size_t i = 0; i < plan.study.parts[part].findings.size(); ++i)
            result.findings.push_back(judgeFinding(result, part, i));
    for (std::size_t part = 0; part < plan.study.parts.size(); ++part) {
        const auto& symptom = plan.study.parts[part].symptom;
        if (!symptom) continue;
        SymptomVerdict verdict;
        verdict.part = part;
        verdict.fault = shownBy(result, part, symptom->fault);
        verdict.cure = shownBy(result, part, symptom->cure);
        verdict.shown = verdict.fault >= symptom->faultAtLeast;
        verdict.cured = verdict.cure <= symptom->cureAtMost;
        const CaseRow* fault = caseOf(cases, plan, part, symptom->fault);
        const CaseRow* cure = caseOf(cases, plan, part, symptom->cure);
        if (fault != nullptr && cure != nullptr) verdict.switched = differences(*fault, *cure);
        result.symptoms.push_back(std::move(verdict));
    }
    return result;
}

bool studyIsGreen(const StudyResult& result) {
    for (const SymptomVerdict& s : result.symptoms)
        if (!s.shown || !s.cured) return false;
    for (const FindingVerdict& f : result.findings)
        if (!f.holds) return false;
    for (const StudyResultRow& row : result.rows) {
        if (mayBreak(result.study.parts[row.row.part], row.row)) continue;
        if (!row.ran || broke(row.outcome) || row.outcome == Outcome::Error) return false;
    }
    return true;
}

}  // namespace rigor::validation
