// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/orders.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "validation/symmetry/listing.hpp"

namespace rigor::validation {
namespace {

using results::CaseRow;
using results::Grade;
using results::MetricRow;
using results::Outcome;

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
    metric.orderMin = *least, metric.orderMax = *greatest;
    metric.orderCount = static_cast<std::int64_t>(values.size());
}

/// What another order adds to the note; "" where it ended as it should.
std::string noteOf(const OrderEnd& end) {
    const std::string order = "order " + std::to_string(end.number + 1) + ": ";
    if (!end.reference.empty()) return order + end.reference;
    if (end.row.outcome == Outcome::Completed) return "";
    return order + results::outcomeName(end.row.outcome) +
           (end.row.reason.empty() ? "" : " (" + end.row.reason + ")");
}

}  // namespace

int otherOrders(const scenario::Scenario& scenario, int asked) {
    return static_cast<int>(listingCount(scenario, static_cast<std::size_t>(std::max(asked, 1)))) - 1;
}

void addOrders(CaseRow& row, std::vector<OrderEnd> others) {
    std::sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
    row.orders = {};
    row.orders.run = static_cast<std::int64_t>(others.size()) + 1;
    row.orders.completed = 1;
    const bool isGraded = row.accuracy.grade != Grade::None;
    row.orders.best = row.orders.worst = row.accuracy.grade;
    for (const OrderEnd& other : others) {
        if (const std::string note = noteOf(other); !note.empty())
            row.orders.note += (row.orders.note.empty() ? "" : "; ") + note;
        if (!other.reference.empty()) continue;
        const bool completed = other.row.outcome == Outcome::Completed;
        *row.orders.completed += completed ? 1 : 0;
        const Grade grade = completed ? other.row.accuracy.grade : Grade::E;
        if (!isGraded || grade == Grade::None) continue;
        row.orders.best = std::min(row.orders.best, grade);
        row.orders.worst = std::max(row.orders.worst, grade);
    }
    for (MetricRow& metric : row.metrics) addRange(metric, others);
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
    it->second.ends.push_back(std::move(end));
    if (--it->second.missing > 0) return std::nullopt;
    CaseRow row = std::move(it->second.row);
    addOrders(row, std::move(it->second.ends));
    cases_.erase(it);
    return row;
}

}  // namespace rigor::validation
