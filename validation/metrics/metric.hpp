// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Metrics: pure functions from a recorded trajectory, its scenario and its reference to numbers. One
// implementation for all engines, in double, from states and the scenario's own mass properties.
#pragma once

#include <string>
#include <vector>

#include "scenarios/model/scenario.hpp"
#include "validation/references/reference.hpp"
#include "validation/trajectory.hpp"

namespace rigor::validation {

/// Object that the number is compared with. Outcome: nothing; the value belongs to the result of a scene
/// without an exact solution, and engines can agree on its distribution over many starts.
enum class MetricKind { Exact, SchemeExact, Measured, Invariant, Contact, Joint, Rest, Outcome };
const char* metricKindName(MetricKind kind);  ///< "exact", "scheme_exact", "measured", ...

struct MetricValue {
    std::string subject;  ///< body, joint or quantity name; "" for the whole scene
    double value = 0.0;   ///< >= 0, smaller is better, unless the metric says otherwise
    double at = -1.0;     ///< time of the largest contribution [s], or -1
};

struct MetricInput {
    const scenario::Scenario& scenario;
    const Trajectory& trajectory;
    const Reference* reference;  ///< reference; may be null
    adapter::Scheme scheme;
};

/// A series over the frames of a trajectory for plots and the store.
struct Series {
    std::string name;     ///< "energy", "position_error", ...
    std::string subject;  ///< body name or ""
    std::string unit;
    std::vector<double> values;  ///< one per frame; NaN where undefined
};

struct MetricEntry {
    const char* name;  ///< "position_final"
    const char* title;
    const char* unit;
    MetricKind kind;
    const char* formula;
    /// One value per subject, the whole-scene value ("", the worst) first; empty when the metric does not
    /// apply here.
    std::vector<MetricValue> (*evaluate)(const MetricInput&);
};
const std::vector<MetricEntry>& metricTable();
const MetricEntry* findMetric(const std::string& name);

/// Energy, momentum, error and penetration over time, for the curves of the report.
std::vector<Series> diagnosticSeries(const MetricInput& input);

}  // namespace rigor::validation
