// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/summaries/summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "reports/encoding/text.hpp"
#include "reports/model/view_model.hpp"
#include "reports/tables/bench.hpp"
#include "reports/tables/costs.hpp"
#include "reports/tables/insertion_orders.hpp"
#include "reports/tables/refinements.hpp"
#include "validation/results/counted.hpp"
#include "validation/results/values.hpp"

namespace rigor::report {
namespace {

constexpr std::size_t kMostOffenders = 20;
constexpr int kMostChoices = 3;
constexpr std::size_t kMostCommand = 1000;
constexpr std::size_t kMostBytes = 65000;  // a comment holds 65536 characters; bytes are at least as many

/// Accuracy and regression are two lines, and never one.
std::string totalsLines(const ViewModel& view) {
    std::string lines;
    for (const auto& [what, counts] : totalsText(view)) lines += "- " + what + ": " + counts + "\n";
    return lines;
}

std::string scoreboardRow(const ViewModel& view, std::size_t s) {
    bool isGraded = false;
    for (std::size_t c = 0; c < view.columns().size(); ++c)
        for (const auto* row : view.cell(s, c).cases) isGraded = isGraded || row->accuracy.relative;
    const auto& metric = view.mainMetric(s);
    const std::string number =
        isGraded
            ? "relative error"
            : markdownCell(metric.name) +
                  (metric.unit.empty() || metric.unit == "1" ? "" : " [" + markdownCell(metric.unit) + "]");
    std::string out = "| " + markdownCell(view.run().scenarios[s].name) + " | " + number + " |";
    for (std::size_t c = 0; c < view.columns().size(); ++c) out += " " + cellText(view, s, c, true) + " |";
    return out + "\n";
}

/// The scoreboard in at most `budget` bytes: where it does not fit whole, scenarios with trouble come first.
std::string scoreboardSection(const ViewModel& view, std::size_t budget) {
    const std::size_t scenarios = view.run().scenarios.size();
    std::string out = "\n<details><summary>Scoreboard: " + results::counted(scenarios, "scenario") + ", " +
                      results::counted(view.columns().size(), "engine setting") + "</summary>\n\n";
    std::string rule = "|---|---|";
    out += "| scenario | number |";
    for (const auto& column : view.columns()) {
        out += " " + markdownCell(column.label) + " |";
        rule += "---|";
    }
    out += "\n" + rule + "\n";
    const std::string end =
        "\nA cell: grade of accuracy (A to 1e-6, B to 1e-4, C to 1e-2, D to 1e-1 of the scenario's own "
        "scale, E beyond), △ wrong physics with a reason on file, ▼ ▲ worse or better than on record, ↕ "
        "depends on the order of insertion, ⇅ in its verdict, and the relative error that the grade "
        "rests on, at the finest time step; of a scene without an exact solution how it ended (✓ bounds "
        "kept, ○ ran) and its main metric.\n\n</details>\n";
    std::size_t used = out.size() + end.size() + 100, shown = 0;
    std::vector<std::string> rows(scenarios);
    for (const std::size_t s : byTrouble(view)) {
        std::string row = scoreboardRow(view, s);
        if (used + row.size() > budget) continue;
        used += row.size();
        ++shown;
        rows[s] = std::move(row);
    }
    if (shown == 0) return "";
    for (const auto& row : rows) out += row;
    if (shown < scenarios)
        out += "\nand " + std::to_string(scenarios - shown) + " more scenarios in `tables/scoreboard.md`\n";
    return out + end;
}

std::string offenderList(const ViewModel& view) {
    const auto offenders = view.offenders();
    if (offenders.empty()) return "";
    std::string out = "\n### What is red (" + std::to_string(offenders.size()) + ", worst first)\n\n";
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
        line += markdownCell(e.name) +
                (e.version.empty() ? "" : " " + markdownCell(results::versionText(e))) +
                (e.precision.empty() ? "" : " " + markdownCell(e.precision)) +
                (e.problem.empty() ? "" : " (" + markdownCell(e.problem) + ")");
    }
    for (const char* key : {"cpu", "kernel", "compiler"})
        if (const auto it = run.environment.find(key); it != run.environment.end())
            line += (line.empty() ? "" : "; ") + markdownCell(it->second);
    return line;
}

/// Refused features, each of one engine once: those that its adapter lacks come first.
std::string refusalSection(const ViewModel& view) {
    std::map<std::tuple<std::string, std::string, std::string, std::string>, int> cases;
    for (const auto& row : view.run().cases)
        if (!row.refusal.empty() && !row.ledger.empty())
            ++cases[{row.refusal, row.engine, row.ledger.front().requested, row.ledger.front().reason}];
    if (cases.empty()) return "";
    std::string rows;
    for (const auto& [key, count] : cases) {
        const auto& [refusal, engine, lacking, why] = key;
        rows += "| " + markdownCell(engine) + " | " + markdownCell(lacking) + " | " + std::to_string(count) +
                " | " + refusalText(refusal) + " | " + markdownCell(why) + " |\n";
    }
    return "\n### Refused: " + detailOf(view.totals(), Shown::Unsupported) +
           "\n\n| engine | requested | cases | which is | why |\n|---|---|---:|---|---|\n" + rows;
}

std::string times(double ratio) {
    return shortNumber(std::round(10 * ratio) / 10) + "x";
}

/// Ranking: the first and the next engines of every mechanism, each by its best preset.
std::string trustSection(const ViewModel& view) {
    std::string rows;
    for (const auto& m : view.mechanisms()) {
        if (m.best < 0) continue;
        rows += "| " + markdownCell(m.name) + " | " + std::to_string(m.scenarios.size()) + " |";
        int named = 0;
        for (const std::size_t c : m.engines) {
            const Ranking& s = m.rankings[c];
            if (named == kMostChoices || !std::isfinite(s.toBest)) break;
            const std::string label = markdownCell(view.columns()[c].label);
            rows += " " + (named == 0 ? "**" + label + "**" : label) + " " + std::to_string(s.within()) +
                    "/" + std::to_string(s.gradable()) + ", " + times(s.toBest) +
                    (std::isfinite(s.toOurs) ? ", " + times(s.toOurs) + " ours" : "") + " |";
            ++named;
        }
        for (; named < kMostChoices; ++named) rows += " |";
        rows += "\n";
    }
    if (rows.empty()) return "";
    return "\n### Who to trust for what, each engine by its best preset\n\n| mechanism | scenarios | first "
           "choice | next | then |\n"
           "|---|---:|---|---|---|\n" +
           rows +
           "\nBeside each engine: scenarios within a hundredth of their own scale (grade C or better) of "
           "those it took part in that can be graded, its error over the best engine's and over the in-house "
           "one's (geometric means).\n";
}

/// Scenarios whose reference broke down: the engines ran, and their errors are unknown.
std::string withoutReferences(const ViewModel& view) {
    std::string out;
    for (const auto& line : missingReferences(view.run())) out += "- " + markdownCell(line) + "\n";
    return out.empty() ? "" : "\n**References that could not be computed** (no engine is to blame)\n\n" + out;
}

std::string headline(const ViewModel& view) {
    const auto& run = view.run();
    const auto planned = std::max<std::int64_t>(run.plannedCases, view.totals().total);
    return "## Rigor, " + markdownCell(verdictSentence(view)) + "\n\n" + totalsLines(view) + "\n" +
           std::to_string(view.totals().total) + " of " +
           results::counted(static_cast<std::size_t>(planned), "case") +
           (run.finished.empty() ? " (**unfinished**)\n" : "\n");
}

/// Text as code, with any content.
std::string code(std::string text) {
    std::erase_if(text, [](char c) { return c == '`' || c == '\n' || c == '\r'; });
    return "`" + text.substr(0, kMostCommand) + "`";
}

std::string whereSection(const results::Run& run) {
    std::string out;
    if (!run.directory.empty())
        out = "\nThe whole report: " + code(run.directory + "/index.html") +
              ", tables in `tables/`, plots in `plots/`; replay: " +
              code(results::programOf(run) + " view " + run.directory) + "\n";
    if (!run.command.empty()) out += "\n" + code(run.command) + "\n";
    return out;
}

}  // namespace

std::string markdownSummary(const ViewModel& view) {
    const std::string end = whereSection(view.run()) + "\n" + environmentLine(view.run()) +
                            "\n\nThe authors of this comparison wrote one of the engines in it (rigor).\n";
    std::string out = headline(view);
    // The most important sections come first and take their room first; the scoreboard gets the rest.
    for (const auto& section :
         {benchMarkdown(view.run()), withoutReferences(view), trustSection(view), offenderList(view),
          insertionOrdersMarkdown(view), costMarkdown(view), refusalSection(view), ordersMarkdown(view)})
        if (out.size() + section.size() + end.size() <= kMostBytes) out += section;
    return out + scoreboardSection(view, kMostBytes - std::min(kMostBytes, out.size() + end.size())) + end;
}

}  // namespace rigor::report
