// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Findings: judged as they are stated, and those of the library hold.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "validation/studies/study.hpp"
#include "validation/studies/tests/run_study.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;
using results::CaseRow;
using results::Outcome;

/// Variant "a" at two time steps with errors 0.4 and 0.1, variant "b" at one with 3.
struct Example {
    StudyPlan plan;
    results::Run run;

    Example() {
        scenario::StudyPart part;
        part.name = "p";
        part.metrics = {"position_max", "order.position_max", "quantity.height"};
        plan.study.parts = {part};
        add("a", 0.2, 0.4);
        add("a", 0.1, 0.1);
        add("b", 0.2, 3.0);
    }
    void add(const std::string& variant, double dt, double error) {
        StudyRow row;
        row.scenario = row.base = "swing";
        row.variant = variant;
        row.dt = dt;
        row.parameters = {{"substeps", dt > 0.15 ? "1" : "2"}};
        row.caseId = variant + std::to_string(dt);
        CaseRow c;
        c.id = row.caseId;
        c.dt = dt;
        c.metrics = {{"position_max", "", "m", "exact", error, -1.0, {}, {}, {}, ""}};
        if (variant == "a") c.quantities = {{"height", "m", 1.0, {}, 2.0 * dt}};
        plan.rows.push_back(row);
        run.cases.push_back(c);
    }
    FindingVerdict judge(const scenario::StudyFinding& finding) {
        plan.study.parts[0].findings = {finding};
        return evaluateStudy(plan, run).findings.at(0);
    }
};

scenario::StudyFinding about(const std::string& variant, const std::string& metric) {
    scenario::StudyFinding finding;
    finding.statement = "s";
    finding.variant = variant;
    finding.metric = metric;
    return finding;
}

TEST(Findings, HoldWhereEveryRowIsWithin) {
    Example example;
    auto finding = about("a", "position_max");
    finding.atLeast = 0.1;
    finding.atMost = 0.4;
    const auto verdict = example.judge(finding);
    EXPECT_TRUE(verdict.holds);
    EXPECT_EQ(verdict.least, 0.1);
    EXPECT_EQ(verdict.greatest, 0.4);
    finding.atMost = 0.39;
    EXPECT_FALSE(example.judge(finding).holds);
    finding.atMost = 0.4;
    finding.atLeast = 0.11;
    EXPECT_FALSE(example.judge(finding).holds);
}

TEST(Findings, SpeakOfTheRowsTheyName) {
    Example example;
    auto finding = about("a", "position_max");
    finding.atMost = 0.2;
    EXPECT_FALSE(example.judge(finding).holds);
    finding.where = {{"dt", "0.1"}};
    EXPECT_TRUE(example.judge(finding).holds);
    finding.where = {{"substeps", "2"}, {"scenario", "swing"}};
    EXPECT_TRUE(example.judge(finding).holds);
    finding.where = {{"scenario", "another"}};
    EXPECT_FALSE(example.judge(finding).holds) << "no row is no proof";
}

TEST(Findings, ARunThatBrokeIsInfinitelyWrongAndOneWithoutValueProvesNothing) {
    Example example;
    auto finding = about("b", "position_max");
    finding.atLeast = 1.0;
    EXPECT_TRUE(example.judge(finding).holds);
    example.run.cases[2].outcome = Outcome::NonFinite;
    EXPECT_TRUE(example.judge(finding).holds);
    EXPECT_EQ(example.judge(finding).greatest, std::numeric_limits<double>::infinity());
    EXPECT_TRUE(studyIsGreen(evaluateStudy(example.plan, example.run))) << "it was said to break";
    example.run.cases[2].outcome = Outcome::Completed;
    example.run.cases[2].metrics.clear();
    EXPECT_FALSE(example.judge(finding).holds);
    EXPECT_FALSE(studyIsGreen(evaluateStudy(example.plan, example.run)));
}

TEST(Columns, OrderAndMeasuredQuantity) {
    Example example;
    const auto result = evaluateStudy(example.plan, example.run);
    EXPECT_FALSE(result.rows[0].values[1].value) << "substeps differ: no refinement";
    for (auto& row : example.plan.rows) row.parameters.clear();
    const auto refinement = evaluateStudy(example.plan, example.run);
    EXPECT_NEAR(refinement.rows[0].values[1].value.value(), 2.0, 1e-12);
    EXPECT_NEAR(refinement.rows[1].values[1].value.value(), 2.0, 1e-12);
    EXPECT_FALSE(refinement.rows[2].values[1].value);
    EXPECT_EQ(refinement.rows[0].values[2].value, 0.4);
    EXPECT_FALSE(refinement.rows[2].values[2].value);
}

TEST(Findings, OfTheLibraryHold) {
    for (const char* study : {"published_findings", "integrators"}) {
        int code = -1;
        const json out = runStudy(study, code);
        ASSERT_FALSE(out.is_discarded()) << study;
        EXPECT_EQ(code, 0) << study;
        EXPECT_GE(out.at("findings").size(), 10u);
        for (const json& f : out.at("findings"))
            EXPECT_TRUE(f.at("holds"))
                << f.at("statement") << " (" << f.at("variant") << ", " << f.at("metric")
                << "): " << f.at("least") << " .. " << f.at("greatest");
    }
}

TEST(Findings, OneThatDoesNotHoldIsRed) {
    std::ifstream in(scenario::findStudy("published_findings"));
    json study = json::parse(in);
    study["parts"].erase(study["parts"].begin() + 1, study["parts"].end());
    study["name"] = "wrong";
    study["parts"][0]["findings"][0]["at_least"] = 0.16345;
    const auto file = std::filesystem::path(testing::TempDir()) / "wrong_finding.json";
    std::ofstream(file) << study.dump();
    int code = -1;
    const json out = runStudy(file.string(), code);
    EXPECT_EQ(code, 1);
    EXPECT_FALSE(out.at("findings")[0].at("holds"));
    EXPECT_TRUE(out.at("findings")[1].at("holds"));
    EXPECT_FALSE(out.at("green"));
}

TEST(StudyValues, ShowTheRangeOverOrdersOfInsertion) {
    results::CaseRow row;
    results::MetricRow m;
    m.name = "rest_motion";
    m.value = 2.0;
    m.unit = "m";
    row.metrics = {m};
    EXPECT_EQ(studyValue(row, "rest_motion").note, "");
    row.metrics[0].orderMin = 2.0;
    row.metrics[0].orderMax = 2.0 + 1e-9;
    row.metrics[0].orderCount = 3;
    EXPECT_EQ(studyValue(row, "rest_motion").note, "") << "less than the digits shown";
    row.metrics[0].orderMin = 0.5;
    row.metrics[0].orderMax = 7.0;
    EXPECT_EQ(studyValue(row, "rest_motion").note, "0.5 .. 7 over 3 orders");
    EXPECT_EQ(studyValue(row, "rest_motion").value, 2.0) << "of the order as written";
}

}  // namespace
}  // namespace rigor::validation
