// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenarios that were run at several time steps: error over time step, and error over cost.
#include <algorithm>
#include <set>

#include "reports/encoding/text.hpp"
#include "reports/model/refinements.hpp"
#include "reports/plots/line_plot.hpp"
#include "validation/results/values.hpp"

namespace rigor::report {
namespace {

/// Clocks of the columns, that of modules first: costs by different ones are in plots of their own.
std::set<std::string> clocksOf(const ViewModel& view) {
    std::set<std::string> clocks;
    for (const auto& column : view.columns()) clocks.insert(column.clock);
    return clocks;
}

/// One line per engine spec: its cases from the finest step to the coarsest. Over cost, the specs of one clock.
Plot refinementPlot(const ViewModel& view, const Refinement& refinement, bool overCost,
                    const std::string& clock) {
    Plot plot;
    plot.title = refinement.scenario + (overCost ? ": error against cost" : ": convergence") +
                 (clock.empty() ? "" : " (" + clock + ")");
    plot.xLabel = overCost ? "wall time of all steps [s]" : "time step [s]";
    plot.yLabel = refinement.metric + (refinement.unit == "1" ? "" : " [" + refinement.unit + "]");
    plot.logarithmic = plot.logarithmicX = plot.marked = true;
    for (const auto& column : view.columns()) {
        if (overCost && column.clock != clock) continue;
        PlotLine line{column.label, colourOf(view, column), column.dash, {}, {}};
        std::vector<const results::CaseRow*> cases;
        for (const auto& c : view.run().cases)
            if (c.scenario == refinement.scenario && c.spec == column.spec) cases.push_back(&c);
        std::sort(cases.begin(), cases.end(), [](const auto* a, const auto* b) { return a->dt < b->dt; });
        for (const auto* c : cases) {
            const auto* m = results::wholeScene(*c, refinement.metric);
            const auto cost = results::steppingTime(*c);
            if (!m || (overCost && !cost)) continue;
            line.x.push_back(overCost ? *cost : c->dt);
            line.y.push_back(m->value);
        }
        if (line.x.size() > 1) plot.lines.push_back(line);
    }
    return plot;
}

}  // namespace

std::vector<NamedPlot> refinementPlots(const ViewModel& view) {
    std::vector<NamedPlot> plots;
    const auto add = [&](const std::string& name, const Plot& plot) {
        if (!plot.lines.empty()) plots.push_back(namedPlot(name, plot));
    };
    for (const Refinement& refinement : refinements(view)) {
        const std::string name = fileNamePart(refinement.scenario);
        add(name + "-convergence", refinementPlot(view, refinement, false, ""));
        for (const std::string& clock : clocksOf(view))
            add(name + "-work-precision" + (clock.empty() ? "" : "-" + fileNamePart(clock)),
                refinementPlot(view, refinement, true, clock));
    }
    return plots;
}

}  // namespace rigor::report
