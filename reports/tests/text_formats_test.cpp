// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// CSV, JUnit XML, Markdown, SVG and the terminal table, read by parsers of their own.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <regex>

#include "reports/encoding/text.hpp"
#include "reports/model/view_model.hpp"
#include "reports/page/page_data.hpp"
#include "reports/plots/line_plot.hpp"
#include "reports/summaries/junit.hpp"
#include "reports/summaries/summary.hpp"
#include "reports/summaries/terminal.hpp"
#include "reports/tables/csv.hpp"
#include "reports/tests/csv_reader.hpp"
#include "reports/tests/synthetic_run.hpp"
#include "validation/results/judgement.hpp"

namespace rigor::report {
namespace {

TEST(Csv, EveryNumberComesBackWithItsBits) {
    const auto run = synthetic::makeRun();
    const auto rows = parseCsv(csvReport(run));
    std::map<std::string, std::size_t> column;
    for (std::size_t i = 0; i < rows[0].size(); ++i) column[rows[0][i]] = i;
    std::size_t next = 1;
    const auto field = [&](const char* name) { return rows.at(next).at(column.at(name)); };
    for (const auto& c : run.cases) {
        const auto head = [&] {
            ASSERT_LT(next, rows.size());
            ASSERT_EQ(rows[next].size(), rows[0].size());
            EXPECT_EQ(field("scenario"), c.scenario);
            EXPECT_EQ(field("spec"), c.spec);
            EXPECT_EQ(field("command"), c.command);
            expectBits(field("dt"), c.dt);
            EXPECT_EQ(field("verdict"), results::verdictName(c.verdict));
        };
        const auto number = [&](const char* name, const std::optional<double>& wanted) {
            const bool finite = wanted && std::isfinite(*wanted);
            const bool named = field("non_finite").find(std::string(name) + " is ") != std::string::npos;
            EXPECT_EQ(field(name).empty(), !finite) << name;
            EXPECT_EQ(named, wanted && !finite) << name << ": " << field("non_finite");
            if (finite) expectBits(field(name), *wanted);
        };
        for (const auto& m : c.metrics) {
            head();
            EXPECT_EQ(field("metric"), m.name);
            EXPECT_EQ(field("subject"), m.subject);
            number("value", m.value);
            number("bound", m.bound);
            number("bound_min", m.boundMin);
            number("expectation", m.expectation);
            EXPECT_EQ(field("metric_verdict"), results::verdictName(m.verdict));
            EXPECT_EQ(field("note"), m.note);
            ++next;
        }
        for (const auto& q : c.quantities) {
            head();
            EXPECT_EQ(field("kind"), "quantity");
            number("value", q.measured);
            number("exact", q.exact);
            number("scheme_exact", q.schemeExact);
            ++next;
        }
        if ((c.metrics.empty() && c.quantities.empty()) || c.outcome != results::Outcome::Completed) {
            head();
            EXPECT_EQ(field("note"), c.reason);
            ++next;
        }
    }
    EXPECT_EQ(next, rows.size());
}

/// Enough of XML 1.0 to be sure of nesting, attributes and references; throws where it is not well formed.
struct Xml {
    std::string text;
    std::size_t at = 0;
    std::map<std::string, int> elements;
    std::vector<std::string> names;  ///< values of the attribute `name`

    [[noreturn]] void fail(const std::string& why) const {
        throw std::runtime_error(why + " near " + text.substr(at > 40 ? at - 40 : 0, 80));
    }
    bool eat(const std::string& what) {
        if (text.compare(at, what.size(), what) != 0) return false;
        at += what.size();
        return true;
    }
    std::string name() {
        const auto start = at;
        while (at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '-'))
            ++at;
        if (at == start) fail("a name expected");
        return text.substr(start, at - start);
    }
    std::string characters(const std::string& stops) {
        std::string out;
        while (at < text.size() && stops.find(text[at]) == std::string::npos) {
            const auto c = static_cast<unsigned char>(text[at]);
            if (c == '<' || (c < 0x20 && c != '\n' && c != '\t')) fail("raw character");
            if (c == '&') {
                const auto end = text.find(';', at);
                const std::string entity = text.substr(at, end - at + 1);
                static const std::map<std::string, std::string> known{
                    {"&lt;", "<"},  {"&gt;", ">"},   {"&amp;", "&"},  {"&quot;", "\""},
                    {"&#39;", "'"}, {"&#10;", "\n"}, {"&#13;", "\r"}, {"&#9;", "\t"}};
                if (!known.count(entity)) fail("reference " + entity);
                out += known.at(entity);
                at = end + 1;
                continue;
            }
            out += text[at++];
        }
        return out;
    }
    void space() {
        while (at < text.size() && (text[at] == ' ' || text[at] == '\n')) ++at;
    }
    void element() {
        if (!eat("<")) fail("an element expected");
        const std::string tag = name();
        ++elements[tag];
        std::map<std::string, std::string> attributes;
        for (space(); !eat(">"); space()) {
            if (eat("/>")) return;
            const std::string key = name();
            if (!eat("=\"")) fail("no value");
            if (attributes.count(key)) fail("attribute twice");
            attributes[key] = characters("\"");
            if (tag == "testcase" && key == "classname") names.push_back(attributes[key]);
            if (!eat("\"")) fail("open value");
        }
        for (;;) {
            characters("<");
            if (eat("</")) break;
            element();
        }
        if (name() != tag || !eat(">")) fail("wrong closing tag of " + tag);
    }
};

TEST(Junit, IsWellFormedAndCountsRight) {
    auto run = synthetic::makeRun();
    run.cases[0].reason = std::string("control \x01 broken \xff utf-8 \xc3\xa9 ]]>");
    run.cases[0].verdict = results::Verdict::Crashed;
    Xml xml{junitReport(run), 0, {}, {}};
    ASSERT_TRUE(xml.eat("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"));
    ASSERT_NO_THROW(xml.element());
    xml.space();
    EXPECT_EQ(xml.at, xml.text.size());
    using V = results::Verdict;
    std::map<V, int> verdicts;
    for (const auto& c : run.cases) ++verdicts[c.verdict];
    EXPECT_EQ(xml.elements["testcase"], static_cast<int>(run.cases.size()));
    const auto worse = std::count_if(run.cases.begin(), run.cases.end(), [](const results::CaseRow& c) {
        return c.regression == results::Regression::Worse && results::isRed(c) && c.verdict != V::Fail &&
               c.outcome == results::Outcome::Completed;
    });
    EXPECT_GT(worse, 0) << "worse than on record is a failure, whatever the grade";
    EXPECT_EQ(xml.elements["failure"], verdicts[V::Fail] + worse);
    EXPECT_EQ(xml.elements["skipped"], verdicts[V::Unsupported]);
    EXPECT_EQ(xml.elements["error"], verdicts[V::Crashed] + verdicts[V::Timeout] + verdicts[V::NonFinite]);
    EXPECT_EQ(xml.names.back(), synthetic::kHostileName);
    EXPECT_EQ(xml.text.find('\x01'), std::string::npos);
    EXPECT_EQ(xml.text.find('\xff'), std::string::npos);
}

TEST(Summary, FitsAPullRequestComment) {
    for (const int scenarios : {60, 190, 1000}) {
        const auto run = synthetic::makeRun(scenarios);
        const std::string text = markdownSummary(ViewModel(run));
        EXPECT_LE(text.size(), 65000u) << scenarios;
        EXPECT_GT(text.size(), 10000u) << scenarios;
        EXPECT_EQ(text.find("<img"), std::string::npos);
        for (const char* word : {"bounds kept", "fail", "known deviation", "crashed", "timeout", "non-finite",
                                 "unsupported", "accuracy: A ", "against the record: "})
            EXPECT_NE(text.find(word), std::string::npos) << word;
        const auto at = [&](const char* heading) { return text.find(heading); };
        ASSERT_NE(at("</details>"), std::string::npos) << "the scoreboard is there, and closed";
        EXPECT_LT(at("### Who to trust for what"), at("### What is red"));
        EXPECT_LT(at("### What is red"), at("<details>"));
        EXPECT_NE(at("`./rigor view runs/standard-20260101-000000`"), std::string::npos);
    }
}

/// A feature that an adapter lacks is not reported as missing in the library; both are counted by one code.
TEST(Summary, RefusalsAreDistinguished) {
    const auto run = synthetic::makeRun();
    std::map<std::string, int> count;
    for (const auto& c : run.cases)
        if (!c.refusal.empty()) ++count[c.refusal];
    ASSERT_GT(count["adapter"], 0);
    ASSERT_GT(count["library"], 0);
    const std::string both = std::to_string(count["adapter"]) + " not in the adapter yet, " +
                             std::to_string(count["library"]) + " not in the library";
    const ViewModel view(run);
    EXPECT_EQ(detailOf(view.totals(), Shown::Unsupported), both);
    EXPECT_EQ(detailOf(view.totals(), Shown::Pass), "");
    const std::string text = markdownSummary(view);
    EXPECT_NE(text.find("unsupported (" + both + ")"), std::string::npos);
    EXPECT_NE(text.find("### Refused: " + both), std::string::npos);
    EXPECT_NE(text.find("| box2d | 3D dynamics | " + std::to_string(count["library"])), std::string::npos);
    EXPECT_NE(std::regex_replace(terminalSummary(run, 60, 160, false), std::regex("\\s+"), " ")
                  .find("unsupported (" + both + ")"),
              std::string::npos);
    EXPECT_NE(overviewJson(view).find(both), std::string::npos);
}

/// If not all scenarios fit, those with trouble are listed, and the others are counted.
TEST(Summary, LeavesOutWhatIsNoTrouble) {
    auto run = synthetic::makeRun(1000);
    for (auto& c : run.cases) {
        const bool troubled = c.scenario == "pile_125";  // the last of its kind
        c.outcome = results::Outcome::Completed;
        c.verdict = troubled ? results::Verdict::Fail : results::Verdict::Pass;
        c.regression = results::Regression::Unchanged;
    }
    const std::string text = markdownSummary(ViewModel(run));
    EXPECT_NE(text.find("| pile\\_125 |"), std::string::npos);
    EXPECT_NE(text.find(" more scenarios in `tables/scoreboard.md`"), std::string::npos);
    EXPECT_LE(text.size(), 65000u);
}

TEST(Svg, IsWellFormedWithCurvesInsideTheFrame) {
    const auto run = synthetic::makeRun(4);
    const ViewModel view(run);
    for (std::size_t i = 0; i < 4; ++i) {
        const auto plot = scenarioPlot(view, i, synthetic::makeLoader(run));
        ASSERT_TRUE(plot) << i;
        EXPECT_EQ(plot->name.find('/'), std::string::npos);
        const std::string svg = svgOf(plot->drawing);
        EXPECT_NE(svg.find("<path d=\"M"), std::string::npos);
        EXPECT_NE(svg.find(", time step 1/"), std::string::npos);
        EXPECT_EQ(svg.find("nan"), std::string::npos);
        EXPECT_EQ(svg.find("inf"), std::string::npos);
    }
    EXPECT_FALSE(scenarioPlot(view, 0, [](const auto&) { return std::nullopt; }));
}

/// Data of the picture, with all digits.
TEST(Svg, ComesWithItsData) {
    Plot plot;
    plot.title = "x";
    plot.xLabel = "t [s]";
    plot.yLabel = "a, b";
    const double inf = std::numeric_limits<double>::infinity();
    plot.lines = {{"one", "#000", {}, {0.0, 0.1}, {1.0 / 3.0, std::nan("")}},
                  {"two", "#000", {6, 4}, {2.0, inf}, {1e-300, -inf}}};
    const auto rows = parseCsv(namedPlot("p", plot).csv);
    ASSERT_EQ(rows.size(), 5u);
    EXPECT_EQ(rows[0], (std::vector<std::string>{"line", "t [s]", "a, b", "non_finite"}));
    EXPECT_EQ(rows[1][0], "one");
    expectBits(rows[2][1], 0.1);
    expectBits(rows[1][2], 1.0 / 3.0);
    EXPECT_EQ(rows[1][3], "");
    EXPECT_EQ(rows[2][2], "");
    EXPECT_EQ(rows[2][3], "y is not a number");
    expectBits(rows[3][2], 1e-300);
    EXPECT_EQ(rows[4], (std::vector<std::string>{"two", "", "", "x is infinite; y is minus infinite"}));
    const auto run = synthetic::makeRun(4);
    for (std::size_t i = 0; i < 4; ++i) {
        const auto drawn = scenarioPlot(ViewModel(run), i, synthetic::makeLoader(run));
        ASSERT_TRUE(drawn) << i;
        EXPECT_GT(parseCsv(drawn->csv).size(), 1000u) << "up to 800 points of each line";
    }
}

TEST(Svg, TicksAreRoundAndCoverTheRange) {
    EXPECT_EQ(niceTicks(0.0, 10.0, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
    for (const double scale : {1e-12, 0.37, 1.0, 4321.0, 1e15}) {
        const auto ticks = niceTicks(-0.3 * scale, 0.9 * scale, 6);
        EXPECT_GE(ticks.size(), 3u) << scale;
        EXPECT_LE(ticks.size(), 10u) << scale;
        EXPECT_GE(ticks.front(), -0.3 * scale * (1 + 1e-9));
        EXPECT_LE(ticks.back(), 0.9 * scale * (1 + 1e-9));
    }
}

std::vector<std::string> splitLines(const std::string& text) {
    std::vector<std::string> lines(1);
    for (const char c : text) {
        if (c == '\n')
            lines.emplace_back();
        else
            lines.back().push_back(c);
    }
    return lines;
}

TEST(Terminal, KeepsToItsLinesAndColumns) {
    for (const int scenarios : {0, 3, 25, 60})
        for (const int columns : {60, 80, 140, 240})
            for (const int most : {12, 40}) {
                const auto run = synthetic::makeRun(scenarios);
                const auto text = terminalSummary(run, most, columns, false);
                const auto lines = splitLines(text);
                EXPECT_LE(lines.size(), static_cast<std::size_t>(most));
                EXPECT_EQ(text.find('\x1b'), std::string::npos);
                for (const auto& line : lines)
                    EXPECT_LE(displayWidth(line), static_cast<std::size_t>(columns)) << line;
                EXPECT_NE(text.find("of " + std::to_string(run.cases.size()) + " cases"), std::string::npos);
                EXPECT_NE(text.find("Report: runs/standard-20260101-000000/index.html"), std::string::npos);
                EXPECT_NE(text.find("./rigor view runs/standard-20260101-000000"), std::string::npos);
            }
}

/// The terminal shows the rankings, the failures, the scoreboard and the paths.
TEST(Terminal, ShowsRankingsFailuresAndPaths) {
    const auto run = synthetic::makeRun(190);
    const auto text = terminalSummary(run, 40, 160, false);
    const auto at = [&](const char* words) { return text.find(words); };
    ASSERT_NE(at("Where"), 0u);
    EXPECT_EQ(at("standard: "), 0u);
    EXPECT_LT(at("Who to trust for what"), at("What is red, worst first"));
    EXPECT_LT(at("What is red, worst first"), at("more scenarios in the report"));
    EXPECT_LT(at("more scenarios in the report"), at("Report: "));
    const ViewModel view(run);
    const auto mechanisms = view.mechanisms();
    const auto& best = view.columns()[mechanisms.front().best];
    const auto line = text.substr(at(("  " + mechanisms.front().name + " ").c_str()));
    EXPECT_LT(line.find(best.label), line.find('\n')) << "the first choice stands beside the mechanism";
    EXPECT_GE(splitLines(text).size(), 36u) << "the lines are used";
    const auto from = at("Cost of a step, by the mean over the cheapest one's");
    ASSERT_NE(from, std::string::npos) << text;
    const auto cost = text.substr(from);
    EXPECT_TRUE(std::regex_search(cost, std::regex(" median [0-9.e+]+ (µs|ms|s) "))) << cost;
    EXPECT_EQ(cost.substr(0, cost.find("\n\n")).find("…"), std::string::npos)
        << "durations keep their units\n"
        << cost;
}

/// Specs with ten options: a number in rows and columns, and what it stands for once.
TEST(Terminal, LongSpecsAreNumbered) {
    const std::string many =
        "box_margin=0.05, broad_phase=wide_tree, contact_frequency=45, curved_joints=off";
    auto run = synthetic::makeRun(3);
    for (auto& c : run.cases) {
        if (c.engine != run.cases.front().engine) continue;
        c.spec = c.engine + ":preset=" + c.preset + "," + std::regex_replace(many, std::regex(", "), ",");
        c.verdict = results::Verdict::Fail;
    }
    const std::string engine = run.cases.front().engine, preset = run.cases.front().preset;
    for (const int columns : {80, 200}) {
        const auto text = terminalSummary(run, 40, columns, false);
        for (const auto& line : splitLines(text))
            EXPECT_LE(displayWidth(line), static_cast<std::size_t>(columns)) << line;
        EXPECT_NE(text.find("  " + engine + " " + preset + " [1]  "), std::string::npos) << "of what fails\n"
                                                                                         << text;
        EXPECT_EQ(text.find("wide_tree"), text.rfind("wide_tree")) << text;
        std::string joined = std::regex_replace(text, std::regex("\\s+"), " ");
        EXPECT_NE(joined.find(engine + " [1]: " + many), std::string::npos) << text;
    }
}

TEST(Terminal, AGreenRunSaysSo) {
    auto run = synthetic::makeRun(3);
    for (auto& c : run.cases) {
        c.verdict = results::Verdict::Pass;
        c.regression = results::Regression::Unchanged;
    }
    run.finished.clear();
    const auto text = terminalSummary(run, 40, 160, false);
    EXPECT_EQ(text.find("standard: no case is red, unfinished"), 0u) << text;
    EXPECT_EQ(text.find("What is red"), std::string::npos);
}

TEST(Terminal, ColourChangesNothingButColour) {
    const auto run = synthetic::makeRun(25);
    const std::string coloured = terminalSummary(run, 40, 120, true);
    std::string stripped;
    for (std::size_t i = 0; i < coloured.size(); ++i) {
        if (coloured[i] == '\x1b') {
            i = coloured.find('m', i);
            continue;
        }
        stripped += coloured[i];
    }
    EXPECT_EQ(stripped, terminalSummary(run, 40, 120, false));
    EXPECT_NE(stripped, coloured);
}

TEST(Text, NumbersAndEscapes) {
    EXPECT_EQ(shortNumber(0.0123456), "0.01235");
    EXPECT_EQ(shortNumber(1.5e-9), "1.50e-09");
    EXPECT_EQ(timeStepLabel(1.0 / 240.0), "1/240 s");
    EXPECT_EQ(timeStepLabel(0.0033), "0.0033 s");
    EXPECT_EQ(escapeMarkup("<a href='x'>&\"\xc0"), "&lt;a href=&#39;x&#39;&gt;&amp;&quot;\xEF\xBF\xBD");
    EXPECT_EQ(csvField("a\"b,c"), "\"a\"\"b,c\"");
    EXPECT_EQ(fileNamePart("../../etc/passwd"), "_._.._etc_passwd");
}

}  // namespace
}  // namespace rigor::report
