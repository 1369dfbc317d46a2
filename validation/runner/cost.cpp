// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/cost.hpp"

#include <array>

namespace rigor::validation {
namespace {

struct Cost {
    const char* name;
    std::int64_t adapter::StepCounters::*counter;
};
constexpr std::array kCosts{Cost{"mean_pair_tests", &adapter::StepCounters::pairTests},
                            Cost{"mean_pairs", &adapter::StepCounters::pairs},
                            Cost{"mean_narrow_phase_queries", &adapter::StepCounters::narrowPhaseQueries},
                            Cost{"mean_contacts", &adapter::StepCounters::contacts},
                            Cost{"mean_solver_iterations", &adapter::StepCounters::solverIterations}};

}  // namespace

void CostMeter::add(const adapter::StepCounters& counters) {
    sums_.resize(kCosts.size());
    for (std::size_t i = 0; i < kCosts.size(); ++i) {
        const std::int64_t count = counters.*kCosts[i].counter;
        if (count >= 0) {
            sums_[i].total += count;
            ++sums_[i].samples;
        }
    }
}

std::vector<results::MetricRow> CostMeter::rows() const {
    std::vector<results::MetricRow> rows;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        if (sums_[i].samples == 0) continue;
        results::MetricRow row;
        row.name = kCosts[i].name;
        row.unit = "1";
        row.kind = "cost";
        row.value = sums_[i].total / sums_[i].samples;
        rows.push_back(row);
    }
    return rows;
}

std::string costMetricNames() {
    std::string names;
    for (const Cost& cost : kCosts) names += (names.empty() ? "" : ", ") + std::string(cost.name);
    return names;
}

bool isCostMetric(const std::string& name) {
    for (const Cost& cost : kCosts)
        if (name == cost.name) return true;
    return false;
}

}  // namespace rigor::validation
