// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The tables in their three formats: CSV keeps every bit, Markdown and LaTeX are well formed, and all say the
// same.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "reports/encoding/text.hpp"
#include "reports/model/view_model.hpp"
#include "reports/tables/table.hpp"
#include "reports/tests/csv_reader.hpp"
#include "reports/tests/find_table.hpp"
#include "reports/tests/synthetic_run.hpp"

namespace rigor::report {
namespace {

std::vector<std::string> linesOf(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// Number of occurrences of `mark` in LaTeX without a backslash before it.
int countBare(const std::string& text, char mark) {
    int count = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\')
            ++i;
        else
            count += text[i] == mark;
    }
    return count;
}

/// The lines between the outermost begin and end of each longtable.
std::vector<std::vector<std::string>> longtablesOf(const std::string& tex) {
    std::vector<std::vector<std::string>> all;
    bool inside = false;
    for (const auto& line : linesOf(tex)) {
        if (line.starts_with("\\begin{longtable}")) all.emplace_back();
        inside = inside || line.starts_with("\\begin{longtable}");
        if (inside) all.back().push_back(line);
        if (line == "\\end{longtable}") inside = false;
    }
    return all;
}

/// Columns of a longtable by its format: l and r, and p with a width behind the way it is set.
int columnsOf(const std::string& begin) {
    const std::string format = begin.substr(std::string("\\begin{longtable}").size());
    int columns = 0, depth = 0;
    for (const char c : format) {
        depth += c == '{' ? 1 : c == '}' ? -1 : 0;
        columns += depth == 1 && (c == 'l' || c == 'r' || c == 'p');
    }
    return columns;
}

/// Text of one longtable that pdflatex would refuse: "" if there is none.
std::string rowFault(const std::vector<std::string>& lines) {
    if (lines.size() < 9 || lines.back() != "\\end{longtable}") return "no longtable";
    for (const auto& line : lines) {
        if (countBare(line, '$') % 2 != 0) return "half a formula: " + line;
        if (countBare(line, '#') + countBare(line, '%') + countBare(line, '~') > 0) return "bare: " + line;
        const bool isRow = line.ends_with(" \\\\");
        if (isRow && countBare(line, '&') + 1 != columnsOf(lines.front())) return "cells: " + line;
        if (!isRow && countBare(line, '&') > 0) return "half a row: " + line;
    }
    return "";
}

/// Text that pdflatex would refuse: "" if there is none.
std::string latexFault(const std::string& tex) {
    std::vector<std::string> open;
    for (std::size_t i = 0; i < tex.size(); ++i) {
        const auto c = static_cast<unsigned char>(tex[i]);
        if (c < 0x20 && c != '\n') return "a control character";
        if (c >= 0xC5 + 1) return "a character that pdflatex does not know";
        if (tex[i] == '\\') {
            ++i;
        } else if (tex[i] == '{') {
            open.emplace_back("{");
        } else if (tex[i] == '}') {
            if (open.empty()) return "a brace too many";
            open.pop_back();
        }
    }
    if (!open.empty()) return "an open brace";
    const auto tables = longtablesOf(tex);
    if (tables.empty()) return "no longtable";
    for (const auto& lines : tables)
        if (auto fault = rowFault(lines); !fault.empty()) return fault;
    return "";
}

Table sample() {
    Table table{"a/b", "Caption with 50 % & a_b", {}, {}};
    table.columns = {{"name"},
                     {"value", ColumnKind::Number, "m"},
                     {"time", ColumnKind::Duration, "s"},
                     {"dt", ColumnKind::TimeStep, "s"},
                     {"ode matched", ColumnKind::Judged}};
    TableCell good(0.1 + 0.2), lost;
    good.verdict = Shown::Fail;
    good.bound = 0.25;
    lost.verdict = Shown::Crashed;
    table.rows = {{"x_1 | <b> \"q\", 5 %", 1.25e-7, 4.2e-6, 1.0 / 240.0, good},
                  {"θ̈ → ∞ 中", std::numeric_limits<double>::quiet_NaN(), {}, 0.0033, lost},
                  {"", -std::numeric_limits<double>::infinity(), 2.0, 0.5, {}},
                  {"count", std::int64_t{123456}, 0.0, 0.1, {}}};
    return table;
}

TEST(Table, CsvKeepsEveryBitAndEveryVerdict) {
    const auto rows = parseCsv(tableCsv(sample()));
    ASSERT_EQ(rows.size(), 5u);
    EXPECT_EQ(rows[0], (std::vector<std::string>{"name", "value [m]", "time [s]", "dt [s]", "ode matched",
                                                 "ode matched verdict", "ode matched bound", "non_finite"}));
    EXPECT_EQ(rows[1][0], "x_1 | <b> \"q\", 5 %");
    expectBits(rows[1][1], 1.25e-7);
    expectBits(rows[1][3], 1.0 / 240.0);
    expectBits(rows[1][4], 0.1 + 0.2);
    EXPECT_EQ(rows[1][5], "fail");
    expectBits(rows[1][6], 0.25);
    EXPECT_EQ(rows[1][7], "");
    EXPECT_EQ(rows[2][1], "");
    EXPECT_EQ(rows[2][7], "value is not a number");
    EXPECT_EQ(rows[2][2], "");
    EXPECT_EQ(rows[2][4], "");
    EXPECT_EQ(rows[2][5], "crashed");
    EXPECT_EQ(rows[3][1], "");
    EXPECT_EQ(rows[3][7], "value is minus infinite");
    EXPECT_EQ(rows[4][1], "123456");
}

TEST(Table, ALowerBoundIsShownBesideTheUpper) {
    Table table = sample();
    table.rows[0][4].boundMin = 0.125;
    const auto rows = parseCsv(tableCsv(table));
    EXPECT_EQ(rows[0][7], "ode matched lower bound");
    expectBits(rows[1][6], 0.25);
    expectBits(rows[1][7], 0.125);
    EXPECT_EQ(rows[2][7], "");
    EXPECT_EQ(rows[2][8], "value is not a number");
    EXPECT_NE(tableMarkdown(table).find("✗ 0.3 (≥ 0.125, ≤ 0.25) |"), std::string::npos);
    const std::string tex = tableLatex(table);
    EXPECT_EQ(latexFault(tex), "") << tex;
    EXPECT_NE(tex.find("$0.3$ ($\\ge$ $0.125$, $\\le$ $0.25$) fail"), std::string::npos) << tex;
}

TEST(Table, MarkdownIsATable) {
    const auto lines = linesOf(tableMarkdown(sample()));
    ASSERT_EQ(lines.size(), 8u);
    EXPECT_EQ(lines[2], R"(| name | value \[m\] | time | dt | ode matched |)");
    EXPECT_EQ(lines[3], "|---|---:|---:|---:|---:|");
    EXPECT_EQ(lines[4], "| x\\_1 \\| &lt;b&gt; \"q\", 5 % | 1.25e-07 | 4.2 µs | 1/240 s | ✗ 0.3 (≤ 0.25) |");
    EXPECT_NE(lines[5].find("| ! crashed |"), std::string::npos) << lines[5];
    EXPECT_NE(lines[7].find("| 123456 |"), std::string::npos);
}

TEST(Table, LatexIsWellFormedAndEscaped) {
    const std::string tex = tableLatex(sample());
    EXPECT_EQ(latexFault(tex), "") << tex;
    ASSERT_EQ(longtablesOf(tex).size(), 1u);
    EXPECT_EQ(columnsOf(longtablesOf(tex)[0][0]), 5);
    EXPECT_NE(tex.find("x\\_1 | <b> \"q\", 5 \\%"), std::string::npos) << tex;
    EXPECT_NE(tex.find("$1.25 \\times 10^{-7}$"), std::string::npos);
    EXPECT_NE(tex.find("4.2 $\\mu$s & 1/240 s & $0.3$ ($\\le$ $0.25$) fail"), std::string::npos) << tex;
    EXPECT_NE(tex.find("$\\theta$\\texttt{U+0308} $\\to$ $\\infty$ \\texttt{U+4E2D}"), std::string::npos)
        << tex;
    EXPECT_NE(tex.find("\\caption{Caption with 50 \\% \\& a\\_b}\\label{tab:a-b}"), std::string::npos);
    EXPECT_NE(latexFault(tex.substr(0, tex.size() - 5)), "") << "the check finds faults";
    std::string cellMore = tex;
    EXPECT_NE(latexFault(cellMore.replace(cellMore.find(" & "), 3, " & & ")), "");
}

/// Sixteen engines do not fit beside each other: each part names its rows again.
TEST(Table, LatexOfAWideTableHasParts) {
    Table table{"wide", "Caption", {{"dt", ColumnKind::TimeStep, "s"}, {"metric"}, {"unit"}}, {}};
    std::vector<TableCell> row{1.0 / 60.0, "normal_error_median", "rad"};
    for (int i = 0; i < 16; ++i) {
        table.columns.push_back({"engine" + std::to_string(i) + " matched", ColumnKind::Judged});
        row.emplace_back(1.25e-7 * (i + 1));
    }
    table.rows = {row};
    const std::string tex = tableLatex(table);
    EXPECT_EQ(latexFault(tex), "") << tex;
    const auto parts = longtablesOf(tex);
    ASSERT_GT(parts.size(), 2u);
    int engines = 0;
    for (const auto& part : parts) {
        EXPECT_NE(part[3].find("metric"), std::string::npos) << part[3];
        EXPECT_LE(columnsOf(part[0]), 9);
        engines += columnsOf(part[0]) - 3;
    }
    EXPECT_EQ(engines, 16);
    for (int i = 0; i < 16; ++i)
        EXPECT_NE(tex.find("{engine" + std::to_string(i) + "\\\\{}matched}"), std::string::npos) << i;
    EXPECT_NE(tex.find("\\caption{Caption (2 of " + std::to_string(parts.size()) + ")}\\label{tab:wide-2}"),
              std::string::npos);
}

/// Long texts are wrapped, and names may be broken at what joins their words.
TEST(Table, LatexOfLongTextsWrapsThem) {
    const std::string words = "the margin of the shape is not part of its size, and is taken off before";
    Table table{"texts", "Caption", {{"engine"}, {"reason"}, {"scenarios", ColumnKind::Number}}, {}};
    table.rows = {{"bullet", words + " " + words + " a_b", std::int64_t{12}}};
    const std::string tex = tableLatex(table);
    EXPECT_EQ(latexFault(tex), "") << tex;
    EXPECT_NE(tex.find("\\begin{longtable}{l>{\\raggedright\\arraybackslash}p{0."), std::string::npos) << tex;
    EXPECT_NE(tex.find("a\\_\\allowbreak{}b"), std::string::npos);
}

TEST(Tables, AreWellFormedInEveryFormat) {
    const auto run = synthetic::makeRun(26);  // the run has the hostile name
    const ViewModel view(run);
    const auto tables = allTables(view);
    std::set<std::string> names;
    for (const auto& table : tables) {
        EXPECT_TRUE(names.insert(table.name).second) << table.name << " twice";
        EXPECT_FALSE(table.caption.empty());
        std::size_t csvColumns = table.columns.size() + 1;  // one more column for values that are not finite
        for (const auto& column : table.columns) csvColumns += column.kind == ColumnKind::Judged ? 2 : 0;
        for (const auto& row : table.rows) ASSERT_EQ(row.size(), table.columns.size()) << table.name;
        const auto csv = parseCsv(tableCsv(table));
        ASSERT_EQ(csv.size(), table.rows.size() + 1) << table.name;
        for (const auto& row : csv) EXPECT_EQ(row.size(), csvColumns) << table.name;
        EXPECT_EQ(latexFault(tableLatex(table)), "") << table.name;
        const auto markdown = linesOf(tableMarkdown(table));
        ASSERT_EQ(markdown.size(), table.rows.size() + 4) << table.name;
        EXPECT_EQ(tableMarkdown(table).find("<img"), std::string::npos);
    }
    for (const char* name :
         {"scoreboard", "trust", "timing", "phases", "audit", "contacts", "ledger", "scenarios/free_flight"})
        EXPECT_TRUE(names.contains(name)) << name;
}

TEST(Tables, SayWhatTheRunSays) {
    const auto run = synthetic::makeRun(8);
    const ViewModel view(run);
    const auto tables = allTables(view);
    std::size_t timed = 0, phases = 0, inRun = 0;
    for (const auto& c : run.cases)
        for (const auto& t : c.timings) t.phase == "step" ? ++timed : ++phases;
    for (const auto& c : run.cases)
        inRun += static_cast<std::size_t>(std::count_if(c.audit.begin(), c.audit.end(),
                                                        [](const auto& a) { return a.auditor == "in_run"; }));
    EXPECT_EQ(named(tables, "timing").rows.size(), timed);
    EXPECT_EQ(named(tables, "phases").rows.size(), phases);
    EXPECT_EQ(named(tables, "contacts").rows.size(), inRun);
    EXPECT_EQ(named(tables, "ledger").rows.size(), view.ledger().size());
    const Table& board = named(tables, "scoreboard");
    ASSERT_EQ(board.rows.size(), run.scenarios.size());
    for (std::size_t s = 0; s < run.scenarios.size(); ++s)
        for (std::size_t c = 0; c < view.columns().size(); ++c) {
            const TableCell& cell = board.rows[s][5 + c];
            EXPECT_EQ(cell.verdict, view.cell(s, c).worst);
            const auto& row = *view.cell(s, c).cases.front();
            const auto* metric = findMetric(row, view.mainMetric(s).name);
            if (cell.number) {
                EXPECT_EQ(*cell.number, metric->value);
            }
            EXPECT_EQ(cell.number.has_value(), metric != nullptr && *cell.verdict < Shown::NonFinite);
        }
    // The first of a mechanism's rows that is one's choice is the view's.
    const Table& trust = named(tables, "trust");
    for (const auto& m : view.mechanisms()) {
        const auto row = std::find_if(trust.rows.begin(), trust.rows.end(),
                                      [&](const auto& r) { return r[0].text == m.name; });
        ASSERT_NE(row, trust.rows.end());
        if (m.best < 0) continue;
        EXPECT_EQ((*row)[1].text, view.columns()[m.best].engine);
    }
}

/// If there is a pdflatex, it compiles the tables, and none is wider than the text.
TEST(Tables, CompileWhereThereIsAPdflatex) {
    if (std::system("command -v pdflatex > /dev/null 2>&1") != 0) GTEST_SKIP() << "no pdflatex here";
    const auto run = synthetic::makeRun(26);
    std::string document =
        "\\documentclass{article}\\usepackage[T1]{fontenc}\\usepackage{array,booktabs,longtable}\n"
        "\\begin{document}\n" +
        tableLatex(sample());
    for (const auto& table : allTables(ViewModel(run)))
        if (table.rows.size() < 200) document += tableLatex(table);
    const auto folder = std::filesystem::path(testing::TempDir()) / "rigor-latex";
    std::filesystem::create_directories(folder);
    writeFile(folder / "tables.tex", document + "\\end{document}\n");
    EXPECT_EQ(std::system(("cd " + folder.string() +
                           " && pdflatex -interaction=batchmode -halt-on-error tables.tex > log.txt 2>&1")
                              .c_str()),
              0)
        << folder;
    std::ifstream log(folder / "tables.log");
    for (std::string line; std::getline(log, line);)
        EXPECT_EQ(line.find("Overfull \\hbox ("), std::string::npos) << folder << ": " << line;
}

}  // namespace
}  // namespace rigor::report
