// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Sentences of verdicts: each names the two things that were compared, and claims nothing else.
#include <cmath>
#include <numbers>
#include <sstream>

#include "reports/encoding/text.hpp"
#include "reports/model/view_model.hpp"
#include "validation/results/counted.hpp"
#include "validation/results/insertion_orders.hpp"
#include "validation/results/judgement.hpp"

namespace rigor::report {
namespace {

using results::AgainstScheme;
using results::CaseRow;
using results::Grade;
using results::MetricRow;
using results::Outcome;
using results::Regression;

void append(std::string& line, const std::string& part, const char* gap = " · ") {
    if (!part.empty()) line += (line.empty() ? "" : gap) + part;
}

/// Angles are in degrees, as everywhere on the pages.
std::string withUnit(double value, const std::string& unit) {
    if (unit == "rad") return shortNumber(value * 180.0 / std::numbers::pi) + "°";
    return shortNumber(value) + (unit.empty() || unit == "1" ? "" : " " + unit);
}

/// " An ideal run of its scheme has 0.031 (C): this is farther off than its scheme."
std::string schemeText(const results::AccuracyRow& accuracy) {
    if (!accuracy.ideal) return " What its scheme allows here is not known.";
    std::string text = " An ideal run of its scheme has " + shortNumber(*accuracy.ideal) + " (" +
                       results::gradeName(results::gradeOf(*accuracy.ideal)) + "): this is ";
    switch (results::againstScheme(accuracy.relative, accuracy.ideal)) {
        case AgainstScheme::Farther:
            return text + "farther off than its scheme.";
        case AgainstScheme::Nearer:
            return text + "nearer than its scheme.";
        default:
            return text + "as good as its scheme allows.";
    }
}

/// "quantity_error of stop_time": the metric that decides and what it is of.
std::string decidingName(const CaseRow& row) {
    const std::string subject = worstSubject(row, row.accuracy.metric);
    return row.accuracy.metric + (subject.empty() ? "" : " of " + subject);
}

/// "joint_drift of hinge 0.0095 m, which is 0.047 of its scale 0.2 m"; a metric without a unit is its own relative error.
std::string decidingText(const CaseRow& row, const MetricRow* m) {
    const auto& accuracy = row.accuracy;
    const std::string name = decidingName(row);
    const double relative = accuracy.relative.value_or(kNoNumber);
    if (m == nullptr) return name + ", relative error " + shortNumber(relative);
    std::string text = name + " " + withUnit(m->value, m->unit);
    if (m->unit == "1" && (!m->scale || *m->scale == 1.0)) return text;
    return text + ", which is " + shortNumber(relative) + " of its scale" +
           (m->scale ? " " + withUnit(*m->scale, m->unit) : "");
}

}  // namespace

std::string accuracySentence(const CaseRow& row) {
    if (row.outcome != Outcome::Completed)
        return "Not graded: " + std::string(results::outcomeName(row.outcome)) + ".";
    const auto& accuracy = row.accuracy;
    if (accuracy.grade == Grade::None)
        return "Not graded: " + (accuracy.note.empty() ? std::string("nothing was graded") : accuracy.note) +
               ".";
    const MetricRow* m = findMetric(row, accuracy.metric);
    std::string text = "Grade " + std::string(results::gradeName(accuracy.grade)) + " at " +
                       timeStepLabel(row.dt) + ", by its worst error: " + decidingText(row, m) + "." +
                       schemeText(accuracy);
    if (m != nullptr && m->verdict == results::Verdict::KnownDeviation)
        text += " Wrong physics: " + m->note + ".";
    return text;
}

std::string regressionSentence(const CaseRow& row) {
    switch (row.regression) {
        case Regression::NoRecord:
            return row.regressionReason.empty() ? "" : "No record: " + row.regressionReason + ".";
        case Regression::Unchanged:
            return "Unchanged against the record of this version" +
                   (row.regressionReason.empty() ? "." : " (" + row.regressionReason + ").");
        case Regression::Better:
            return "Better than on record: " + row.regressionReason + ".";
        case Regression::Worse:
            return "Worse than on record: " + row.regressionReason + ".";
    }
    return "";
}

std::string runTitle(const results::Run& run) {
    constexpr int kMost = 3;
    if (run.suite.empty()) return "run";
    std::istringstream words(run.suite);
    std::string title, word;
    int count = 0, left = 0;
    while (words >> word)
        if (count < kMost)
            title += (count++ > 0 ? " " : "") + word;
        else
            ++left;
    return left == 0 ? title : title + " and " + std::to_string(left) + " more";
}

std::string verdictSentence(const ViewModel& view) {
    const std::string name = runTitle(view.run());
    const int red = view.totals().red;
    const auto unsupported = view.totals().cases.find(Shown::Unsupported);
    if (unsupported != view.totals().cases.end() && unsupported->second == view.totals().total)
        return name + ": nothing was judged, every case is unsupported";
    if (red == 0) return name + ": no case is red";
    return name + ": " + std::to_string(red) + " of " +
           results::counted(static_cast<std::size_t>(view.totals().total), "case") +
           (red == 1 ? " is red" : " are red");
}

std::vector<std::pair<std::string, std::string>> totalsText(const ViewModel& view) {
    const Totals& totals = view.totals();
    std::string accuracy, regression, endings;
    for (const Grade grade : results::kGrades)
        if (const auto it = totals.grades.find(grade); it != totals.grades.end())
            append(accuracy, std::string(results::gradeName(grade)) + " " + std::to_string(it->second));
    if (const auto it = totals.grades.find(Grade::None); it != totals.grades.end())
        append(accuracy, std::to_string(it->second) + " not graded");
    for (const auto& [state, count] : totals.regressions)
        append(regression, std::to_string(count) + " " + results::regressionName(state));
    for (const auto& [shown, count] : totals.cases) {
        const std::string detail = detailOf(totals, shown);
        append(endings, std::string(shownText(shown).symbol) + " " + std::to_string(count) + " " +
                            shownText(shown).word + (detail.empty() ? "" : " (" + detail + ")"));
    }
    std::vector<std::pair<std::string, std::string>> lines{
        {"accuracy", accuracy}, {"against the record", regression}, {"endings", endings}};
    if (const std::string orders = ordersTotalText(view.run()); !orders.empty())
        lines.emplace_back("order of insertion", orders);
    return lines;
}

std::string cellText(const ViewModel& view, std::size_t scenario, std::size_t column, bool withNumber) {
    const Cell& cell = view.cell(scenario, column);
    if (cell.cases.empty()) return "";
    const CaseRow& row = *cell.cases.front();
    const bool isLost =
        cell.worst == Shown::Crashed || cell.worst == Shown::Timeout || cell.worst == Shown::NonFinite;
    std::string text = results::gradeName(row.accuracy.grade);
    if (text.empty() || isLost || cell.worst == Shown::Fail) text += shownText(cell.worst).symbol;
    if (cell.worst == Shown::KnownDeviation && row.accuracy.grade != Grade::None)
        text += shownText(cell.worst).symbol;
    for (const CaseRow* c : cell.cases)
        if (c->regression == Regression::Worse || c->regression == Regression::Better) {
            text += c->regression == Regression::Worse ? "▼" : "▲";
            break;
        }
    const CaseRow* ordered = &row;
    for (const CaseRow* c : cell.cases)
        if (results::orderDependence(*c) > results::orderDependence(*ordered)) ordered = c;
    text += orderMark(*ordered);
    if (!withNumber || isLost) return text;
    const MetricRow* m = findMetric(row, view.mainMetric(scenario).name);
    if (row.accuracy.relative)
        text += " " + shortNumber(*row.accuracy.relative);
    else if (m != nullptr && row.outcome == Outcome::Completed)
        text += " " + shortNumber(m->value);
    return text;
}

}  // namespace rigor::report
