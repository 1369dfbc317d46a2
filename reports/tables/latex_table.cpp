// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tables for papers. Widths are estimated in characters: the text of an article is 345 pt wide.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "reports/tables/table.hpp"

namespace rigor::report {
namespace {

struct Size {
    const char* command;
    double characters;  ///< in a line of text, so that sums of estimates leave some room
};
constexpr std::array<Size, 2> kSizes{{{"\\footnotesize", 75.0}, {"\\scriptsize", 90.0}}};
constexpr double kGap = 1.7;             ///< width of the space between two columns [characters]
constexpr double kNarrowestText = 11.0;  ///< characters of a column of texts that are wrapped

std::string latexNumber(double value) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value > 0 ? "$\\infty$" : "$-\\infty$";
    const std::string text = readableNumber(value);
    const auto e = text.find('e');
    if (e == std::string::npos) return "$" + text + "$";
    return "$" + text.substr(0, e) + " \\times 10^{" + std::to_string(std::stoi(text.substr(e + 1))) + "}$";
}

std::string latexValue(const TableColumn& column, const TableCell& cell) {
    const bool plainNumber = column.kind == ColumnKind::Number || column.kind == ColumnKind::Judged;
    std::string text = !cell.number  ? latexText(cell.text)
                       : plainNumber ? latexNumber(*cell.number)
                                     : latexText(readable(column, *cell.number));
    if (!cell.verdict) return text;
    const std::string lower = cell.boundMin ? "$\\ge$ " + latexNumber(*cell.boundMin) + ", " : "";
    if (cell.bound) text += " (" + lower + "$\\le$ " + latexNumber(*cell.bound) + ")";
    if (*cell.verdict == Shown::Pass || *cell.verdict == Shown::NoBound) return text;
    const std::string word = latexText(shownText(*cell.verdict).word);
    return text.empty() ? word : text + " " + word;
}

std::string latexRow(const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i) line += (i > 0 ? " & " : "") + cells[i];
    return line + " \\\\\n";
}

/// Characters that LaTeX sets for a text; a command counts as one and a half, as signs have room around them.
double setLength(const std::string& latex) {
    double length = 0.0;
    for (std::size_t i = 0; i < latex.size(); ++i) {
        const auto c = static_cast<unsigned char>(latex[i]);
        if (c == '\\' && i + 1 < latex.size()) {
            const bool isWord = std::isalpha(static_cast<unsigned char>(latex[i + 1]));
            if (!isWord) ++i;
            while (isWord && i + 1 < latex.size() && std::isalpha(static_cast<unsigned char>(latex[i + 1])))
                ++i;
            length += isWord ? 1.5 : 1.0;
        } else if (c != '{' && c != '}' && c != '$' && c != '^' && (c & 0xC0) != 0x80) {
            length += 1.0;
        }
    }
    return length;
}

constexpr std::string_view kBreak = "\\allowbreak{}";

/// A text that may be broken after what joins the words of a name.
std::string breakable(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        out += text[i];
        const bool isEscaped = i > 0 && text[i - 1] == '\\';
        if ((text[i] == '_' && isEscaped) ||
            std::string_view("=|/.,:>").find(text[i]) != std::string_view::npos)
            out += kBreak;
    }
    return out;
}

/// Width of the longest piece of a text that is not broken [characters].
double longestPiece(std::string text) {
    text = breakable(text);
    for (std::size_t at = 0; (at = text.find(kBreak)) != std::string::npos;)
        text.replace(at, kBreak.size(), " ");
    double width = 0.0;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        width = std::max(width, setLength(text.substr(begin, end - begin)));
        begin = end + 1;
    }
    return width;
}

/// The texts of a table in LaTeX, and how wide its columns are.
struct Content {
    std::vector<std::string> heads;
    std::vector<std::vector<std::string>> rows;
    std::vector<double> widths;  ///< [characters] of the longest cell or word of the head
    std::vector<double> pieces;  ///< [characters] of what is not broken

    explicit Content(const Table& table) {
        for (const TableColumn& column : table.columns) {
            heads.push_back(latexText(titleOf(column)));
            widths.push_back(longestPiece(heads.back()));
            pieces.push_back(widths.back());
        }
        for (const auto& row : table.rows) {
            auto& cells = rows.emplace_back();
            for (std::size_t c = 0; c < row.size(); ++c) {
                cells.push_back(latexValue(table.columns[c], row[c]));
                widths[c] = std::max(widths[c], setLength(cells.back()));
                pieces[c] = std::max(pieces[c], longestPiece(cells.back()));
            }
        }
    }
};

double narrowest(const Table& table, const Content& content, std::size_t c) {
    if (isNumeric(table.columns[c])) return content.widths[c];
    return std::max(content.pieces[c], std::min(content.widths[c], kNarrowestText));
}

using Columns = std::vector<std::size_t>;

double leastWidth(const Table& table, const Content& content, const Columns& columns) {
    double width = 0.0;
    for (const std::size_t c : columns) width += narrowest(table, content, c) + kGap;
    return width;
}

/// The columns that name a row: those before the first number, as long as half of the line is free.
Columns leadingColumns(const Table& table, const Content& content, double line) {
    Columns leading;
    for (std::size_t c = 0; c + 1 < table.columns.size(); ++c) {
        const ColumnKind kind = table.columns[c].kind;
        if (kind != ColumnKind::Text && kind != ColumnKind::TimeStep) break;
        leading.push_back(c);
        if (leastWidth(table, content, leading) > 0.5 * line) {
            leading.pop_back();
            break;
        }
    }
    return leading;
}

/// Columns of each of the tables that a table is written as.
std::vector<Columns> partsOf(const Table& table, const Content& content, double line) {
    const Columns leading = leadingColumns(table, content, line);
    std::vector<Columns> parts{leading};
    for (std::size_t c = leading.size(); c < table.columns.size(); ++c) {
        Columns wider = parts.back();
        wider.push_back(c);
        if (leastWidth(table, content, wider) <= line || parts.back().size() == leading.size()) {
            parts.back() = std::move(wider);
        } else {
            parts.push_back(leading);
            parts.back().push_back(c);
        }
    }
    return parts;
}

/// Widths of columns [characters]; texts share what the numbers leave.
std::vector<double> sharedWidths(const Table& table, const Content& content, const Columns& columns,
                                 double line) {
    std::vector<double> widths;
    double rest = line;
    for (const std::size_t c : columns) {
        widths.push_back(narrowest(table, content, c));
        rest -= widths.back() + kGap;
    }
    for (bool grows = true; grows && rest > 0.5;) {
        grows = false;
        for (std::size_t i = 0; i < columns.size() && rest > 0.5; ++i)
            if (widths[i] < content.widths[columns[i]]) {
                widths[i] += 1.0;
                rest -= 1.0;
                grows = true;
            }
    }
    return widths;
}

/// Words below each other, where a head is wider than what is below it.
std::string stackedHead(const std::string& head, double width, char side) {
    if (setLength(head) <= width || head.find(' ') == std::string::npos) return head;
    std::string text = std::string("\\shortstack[") + side + "]{";
    for (const char c : head) text += c == ' ' ? std::string("\\\\{}") : std::string(1, c);
    return text + "}";
}

std::string partLatex(const Table& table, const Content& content, const Columns& columns, const Size& size,
                      const std::string& note, const std::string& label) {
    const auto widths = sharedWidths(table, content, columns, size.characters);
    std::string format;
    std::vector<std::string> head;
    std::vector<bool> isWrapped;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const std::size_t c = columns[i];
        const bool numeric = isNumeric(table.columns[c]);
        isWrapped.push_back(widths[i] + 0.5 < content.widths[c]);
        char wrapped[64];
        std::snprintf(wrapped, sizeof wrapped, ">{\\raggedright\\arraybackslash}p{%.3f\\linewidth}",
                      widths[i] / (1.06 * size.characters));
        format += isWrapped.back() ? wrapped : numeric ? "r" : "l";
        head.push_back(isWrapped.back() ? breakable(content.heads[c])
                                        : stackedHead(content.heads[c], widths[i], numeric ? 'r' : 'l'));
    }
    const std::string top = "\\toprule\n" + latexRow(head) + "\\midrule\n";
    std::string out = std::string("{") + size.command + "\\setlength{\\tabcolsep}{3pt}\n\\begin{longtable}{" +
                      format + "}\n\\caption{" + latexText(table.caption) + note + "}\\label{tab:" + label +
                      "}\\\\\n" + top + "\\endfirsthead\n" + top + "\\endhead\n\\bottomrule\n\\endlastfoot\n";
    for (const auto& row : content.rows) {
        std::vector<std::string> cells;
        for (std::size_t i = 0; i < columns.size(); ++i)
            cells.push_back(isWrapped[i] ? breakable(row[columns[i]]) : row[columns[i]]);
        out += latexRow(cells);
    }
    return out + "\\end{longtable}\n}\n";
}

}  // namespace

std::string tableLatex(const Table& table) {
    const Content content(table);
    Columns all(table.columns.size());
    for (std::size_t c = 0; c < all.size(); ++c) all[c] = c;
    const auto fits = std::find_if(kSizes.begin(), kSizes.end(), [&](const Size& s) {
        return leastWidth(table, content, all) <= s.characters;
    });
    const Size& size = fits == kSizes.end() ? kSizes.front() : *fits;
    const auto parts =
        fits == kSizes.end() ? partsOf(table, content, size.characters) : std::vector<Columns>{all};
    std::string label = table.name;
    for (char& c : label)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
    std::string out = "% Needs \\usepackage{array,booktabs,longtable}.\n";
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::string count = std::to_string(i + 1);
        const std::string note =
            parts.size() > 1 ? " (" + count + " of " + std::to_string(parts.size()) + ")" : "";
        out += partLatex(table, content, parts[i], size, note, i == 0 ? label : label + "-" + count);
    }
    return out;
}

}  // namespace rigor::report
