// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tables of scenarios run at several time steps: orders of convergence, error against cost, and engines
// compared in four labelled ways, as CSV, JSON and Markdown.
#include "reports/tables/refinements.hpp"

#include <algorithm>

#include "reports/encoding/json.hpp"
#include "reports/encoding/text.hpp"
#include "reports/model/refinements.hpp"
#include "reports/model/view_model.hpp"
#include "validation/results/values.hpp"

namespace rigor::report {
namespace {

std::string optionalNumber(const std::optional<double>& value) {
    return value ? finiteText(*value) : std::string();
}

std::string csvLine(const std::vector<std::string>& fields) {
    std::string line;
    for (const auto& field : fields) line += (line.empty() ? "" : ",") + csvField(field);
    return line + "\n";
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
        out += csvLine({o.scenario, o.spec, o.metric, o.unit, optionalNumber(o.order), optionalNumber(o.low),
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
        out += csvLine(
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

}  // namespace rigor::report
