// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/plots/study.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reports/tests/csv_reader.hpp"
#include "reports/tests/synthetic_study.hpp"

namespace rigor::report {
namespace {

using Json = nlohmann::ordered_json;
using synthetic::studyPart;
using synthetic::studyRow;

const StudyChart& only(const std::vector<StudyChart>& charts) {
    if (charts.size() != 1) throw std::runtime_error(std::to_string(charts.size()) + " charts");
    return charts.front();
}

/// Sixteen sweeps more, or a step half as long: what takes the most numbers is the axis, the rest makes
/// lines.
TEST(StudyCharts, TheLongestRefinementIsTheAxis) {
    Json rows = Json::array();
    for (const char* variant : {"cold", "warm"})
        for (const int sweeps : {16, 1, 4})
            for (const double dt : {1.0 / 60, 1.0 / 240})
                rows.push_back(studyRow("stack", variant, dt,
                                        {{"velocity_iterations", std::to_string(sweeps)}},
                                        {{"rest_sink", 1.0 / sweeps * dt}}));
    const auto charts = studyCharts({{"parts", {studyPart("sweeps", rows)}}});
    const StudyChart& chart = only(charts);
    EXPECT_EQ(chart.axis, "velocity_iterations");
    EXPECT_TRUE(chart.logarithmicX);
    EXPECT_FALSE(chart.logarithmic) << "1 : 64";
    ASSERT_EQ(chart.points.size(), 12u);
    EXPECT_EQ(chart.points[0].label, "cold, 1/60 s");
    EXPECT_EQ(chart.points[3].label, "cold, 1/240 s");
    for (std::size_t line = 0; line < 12; line += 3) {
        EXPECT_EQ(chart.points[line].x, 1.0);
        EXPECT_EQ(chart.points[line + 2].x, 16.0);
        EXPECT_EQ(chart.points[line].label, chart.points[line + 2].label);
    }
    EXPECT_DOUBLE_EQ(chart.points[5].value.value(), 1.0 / 16 / 240);
}

TEST(StudyCharts, NamesAreBarsAndScenariosHaveTheirOwn) {
    Json rows = Json::array();
    for (const char* scenario : {"arch", "stack"})
        for (const char* solver : {"pgs", "nsgs", "block"})
            rows.push_back(studyRow(scenario, "rigor", 0.01, {{"solver", solver}},
                                    {{"rest_sink", solver[0] == 'p' ? 0.5 : 1e-9}, {"energy_gain", 0.0}}));
    const auto charts = studyCharts({{"parts", {studyPart("solvers", rows)}}});
    ASSERT_EQ(charts.size(), 4u) << "two columns of two scenarios";
    EXPECT_EQ(charts[0].scenario, "arch");
    EXPECT_EQ(charts[2].scenario, "stack");
    EXPECT_EQ(charts[0].axis, "");
    EXPECT_TRUE(charts[1].logarithmic);
    EXPECT_FALSE(charts[0].logarithmic) << "energy_gain: nothing but zeros";
    EXPECT_EQ(charts[0].points[1].label, "nsgs");
}

/// Error against cost: a point per run, at its time.
TEST(StudyCharts, ColumnsOfARefinementAreShownOverTheirCost) {
    Json rows = Json::array();
    for (const double sweeps : {1.0, 2.0, 4.0})
        rows.push_back(studyRow("stack", "pgs", 0.01, {{"iterations", std::to_string(int(sweeps))}},
                                {{"rest_sink", 1.0 / sweeps}, {"time.step", 1e-6 * sweeps}}));
    rows[1]["metrics"]["time.step"]["value"] = nullptr;
    const auto charts = studyCharts({{"parts", {studyPart("sweeps", rows)}}});
    ASSERT_EQ(charts.size(), 3u);
    EXPECT_EQ(charts[2].metric, "rest_sink against time.step");
    EXPECT_EQ(charts[2].axis, "time.step [s]");
    EXPECT_EQ(charts[2].points[2].x, 4e-6);
    EXPECT_EQ(charts[2].points[2].value, 0.25);
    EXPECT_FALSE(charts[2].points[1].value.has_value()) << "a run without a time";
}

TEST(StudyCharts, ARunThatBrokeIsNoPointButIsReported) {
    Json rows = Json::array();
    for (const char* variant : {"good", "bad", "none"})
        rows.push_back(studyRow("stack", variant, 0.01, {}, {{"rest_sink", 0.5}}));
    rows[1]["outcome"] = "non_finite";
    rows[1]["metrics"]["rest_sink"]["value"] = nullptr;
    rows[2]["ran"] = false;
    rows[2]["metrics"]["rest_sink"]["value"] = nullptr;
    const Json study{{"parts", {studyPart("broken", rows)}}};
    const auto charts = studyCharts(study);
    EXPECT_FALSE(only(charts).points[1].value.has_value());
    const auto plots = studyPlots(study);
    ASSERT_EQ(plots.size(), 1u);
    EXPECT_EQ(plots[0].name, "study-broken-rest_sink");
    EXPECT_NE(svgOf(plots[0].drawing).find(">non_finite</text>"), std::string::npos);
    EXPECT_NE(svgOf(plots[0].drawing).find(">not run</text>"), std::string::npos);

    for (auto& row : rows) row["metrics"]["rest_sink"]["value"] = nullptr;
    EXPECT_TRUE(studyCharts({{"parts", {studyPart("empty", rows)}}}).empty());
}

/// A bar of a logarithmic chart is as long as its decades above the same floor.
TEST(StudyCharts, BarsByLogarithms) {
    Json rows = Json::array();
    for (const double value : {1e-6, 1e-4, 1e-2})
        rows.push_back(
            studyRow("stack", "v" + std::to_string(rows.size()), 0.01, {}, {{"rest_sink", value}}));
    const auto svg = svgOf(studyPlots({{"parts", {studyPart("bars", rows)}}}).at(0).drawing);
    std::vector<double> widths;
    for (auto at = svg.find("\" y=\""); at != std::string::npos; at = svg.find("\" y=\"", at + 1)) {
        const auto rect = svg.rfind('<', at);
        if (svg.compare(rect, 5, "<rect") == 0)
            widths.push_back(std::stod(svg.substr(svg.find("width=\"", at) + 7)));
    }
    ASSERT_EQ(widths.size(), 3u);
    EXPECT_GT(widths[0], 1.0);
    EXPECT_NEAR(widths[1] - widths[0], widths[2] - widths[1], 0.02);
}

/// Endless intervals leave their fields empty, and the row says so.
TEST(StudyCharts, ATableHasNoTextInAColumnOfNumbers) {
    Json rows = Json::array();
    for (const char* variant : {"good", "bad"})
        rows.push_back(studyRow("stack", variant, 0.01, {}, {{"rest_sink", 0.5}}));
    rows[1]["metrics"]["rest_sink"]["low"] = 0.25;
    rows[1]["metrics"]["rest_sink"]["high"] = "inf";
    const auto plots = studyPlots({{"parts", {studyPart("wide", rows)}}});
    ASSERT_EQ(plots.size(), 1u);
    const auto lines = parseCsv(plots[0].csv);
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0].back(), "non_finite");
    EXPECT_EQ(lines[1].back(), "");
    EXPECT_EQ(lines[2][2], "0.25");
    EXPECT_EQ(lines[2][3], "") << plots[0].csv;
    EXPECT_EQ(lines[2].back(), "high is infinite");
}

TEST(StudyCharts, ThePageHasEveryDigit) {
    const double value = 0.1 + 0.2;
    Json rows = Json::array({studyRow("stack", "a", 0.01, {}, {{"rest_sink", value}})});
    rows[0]["metrics"]["rest_sink"]["low"] = 0.25;
    rows[0]["metrics"]["rest_sink"]["high"] = 0.75;
    const Json page = Json::parse(studyPageJson({{"name", "s"}, {"parts", {studyPart("p", rows)}}}));
    const Json& point = page.at("charts").at(0).at("points").at(0);
    EXPECT_EQ(point.at("value").get<double>(), value);
    EXPECT_EQ(point.at("low"), 0.25);
    EXPECT_EQ(point.at("high"), 0.75);
    EXPECT_EQ(page.at("parts").at(0).at("name"), "p");
}

}  // namespace
}  // namespace rigor::report
