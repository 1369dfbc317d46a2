// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/tables/table.hpp"

#include <cmath>

#include "reports/encoding/text.hpp"

namespace rigor::report {

bool isNumeric(const TableColumn& column) {
    return column.kind != ColumnKind::Text;
}

std::string titleOf(const TableColumn& column) {
    const bool spoken = column.kind == ColumnKind::Duration || column.kind == ColumnKind::TimeStep;
    if (column.unit.empty() || column.unit == "1" || spoken) return column.title;
    return column.title + " [" + column.unit + "]";
}

std::string readableNumber(double value) {
    if (value == std::floor(value) && std::abs(value) < 1e9) {
        char text[32];
        std::snprintf(text, sizeof text, "%.0f", value);
        return text;
    }
    return shortNumber(value);
}

std::string readable(const TableColumn& column, double value) {
    if (column.kind == ColumnKind::Duration) return durationLabel(value);
    if (column.kind == ColumnKind::TimeStep) return timeStepLabel(value);
    return readableNumber(value);
}

namespace {

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
    const std::string lower = cell.boundMin ? "≥ " + readableNumber(*cell.boundMin) + ", " : "";
    if (cell.bound) text += " (" + lower + "≤ " + readableNumber(*cell.bound) + ")";
    return text;
}

bool hasLowerBound(const Table& table, std::size_t column) {
    return std::any_of(table.rows.begin(), table.rows.end(),
                       [&](const auto& row) { return row[column].boundMin.has_value(); });
}

}  // namespace

std::string tableCsv(const Table& table) {
    std::vector<std::string> head;
    std::vector<bool> isTwoSided;
    for (const auto& column : table.columns) {
        isTwoSided.push_back(hasLowerBound(table, isTwoSided.size()));
        head.push_back(column.unit.empty() || column.unit == "1" ? column.title
                                                                 : column.title + " [" + column.unit + "]");
        if (column.kind == ColumnKind::Judged) {
            head.push_back(column.title + " verdict");
            head.push_back(column.title + " bound");
            if (isTwoSided.back()) head.push_back(column.title + " lower bound");
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
            if (isTwoSided[c])
                fields.push_back(csvValue(title + " lower bound", TableCell(row[c].boundMin), reason));
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

}  // namespace rigor::report
