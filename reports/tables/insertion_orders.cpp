// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/tables/insertion_orders.hpp"

#include <algorithm>
#include <cmath>

#include "reports/encoding/text.hpp"
#include "reports/model/view_model.hpp"
#include "validation/results/insertion_orders.hpp"

namespace rigor::report {

using results::CaseRow;
using results::MetricRow;

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
                        {"dependence", results::orderDependenceName(results::orderDependence(row))},
                        {"verdicts", verdictsText(row)},
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
        "\n| scenario | engine | time step | depends | metric | as written | over the orders | grade | |\n"
        "|---|---|---|---|---|---:|---|---|---|\n";
    for (std::size_t i = 0; i < std::min(dependents.size(), kMost); ++i) {
        const CaseRow& row = *dependents[i].row;
        const MetricRow* m = dependents[i].metric;
        out += "| " + markdownCell(row.scenario) + " | " + markdownCell(row.spec) + " | " +
               timeStepLabel(row.dt) + " | " + orderMark(row) + " " +
               results::orderDependenceName(results::orderDependence(row)) + " | " +
               (m ? markdownCell(m->name) : "") + " | " +
               (m == nullptr           ? ""
                : std::isnan(m->value) ? "no value"
                                       : shortNumber(m->value)) +
               " | " + (m ? markdownCell(orderRangeText(*m)) : "") + " | " +
               results::gradeName(row.accuracy.grade) +
               (row.orders.best != row.orders.worst ? ", " + gradesText(row) : "") + " | " +
               markdownCell(verdictsText(row)) +
               (verdictsText(row).empty() || row.orders.note.empty() ? "" : "; ") +
               markdownCell(row.orders.note.substr(0, 200)) + " |\n";
    }
    if (dependents.size() > kMost)
        out +=
            "\nand " + std::to_string(dependents.size() - kMost) + " more in `tables/insertion_orders.md`\n";
    return out +
           "\nValue, grade, verdict and record of a case are those of the order as written in the scenario; "
           "the same orders are run for every engine. ⇅: orders disagree about the verdict or about how the "
           "run ends.\n";
}

}  // namespace rigor::report
