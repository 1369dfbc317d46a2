// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/summaries/terminal.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "reports/encoding/text.hpp"
#include "reports/model/view_model.hpp"
#include "validation/results/counted.hpp"
#include "validation/results/values.hpp"

namespace rigor::report {
namespace {

const char* colourOf(results::Grade grade) {
    switch (grade) {
        case results::Grade::A:
        case results::Grade::B:
            return "32";
        case results::Grade::C:
            return "36";
        case results::Grade::D:
            return "33";
        case results::Grade::E:
            return "35";
        case results::Grade::None:
            break;
    }
    return "0";
}

const char* colourOf(Shown shown) {
    switch (shown) {
        case Shown::Pass:
            return "32";
        case Shown::KnownDeviation:
            return "33";
        case Shown::NoBound:
        case Shown::NoReference:
            return "36";
        case Shown::Unsupported:
            return "2";
        default:
            return "1;31";
    }
}

/// Colour of a cell: that of its ending if it failed, otherwise that of its grade.
const char* colourOf(const Cell& cell) {
    const bool ran =
        cell.worst == Shown::Pass || cell.worst == Shown::NoBound || cell.worst == Shown::KnownDeviation;
    const auto grade = cell.cases.front()->accuracy.grade;
    return ran && grade != results::Grade::None ? colourOf(grade) : colourOf(cell.worst);
}

struct Painter {
    bool colour;
    std::string operator()(const std::string& text, const char* code) const {
        return colour ? "\x1b[" + std::string(code) + "m" + text + "\x1b[0m" : text;
    }
};

std::string cut(const std::string& text, std::size_t width) {
    if (displayWidth(text) <= width) return text;
    std::string out;
    std::size_t used = 0;
    for (const char c : text) {
        const bool starts = (static_cast<unsigned char>(c) & 0xC0) != 0x80;
        if (starts && used + 1 >= width) break;
        used += starts;
        out += c;
    }
    return out + "…";
}

std::string pad(const std::string& text, std::size_t width) {
    const std::string shown = cut(text, width);
    return shown + std::string(width - std::min(width, displayWidth(shown)), ' ');
}

/// Control characters of a name must not reach the terminal.
std::string plain(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    return text;
}

/// An error over the best one's: "1.3x".
std::string timesText(double ratio) {
    char text[32];
    std::snprintf(text, sizeof text, ratio < 9.95 ? "%.1fx" : ratio < 1e4 ? "%.0fx" : "%.0ex", ratio);
    return text;
}

/// Columns as they are named here: options that would make a label longer than this are numbered.
constexpr std::size_t kLongestLabel = 36;

struct Names {
    std::vector<SpecColumn> columns;
    std::vector<std::string> key;  ///< "rigor [1]: box_margin=0.05, ...", for each number once

    const std::string& labelOf(const std::string& spec) const {
        const auto found =
            std::find_if(columns.begin(), columns.end(), [&](const SpecColumn& c) { return c.spec == spec; });
        return found != columns.end() && found->options.rfind('[', 0) == 0 ? found->label : spec;
    }
};

Names namesOf(const ViewModel& view) {
    Names names;
    names.columns = view.columns();
    std::map<std::string, std::vector<std::string>> numbered;  // options, by engine
    for (SpecColumn& column : names.columns) {
        if (displayWidth(column.label) <= kLongestLabel) continue;
        auto& known = numbered[column.engine];
        auto at = std::find(known.begin(), known.end(), column.options);
        if (at == known.end()) {
            names.key.push_back(column.engine + " [" + std::to_string(known.size() + 1) +
                                "]: " + column.options);
            at = known.insert(known.end(), column.options);
        }
        column.options = "[" + std::to_string(at - known.begin() + 1) + "]";
        column.label =
            column.engine + (column.preset.empty() ? " " : " " + column.preset + " ") + column.options;
    }
    return names;
}

/// Legend of the numbers, in lines that fit.
std::vector<std::string> keyLines(const Names& names, std::size_t width) {
    std::vector<std::string> lines;
    for (const auto& entry : names.key) {
        std::istringstream words(plain(entry));
        bool first = true;
        for (std::string word; words >> word; first = false)
            if (first)
                lines.push_back(word);
            else if (displayWidth(lines.back()) + 1 + displayWidth(word) > width)
                lines.push_back("  " + word);
            else
                lines.back() += " " + word;
    }
    for (auto& line : lines) line = cut(line, width);
    return lines;
}

/// Layout of a table of this run in the terminal.
struct Layout {
    std::size_t nameWidth = 8, cellWidth = 0;
    bool letters = false;  ///< columns headed a, b, ... with a key below
    bool values = false;   ///< main metric beside the symbol
};

Layout layoutOf(const ViewModel& view, const Names& names, std::size_t columns) {
    Layout layout;
    for (const auto& s : view.run().scenarios)
        layout.nameWidth = std::max(layout.nameWidth, displayWidth(plain(s.name)));
    layout.nameWidth = std::min<std::size_t>(layout.nameWidth, std::max<std::size_t>(12, columns / 3));
    std::size_t widest = 4;
    for (const auto& c : names.columns)
        widest = std::max({widest, displayWidth(c.engine), displayWidth(c.preset)});
    std::size_t number = 10;  // width of a cell with its number
    for (std::size_t s = 0; s < view.run().scenarios.size(); ++s)
        for (std::size_t c = 0; c < view.columns().size(); ++c)
            number = std::max(number, displayWidth(cellText(view, s, c, true)));
    const std::size_t room = columns > layout.nameWidth ? columns - layout.nameWidth : 0;
    const std::size_t each = room / std::max<std::size_t>(1, view.columns().size());
    if (each >= std::max(widest, number) + 1) {
        layout.cellWidth = std::max(widest, number) + 1;
        layout.values = true;
    } else if (each >= widest + 1)
        layout.cellWidth = widest + 1;
    else {
        layout.cellWidth = 3;
        layout.letters = true;
    }
    return layout;
}

std::string letter(std::size_t i) {
    std::string text;
    do {
        text.insert(text.begin(), static_cast<char>('a' + i % 26));
        i /= 26;
    } while (i-- > 0);
    return text;
}

std::vector<std::string> headLines(const Names& names, const Layout& layout, std::size_t width,
                                   const Painter& paint) {
    std::vector<std::string> lines;
    if (names.columns.empty()) return lines;
    if (layout.letters) {
        std::string head = std::string(layout.nameWidth, ' '), key;
        for (std::size_t c = 0; c < names.columns.size(); ++c) {
            head += " " + pad(letter(c), layout.cellWidth - 1);
            const std::string entry = letter(c) + " " + plain(names.columns[c].label);
            if (!key.empty() && displayWidth(key) + displayWidth(entry) + 2 > width) {
                lines.push_back(key + ",");
                key.clear();
            }
            key += (key.empty() ? "" : ", ") + entry;
        }
        lines.push_back(key);
        lines.push_back(paint(head, "1"));
        return lines;
    }
    const auto row = [&](const auto& text) {
        std::string line(layout.nameWidth, ' ');
        bool any = false;
        for (const auto& column : names.columns) {
            any = any || !text(column).empty();
            line += " " + pad(plain(text(column)), layout.cellWidth - 1);
        }
        if (any) lines.push_back(paint(line, "1"));
    };
    row([](const SpecColumn& c) { return c.engine; });
    row([](const SpecColumn& c) { return c.preset; });
    row([](const SpecColumn& c) { return c.options; });
    return lines;
}

std::string scenarioLine(const ViewModel& view, std::size_t s, const Layout& layout, const Painter& paint) {
    std::string line = pad(plain(view.run().scenarios[s].name), layout.nameWidth);
    for (std::size_t c = 0; c < view.columns().size(); ++c) {
        const Cell& cell = view.cell(s, c);
        const std::string padded = pad(cellText(view, s, c, layout.values), layout.cellWidth - 1);
        line += " " + (cell.cases.empty() ? padded : paint(padded, colourOf(cell)));
    }
    return line;
}

/// Order of the scenarios: that of the run if all fit, otherwise those with something to report first.
std::vector<std::size_t> order(const ViewModel& view, std::size_t room) {
    std::vector<std::size_t> chosen = byTrouble(view);
    if (chosen.size() <= room) {
        std::sort(chosen.begin(), chosen.end());
        return chosen;
    }
    chosen.resize(room > 0 ? room - 1 : 0);
    return chosen;
}

/// Accuracy, regression and endings, each in as many lines as the width requires.
std::vector<std::string> totalsLines(const ViewModel& view, std::size_t width) {
    std::vector<std::string> lines;
    const auto planned = std::max<std::int64_t>(view.run().plannedCases, view.totals().total);
    for (const auto& [what, counts] : totalsText(view)) {
        std::istringstream words(
            what + ": " + counts +
            (what == "endings" ? " of " + results::counted(static_cast<std::size_t>(planned), "case") : ""));
        lines.emplace_back();
        for (std::string word; words >> word;)
            if (lines.back().empty())
                lines.back() = word;
            else if (displayWidth(lines.back()) + 1 + displayWidth(word) > width)
                lines.push_back("  " + word);
            else
                lines.back() += " " + word;
    }
    if (view.totals().total < planned) lines.push_back("  " + std::to_string(view.totals().total) + " done");
    return lines;
}

/// Rankings: a line for each mechanism, its engines from the best on, each by its best preset, as many as fit.
std::vector<std::string> trustLines(const ViewModel& view, const Names& names, std::size_t most,
                                    std::size_t width, const Painter& paint) {
    std::vector<std::string> lines;
    std::size_t nameWidth = 0;
    auto mechanisms = view.mechanisms();
    std::erase_if(mechanisms, [](const Mechanism& m) { return m.best < 0; });
    if (mechanisms.empty() || most < 2) return lines;
    lines.push_back(
        paint(cut("Who to trust for what, each engine by its best preset (within 1e-2; x best, ours)", width),
              "1"));
    if (mechanisms.size() > most - 1) mechanisms.resize(most - 1);
    for (const auto& m : mechanisms) nameWidth = std::max(nameWidth, displayWidth(plain(m.name)));
    nameWidth = std::min(nameWidth, width / 3);
    for (const auto& m : mechanisms) {
        std::string line = "  " + pad(plain(m.name), nameWidth);
        bool first = true;
        for (const std::size_t c : m.engines) {
            const Ranking& s = m.rankings[c];
            if (!std::isfinite(s.toBest)) continue;
            std::string entry = (first ? "  " : ", ") + plain(names.columns[c].label) + " " +
                                std::to_string(s.within()) + "/" + std::to_string(s.gradable()) + " " +
                                timesText(s.toBest);
            if (std::isfinite(s.toOurs)) entry += " " + timesText(s.toOurs);
            if (!first && displayWidth(line) + displayWidth(entry) > width) break;
            line += entry;
            first = false;
        }
        lines.push_back(cut(line, width));
    }
    return lines;
}

std::vector<std::string> offenderLines(const ViewModel& view, const Names& names, std::size_t most,
                                       std::size_t width, const Painter& paint) {
    std::vector<std::string> lines;
    const auto offenders = view.offenders();
    if (offenders.empty() || most < 2) return lines;
    std::set<std::pair<std::string, std::string>> seen;  // one line per scenario and spec
    for (const auto& o : offenders) {
        if (!seen.insert({o.row->scenario, o.row->spec}).second || lines.size() + 1 >= most) continue;
        lines.push_back(cut("  " + std::string(shownText(shownOf(*o.row)).symbol) + " " +
                                plain(o.row->scenario + "  " + names.labelOf(o.row->spec)) + "  " +
                                timeStepLabel(o.row->dt) + "  " + plain(o.text),
                            width));
    }
    std::string title = "What is red, worst first";
    if (seen.size() > lines.size())
        title += " (" + std::to_string(lines.size()) + " of " + std::to_string(seen.size()) + ")";
    lines.insert(lines.begin(), paint(cut(title, width), "1"));
    return lines;
}

constexpr std::size_t kDurationWidth = 8;  ///< width of the longest duration, "0.631 µs"

/// Costs of a step in the order of byCost(), those of each clock together: median and mean, the first step apart, with
/// the accuracy of the same runs.
std::vector<std::string> costLines(const ViewModel& view, const Names& names, std::size_t most,
                                   std::size_t width, const Painter& paint) {
    std::vector<std::string> lines;
    const auto costs = stepCosts(view);
    const auto order = byCost(costs);
    if (order.empty() || most < 2) return lines;
    std::string title = "Cost of a step, by the mean over the cheapest one's";
    if (order.size() + 1 > most)
        title += ", " + std::to_string(most - 1) + " of " + std::to_string(order.size());
    title += " (cases within 1e-2; medians over scenarios; the first step apart)";
    lines.push_back(paint(cut(title, width), "1"));
    const Mechanism overall = view.overall();
    const auto nameOf = [&](std::size_t c) {
        const std::string& clock = costs[c].clock;
        return plain(names.columns[c].label + (clock.empty() ? "" : " (" + clock + ")"));
    };
    std::size_t nameWidth = 0;
    for (const std::size_t c : order) nameWidth = std::max(nameWidth, displayWidth(nameOf(c)));
    nameWidth = std::min(nameWidth, width / 3);
    for (const std::size_t c : order) {
        if (lines.size() == most) break;
        const StepCost& cost = costs[c];
        const Ranking& ranking = overall.rankings[c];
        std::string line = "  " + pad(nameOf(c), nameWidth) + "  " +
                           pad(std::to_string(ranking.within()) + "/" + std::to_string(ranking.graded()), 7);
        const std::pair<const char*, double> parts[] = {{"median", cost.median}, {"mean", cost.mean},
                                                        {"first", cost.first},   {"p95", cost.p95},
                                                        {"p99", cost.p99},       {"worst", cost.worst}};
        for (const auto& [name, seconds] : parts) {
            const std::string entry = " " + std::string(name) + " " +
                                      pad(std::isnan(seconds) ? "-" : durationLabel(seconds), kDurationWidth);
            if (displayWidth(line) + displayWidth(entry) > width) break;
            line += entry;
        }
        const std::string factor = " " + timesText(cost.realTimeFactor) + " real time";
        if (!std::isnan(cost.realTimeFactor) && displayWidth(line) + displayWidth(factor) <= width)
            line += factor;
        lines.push_back(cut(line, width));
    }
    return lines;
}

/// Results that are the order's, the widest range first.
std::vector<std::string> orderLines(const ViewModel& view, const Names& names, std::size_t most,
                                    std::size_t width, const Painter& paint) {
    std::vector<std::string> lines;
    const auto dependents = orderDependents(view.run());
    const std::string heading = ordersHeading(view.run(), dependents.size());
    if (heading.empty() || most < 2) return lines;
    lines.push_back(paint(cut(heading, width), "1"));
    for (const auto& d : dependents)
        if (lines.size() < most)
            lines.push_back(cut("  " + plain(d.row->scenario + "  " + names.labelOf(d.row->spec)) + "  " +
                                    timeStepLabel(d.row->dt) + "  " + plain(orderText(d)),
                                width));
    return lines;
}

/// One sentence, then what became of the cases.
std::vector<std::string> verdictLines(const ViewModel& view, std::size_t width, const Painter& paint) {
    const bool bad = !view.offenders().empty();
    const std::string sentence =
        plain(verdictSentence(view)) + (view.run().finished.empty() ? ", unfinished" : "");
    std::vector<std::string> lines{paint(cut(sentence, width), bad ? "1;31" : "1;32")};
    for (auto& line : totalsLines(view, width)) lines.push_back(line);
    return lines;
}

/// Paths of the complete results. They are never cut, so that they can be used.
std::vector<std::string> whereLines(const results::Run& run) {
    if (run.directory.empty()) return {};
    return {"Report: " + plain(run.directory) + "/index.html",
            "Replay: " + results::programOf(run) + " view " + plain(run.directory)};
}

/// The scoreboard in `most` lines: all scenarios, or those with something to say.
std::vector<std::string> boardLines(const ViewModel& view, const Names& names, std::size_t most,
                                    std::size_t width, const Painter& paint) {
    const Layout layout = layoutOf(view, names, width);
    const std::string cells = layout.values ? "grade and relative error" : "grade";
    std::vector<std::string> lines{paint(
        cut("Scoreboard: " + cells + "; △ wrong physics, ▼▲ record, ↕ order (⇅ its verdict), – unsupported",
            width),
        "1")};
    for (auto& line : headLines(names, layout, width, paint)) lines.push_back(std::move(line));
    if (view.columns().empty() || lines.size() + 2 > most) return {};
    const std::size_t all = view.run().scenarios.size();
    const auto chosen = order(view, most - lines.size());
    for (const std::size_t s : chosen) lines.push_back(scenarioLine(view, s, layout, paint));
    if (chosen.size() < all)
        lines.push_back("… and " + std::to_string(all - chosen.size()) + " more scenarios in the report");
    return lines;
}

}  // namespace

std::string terminalSummary(const results::Run& run, int lines, int columns, bool colour) {
    const ViewModel view(run);
    const Painter paint{colour};
    const auto width = static_cast<std::size_t>(std::max(columns, 40));
    const auto most = static_cast<std::size_t>(std::max(lines, 6));

    // The required lines come first, then the sections in the order of their importance per line.
    auto head = verdictLines(view, width, paint);
    for (const auto& line : missingReferences(run))
        if (head.size() + 4 < most) head.push_back(paint(cut("no reference: " + plain(line), width), "1;33"));
    auto where = whereLines(run);
    if (head.size() + where.size() > most) where.clear();
    std::size_t room = most - std::min(most, head.size() + where.size());
    const auto reserve = [&](std::vector<std::string> section) {
        if (section.size() + 1 > room) section.clear();
        room -= section.empty() ? 0 : section.size() + 1;  // one more for the empty line before it
        return section;
    };
    Names names = namesOf(view);
    const auto key = reserve(keyLines(names, width));
    if (key.empty()) names = {view.columns(), {}};  // a number without its column's name means nothing
    const auto worst = reserve(offenderLines(view, names, std::min<std::size_t>(8, most / 5), width, paint));
    const auto orders = reserve(orderLines(view, names, std::min<std::size_t>(8, most / 5), width, paint));
    const auto trust = reserve(trustLines(view, names, std::min<std::size_t>(12, most / 4), width, paint));
    const auto cost = reserve(costLines(view, names, std::min<std::size_t>(8, most / 8), width, paint));
    const auto board = reserve(boardLines(view, names, room > 1 ? room - 2 : 0, width, paint));

    std::string text;
    for (const std::vector<std::string>* section :
         {&std::as_const(head), &trust, &worst, &orders, &cost, &board, &key, &std::as_const(where)}) {
        if (section->empty()) continue;
        if (!text.empty() && (section != &where || room > 0)) text += "\n";
        for (const auto& line : *section) text += (text.empty() ? "" : "\n") + line;
    }
    return text;
}

}  // namespace rigor::report
