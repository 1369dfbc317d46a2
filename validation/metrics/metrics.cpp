// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The table of metrics, from metrics.def.
#include "validation/metrics/metric.hpp"
#include "validation/table.hpp"

namespace rigor::validation {

#define METRIC(name, function, title, unit, kind, formula) \
    std::vector<MetricValue> function(const MetricInput&);
#include "validation/metrics/metrics.def"
#undef METRIC

const std::vector<MetricEntry>& metricTable() {
    static const std::vector<MetricEntry> table{
#define METRIC(name, function, title, unit, kind, formula) \
    {#name, title, unit, MetricKind::kind, formula, &function},
#include "validation/metrics/metrics.def"
#undef METRIC
    };
    return table;
}

const MetricEntry* findMetric(const std::string& name) {
    return findEntry(metricTable(), name);
}

const char* metricKindName(MetricKind kind) {
    switch (kind) {
        case MetricKind::Exact:
            return "exact";
        case MetricKind::SchemeExact:
            return "scheme_exact";
        case MetricKind::Measured:
            return "measured";
        case MetricKind::Invariant:
            return "invariant";
        case MetricKind::Contact:
            return "contact";
        case MetricKind::Joint:
            return "joint";
        case MetricKind::Rest:
            return "rest";
        case MetricKind::Outcome:
            return "outcome";
    }
    return "unknown";
}

}  // namespace rigor::validation
