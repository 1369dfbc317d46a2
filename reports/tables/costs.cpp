// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cost of a step for each engine, beside the accuracy of its runs.
#include "reports/tables/costs.hpp"

#include <cmath>

#include "reports/encoding/text.hpp"
#include "reports/model/view_model.hpp"

namespace rigor::report {
namespace {

std::string time(double seconds) {
    return std::isnan(seconds) ? "-" : durationLabel(seconds);
}
std::string factor(double value) {
    return std::isnan(value) ? "-" : shortNumber(std::round(10.0 * value) / 10.0) + "x";
}

}  // namespace

std::string costMarkdown(const ViewModel& view) {
    const auto costs = stepCosts(view);
    const auto order = byCost(costs);
    if (order.empty()) return "";
    const Mechanism overall = view.overall();
    std::string out =
        "\n### Cost of a step\n\n| engine | scenarios | median | mean | first step | 95 % | 99 % | worst | x "
        "real "
        "time | "
        "over the cheapest: median | mean | C or better "
        "|\n|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
    for (const std::size_t c : order) {
        const StepCost& cost = costs[c];
        const Ranking& ranking = overall.rankings[c];
        const std::string clock = cost.clock.empty() ? "" : " (" + cost.clock + ")";
        out += "| " + markdownCell(view.columns()[c].label + clock) + " | " + std::to_string(cost.scenarios) +
               " |";
        for (const double seconds : {cost.median, cost.mean, cost.first, cost.p95, cost.p99, cost.worst})
            out += " " + time(seconds) + " |";
        out += " " + (std::isnan(cost.realTimeFactor) ? "-" : shortNumber(cost.realTimeFactor)) + " | " +
               factor(cost.medianRatio) + " | " + factor(cost.meanRatio) + " | " +
               std::to_string(ranking.within()) + "/" + std::to_string(ranking.graded()) + " |\n";
    }
    return out +
           "\nWall time of a step at the finest time step of each scenario, medians over the scenarios. The "
           "first step "
           "stands apart: mean, quantiles, worst and real-time factor (time step over mean) are of all "
           "others. Times of guests are by their own clocks: the cheapest is that of the same clock.\n";
}

}  // namespace rigor::report
