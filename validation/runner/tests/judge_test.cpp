// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/judge.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "validation/runner/runner.hpp"

namespace rigor::validation {
namespace {

using results::Outcome;
using results::Verdict;
using scenario::Scenario;

Scenario judged() {
    Scenario s;
    s.timeSteps = {0.1, 0.01};
    s.accept = {{"*", "", "drift", 1.0, 0.0},
                {"ode", "", "drift", 2.0, 0.0},
                {"ode", "matched", "drift", 0.5, 0.0},
                {"*", "", "scaled", 1.0, 2.0},
                {"*", "", "between", 2.0, 0.0, 1.0}};
    s.knownDeviations = {{"ode", "", "drift", 5.0, "a skin"},
                         {"ode", "", "between", 5.0, "a skin"},
                         {"bullet", "", "crashed", 0.0, "an assertion"}};
    return s;
}

struct Row {
    const char *engine, *preset, *metric;
    double dt, value;
    Verdict verdict;
};

class MetricVerdicts : public testing::TestWithParam<Row> {};

TEST_P(MetricVerdicts, FollowTheTable) {
    const Row& c = GetParam();
    results::MetricRow row;
    row.name = c.metric;
    row.value = c.value;
    results::CaseRow judgedCase;
    judgedCase.engine = c.engine;
    judgedCase.preset = c.preset;
    judgedCase.dt = c.dt;
    judgeMetric(row, judged(), judgedCase);
    EXPECT_STREQ(results::verdictName(row.verdict), results::verdictName(c.verdict));
    const bool isBelow = std::string(c.metric) == "between" && c.value < 1.0;
    EXPECT_EQ(row.boundMin, std::string(c.metric) == "between" ? std::optional(1.0) : std::nullopt);
    EXPECT_EQ(row.note, isBelow                                ? "less than its lower bound 1"
                        : c.verdict == Verdict::KnownDeviation ? "a skin"
                                                               : "");
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
INSTANTIATE_TEST_SUITE_P(
    Table, MetricVerdicts,
    testing::Values(Row{"box2d", "default", "drift", 0.1, 1.0, Verdict::Pass},        // exactly at the bound
                    Row{"box2d", "default", "drift", 0.1, 1.0000001, Verdict::Fail},  // "*" binds the unnamed
                    Row{"ode", "default", "drift", 0.1, 1.9, Verdict::Pass},          // named beats "*"
                    // over the bound, but recorded
                    Row{"ode", "default", "drift", 0.1, 2.1, Verdict::KnownDeviation},
                    // over the recorded value
                    Row{"ode", "default", "drift", 0.1, 5.1, Verdict::Fail},
                    Row{"ode", "matched", "drift", 0.1, 0.6, Verdict::KnownDeviation},  // preset beats name
                    Row{"ode", "matched", "drift", 0.1, 0.4, Verdict::Pass},
                    Row{"ode", "default", "drift", 0.1, kNaN, Verdict::Fail},  // NaN is never within
                    Row{"box2d", "default", "drift", 0.1, kNaN, Verdict::Fail},
                    Row{"box2d", "default", "unbounded", 0.1, 1e9, Verdict::Pass},
                    Row{"box2d", "default", "scaled", 0.1, 0.99, Verdict::Pass},
                    Row{"box2d", "default", "scaled", 0.01, 0.011, Verdict::Fail},  // 1 * (0.01/0.1)^2
                    Row{"box2d", "default", "scaled", 0.01, 0.0099, Verdict::Pass},
                    Row{"box2d", "default", "scaled", 0.2, 3.9, Verdict::Pass},
                    // A lower bound: nothing at all is not within, and no known deviation either.
                    Row{"box2d", "default", "between", 0.1, 1.0, Verdict::Pass},
                    Row{"box2d", "default", "between", 0.1, 2.0, Verdict::Pass},
                    Row{"box2d", "default", "between", 0.1, 0.99, Verdict::Fail},
                    Row{"box2d", "default", "between", 0.1, 2.01, Verdict::Fail},
                    Row{"box2d", "default", "between", 0.1, kNaN, Verdict::Fail},
                    Row{"ode", "default", "between", 0.1, 0.0, Verdict::Fail},
                    Row{"ode", "default", "between", 0.1, 3.0, Verdict::KnownDeviation},
                    // Bounds are for the presets that every engine has; those that hold everywhere hold.
                    Row{"ode", "rough", "drift", 0.1, 5.1, Verdict::Pass},
                    Row{"ode", "rough", "contact_inconsistency", 0.1, 0.6, Verdict::Fail}));

TEST(MetricVerdict, SinglePrecisionIsHeldToEveryonesBound) {
    results::CaseRow c;
    c.engine = "ode";
    c.preset = "matched";
    c.dt = 0.1;
    results::MetricRow row;
    row.name = "drift";
    row.value = 0.9;
    c.settings["precision"] = "f64";
    judgeMetric(row, judged(), c);
    EXPECT_EQ(row.bound, 0.5);
    c.settings["precision"] = "f32";
    judgeMetric(row, judged(), c);
    EXPECT_EQ(row.bound, 1.0);
    EXPECT_EQ(row.verdict, Verdict::Pass);
}

constexpr double kInf = std::numeric_limits<double>::infinity();

/// A deviation without a bound is one of wrong physics: its grade decides, not an amount.
TEST(MetricVerdict, ADeviationWithoutABoundIsOneOfGradeE) {
    Scenario s;
    s.timeSteps = {0.1};
    s.knownDeviations = {{"ode", "", "way", kInf, "another law of friction"},
                         {"ode", "", "turn", 3.0, "another law of friction"}};
    results::CaseRow c;
    c.engine = "ode";
    c.preset = "default";
    c.dt = 0.1;
    const auto judged = [&](const std::string& metric, double value, std::optional<double> relative) {
        results::MetricRow row;
        row.name = metric;
        row.value = value;
        row.relative = relative;
        judgeMetric(row, s, c);
        return row;
    };
    EXPECT_EQ(judged("way", 1.0, 0.1).verdict, Verdict::Pass) << "grade D is accuracy, not another law";
    EXPECT_EQ(judged("way", 1.0, 0.11).verdict, Verdict::KnownDeviation);
    EXPECT_EQ(judged("way", 1.0, 0.11).note, "another law of friction");
    EXPECT_EQ(judged("way", 1e9, {}).verdict, Verdict::Pass) << "nothing to be wrong against";
    EXPECT_EQ(judged("turn", 2.9, 0.5).verdict, Verdict::KnownDeviation);
    EXPECT_EQ(judged("turn", 3.1, 0.5).verdict, Verdict::Fail) << "beyond the amount it was given";
    EXPECT_EQ(judged("other", 1e9, 9.0).verdict, Verdict::Pass) << "accuracy is graded, not judged";
}

results::CaseRow caseWith(const std::string& engine, Outcome outcome) {
    results::CaseRow row;
    row.engine = engine;
    row.preset = "default";
    row.outcome = outcome;
    judgeCase(row, judged());
    return row;
}

TEST(CaseVerdict, FollowsTheOutcome) {
    EXPECT_EQ(caseWith("ode", Outcome::Completed).verdict, Verdict::Pass);
    EXPECT_EQ(caseWith("ode", Outcome::Unsupported).verdict, Verdict::Unsupported);
    EXPECT_EQ(caseWith("ode", Outcome::Crashed).verdict, Verdict::Crashed);
    EXPECT_EQ(caseWith("ode", Outcome::OutOfMemory).verdict, Verdict::Crashed);
    EXPECT_EQ(caseWith("ode", Outcome::Timeout).verdict, Verdict::Timeout);
    EXPECT_EQ(caseWith("ode", Outcome::NonFinite).verdict, Verdict::NonFinite);
    EXPECT_EQ(caseWith("ode", Outcome::Error).verdict, Verdict::Fail);
    EXPECT_EQ(caseWith("bullet", Outcome::Crashed).verdict, Verdict::KnownDeviation) << "a recorded crash";
    EXPECT_EQ(caseWith("bullet", Outcome::Timeout).verdict, Verdict::Timeout)
        << "another ending is not recorded";
}

TEST(CaseVerdict, TheWorstMetricDecides) {
    results::CaseRow row;
    row.engine = "ode";
    row.metrics.resize(3);
    row.metrics[1].name = "depth";
    row.metrics[1].note = "a skin";
    row.metrics[1].verdict = Verdict::KnownDeviation;
    judgeCase(row, judged());
    EXPECT_EQ(row.verdict, Verdict::KnownDeviation);
    EXPECT_EQ(row.reason, "depth: a skin");
    row.metrics[2].name = "energy";
    row.metrics[2].verdict = Verdict::Fail;
    judgeCase(row, judged());
    EXPECT_EQ(row.verdict, Verdict::Fail);
    EXPECT_EQ(row.reason, "energy misses its bound");
}

TEST(CaseVerdict, TheBuiltWorldMustBeTheRequestedOne) {
    results::CaseRow row;
    row.engine = "ode";
    row.readBack = {{"mass", "block", 2.0, 2.0, 0.0, true}, {"inertia", "block", 1.0, 3.0, 2.0, false}};
    judgeCase(row, judged());
    EXPECT_EQ(row.verdict, Verdict::Fail);
    EXPECT_EQ(row.reason, "read-back, inertia of block: found 3, expected 1");
    row.reason.clear();
    row.ledger = {{"inertia", "exact", "box", "approximate", "the library has no other"}};
    judgeCase(row, judged());
    EXPECT_EQ(row.verdict, Verdict::Pass);
    row.ledger[0].realisation = "exact";
    judgeCase(row, judged());
    EXPECT_EQ(row.verdict, Verdict::Fail) << "a ledger that claims exactness excuses nothing";
}

TEST(Green, IsWhatTheExitCodeSays) {
    const auto green = [](const std::string& engine, Verdict verdict) {
        results::Run run;
        run.cases.resize(2);
        run.cases[1].engine = engine;
        run.cases[1].verdict = verdict;
        return runIsGreen(run);
    };
    for (const std::string engine : {"ode", kInHouseEngine}) {
        EXPECT_TRUE(green(engine, Verdict::Pass));
        EXPECT_TRUE(green(engine, Verdict::Unsupported));
        EXPECT_FALSE(green(engine, Verdict::Fail));
        EXPECT_FALSE(green(engine, Verdict::Crashed));
        EXPECT_FALSE(green(engine, Verdict::Timeout));
        EXPECT_FALSE(green(engine, Verdict::NonFinite));
    }
    EXPECT_TRUE(green("ode", Verdict::KnownDeviation));
    EXPECT_FALSE(green(kInHouseEngine, Verdict::KnownDeviation)) << "it may not excuse itself";
}

TEST(Green, ARunOfUnsupportedCasesAloneJudgesNothing) {
    results::Run run;
    EXPECT_FALSE(judgesNothing(run));
    run.cases.resize(2);
    for (auto& c : run.cases) c.verdict = Verdict::Unsupported;
    EXPECT_TRUE(judgesNothing(run));
    for (const auto verdict : {Verdict::Pass, Verdict::Fail, Verdict::Crashed, Verdict::NoReference}) {
        run.cases[1].verdict = verdict;
        EXPECT_FALSE(judgesNothing(run));
    }
}

TEST(Green, TheInHouseEngineMayNotBecomeWorseAndOthersMayNotLoseAGrade) {
    const auto green = [](const std::string& engine, results::Regression regression, double value) {
        results::Run run;
        results::CaseRow& c = run.cases.emplace_back();
        c.engine = engine;
        c.regression = regression;
        results::MetricRow& m = c.metrics.emplace_back();
        m.name = "way";
        m.scale = 2.0;
        m.value = value;
        m.recorded = 0.018;
        m.relative = value / 2.0;
        c.accuracy.grade = results::gradeOf(value / 2.0);
        return runIsGreen(run);
    };
    using results::Regression;
    EXPECT_FALSE(green(kInHouseEngine, Regression::Worse, 0.019));
    EXPECT_TRUE(green("ode", Regression::Worse, 0.019)) << "reported, and still of grade C";
    EXPECT_FALSE(green("ode", Regression::Worse, 0.021)) << "of grade D now";
    for (const auto r : {Regression::NoRecord, Regression::Unchanged, Regression::Better})
        EXPECT_TRUE(green(kInHouseEngine, r, 0.9));
}

}  // namespace
}  // namespace rigor::validation
