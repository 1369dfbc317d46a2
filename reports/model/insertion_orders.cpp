// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Results that depend on the order in which bodies, shapes, joints and forces were handed to an engine
// (`rigor validate --orders N`): the value as written, and both ends of the range.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "reports/encoding/text.hpp"
#include "reports/model/view_model.hpp"
#include "validation/results/counted.hpp"
#include "validation/results/insertion_orders.hpp"

namespace rigor::report {
namespace {

using results::CaseRow;
using results::Grade;
using results::MetricRow;
using results::OrderDependence;

std::size_t casesInOrders(const results::Run& run) {
    return std::count_if(run.cases.begin(), run.cases.end(), [](const CaseRow& c) { return c.orders.run; });
}

bool isOrderDependent(const CaseRow& row) {
    return results::orderDependence(row) > OrderDependence::None;
}

/// The metric to show of a case: what varies most, or what others have a value of where the order as written
/// does not complete. Null where no order has a number.
const MetricRow* shownMetric(const CaseRow& row) {
    if (const MetricRow* widest = results::widestOverOrders(row)) return widest;
    if (row.outcome == results::Outcome::Completed) return nullptr;
    for (const MetricRow& m : row.metrics)
        if (m.subject.empty() && m.orderCount && m.kind != "cost") return &m;
    return nullptr;
}

/// "0.0031 as written", or "no value as written".
std::string asWrittenText(const MetricRow& m) {
    return (std::isnan(m.value) ? "no value" : shortNumber(m.value)) + std::string(" as written");
}

}  // namespace

std::string verdictsText(const CaseRow& row) {
    if (row.orders.verdicts.find(", ") == std::string::npos) return "";
    const std::int64_t failed = row.orders.failed.value_or(0);
    if (failed == 0) return "orders end in other verdicts (" + row.orders.verdicts + ")";
    return std::to_string(failed) + " of " + std::to_string(row.orders.run.value_or(0)) +
           (failed == 1 ? " orders fails (" : " orders fail (") + row.orders.verdicts + ")";
}

std::string gradesText(const CaseRow& row) {
    if (row.orders.best == row.orders.worst) return results::gradeName(row.orders.best);
    return std::string(results::gradeName(row.orders.best)) + " … " + results::gradeName(row.orders.worst);
}

const char* orderMark(const CaseRow& row) {
    switch (results::orderDependence(row)) {
        case OrderDependence::Unknown:
        case OrderDependence::None:
            return "";
        case OrderDependence::Value:
        case OrderDependence::Grade:
            return "↕";
        case OrderDependence::Verdict:
            return "⇅";
    }
    return "";
}

std::string orderRangeText(const MetricRow& metric) {
    if (!metric.orderMin || !metric.orderMax || !metric.orderCount) return "";
    return shortNumber(*metric.orderMin) + " … " + shortNumber(*metric.orderMax) +
           (metric.unit.empty() || metric.unit == "1" ? "" : " " + metric.unit) + " over " +
           std::to_string(*metric.orderCount) + " orders";
}

std::vector<OrderDependent> orderDependents(const results::Run& run) {
    std::vector<OrderDependent> list;
    for (const CaseRow& row : run.cases)
        if (isOrderDependent(row)) list.push_back({&row, shownMetric(row)});
    const auto gravity = [](const OrderDependent& d) {
        const bool isVerdict = results::orderDependence(*d.row) == OrderDependence::Verdict;
        return std::pair(isVerdict, d.metric == nullptr ? 0.0 : results::orderWidth(*d.metric));
    };
    std::stable_sort(list.begin(), list.end(),
                     [&](const auto& a, const auto& b) { return gravity(a) > gravity(b); });
    return list;
}

std::string orderCountsText(const results::Run& run) {
    std::map<OrderDependence, int> counts;
    for (const CaseRow& row : run.cases) ++counts[results::orderDependence(row)];
    std::string text;
    for (const OrderDependence d : {OrderDependence::Verdict, OrderDependence::Grade, OrderDependence::Value})
        if (const int count = counts[d]; count > 0)
            text += (text.empty() ? "" : ", ") + std::string(d == OrderDependence::Verdict ? "⇅ " : "↕ ") +
                    std::to_string(count) + " in " + results::orderDependenceName(d);
    return text;
}

std::string ordersTotalText(const results::Run& run) {
    const std::size_t all = casesInOrders(run);
    if (all == 0) return "";
    const auto dependent = std::count_if(run.cases.begin(), run.cases.end(), isOrderDependent);
    const std::string counts = orderCountsText(run);
    return std::to_string(dependent) + " of " + results::counted(all, "case") + " order-dependent" +
           (counts.empty() ? "" : " (" + counts + ")");
}

std::string ordersHeading(const results::Run& run, std::size_t dependent) {
    const std::size_t all = casesInOrders(run);
    if (all == 0) return "";
    const std::string of = results::counted(all, "case") + " run in several orders";
    if (dependent == 0) return "No result depends on the order of insertion (" + of + ")";
    return "Depends on the order of insertion (" + std::to_string(dependent) + " of " + of + ": " +
           orderCountsText(run) + ")";
}

std::string orderText(const OrderDependent& dependent) {
    const CaseRow& row = *dependent.row;
    std::string text = verdictsText(row);
    if (dependent.metric != nullptr)
        text += (text.empty() ? "" : "; ") + dependent.metric->name + " " + asWrittenText(*dependent.metric) +
                ", " + orderRangeText(*dependent.metric);
    if (row.accuracy.grade != Grade::None && row.orders.best != row.orders.worst)
        text += (text.empty() ? "" : "; ") + std::string("grade ") + results::gradeName(row.accuracy.grade) +
                " as written, " + gradesText(row);
    if (!row.orders.note.empty()) text += (text.empty() ? "" : "; ") + row.orders.note;
    return text;
}

std::string orderSentence(const CaseRow& row) {
    if (!row.orders.run)
        return row.orders.note.empty() ? "" : "One order of insertion: " + row.orders.note + ".";
    const std::string over = std::to_string(*row.orders.run) + " orders";
    if (!isOrderDependent(row)) return "Does not depend on the order of insertion (" + over + ").";
    const MetricRow* shown = shownMetric(row);
    std::string text = "Depends on the order of insertion: over " + over + " ";
    if (shown != nullptr)
        text += shown->name + " is " + shortNumber(*shown->orderMin) + " … " + shortNumber(*shown->orderMax) +
                (shown->unit.empty() || shown->unit == "1" ? "" : " " + shown->unit) + " (" +
                asWrittenText(*shown) + ")";
    else
        text += std::to_string(row.orders.completed.value_or(0)) + " completed";
    if (row.orders.best != row.orders.worst) text += ", its grade " + gradesText(row);
    if (const std::string verdicts = verdictsText(row); !verdicts.empty()) text += "; " + verdicts;
    if (!row.orders.note.empty()) text += "; " + row.orders.note;
    return text + ".";
}

}  // namespace rigor::report
