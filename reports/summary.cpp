// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <cmath>

#include "reports/text.hpp"
#include "reports/writers.hpp"

namespace rigor::report {
namespace {

constexpr std::size_t kMostOffenders = 20;

std::string totalsLine(const ViewModel& view) {
    std::string line;
    for (const auto& [shown, count] : view.totals().cases)
        line += (line.empty() ? "" : " · ") + std::string(shownText(shown).symbol) + " " +
                std::to_string(count) + " " + shownText(shown).word;
    return line;
}

std::string cellText(const ViewModel& view, std::size_t scenario, std::size_t column) {
    const Cell& cell = view.cell(scenario, column);
    if (cell.cases.empty()) return " ";
    std::string text = shownText(cell.worst).symbol;
    const auto* metric = findMetric(*cell.cases.front(), view.mainMetric(scenario).name);
    const bool lost =
        cell.worst == Shown::Crashed || cell.worst == Shown::Timeout || cell.worst == Shown::NonFinite;
    if (metric && !lost) return text + " " + shortNumber(metric->value);
    if (cell.worst != Shown::Unsupported) text += std::string(" ") + shownText(cell.worst).word;
    return text;
}

std::string verdictTable(const ViewModel& view) {
    std::string out = "| scenario | metric |", rule = "|---|---|";
    for (const auto& column : view.columns()) out += " " + markdownCell(column.label) + " |", rule += "---|";
    out += "\n" + rule + "\n";
    for (std::size_t s = 0; s < view.run().scenarios.size(); ++s) {
        const auto& metric = view.mainMetric(s);
        out += "| " + markdownCell(view.run().scenarios[s].name) + " | " + markdownCell(metric.name) +
               (metric.unit.empty() || metric.unit == "1" ? "" : " [" + markdownCell(metric.unit) + "]") +
               " |";
        for (std::size_t c = 0; c < view.columns().size(); ++c) out += " " + cellText(view, s, c) + " |";
        out += "\n";
    }
    return out;
}

std::string offenderList(const ViewModel& view) {
    const auto offenders = view.offenders();
    if (offenders.empty()) return "";
    std::string out = "\n### Not good (" + std::to_string(offenders.size()) + ")\n\n";
    for (std::size_t i = 0; i < std::min(offenders.size(), kMostOffenders); ++i) {
        const auto& row = *offenders[i].row;
        std::string text = offenders[i].text;
        if (text.size() > 200) text = text.substr(0, 200) + " …";
        out += "- " + std::string(shownText(shownOf(row)).symbol) + " **" + markdownCell(row.scenario) +
               "** " + markdownCell(row.spec) + " at " + timeStepLabel(row.dt) + ": " +
               shownText(shownOf(row)).word + ", " + markdownCell(text) + "\n";
    }
    if (offenders.size() > kMostOffenders)
        out += "- and " + std::to_string(offenders.size() - kMostOffenders) + " more in `index.html`\n";
    return out;
}

std::string environmentLine(const results::Run& run) {
    std::string line;
    for (const auto& e : run.engines) {
        line += line.empty() ? "" : ", ";
        line += markdownCell(e.name) + (e.version.empty() ? "" : " " + markdownCell(e.version)) +
                (e.precision.empty() ? "" : " " + markdownCell(e.precision)) +
                (e.problem.empty() ? "" : " (" + markdownCell(e.problem) + ")");
    }
    for (const char* key : {"cpu", "kernel", "compiler"})
        if (const auto it = run.environment.find(key); it != run.environment.end())
            line += (line.empty() ? "" : "; ") + markdownCell(it->second);
    return line;
}

std::string trustList(const ViewModel& view) {
    std::string out;
    for (const auto& m : view.mechanisms()) {
        if (m.best < 0) continue;
        const auto best = static_cast<std::size_t>(m.best);
        const auto& standing = m.standings[best];
        out += "- " + markdownCell(m.name) + ": **" + markdownCell(view.columns()[best].label) + "**, " +
               std::to_string(standing.good) + " of " + std::to_string(standing.scenarios) +
               " scenarios without a failure\n";
    }
    return out.empty() ? "" : "\n### Smallest error by mechanism\n\n" + out;
}

}  // namespace

std::string markdownSummary(const ViewModel& view) {
    const auto& run = view.run();
    std::string out = "## Rigor: " + markdownCell(run.suite.empty() ? "run" : run.suite) + "\n\n";
    out += totalsLine(view) + " — " + std::to_string(view.totals().total) + " of " +
           std::to_string(std::max<std::int64_t>(run.plannedCases, view.totals().total)) + " cases";
    out += run.finished.empty() ? " (**unfinished**)\n\n" : "\n\n";
    out += verdictTable(view);
    out += "\nA cell shows the worst verdict over all time steps and the metric at the finest one.\n";
    out += offenderList(view) + trustList(view) + ordersMarkdown(view);
    if (!run.command.empty()) out += "\n`" + run.command + "`\n";
    out += "\n" + environmentLine(run) + "\n\n";
    out += "The authors of this comparison wrote one of the engines in it (rigor).\n";
    return out;
}

}  // namespace rigor::report
