// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenarios that were run at several time steps: error over time step, and error over cost.
#include <algorithm>

#include "reports/encoding/text.hpp"
#include "reports/model/refinements.hpp"
#include "reports/plots/svg_plot.hpp"
#include "validation/results/values.hpp"

namespace rigor::report {
namespace {

/// One line per engine spec: its cases from the finest step to the coarsest.
Plot refinementPlot(const ViewModel& view, const Refinement& refinement, bool overCost) {
    Plot plot;
    plot.title = refinement.scenario + (overCost ? ": error against cost" : ": convergence");
    plot.xLabel = overCost ? "wall time of all steps [s]" : "time step [s]";
    plot.yLabel = refinement.metric + (refinement.unit == "1" ? "" : " [" + refinement.unit + "]");
    plot.logarithmic = plot.logarithmicX = plot.marked = true;
    for (const auto& column : view.columns()) {
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
    for (const Refinement& refinement : refinements(view))
        for (const bool overCost : {false, true}) {
            const Plot plot = refinementPlot(view, refinement, overCost);
            if (plot.lines.empty()) continue;
            plots.push_back(namedPlot(
                fileNamePart(refinement.scenario) + (overCost ? "-work-precision" : "-convergence"), plot));
        }
    return plots;
}

}  // namespace rigor::report
