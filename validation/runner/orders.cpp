// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/orders.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include "validation/results/insertion_orders.hpp"
#include "validation/symmetry/listing.hpp"

namespace rigor::validation {
namespace {

using results::CaseRow;
using results::Grade;
using results::MetricRow;
using results::Outcome;
using results::Verdict;

const MetricRow* sameMetric(const CaseRow& row, const MetricRow& metric) {
    const auto it = std::find_if(row.metrics.begin(), row.metrics.end(), [&](const MetricRow& m) {
        return m.name == metric.name && m.subject == metric.subject;
    });
    return it == row.metrics.end() ? nullptr : &*it;
}

/// Orders without a value of it (an event that did not happen, another ending) are missing in the count.
void addRange(MetricRow& metric, const std::vector<OrderEnd>& others) {
    std::vector<double> values;
    for (const OrderEnd& other : others)
        if (const MetricRow* found = sameMetric(other.row, metric); found && !std::isnan(found->value))
            values.push_back(found->value);
    if (values.empty()) return;
    if (!std::isnan(metric.value)) values.push_back(metric.value);
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    metric.orderMin = *least;
    metric.orderMax = *greatest;
    metric.orderCount = static_cast<std::int64_t>(values.size());
}

/// Metrics of the whole scene that another order has a value of and the one as written does not, be it that
/// it did not complete or that an event did not happen: without a value of their own, for the range.
void addMetricsOfOthers(CaseRow& row, const std::vector<OrderEnd>& others) {
    const std::string why = row.outcome == Outcome::Completed
                                ? "no value in the order as written"
                                : std::string("the order as written: ") + results::outcomeName(row.outcome);
    for (const OrderEnd& other : others)
        for (const MetricRow& metric : other.row.metrics) {
            if (!metric.subject.empty() || std::isnan(metric.value)) continue;
            if (sameMetric(row, metric) != nullptr) continue;
            MetricRow absent;
            absent.name = metric.name;
            absent.unit = metric.unit;
            absent.kind = metric.kind;
            absent.value = std::nan("");
            absent.bound = metric.bound;
            absent.boundMin = metric.boundMin;
            absent.scale = metric.scale;
            absent.note = why;
            row.metrics.push_back(absent);
        }
}

/// Metrics that fail in another order and not in the one as written: " position_final (0.2, bound 0.1)".
std::string failuresOnlyOf(const CaseRow& other, const CaseRow& asWritten) {
    std::string text;
    for (const MetricRow& metric : other.metrics) {
        if (metric.verdict != Verdict::Fail) continue;
        const MetricRow* same = sameMetric(asWritten, metric);
        if (same != nullptr && same->verdict == Verdict::Fail) continue;
        char numbers[80];
        std::snprintf(numbers, sizeof numbers, " (%.3g, bound %.3g)", metric.value,
                      metric.bound.value_or(std::nan("")));
        text += (text.empty() ? " " : ", ") + metric.name +
                (metric.subject.empty() ? "" : " of " + metric.subject) + (metric.bound ? numbers : "");
    }
    return text;
}

/// Addition to the note by another order; "" if it ended like the order as written and fails nothing else.
std::string noteOf(const OrderEnd& end, const CaseRow& asWritten) {
    const std::string order = "order " + std::to_string(end.number + 1) + ": ";
    if (!end.reference.empty()) return order + end.reference;
    if (end.row.outcome == Outcome::Completed) {
        const std::string failures = failuresOnlyOf(end.row, asWritten);
        if (asWritten.outcome != Outcome::Completed)
            return order + "completes" + (failures.empty() ? "" : " and fails" + failures);
        if (!failures.empty()) return order + "fails" + failures;
        return end.row.verdict == asWritten.verdict ? "" : order + results::verdictName(end.row.verdict);
    }
    return order + results::outcomeName(end.row.outcome) +
           (end.row.reason.empty() ? "" : " (" + end.row.reason + ")");
}

bool isFailure(Verdict verdict) {
    return verdict == Verdict::Fail || verdict == Verdict::Crashed || verdict == Verdict::Timeout ||
           verdict == Verdict::NonFinite;
}

/// Counts the verdicts of all orders whose reference held: "pass 3, fail 2".
void addVerdicts(CaseRow& row, const std::vector<OrderEnd>& others) {
    std::map<Verdict, int> counts;
    if (row.verdict != Verdict::NoReference) ++counts[row.verdict];
    for (const OrderEnd& other : others)
        if (other.reference.empty() && other.row.verdict != Verdict::NoReference) ++counts[other.row.verdict];
    std::int64_t failed = 0;
    for (const auto& [verdict, count] : counts) {
        failed += isFailure(verdict) ? count : 0;
        row.orders.verdicts += (row.orders.verdicts.empty() ? "" : ", ") +
                               std::string(results::verdictName(verdict)) + " " + std::to_string(count);
    }
    row.orders.failed = failed;
}

}  // namespace

int otherOrders(const scenario::Scenario& scenario, int requested) {
    return static_cast<int>(listingCount(scenario, static_cast<std::size_t>(std::max(requested, 1)))) - 1;
}

void addOrders(CaseRow& row, std::vector<OrderEnd> others) {
    std::sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
    row.orders = {};
    row.orders.run = static_cast<std::int64_t>(others.size()) + 1;
    const bool ownCompleted = row.outcome == Outcome::Completed;
    row.orders.completed = ownCompleted ? 1 : 0;
    const bool isGraded = ownCompleted ? row.accuracy.grade != Grade::None
                                       : std::any_of(others.begin(), others.end(), [](const OrderEnd& other) {
                                             return other.row.outcome == Outcome::Completed &&
                                                    other.row.accuracy.grade != Grade::None;
                                         });
    row.orders.best = row.orders.worst = ownCompleted || !isGraded ? row.accuracy.grade : Grade::E;
    for (const OrderEnd& other : others) {
        if (const std::string note = noteOf(other, row); !note.empty())
            row.orders.note += (row.orders.note.empty() ? "" : "; ") + note;
        if (!other.reference.empty()) continue;
        const bool completed = other.row.outcome == Outcome::Completed;
        *row.orders.completed += completed ? 1 : 0;
        const Grade grade = completed ? other.row.accuracy.grade : Grade::E;
        if (!isGraded || grade == Grade::None) continue;
        row.orders.best = std::min(row.orders.best, grade);
        row.orders.worst = std::max(row.orders.worst, grade);
    }
    addVerdicts(row, others);
    addMetricsOfOthers(row, others);
    for (MetricRow& metric : row.metrics) addRange(metric, others);
    row.orders.dependence = results::orderDependence(row);
}

bool isRunInOrders(const CaseRow& row) {
    return row.outcome != Outcome::Unsupported;
}

void addNoOrders(CaseRow& row) {
    row.orders = {};
    row.orders.note = "nothing to reorder: no list of the scenario has two entries";
}

void OpenOrders::open(std::size_t index, CaseRow row, int others) {
    cases_[index] = {std::move(row), others, {}};
}

std::optional<CaseRow> OpenOrders::ended(std::size_t index, OrderEnd end) {
    const auto it = cases_.find(index);
    if (it == cases_.end()) return std::nullopt;
    it->second.ends.push_back(std::move(end));
    if (--it->second.missing > 0) return std::nullopt;
    CaseRow row = std::move(it->second.row);
    addOrders(row, std::move(it->second.ends));
    cases_.erase(it);
    return row;
}

}  // namespace rigor::validation
