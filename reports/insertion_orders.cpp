// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Results that depend on the order in which bodies, shapes, joints and forces were handed to an engine
// (`rigor validate --orders N`): the value as written, and both ends of the range.
#include <algorithm>
#include <cmath>

#include "reports/page_json.hpp"
#include "reports/text.hpp"
#include "reports/view_model.hpp"
#include "reports/writers.hpp"

namespace rigor::report {
namespace {

using results::CaseRow;
using results::Grade;
using results::MetricRow;

/// Width of the range over the scale of the metric; one unit where it has none.
double relativeWidth(const MetricRow& m) {
    if (!m.orderMin || !m.orderMax) return 0.0;
    const double width = (*m.orderMax - *m.orderMin) / m.scale.value_or(1.0);
    return std::isnan(width) ? 0.0 : width;  // infinite at both ends
}

/// The metric of the whole scene that varies most; null where none does. Counters of work are no result.
const MetricRow* widestOf(const CaseRow& row) {
    const MetricRow* widest = nullptr;
    for (const MetricRow& m : row.metrics)
        if (m.subject.empty() && m.kind != "cost" && dependsOnOrder(m) &&
            (widest == nullptr || relativeWidth(m) > relativeWidth(*widest)))
            widest = &m;
    return widest;
}

bool endsOtherwise(const CaseRow& row) {
    return row.orders.run && row.orders.completed != row.orders.run && row.orders.completed != 0;
}

/// "C" or, where orders have other grades, "B … D".
std::string gradesText(const CaseRow& row) {
    if (row.orders.best == row.orders.worst) return results::gradeName(row.orders.best);
    return std::string(results::gradeName(row.orders.best)) + " … " + results::gradeName(row.orders.worst);
}

std::size_t casesInOrders(const results::Run& run) {
    return static_cast<std::size_t>(
        std::count_if(run.cases.begin(), run.cases.end(), [](const CaseRow& c) { return c.orders.run; }));
}

}  // namespace

bool dependsOnOrder(const MetricRow& metric) {
    return relativeWidth(metric) > results::gradeLimit(Grade::A);
}

bool dependsOnOrder(const CaseRow& row) {
    return row.orders.run &&
           (row.orders.best != row.orders.worst || endsOtherwise(row) || widestOf(row) != nullptr);
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
        if (dependsOnOrder(row)) list.push_back({&row, widestOf(row)});
    const auto width = [](const OrderDependent& d) {
        if (endsOtherwise(*d.row)) return std::numeric_limits<double>::infinity();
        return d.metric == nullptr ? 0.0 : relativeWidth(*d.metric);
    };
    std::stable_sort(list.begin(), list.end(),
                     [&](const auto& a, const auto& b) { return width(a) > width(b); });
    return list;
}

std::string ordersHeading(const results::Run& run, std::size_t dependent) {
    const std::size_t all = casesInOrders(run);
    if (all == 0) return "";
    const std::string of = std::to_string(all) + (all == 1 ? " case" : " cases") + " run in several orders";
    if (dependent == 0) return "No result depends on the order of insertion (" + of + ")";
    return "Depends on the order of insertion ↕ (" + std::to_string(dependent) + " of " + of + ")";
}

std::string orderText(const OrderDependent& dependent) {
    const CaseRow& row = *dependent.row;
    std::string text;
    if (dependent.metric != nullptr)
        text = dependent.metric->name + " " + shortNumber(dependent.metric->value) + " as written, " +
               orderRangeText(*dependent.metric);
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
    if (!dependsOnOrder(row)) return "Does not depend on the order of insertion (" + over + ").";
    const MetricRow* widest = widestOf(row);
    std::string text = "Depends on the order of insertion: over " + over + " ";
    if (widest != nullptr)
        text += widest->name + " is " + shortNumber(*widest->orderMin) + " … " +
                shortNumber(*widest->orderMax) +
                (widest->unit.empty() || widest->unit == "1" ? "" : " " + widest->unit) + " (" +
                shortNumber(widest->value) + " as written)";
    else
        text += std::to_string(row.orders.completed.value_or(0)) + " completed";
    if (row.orders.best != row.orders.worst) text += ", its grade " + gradesText(row);
    if (!row.orders.note.empty()) text += "; " + row.orders.note;
    return text + ".";
}

Json insertionOrdersJson(const ViewModel& view) {
    const auto dependents = orderDependents(view.run());
    const std::string heading = ordersHeading(view.run(), dependents.size());
    if (heading.empty()) return nullptr;
    Json rows = Json::array();
    for (const OrderDependent& d : dependents) {
        const CaseRow& row = *d.row;
        const MetricRow* m = d.metric;
        rows.push_back({{"scenario", row.scenario},
                        {"spec", row.spec},
                        {"dt", number(row.dt)},
                        {"metric", m ? m->name : ""},
                        {"unit", m ? m->unit : ""},
                        {"value", m ? number(m->value) : Json(nullptr)},
                        {"least", m ? number(m->orderMin) : Json(nullptr)},
                        {"greatest", m ? number(m->orderMax) : Json(nullptr)},
                        {"run", row.orders.run.value_or(0)},
                        {"completed", row.orders.completed.value_or(0)},
                        {"grade", results::gradeName(row.accuracy.grade)},
                        {"best", results::gradeName(row.orders.best)},
                        {"worst", results::gradeName(row.orders.worst)},
                        {"note", row.orders.note}});
    }
    return {{"heading", heading}, {"rows", rows}};
}

std::string insertionOrdersMarkdown(const ViewModel& view) {
    constexpr std::size_t kMost = 40;
    const auto dependents = orderDependents(view.run());
    const std::string heading = ordersHeading(view.run(), dependents.size());
    if (heading.empty()) return "";
    std::string out = "\n### " + heading + "\n";
    if (dependents.empty()) return out;
    out +=
        "\n| scenario | engine | time step | metric | as written | over the orders | grade | |\n"
        "|---|---|---|---|---:|---|---|---|\n";
    for (std::size_t i = 0; i < std::min(dependents.size(), kMost); ++i) {
        const CaseRow& row = *dependents[i].row;
        const MetricRow* m = dependents[i].metric;
        out += "| " + markdownCell(row.scenario) + " | " + markdownCell(row.spec) + " | " +
               timeStepLabel(row.dt) + " | " + (m ? markdownCell(m->name) : "") + " | " +
               (m ? shortNumber(m->value) : "") + " | " + (m ? markdownCell(orderRangeText(*m)) : "") +
               " | " + results::gradeName(row.accuracy.grade) +
               (row.orders.best != row.orders.worst ? ", " + gradesText(row) : "") + " | " +
               markdownCell(row.orders.note.substr(0, 200)) + " |\n";
    }
    if (dependents.size() > kMost)
        out +=
            "\nand " + std::to_string(dependents.size() - kMost) + " more in `tables/insertion_orders.md`\n";
    return out +
           "\nValue, grade, bound and record of a case are those of the order as written in the scenario; "
           "the same "
           "orders are run for every engine.\n";
}

}  // namespace rigor::report
