// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/insertion_orders.hpp"

#include <cmath>

namespace rigor::results {

double orderWidth(const MetricRow& metric) {
    if (!metric.orderMin || !metric.orderMax) return 0.0;
    const double width = (*metric.orderMax - *metric.orderMin) / metric.scale.value_or(1.0);
    return std::isnan(width) ? 0.0 : width;  // infinite at both ends
}

bool dependsOnOrder(const MetricRow& metric) {
    return orderWidth(metric) > gradeLimit(Grade::A);
}

const MetricRow* widestOverOrders(const CaseRow& row) {
    const MetricRow* widest = nullptr;
    for (const MetricRow& m : row.metrics) {
        if (!m.subject.empty() || m.kind == "cost" || !dependsOnOrder(m)) continue;
        if (widest == nullptr || orderWidth(m) > orderWidth(*widest)) widest = &m;
    }
    return widest;
}

bool endsOtherwise(const CaseRow& row) {
    return row.orders.run && row.orders.completed != row.orders.run && row.orders.completed != 0;
}

OrderDependence orderDependence(const CaseRow& row) {
    if (!row.orders.run) return OrderDependence::Unknown;
    const bool hasOtherVerdicts = row.orders.verdicts.find(", ") != std::string::npos;
    if (hasOtherVerdicts || endsOtherwise(row)) return OrderDependence::Verdict;
    if (row.orders.best != row.orders.worst) return OrderDependence::Grade;
    return widestOverOrders(row) != nullptr ? OrderDependence::Value : OrderDependence::None;
}

}  // namespace rigor::results
