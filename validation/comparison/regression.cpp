// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/regression.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "validation/results/values.hpp"

namespace rigor::validation {
namespace {

using results::CaseRow;
using results::MetricRow;
using results::Outcome;
using results::Regression;

struct Change {
    Regression state = Regression::Unchanged;
    double size = 0.0;  ///< size as a fraction of the scale, to find the largest
    std::string text;
};

std::string shownNumber(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

Change changeOf(const CaseRow& row, const MetricRow& now, const RecordedMetric& old) {
    const auto magnitude = [](double a, double b) { return std::abs(a) < std::abs(b); };
    const double low = std::abs(*std::min_element(old.values.begin(), old.values.end(), magnitude));
    const double high = std::abs(*std::max_element(old.values.begin(), old.values.end(), magnitude));
    const double value = std::abs(now.value);
    Change change;
    const bool was = std::isfinite(high), is = std::isfinite(value);
    if (!was && !is) return change;
    const double rounding = roundingOf(row, now);
    if (!is || (was && value > high * (1.0 + kSameShare) + rounding))
        change.state = Regression::Worse;
    else if (!was || value < low * (1.0 - kSameShare) - rounding)
        change.state = Regression::Better;
    if (change.state == Regression::Unchanged) return change;
    change.size = is && was ? std::abs(value - (change.state == Regression::Worse ? high : low)) /
                                  now.scale.value_or(std::max(high, value))
                            : std::numeric_limits<double>::infinity();
    change.text = now.name + " " + shownNumber(old.values.front()) + " -> " + shownNumber(now.value) +
                  (now.unit.empty() || now.unit == "1" ? "" : " " + now.unit);
    return change;
}

const RecordedMetric* find(const RecordedCase& recorded, const std::string& name) {
    for (const RecordedMetric& m : recorded.metrics)
        if (m.name == name && !m.values.empty()) return &m;
    return nullptr;
}

/// The most important change: worse before better, then the largest.
Change worstChange(const CaseRow& row, const RecordedCase& old, bool isChaotic) {
    Change worst;
    for (const RecordedMetric& m : old.metrics) {
        if (m.values.empty() || (isChaotic && m.values.size() < 2)) continue;
        const MetricRow* now = results::wholeScene(row, m.name);
        Change change;
        if (now != nullptr)
            change = changeOf(row, *now, m);
        else
            change = {Regression::Worse, std::numeric_limits<double>::infinity(),
                      m.name + " has no value any more"};
        const auto rank = [](const Change& c) { return std::pair(static_cast<int>(c.state), c.size); };
        if (rank(change) > rank(worst)) worst = change;
    }
    return worst;
}

}  // namespace

double roundingOf(const CaseRow& row, const MetricRow& metric) {
    const auto precision = row.settings.find("precision");
    const bool isSingle = precision != row.settings.end() && precision->second == "f32";
    return (isSingle ? kRoundingSingle : kRoundingDouble) * metric.scale.value_or(1.0);
}

void compareWithRecord(const Record& record, const results::ScenarioRow& scenario, CaseRow& row) {
    row.regression = Regression::NoRecord;
    row.regressionReason.clear();
    for (MetricRow& m : row.metrics) m.recorded.reset();
    if (row.verdict == results::Verdict::NoReference) {
        row.regressionReason = "its reference could not be computed";
        return;
    }
    const RecordedCase* old = record.find(row.scenario, row.spec, row.dt);
    if (old == nullptr) {
        row.regressionReason = "this scenario, spec and time step are not on record";
        return;
    }
    if (old->scenarioHash != recordedHash(scenario.text)) {
        row.regressionReason = "the scenario on record has other physics";
        return;
    }
    for (MetricRow& m : row.metrics)
        if (const auto* recorded = m.subject.empty() ? find(*old, m.name) : nullptr)
            m.recorded = recorded->values.front();
    if (old->outcome != row.outcome) {
        const auto badness = [](Outcome o) {
            return o == Outcome::Completed ? 0 : o == Outcome::Unsupported ? 1 : 2;
        };
        const bool isBetter = badness(row.outcome) < badness(old->outcome);
        row.regression = isBetter ? Regression::Better : Regression::Worse;
        row.regressionReason =
            std::string(results::outcomeName(old->outcome)) + " -> " + results::outcomeName(row.outcome);
        return;
    }
    const bool isChaotic = scenario.reference.empty();
    const Change change = worstChange(row, *old, isChaotic);
    row.regression = change.state;
    row.regressionReason = change.text;
    if (change.state == Regression::Unchanged && isChaotic)
        row.regressionReason = "no exact solution: how it ends is compared, not its numbers";
}

}  // namespace rigor::validation
