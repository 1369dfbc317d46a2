// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Dependence of a case on the order in which bodies, shapes, joints and forces are passed to the engine. One
// definition, for the store and for every report.
#pragma once

#include "validation/results/types.hpp"

namespace rigor::results {

/// Width of a metric's range over the orders, over the metric's scale; over one unit where it has none. 0
/// without a range.
double orderWidth(const MetricRow& metric);

/// Least and greatest value over the orders of insertion differ by more than rounding: by more than 1e-6 of
/// the metric's scale, the limit of grade A, or of one unit where it has none.
bool dependsOnOrder(const MetricRow& metric);

/// The metric of the whole scene that varies most; null where none does. Counters of work are no result.
const MetricRow* widestOverOrders(const CaseRow& row);

/// Some of its orders complete and some do not.
bool endsOtherwise(const CaseRow& row);

/// The gravest dependence: orders with other verdicts or endings, else other grades, else other values.
OrderDependence orderDependence(const CaseRow& row);

}  // namespace rigor::results
