// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

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
        n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    const double spread = n * sxx - sx * sx;
    return spread > 0.0 ? (n * sxy - sx * sy) / spread : kNaN;
}

/// What a variant shows: its worst row, or how its rows grow.
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

}  // namespace

StudyValue studyValue(const CaseRow& row, const std::string& metric) {
    const std::string timePrefix = "time.";
    if (metric.starts_with(timePrefix)) {
        for (const auto& t : row.timings)
            if (t.phase == metric.substr(timePrefix.size()) && t.samples > 0) return {t.median, "s"};
        return {std::nullopt, "s"};
    }
    const auto colon = metric.find(':');
    const std::string name = metric.substr(0, colon);
    const std::string subject = colon == std::string::npos ? "" : metric.substr(colon + 1);
    for (const auto& m : row.metrics)
        if (m.name == name && m.subject == subject) return {m.value, m.unit};
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
            shown.ran = true, shown.outcome = it->second->outcome, shown.reason = it->second->reason;
            for (std::size_t i = 0; i < metrics.size(); ++i)
                shown.values[i] = studyValue(*it->second, metrics[i]);
        }
        result.rows.push_back(std::move(shown));
    }
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
    for (const StudyResultRow& row : result.rows) {
        const auto& symptom = result.study.parts[row.row.part].symptom;
        if (symptom && symptom->fault == row.row.variant) continue;
        if (!row.ran || broke(row.outcome) || row.outcome == Outcome::Error) return false;
    }
    return true;
}

}  // namespace rigor::validation
