// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "reports/model/view_model.hpp"
#include "reports/plots/line_plot.hpp"
#include "reports/summaries/summary.hpp"
#include "reports/tables/refinements.hpp"
#include "reports/tests/synthetic_run.hpp"

namespace rigor::report {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

results::Run withOrders() {
    results::Run run = synthetic::makeRun();
    const auto& name = run.scenarios[0].name;
    run.orders = {{name, "ode", "position_max", "m", 1.0 / 3.0, 0.25, {}, 5, 1e-3, 1e-2, "a, b"},
                  {name, "rigor", "position_max", "m", {}, {}, {}, 0, 0.0, 0.0, ""},
                  {name, "bullet", "position_max", "m", 1.0, -kInfinity, kInfinity, 2, 0.5, 1.0, ""}};
    run.fairness = {
        {"equal_time", name, "position_max", "m", "ode", "id", "ode:n=3", 0.01, 0.25, 1e-3, {}},
        {"equal_time", name, "position_max", "m", "rigor", "id", "rigor", 0.01, std::nan(""), 1e-3, {}}};
    return run;
}

TEST(Refinements, TablesHoldEveryDigit) {
    const auto run = withOrders();
    EXPECT_EQ(ordersCsv(run),
              "scenario,spec,metric,unit,order,low,high,points,finest,coarsest,note,non_finite\n" +
                  run.scenarios[0].name +
                  ",ode,position_max,m,0.33333333333333331,0.25,,5,0.001,0.01,\"a, b\",\n" +
                  run.scenarios[0].name + ",rigor,position_max,m,,,,0,0,0,,\n" + run.scenarios[0].name +
                  ",bullet,position_max,m,1,,,2,0.5,1,,low is minus infinite; high is infinite\n");
    EXPECT_EQ(fairnessCsv(run),
              "mode,scenario,metric,unit,competitor,spec,dt,error,cost,budget_or_target,case,non_"
              "finite\nequal_time," +
                  run.scenarios[0].name + ",position_max,m,ode,ode:n=3,0.01,0.25,0.001,,id,\nequal_time," +
                  run.scenarios[0].name +
                  ",position_max,m,rigor,rigor,0.01,,0.001,,id,error is not a number\n");
}

TEST(Refinements, TheSummaryHasThemWhereThereAreAny) {
    EXPECT_EQ(markdownSummary(ViewModel(synthetic::makeRun())).find("Observed order"), std::string::npos);
    const auto summary = markdownSummary(ViewModel(withOrders()));
    EXPECT_NE(summary.find("### Observed order of convergence"), std::string::npos);
    EXPECT_NE(summary.find("| 0.3333 |"), std::string::npos) << summary;
}

/// Decades are equally far apart, and a point stands where its logarithm is.
TEST(Refinements, LogarithmicAxes) {
    Plot plot;
    plot.logarithmic = plot.logarithmicX = plot.marked = true;
    plot.lines = {{"a", "#000000", {}, {1e-3, 1e-2, 1e-1, 0.0}, {1e-2, 1e-1, 1.0, 5.0}}};
    const auto svg = svgOf(drawPlot(plot));
    std::vector<double> x;
    for (auto at = svg.find("<circle cx=\""); at != std::string::npos; at = svg.find("<circle cx=\"", at + 1))
        x.push_back(std::stod(svg.substr(at + 12)));
    ASSERT_EQ(x.size(), 3u) << "zero has no logarithm";
    EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.011);
    EXPECT_GT(x[1] - x[0], 100.0);
    EXPECT_NE(svg.find(">0.01</text>"), std::string::npos);
}

}  // namespace
}  // namespace rigor::report
