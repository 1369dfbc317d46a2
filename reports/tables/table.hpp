// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A table before it has a format: CSV for programs (all digits), Markdown and LaTeX for people.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/model/view_model.hpp"

namespace rigor::report {

/// Kind of the numbers of a column, which decides their format; CSV has SI numbers throughout.
enum class ColumnKind {
    Text,
    Number,    ///< a number in the column's unit
    Duration,  ///< [s], shown as 12.3 µs
    TimeStep,  ///< [s], shown as 1/240 s
    Judged     ///< a number with its verdict and its bounds: three columns in CSV, four with a lower bound
};

struct TableColumn {
    std::string title;
    ColumnKind kind = ColumnKind::Text;
    std::string unit = "";  ///< "" where the rows have different ones or none
};

/// Content of a column of its kind. A cell with neither number nor text is empty.
struct TableCell {
    TableCell() = default;
    TableCell(std::string words) : text(std::move(words)) {}
    TableCell(const char* words) : text(words) {}
    TableCell(std::optional<double> value) : number(value) {}
    TableCell(double value) : number(value) {}
    /// Counts are exact up to 2^53.
    TableCell(std::int64_t count) : number(static_cast<double>(count)) {}

    std::string text;                ///< instead of a number
    std::optional<double> number;    ///< number; may be NaN or infinite
    std::optional<Shown> verdict;    ///< verdict of a Judged cell
    std::optional<double> bound;     ///< bound of a Judged cell
    std::optional<double> boundMin;  ///< lower bound of a Judged cell
};

struct Table {
    std::string name;     ///< name of its files, without an ending; "/" makes a folder
    std::string caption;  ///< one line: what it says and how to read it
    std::vector<TableColumn> columns;
    std::vector<std::vector<TableCell>> rows;  ///< rows with as many cells as columns
    bool ofScenario = false;  ///< Its rows belong to one scenario: a large run has thousands of such tables.
};

/// RFC 4180 with a header line. A Judged column "x" becomes "x", "x verdict", "x bound", and
/// "x lower bound" where one of its cells has it.
std::string tableCsv(const Table& table);
/// The caption, then a GitHub table.
std::string tableMarkdown(const Table& table);
/// Longtables with the rules of booktabs, to be \input; the first line says which packages they need. A table that is
/// wider than the text of an article in a small size wraps its texts, and continues in further tables, each with the
/// first columns again.
std::string tableLatex(const Table& table);

/// True for columns of numbers.
bool isNumeric(const TableColumn& column);
/// The title with the unit.
std::string titleOf(const TableColumn& column);
/// A number in few digits; a count stays a count: "12400", not "1.24e+04".
std::string readableNumber(double value);
/// The number of a column as people read it, in plain text.
std::string readable(const TableColumn& column, double value);

/// Plain text as LaTeX: its special characters escaped, what pdflatex does not know of Unicode replaced.
std::string latexText(std::string_view text);

/// The tables of a run. An entry is one line in tables.cpp.
struct TableEntry {
    const char* name;
    std::vector<Table> (*make)(const ViewModel& view);
};
const std::vector<TableEntry>& tableEntries();
/// Name of the table with the metrics of a scenario.
std::string scenarioTableName(const results::ScenarioRow& scenario);
std::vector<Table> allTables(const ViewModel& view);

}  // namespace rigor::report
