// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cost of the steps of a run by the engine's own counters: rows of kind "cost" beside the metrics, so that
// work can be compared without a clock.
#pragma once

#include <string>
#include <vector>

#include "adapters/interface/types.hpp"
#include "validation/results/types.hpp"

namespace rigor::validation {

/// Means over the steps of the counters that the engine reports.
class CostMeter {
  public:
    void add(const adapter::StepCounters& counters);
    std::vector<results::MetricRow> rows() const;

  private:
    struct Sum {
        double total = 0.0;
        std::int64_t samples = 0;
    };
    std::vector<Sum> sums_;
};

/// "mean_pair_tests, mean_pairs, ..."
std::string costMetricNames();
bool isCostMetric(const std::string& name);

}  // namespace rigor::validation
