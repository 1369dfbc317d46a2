// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What the reports claim about a run, on small runs whose answer is known.
#include "reports/view_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "reports/writers.hpp"

namespace rigor::report {
namespace {

using namespace results;

CaseRow makeCase(const std::string& scenario, const std::string& engine, double dt, double error,
                 std::optional<double> bound = {}) {
    CaseRow c;
    c.id = scenario + engine + std::to_string(dt);
    c.scenario = scenario, c.engine = engine, c.preset = "matched", c.dt = dt;
    c.spec = engine + ":preset=matched";
    c.verdict = bound && error > *bound ? Verdict::Fail : Verdict::Pass;
    c.metrics = {{"error", "", "m", "exact", error, -1.0, bound, {}, c.verdict, ""}};
    return c;
}

Run twoScenarios() {
    Run run;
    for (const char* name : {"a", "b"}) {
        ScenarioRow s;
        s.name = name, s.isolates = {"friction"}, s.metrics = {"absent", "error"};
        s.reference = "sliding_stop";
        run.scenarios.push_back(s);
    }
    return run;
}

TEST(ViewModel, RatiosAreGeometricMeansOverTheBestOfEachScenario) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", "one", 0.01, 1.0), makeCase("a", "two", 0.01, 4.0),
                 makeCase("b", "one", 0.01, 9.0), makeCase("b", "two", 0.01, 1.0)};
    const auto mechanisms = ViewModel(run).mechanisms();
    ASSERT_EQ(mechanisms.size(), 1u);
    // one: sqrt(1 * 9) = 3, two: sqrt(4 * 1) = 2, up to the floor of a thousandth of the median.
    EXPECT_NEAR(mechanisms[0].standings[0].ratio, 3.0, 0.05);
    EXPECT_NEAR(mechanisms[0].standings[1].ratio, 2.0, 0.05);
    EXPECT_EQ(mechanisms[0].best, 1);
}

TEST(ViewModel, CompanionsHaveNumbersButNoPage) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", "one", 0.01, 1.0), makeCase("b", "one", 0.01, 9.0)};
    run.orders = {{"b", "one", "error", "m", 1.0, {}, {}, 3, 0.01, 0.1, ""}};
    run.plannedCases = 3;
    run.scenarios[1].tags = {"companion"};
    const results::Run shown = withoutCompanions(run);
    ASSERT_EQ(shown.scenarios.size(), 1u);
    EXPECT_EQ(shown.scenarios[0].name, "a");
    ASSERT_EQ(shown.cases.size(), 1u);
    EXPECT_EQ(shown.cases[0].scenario, "a");
    EXPECT_TRUE(shown.orders.empty());
    EXPECT_EQ(shown.plannedCases, 2) << "one of a is still to come";
    EXPECT_NE(csvReport(run).find("b,one"), std::string::npos);
}

TEST(ViewModel, AFailureAtAnyTimeStepWeighsMoreThanASmallError) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", "one", 0.01, 1e-9, 1.0), makeCase("a", "one", 0.1, 2.0, 1.0),
                 makeCase("a", "two", 0.01, 0.5, 1.0), makeCase("a", "two", 0.1, 0.6, 1.0)};
    const ViewModel view(run);
    EXPECT_EQ(view.cell(0, 0).worst, Shown::Fail);
    EXPECT_EQ(view.cell(0, 0).cases.front()->dt, 0.01) << "finest first";
    EXPECT_EQ(view.mechanisms()[0].best, 1);
    EXPECT_EQ(view.mechanisms()[0].standings[0].bad, 1);
}

TEST(ViewModel, ErrorsAreComparedAtTheSameTimeStepAlone) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", "one", 0.001, 1e-6), makeCase("a", "two", 0.1, 1e-9)};
    const auto mechanisms = ViewModel(run).mechanisms();
    EXPECT_TRUE(std::isnan(mechanisms[0].standings[1].ratio));
    EXPECT_EQ(mechanisms[0].best, 0);
}

TEST(ViewModel, WithoutAReferenceNobodyIsRanked) {
    results::Run run = twoScenarios();
    for (auto& s : run.scenarios) s.reference.clear();
    run.cases = {makeCase("a", "one", 0.01, 1.0), makeCase("a", "two", 0.01, 4.0)};
    EXPECT_EQ(ViewModel(run).mechanisms()[0].best, -1);
}

TEST(ViewModel, RoundingCountsAsEqual) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", "one", 0.01, 1e-16), makeCase("a", "two", 0.01, 1e-9)};
    EXPECT_NEAR(ViewModel(run).mechanisms()[0].standings[1].ratio, 1.0, 0.01);
}

TEST(ViewModel, WhoNeverFinishesIsNotRanked) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", "one", 0.01, 1.0), makeCase("b", "one", 0.01, 1.0)};
    for (const char* s : {"a", "b"}) {
        auto c = makeCase(s, "two", 0.01, 0.0);
        c.outcome = Outcome::Crashed, c.verdict = Verdict::Crashed, c.metrics.clear();
        run.cases.push_back(c);
    }
    EXPECT_EQ(ViewModel(run).mechanisms()[0].best, 0);
    EXPECT_EQ(ViewModel(run).mechanisms()[0].standings[1].bad, 2);
}

TEST(ViewModel, NothingDemandedIsNotShownAsAPass) {
    EXPECT_EQ(shownOf(makeCase("a", "one", 0.01, 5.0)), Shown::NoBound);
    EXPECT_EQ(shownOf(makeCase("a", "one", 0.01, 5.0, 9.0)), Shown::Pass);
    EXPECT_EQ(shownOf(makeCase("a", "one", 0.01, 5.0, 1.0)), Shown::Fail);
}

TEST(ViewModel, MainMetricIsTheFirstThatMattersAndExists) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", "one", 0.01, 1.0)};
    const ViewModel view(run);
    EXPECT_EQ(view.mainMetric(0).name, "error");
    EXPECT_EQ(view.mainMetric(1).name, "") << "no case of it ran";
}

TEST(ViewModel, OffendersAreSortedByHowFarTheyMiss) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", "near", 0.01, 1.1, 1.0), makeCase("a", "far", 0.01, 90.0, 1.0),
                 makeCase("a", "good", 0.01, 0.1, 1.0)};
    const ViewModel view(run);
    const auto list = view.offenders();
    ASSERT_EQ(list.size(), 2u);
    EXPECT_EQ(list[0].row->engine, "far");
    EXPECT_DOUBLE_EQ(list[0].excess, 90.0);
}

TEST(ViewModel, LedgerGathersEqualLinesOverScenarios) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", "one", 0.01, 1.0), makeCase("a", "one", 0.1, 1.0),
                 makeCase("b", "one", 0.01, 1.0)};
    for (auto& c : run.cases) c.ledger = {{"friction", "cone", "pyramid", "approximate", "why"}};
    run.cases.back().ledger.push_back({"friction", "cone", "cone", "exact", ""});
    const auto ledger = ViewModel(run).ledger();
    ASSERT_EQ(ledger.size(), 2u);
    EXPECT_EQ(ledger[0].scenarios, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(ledger[1].scenarios, (std::vector<std::string>{"b"}));
}

}  // namespace
}  // namespace rigor::report
