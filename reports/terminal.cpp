// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <set>

#include "reports/report.hpp"
#include "reports/text.hpp"
#include "reports/view_model.hpp"

namespace rigor::report {
namespace {

const char* colourOf(Shown shown) {
    switch (shown) {
        case Shown::Pass:
            return "32";
        case Shown::KnownDeviation:
            return "33";
        case Shown::NoBound:
            return "36";
        case Shown::Unsupported:
            return "2";
        default:
            return "1;31";
    }
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

/// How a table of this run fits the terminal.
struct Layout {
    std::size_t nameWidth = 8, cellWidth = 0;
    bool letters = false;  ///< columns headed A, B, ... with a key below
    bool values = false;   ///< main metric beside the symbol
};

Layout layoutOf(const ViewModel& view, std::size_t columns) {
    Layout layout;
    for (const auto& s : view.run().scenarios)
        layout.nameWidth = std::max(layout.nameWidth, displayWidth(plain(s.name)));
    layout.nameWidth = std::min<std::size_t>(layout.nameWidth, std::max<std::size_t>(12, columns / 3));
    std::size_t widest = 4;
    for (const auto& c : view.columns())
        widest = std::max({widest, displayWidth(c.engine), displayWidth(c.preset)});
    const std::size_t room = columns > layout.nameWidth ? columns - layout.nameWidth : 0;
    const std::size_t each = room / std::max<std::size_t>(1, view.columns().size());
    if (each >= std::max<std::size_t>(widest, 10) + 1)
        layout.cellWidth = std::max<std::size_t>(widest, 10) + 1, layout.values = true;
    else if (each >= widest + 1)
        layout.cellWidth = widest + 1;
    else
        layout.cellWidth = 3, layout.letters = true;
    return layout;
}

std::string letter(std::size_t i) {
    std::string text;
    do {
        text.insert(text.begin(), static_cast<char>('A' + i % 26));
        i /= 26;
    } while (i-- > 0);
    return text;
}

std::vector<std::string> headLines(const ViewModel& view, const Layout& layout, std::size_t width,
                                   const Painter& paint) {
    std::vector<std::string> lines;
    if (layout.letters) {
        std::string head = std::string(layout.nameWidth, ' '), key;
        for (std::size_t c = 0; c < view.columns().size(); ++c) {
            head += " " + pad(letter(c), layout.cellWidth - 1);
            const std::string entry = letter(c) + " " + plain(view.columns()[c].label);
            if (!key.empty() && displayWidth(key) + displayWidth(entry) + 2 > width)
                lines.push_back(key + ","), key.clear();
            key += (key.empty() ? "" : ", ") + entry;
        }
        lines.push_back(key);
        lines.push_back(paint(head, "1"));
        return lines;
    }
    const auto row = [&](const auto& text) {
        std::string line(layout.nameWidth, ' ');
        bool any = false;
        for (const auto& column : view.columns()) {
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
        std::string text;
        if (!cell.cases.empty()) {
            text = shownText(cell.worst).symbol;
            const auto* m = findMetric(*cell.cases.front(), view.mainMetric(s).name);
            if (layout.values && m && cell.worst < Shown::NonFinite) text += " " + shortNumber(m->value);
        }
        const std::string padded = pad(text, layout.cellWidth - 1);
        line += " " + (cell.cases.empty() ? padded : paint(padded, colourOf(cell.worst)));
    }
    return line;
}

/// Scenarios with something to say first when not all of them fit.
std::vector<std::size_t> order(const ViewModel& view, std::size_t room) {
    std::vector<std::size_t> all(view.run().scenarios.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    if (all.size() <= room) return all;
    const auto trouble = [&](std::size_t s) {
        int count = 0;
        for (std::size_t c = 0; c < view.columns().size(); ++c) {
            const Shown w = view.cell(s, c).worst;
            count += w == Shown::Fail || w == Shown::Crashed || w == Shown::Timeout || w == Shown::NonFinite;
        }
        return count;
    };
    std::stable_sort(all.begin(), all.end(), [&](auto a, auto b) { return trouble(a) > trouble(b); });
    all.resize(room > 0 ? room - 1 : 0);
    return all;
}

/// "3 pass   1 fail   of 4 cases", in as many lines as the width asks for.
std::vector<std::string> totalsLines(const ViewModel& view, std::size_t width, const Painter& paint) {
    struct Part {
        std::string text;
        const char* colour;
    };
    std::vector<Part> parts;
    for (const auto& [shown, count] : view.totals().cases)
        parts.push_back(
            {std::string(shownText(shown).symbol) + " " + std::to_string(count) + " " + shownText(shown).word,
             colourOf(shown)});
    const auto planned = std::max<std::int64_t>(view.run().plannedCases, view.totals().total);
    std::string total = "of " + std::to_string(planned) + " cases";
    if (view.totals().total < planned) total += ", " + std::to_string(view.totals().total) + " done";
    parts.push_back({total, nullptr});

    std::vector<std::string> lines(1);
    std::size_t used = 0;
    for (const auto& part : parts) {
        const std::size_t gap = used == 0 ? 0 : 3;
        if (used > 0 && used + gap + displayWidth(part.text) > width) {
            lines.emplace_back();
            used = 0;
        }
        lines.back() += std::string(used == 0 ? 0 : gap, ' ') +
                        (part.colour != nullptr ? paint(part.text, part.colour) : part.text);
        used += (used == 0 ? 0 : gap) + displayWidth(part.text);
    }
    return lines;
}

std::vector<std::string> offenderLines(const ViewModel& view, std::size_t most, std::size_t width,
                                       const Painter& paint) {
    std::vector<std::string> lines;
    const auto offenders = view.offenders();
    if (offenders.empty() || most < 2) return lines;
    lines.push_back(paint("Worst offenders", "1"));
    std::set<std::pair<std::string, std::string>> seen;  // one line per scenario and spec
    for (const auto& o : offenders) {
        if (lines.size() >= most) break;
        if (!seen.insert({o.row->scenario, o.row->spec}).second) continue;
        lines.push_back(cut("  " + std::string(shownText(shownOf(*o.row)).symbol) + " " +
                                plain(o.row->scenario + "  " + o.row->spec) + "  " +
                                timeStepLabel(o.row->dt) + "  " + plain(o.text),
                            width));
    }
    return lines;
}

}  // namespace

std::string terminalSummary(const results::Run& run, int lines, int columns, bool colour) {
    const ViewModel view(run);
    const Painter paint{colour};
    const auto width = static_cast<std::size_t>(std::max(columns, 40));
    const auto most = static_cast<std::size_t>(std::max(lines, 6));
    const Layout layout = layoutOf(view, width);

    std::vector<std::string> out = headLines(view, layout, width, paint);
    const std::size_t offenderRoom = std::min<std::size_t>(6, most / 4);
    const auto worst = offenderLines(view, offenderRoom, width, paint);
    std::vector<std::string> tail = totalsLines(view, width, paint);
    tail.insert(tail.end(), worst.begin(), worst.end());

    const std::size_t used = out.size() + tail.size() + 1;
    const std::size_t room = most > used ? most - used : 0;
    const auto chosen = order(view, room);
    for (const std::size_t s : chosen) out.push_back(scenarioLine(view, s, layout, paint));
    if (chosen.size() < view.run().scenarios.size() && room > 0)
        out.push_back("… and " + std::to_string(view.run().scenarios.size() - chosen.size()) +
                      " more scenarios in the report");
    out.push_back("");
    out.insert(out.end(), tail.begin(), tail.end());
    if (out.size() > most) out.resize(most);
    std::string text;
    for (const auto& line : out) text += (text.empty() ? "" : "\n") + line;
    return text;
}

}  // namespace rigor::report
