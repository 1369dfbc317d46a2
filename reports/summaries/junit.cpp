// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/summaries/junit.hpp"

#include <cmath>

#include "reports/encoding/text.hpp"
#include "reports/model/view_model.hpp"
#include "validation/results/judgement.hpp"

namespace rigor::report {
namespace {

using results::CaseRow;
using results::Verdict;

std::string attribute(const char* name, const std::string& value) {
    return std::string(" ") + name + "=\"" + escapeMarkup(value) + "\"";
}

std::string seconds(double value) {
    return fullNumber(std::isfinite(value) && value > 0.0 ? value : 0.0);
}

std::string metricLines(const CaseRow& row, Verdict verdict) {
    std::string text;
    for (const auto& m : row.metrics) {
        if (m.verdict != verdict) continue;
        text += m.name + (m.subject.empty() ? "" : " of " + m.subject) + " = " + fullNumber(m.value) + " " +
                m.unit;
        if (m.bound) text += ", bound " + fullNumber(*m.bound);
        if (m.boundMin) text += ", lower bound " + fullNumber(*m.boundMin);
        if (m.expectation) text += ", expected " + fullNumber(*m.expectation);
        if (!m.note.empty()) text += " (" + m.note + ")";
        text += "\n";
    }
    return text;
}

/// A line break of a text node stays one; only attributes need them as references.
std::string body(const std::string& text) {
    std::string out;
    std::size_t start = 0;
    for (std::size_t end; (end = text.find('\n', start)) != std::string::npos; start = end + 1)
        out += escapeMarkup(text.substr(start, end - start)) + "\n";
    return out + escapeMarkup(text.substr(start));
}

std::string element(const char* name, const std::string& type, const std::string& message,
                    const std::string& text) {
    return std::string("      <") + name + attribute("type", type) + attribute("message", message) + ">" +
           body(text) + "</" + name + ">\n";
}

std::string outcomeElement(const CaseRow& row) {
    const std::string verdict = results::verdictName(row.verdict);
    if (row.regression == results::Regression::Worse && results::isRed(row) &&
        row.outcome == results::Outcome::Completed && row.verdict != Verdict::Fail)
        return element("failure", "worse than on record", row.regressionReason, regressionSentence(row));
    switch (row.verdict) {
        case Verdict::Pass:
        case Verdict::KnownDeviation:
            return "";
        case Verdict::Unsupported:
        case Verdict::NoReference:
            return "      <skipped" + attribute("message", row.reason.empty() ? verdict : row.reason) +
                   "/>\n";
        case Verdict::Fail: {
            const std::string lines = metricLines(row, Verdict::Fail);
            const std::string first = lines.substr(0, lines.find('\n'));
            return element("failure", verdict, row.reason.empty() ? first : row.reason, lines);
        }
        case Verdict::Crashed:
        case Verdict::Timeout:
        case Verdict::NonFinite:
            break;
    }
    return element("error", results::outcomeName(row.outcome), row.reason.empty() ? verdict : row.reason,
                   row.reason);
}

std::string testcase(const CaseRow& row) {
    std::string out = "    <testcase" + attribute("classname", row.scenario) +
                      attribute("name", row.spec + " dt=" + fullNumber(row.dt)) +
                      attribute("time", seconds(row.wallSeconds)) + ">\n";
    out += outcomeElement(row);
    std::string note = "verdict: " + std::string(results::verdictName(row.verdict)) + "\n";
    note += metricLines(row, Verdict::KnownDeviation);
    note += accuracySentence(row) + "\n";
    if (const std::string change = regressionSentence(row); !change.empty()) note += change + "\n";
    if (const std::string orders = orderSentence(row); !orders.empty()) note += orders + "\n";
    if (!row.command.empty()) note += "reproduce: " + row.command + "\n";
    return out + "      <system-out>" + body(note) + "</system-out>\n    </testcase>\n";
}

struct Counts {
    int tests = 0, failures = 0, errors = 0, skipped = 0;
    double time = 0.0;

    void add(const CaseRow& row) {
        ++tests;
        failures += outcomeElement(row).find("<failure") != std::string::npos;
        skipped += row.verdict == Verdict::Unsupported || row.verdict == Verdict::NoReference;
        errors += row.verdict == Verdict::Crashed || row.verdict == Verdict::Timeout ||
                  row.verdict == Verdict::NonFinite;
        if (std::isfinite(row.wallSeconds)) time += row.wallSeconds;
    }
    std::string attributes() const {
        return attribute("tests", std::to_string(tests)) + attribute("failures", std::to_string(failures)) +
               attribute("errors", std::to_string(errors)) + attribute("skipped", std::to_string(skipped)) +
               attribute("time", seconds(time));
    }
};

}  // namespace

std::string junitReport(const results::Run& run) {
    Counts counts;
    std::string cases;
    for (const auto& row : run.cases) {
        counts.add(row);
        cases += testcase(row);
    }
    const std::string name = "rigor." + (run.suite.empty() ? std::string("run") : run.suite);
    std::string suite = "  <testsuite" + attribute("name", name) + counts.attributes();
    if (!run.started.empty()) suite += attribute("timestamp", run.started);
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" + attribute("name", name) +
           counts.attributes() + ">\n" + suite + ">\n" + cases + "  </testsuite>\n</testsuites>\n";
}

}  // namespace rigor::report
