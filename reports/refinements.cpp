// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Where scenarios were run at several time steps: orders of convergence, error against cost, and engines
// compared in four labelled ways, as CSV and as plots.
#include <algorithm>

#include "reports/page_json.hpp"
#include "reports/svg_plot.hpp"
#include "reports/text.hpp"
#include "reports/writers.hpp"
#include "validation/results/values.hpp"

namespace rigor::report {
namespace {

std::string optionalNumber(const std::optional<double>& value) {
    return value ? finiteText(*value) : std::string();
}

std::string joined(const std::vector<std::string>& fields) {
    std::string line;
    for (const auto& field : fields) line += (line.empty() ? "" : ",") + csvField(field);
    return line + "\n";
}

struct Refinement {
    std::string scenario, metric, unit;
};

/// Scenarios with orders, each with the first of its metrics that has some.
std::vector<Refinement> refinements(const ViewModel& view) {
    std::vector<Refinement> list;
    for (std::size_t s = 0; s < view.run().scenarios.size(); ++s) {
        const auto& name = view.run().scenarios[s].name;
        const auto& main = view.mainMetric(s).name;
        const results::OrderRow* chosen = nullptr;
        for (const auto& o : view.run().orders)
            if (o.scenario == name && (!chosen || (o.metric == main && chosen->metric != main))) chosen = &o;
        if (chosen) list.push_back({name, chosen->metric, chosen->unit});
    }
    return list;
}

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

Json ordersJson(const results::Run& run, const std::string& scenario) {
    Json list = Json::array();
    for (const auto& o : run.orders)
        if (o.scenario == scenario)
            list.push_back({{"spec", o.spec},
                            {"metric", o.metric},
                            {"unit", o.unit},
                            {"order", number(o.order)},
                            {"low", number(o.low)},
                            {"high", number(o.high)},
                            {"points", o.points},
                            {"finest", number(o.finest)},
                            {"coarsest", number(o.coarsest)},
                            {"note", o.note}});
    return list;
}

Json fairnessJson(const results::Run& run, const std::string& scenario) {
    Json list = Json::array();
    for (const auto& f : run.fairness)
        if (f.scenario == scenario)
            list.push_back({{"mode", f.mode},
                            {"metric", f.metric},
                            {"unit", f.unit},
                            {"competitor", f.competitor},
                            {"dt", number(f.dt)},
                            {"error", number(f.error)},
                            {"cost", number(f.cost)},
                            {"limit", number(f.limit)}});
    return list;
}

std::string ordersCsv(const results::Run& run) {
    std::string out = "scenario,spec,metric,unit,order,low,high,points,finest,coarsest,note,non_finite\n";
    for (const auto& o : run.orders)
        out += joined({o.scenario, o.spec, o.metric, o.unit, optionalNumber(o.order), optionalNumber(o.low),
                       optionalNumber(o.high), std::to_string(o.points), finiteText(o.finest),
                       finiteText(o.coarsest), o.note,
                       results::nonFiniteNote({{"order", o.order},
                                               {"low", o.low},
                                               {"high", o.high},
                                               {"finest", o.finest},
                                               {"coarsest", o.coarsest}})});
    return out;
}

std::string fairnessCsv(const results::Run& run) {
    std::string out =
        "mode,scenario,metric,unit,competitor,spec,dt,error,cost,budget_or_target,case,non_finite\n";
    for (const auto& f : run.fairness)
        out += joined(
            {f.mode, f.scenario, f.metric, f.unit, f.competitor, f.spec, fullNumber(f.dt),
             finiteText(f.error), finiteText(f.cost), optionalNumber(f.limit), f.caseId,
             results::nonFiniteNote({{"error", f.error}, {"cost", f.cost}, {"budget_or_target", f.limit}})});
    return out;
}

std::string ordersMarkdown(const ViewModel& view) {
    constexpr std::size_t kMost = 60;
    std::string out;
    std::size_t shown = 0;
    for (const Refinement& refinement : refinements(view))
        for (const auto& o : view.run().orders) {
            if (o.scenario != refinement.scenario || o.metric != refinement.metric) continue;
            if (++shown > kMost) continue;
            std::string interval = "-";
            if (o.low && o.high) interval = shortNumber(*o.low) + " .. " + shortNumber(*o.high);
            out += "| " + markdownCell(o.scenario) + " | " + markdownCell(o.metric) + " | " +
                   markdownCell(o.spec) + " | " + (o.order ? shortNumber(*o.order) : "-") + " | " + interval +
                   " | " + std::to_string(o.points) + " | " + markdownCell(o.note) + " |\n";
        }
    if (out.empty()) return "";
    if (shown > kMost) out += "\nand " + std::to_string(shown - kMost) + " more in `orders.csv`\n";
    return "\n### Observed order of convergence\n\n| scenario | metric | engine | order | 95 % interval | "
           "time steps | |\n|---|---|---|---|---|---|---|\n" +
           out;
}

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
