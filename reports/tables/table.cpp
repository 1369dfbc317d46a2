// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/tables/table.hpp"

#include <cmath>

#include "reports/encoding/text.hpp"

namespace rigor::report {
namespace {

bool isNumeric(const TableColumn& column) {
    return column.kind != ColumnKind::Text;
}

std::string titleOf(const TableColumn& column) {
    const bool spoken = column.kind == ColumnKind::Duration || column.kind == ColumnKind::TimeStep;
    if (column.unit.empty() || column.unit == "1" || spoken) return column.title;
    return column.title + " [" + column.unit + "]";
}

/// A count stays a count: "12400", not "1.24e+04".
std::string readableNumber(double value) {
    if (value == std::floor(value) && std::abs(value) < 1e9) {
        char text[32];
        std::snprintf(text, sizeof text, "%.0f", value);
        return text;
    }
    return shortNumber(value);
}

/// The number as people read it, in plain text.
std::string readable(const TableColumn& column, double value) {
    if (column.kind == ColumnKind::Duration) return durationLabel(value);
    if (column.kind == ColumnKind::TimeStep) return timeStepLabel(value);
    return readableNumber(value);
}

// ---- CSV ----

void appendCsvLine(std::string& out, const std::vector<std::string>& fields) {
    for (std::size_t i = 0; i < fields.size(); ++i) out += (i > 0 ? "," : "") + csvField(fields[i]);
    out += '\n';
}

/// A number that is not finite leaves its cell empty and is named in `reason`.
std::string csvValue(const std::string& title, const TableCell& cell, std::string& reason) {
    if (!cell.number) return cell.text;
    const std::string text = finiteText(*cell.number);
    if (text.empty()) reason += (reason.empty() ? "" : "; ") + nonFiniteText(title, *cell.number);
    return text;
}

// ---- Markdown ----

std::string markdownValue(const TableColumn& column, const TableCell& cell) {
    std::string text = cell.number ? readable(column, *cell.number) : markdownCell(cell.text);
    if (!cell.verdict) return text;
    const ShownText shown = shownText(*cell.verdict);
    text = std::string(shown.symbol) + " " + (text.empty() ? shown.word : text);
    if (cell.bound) text += " (≤ " + readableNumber(*cell.bound) + ")";
    return text;
}

// ---- LaTeX ----

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
    if (cell.bound) text += " ($\\le$ " + latexNumber(*cell.bound) + ")";
    if (*cell.verdict == Shown::Pass || *cell.verdict == Shown::NoBound) return text;
    const std::string word = latexText(shownText(*cell.verdict).word);
    return text.empty() ? word : text + " " + word;
}

std::string latexRow(const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i) line += (i > 0 ? " & " : "") + cells[i];
    return line + " \\\\\n";
}

}  // namespace

std::string tableCsv(const Table& table) {
    std::vector<std::string> head;
    for (const auto& column : table.columns) {
        head.push_back(column.unit.empty() || column.unit == "1" ? column.title
                                                                 : column.title + " [" + column.unit + "]");
        if (column.kind == ColumnKind::Judged) {
            head.push_back(column.title + " verdict");
            head.push_back(column.title + " bound");
        }
    }
    head.push_back("non_finite");
    std::string out;
    appendCsvLine(out, head);
    for (const auto& row : table.rows) {
        std::vector<std::string> fields;
        std::string reason;
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
            const std::string& title = table.columns[c].title;
            fields.push_back(csvValue(title, row[c], reason));
            if (table.columns[c].kind != ColumnKind::Judged) continue;
            fields.push_back(row[c].verdict ? shownText(*row[c].verdict).word : "");
            fields.push_back(csvValue(title + " bound", TableCell(row[c].bound), reason));
        }
        fields.push_back(reason);
        appendCsvLine(out, fields);
    }
    return out;
}

std::string tableMarkdown(const Table& table) {
    std::string out = markdownCell(table.caption) + "\n\n|", rule = "|";
    for (const auto& column : table.columns) {
        out += " " + markdownCell(titleOf(column)) + " |";
        rule += isNumeric(column) ? "---:|" : "---|";
    }
    out += "\n" + rule + "\n";
    for (const auto& row : table.rows) {
        out += "|";
        for (std::size_t c = 0; c < table.columns.size(); ++c)
            out += " " + markdownValue(table.columns[c], row[c]) + " |";
        out += "\n";
    }
    return out;
}

std::string tableLatex(const Table& table) {
    std::string format, label = table.name;
    std::vector<std::string> head;
    for (const auto& column : table.columns) {
        format += isNumeric(column) ? 'r' : 'l';
        head.push_back(latexText(titleOf(column)));
    }
    for (char& c : label)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
    const std::string top = "\\toprule\n" + latexRow(head) + "\\midrule\n";
    std::string out = "% Needs \\usepackage{booktabs,longtable}.\n\\begin{longtable}{" + format +
                      "}\n\\caption{" + latexText(table.caption) + "}\\label{tab:" + label + "}\\\\\n" + top +
                      "\\endfirsthead\n" + top + "\\endhead\n\\bottomrule\n\\endlastfoot\n";
    for (const auto& row : table.rows) {
        std::vector<std::string> cells;
        for (std::size_t c = 0; c < table.columns.size(); ++c)
            cells.push_back(latexValue(table.columns[c], row[c]));
        out += latexRow(cells);
    }
    return out + "\\end{longtable}\n";
}

}  // namespace rigor::report
