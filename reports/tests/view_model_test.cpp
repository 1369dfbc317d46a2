// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tests of the reports' statements about a run, on small runs whose results are known.
#include "reports/model/view_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "reports/model/derived_runs.hpp"
#include "reports/summaries/summary.hpp"
#include "reports/summaries/terminal.hpp"
#include "reports/tables/csv.hpp"
#include "validation/results/judgement.hpp"

namespace rigor::report {
namespace {

using namespace results;

CaseRow makeCase(const std::string& scenario, const std::string& engine, double dt, double error,
                 std::optional<double> bound = {}) {
    CaseRow c;
    c.id = scenario + engine + std::to_string(dt);
    c.scenario = scenario;
    c.engine = engine;
    c.preset = "matched";
    c.dt = dt;
    c.spec = engine + ":preset=matched";
    c.verdict = bound && error > *bound ? Verdict::Fail : Verdict::Pass;
    c.metrics = {{"error", "", "m", "exact", error, -1.0, bound, {}, c.verdict, "", 10.0, error / 10.0}};
    c.accuracy = {results::gradeOf(error / 10.0), "error", error / 10.0, {}, ""};
    return c;
}

Run twoScenarios() {
    Run run;
    for (const char* name : {"a", "b"}) {
        ScenarioRow s;
        s.name = name;
        s.isolates = {"friction"};
        s.metrics = {"absent", "error"};
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
    EXPECT_NEAR(mechanisms[0].rankings[0].toBest, 3.0, 1e-12) << "sqrt(1 * 9)";
    EXPECT_NEAR(mechanisms[0].rankings[1].toBest, 2.0, 1e-12) << "sqrt(4 * 1)";
    EXPECT_TRUE(std::isnan(mechanisms[0].rankings[1].toOurs)) << "the in-house engine is not here";
}

TEST(ViewModel, StandsBesideTheInHouseEngineInTheSamePresetElseItsDefault) {
    results::Run run = twoScenarios();
    const auto ours = [](const std::string& preset, double error) {
        CaseRow c = makeCase("a", results::kInHouseEngine, 0.01, error);
        c.preset = preset;
        c.spec = c.engine + ":preset=" + preset;
        c.id += preset;
        return c;
    };
    run.cases = {ours("default", 2.0), ours("matched", 4.0), ours("fast", 8.0),
                 makeCase("a", "one", 0.01, 1.0)};
    const ViewModel view(run);
    EXPECT_DOUBLE_EQ(view.ratios(run.cases[3]).toOurs, 0.25) << "matched beside matched";
    EXPECT_DOUBLE_EQ(view.ratios(run.cases[2]).toOurs, 1.0) << "fast is a preset of its own";
    EXPECT_DOUBLE_EQ(view.ratios(run.cases[2]).toBest, 8.0);
    run.cases[3].preset = "other";
    EXPECT_DOUBLE_EQ(ViewModel(run).ratios(run.cases[3]).toOurs, 0.5) << "else the default";
}

/// Grades do not depend on what is negligible between engines.
TEST(ViewModel, ErrorsThatTheScenarioCallsNegligibleCountAsEqual) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", "one", 0.01, 1e-4), makeCase("a", "two", 0.01, 9e-4),
                 makeCase("a", "three", 0.01, 2e-3)};
    EXPECT_DOUBLE_EQ(ViewModel(run).ratios(run.cases[1]).toBest, 9.0);
    run.scenarios[0].text = R"({"negligible_error": {"value": 1e-4, "reason": "an overlap at the start"}})";
    const ViewModel view(run);
    EXPECT_DOUBLE_EQ(view.ratios(run.cases[0]).toBest, 1.0);
    EXPECT_DOUBLE_EQ(view.ratios(run.cases[1]).toBest, 1.0) << "1e-4 of its scale of ten metres is 1 mm";
    EXPECT_DOUBLE_EQ(view.ratios(run.cases[2]).toBest, 2.0);
    for (const char* text :
         {"{", "[]", R"({"negligible_error": 3})", R"({"negligible_error": {"value": "x"}})"}) {
        run.scenarios[0].text = text;
        EXPECT_DOUBLE_EQ(ViewModel(run).ratios(run.cases[1]).toBest, 9.0) << text;
    }
}

/// Lines of one engine have one colour: dashes alone distinguish its columns.
TEST(ViewModel, NoTwoColumnsOfAnEngineHaveTheSameDashes) {
    results::Run run = twoScenarios();
    for (const char* spec : {"one:preset=default", "one:preset=matched", "one:preset=fast",
                             "one:preset=matched,x=1", "one:preset=default,x=1", "two:preset=default"}) {
        CaseRow c = makeCase("a", std::string(spec).substr(0, 3), 0.01, 1.0);
        c.spec = spec;
        c.preset = std::string(spec).substr(11, std::string(spec).find(',') - 11);
        run.cases.push_back(c);
    }
    const ViewModel view(run);
    std::set<std::vector<double>> seen;
    for (std::size_t i = 0; i < 5; ++i)
        EXPECT_TRUE(seen.insert(view.columns()[i].dash).second) << view.columns()[i].spec;
    EXPECT_EQ(view.columns()[1].dash, std::vector<double>{}) << "what is compared like for like is solid";
    EXPECT_EQ(view.columns()[5].dash, view.columns()[0].dash) << "as shipped looks the same for all";
    run.cases.erase(run.cases.begin() + 1, run.cases.begin() + 5);
    EXPECT_TRUE(ViewModel(run).columns()[0].dash.empty()) << "nothing to be distinguished from";
}

TEST(ViewModel, FewestWrongOutcomesThenMostWithinAHundredthThenTheSmallestErrorComeFirst) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", "wrong", 0.01, 1e-9), makeCase("b", "wrong", 0.01, 5.0),
                 makeCase("a", "rough", 0.01, 0.01), makeCase("b", "rough", 0.01, 0.5),
                 makeCase("a", "near", 0.01, 0.09),  makeCase("b", "near", 0.01, 0.09)};
    const auto m = ViewModel(run).mechanisms().at(0);
    EXPECT_EQ(m.order, (std::vector<std::size_t>{2, 1, 0}));
    EXPECT_EQ(m.rankings[0].grades, (std::array<int, 5>{1, 0, 0, 0, 1}));
    EXPECT_EQ(m.rankings[1].within(), 1);
    EXPECT_EQ(m.rankings[2].within(), 2);
    EXPECT_EQ(m.best, 2);
}

/// The letter, the number beside it and the ratios are of one quantity, whichever metric decides it.
TEST(ViewModel, LetterNumberAndRatiosSpeakOfTheSameError) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", "one", 0.01, 1e-12), makeCase("a", "two", 0.01, 1.0)};
    run.cases[0].accuracy = {results::Grade::D, "another", 0.05, {}, ""};
    const ViewModel view(run);
    EXPECT_EQ(cellText(view, 0, 0, true), "D 0.05");
    EXPECT_EQ(cellText(view, 0, 1, true), "D 0.1");
    EXPECT_DOUBLE_EQ(view.ratios(run.cases[1]).toBest, 2.0);
    run.cases[0].accuracy = run.cases[1].accuracy = {results::Grade::None, "", {}, {}, "no exact solution"};
    const ViewModel ungraded(run);
    EXPECT_EQ(cellText(ungraded, 0, 1, true), "○ 1") << "how it ended, and the main metric";
}

TEST(ViewModel, ARunOfManyScenariosHasAShortTitle) {
    results::Run run;
    run.suite = "standard";
    EXPECT_EQ(runTitle(run), "standard");
    run.suite = "a b c d e";
    EXPECT_EQ(runTitle(run), "a b c and 2 more");
    EXPECT_EQ(verdictSentence(ViewModel(run)), "a b c and 2 more: no case is red");
}

TEST(ViewModel, ARunOfUnsupportedCasesAloneIsNotCalledGreen) {
    results::Run run = twoScenarios();
    run.suite = "mine";
    run.cases = {makeCase("a", "one", 0.01, 1.0), makeCase("a", "two", 0.01, 1.0)};
    run.cases[0].verdict = Verdict::Unsupported;
    EXPECT_EQ(verdictSentence(ViewModel(run)), "mine: no case is red");
    run.cases[1].verdict = Verdict::Unsupported;
    EXPECT_EQ(verdictSentence(ViewModel(run)), "mine: nothing was judged, every case is unsupported");
}

TEST(ViewModel, SentencesSayWhatWasComparedWithWhat) {
    CaseRow c = makeCase("a", "one", 1.0 / 60.0, 0.2);
    EXPECT_EQ(accuracySentence(c),
              "Grade D at 1/60 s, by its worst error: error 0.2 m, which is 0.02 of its scale 10 m. What its "
              "scheme "
              "allows here is not known.");
    c.accuracy.ideal = 0.005;
    EXPECT_EQ(accuracySentence(c),
              "Grade D at 1/60 s, by its worst error: error 0.2 m, which is 0.02 of its scale 10 m. An ideal "
              "run of "
              "its scheme has 0.005 (C): this is farther off than its scheme.");
    c.accuracy.ideal = 0.02;
    EXPECT_NE(accuracySentence(c).find("as good as its scheme allows"), std::string::npos);
    c.accuracy = {results::Grade::None, "", {}, {}, "no exact solution"};
    EXPECT_EQ(accuracySentence(c), "Not graded: no exact solution.");
    c.outcome = Outcome::Timeout;
    EXPECT_EQ(accuracySentence(c), "Not graded: timeout.");
    c.regression = Regression::Worse;
    c.regressionReason = "error 0.1 -> 0.2 m";
    EXPECT_EQ(regressionSentence(c), "Worse than on record: error 0.1 -> 0.2 m.");
}

TEST(ViewModel, AChangeAgainstTheRecordIsNoMatterOfAccuracy) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", results::kInHouseEngine, 0.01, 1e-9),
                 makeCase("b", results::kInHouseEngine, 0.01, 9.0)};
    run.cases[0].regression = Regression::Worse;
    run.cases[0].regressionReason = "error 1e-10 -> 1e-09 m";
    run.cases[1].regression = Regression::Unchanged;
    const ViewModel view(run);
    ASSERT_EQ(view.offenders().size(), 1u);
    EXPECT_EQ(view.offenders()[0].row, &run.cases[0]) << "grade A, and worse";
    EXPECT_EQ(view.offenders()[0].text, "worse than on record: error 1e-10 -> 1e-09 m");
    EXPECT_EQ(view.totals().red, 1);
    EXPECT_EQ(view.totals().grades.at(results::Grade::A), 1);
    EXPECT_EQ(view.totals().grades.at(results::Grade::E), 1);
    EXPECT_EQ(view.totals().regressions.at(Regression::Unchanged), 1);
}

TEST(ViewModel, DerivedRunsHaveNumbersButNoPage) {
    for (const char* tag : {"derived", "companion"}) {
        results::Run run = twoScenarios();
        run.cases = {makeCase("a", "one", 0.01, 1.0), makeCase("b", "one", 0.01, 9.0)};
        run.orders = {{"b", "one", "error", "m", 1.0, {}, {}, 3, 0.01, 0.1, ""}};
        run.plannedCases = 3;
        run.scenarios[1].tags = {tag};
        const results::Run shown = withoutDerivedRuns(run);
        ASSERT_EQ(shown.scenarios.size(), 1u);
        EXPECT_EQ(shown.scenarios[0].name, "a");
        ASSERT_EQ(shown.cases.size(), 1u);
        EXPECT_EQ(shown.cases[0].scenario, "a");
        EXPECT_TRUE(shown.orders.empty());
        EXPECT_EQ(shown.plannedCases, 2) << "one of a is still to come";
        EXPECT_NE(csvReport(run).find("b,one"), std::string::npos);
    }
}

TEST(ViewModel, AFailureAtAnyTimeStepWeighsMoreThanASmallError) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", "one", 0.01, 1e-9, 1.0), makeCase("a", "one", 0.1, 2.0, 1.0),
                 makeCase("a", "two", 0.01, 0.5, 1.0), makeCase("a", "two", 0.1, 0.6, 1.0)};
    const ViewModel view(run);
    EXPECT_EQ(view.cell(0, 0).worst, Shown::Fail);
    EXPECT_EQ(view.cell(0, 0).cases.front()->dt, 0.01) << "finest first";
    EXPECT_EQ(view.mechanisms()[0].best, 1);
    EXPECT_EQ(view.mechanisms()[0].rankings[0].lost, 1);
}

TEST(ViewModel, CostsAreOfGradedScenariosAndTellEqualErrorsApart) {
    results::Run run = twoScenarios();
    const auto timed = [](CaseRow c, double median) {
        c.timings.push_back({.phase = "step", .median = median, .samples = 10});
        return c;
    };
    CaseRow heap = timed(makeCase("b", "one", 0.01, 1.0), 8.0);
    heap.accuracy = {};
    run.cases = {timed(makeCase("a", "one", 0.01, 1e-9), 4.0), heap,
                 timed(makeCase("a", "two", 0.01, 1e-9), 2.0)};
    const auto m = ViewModel(run).mechanisms().at(0);
    EXPECT_DOUBLE_EQ(m.rankings[0].cost, 4.0) << "the step of what has no exact solution is not the stack's";
    EXPECT_EQ(m.order, (std::vector<std::size_t>{1, 0})) << "equal errors, the cheaper first";
}

/// Steps of an ungraded scene do not stand beside those of graded ones; where no scene can be graded, all are timed.
TEST(ViewModel, CostsOfUngradedScenariosAreNotSetBesideOthers) {
    results::Run run = twoScenarios();
    const auto timed = [](CaseRow c, bool isGraded) {
        c.timings.push_back({.phase = "step", .median = 4.0, .samples = 10});
        if (!isGraded) c.accuracy = {};
        return c;
    };
    run.cases = {timed(makeCase("a", "one", 0.01, 1e-9), true), timed(makeCase("b", "one", 0.01, 1.0), false),
                 timed(makeCase("b", "two", 0.01, 1.0), false)};
    const auto m = ViewModel(run).mechanisms().at(0);
    EXPECT_EQ(m.rankings[0].timed, 1);
    EXPECT_EQ(m.rankings[1].timed, 0);
    EXPECT_TRUE(std::isnan(m.rankings[1].cost));
    run.cases[0] = timed(makeCase("a", "one", 0.01, 1e-9), false);
    const auto none = ViewModel(run).mechanisms().at(0);
    EXPECT_EQ(none.rankings[0].timed, 2);
    EXPECT_DOUBLE_EQ(none.rankings[1].cost, 4.0);
}

/// The third preset of one engine is no choice beside that engine: each engine is named once, by its best preset.
TEST(ViewModel, EachEngineIsRankedByItsBestPreset) {
    results::Run run = twoScenarios();
    const auto preset = [](const std::string& engine, const std::string& name, double error) {
        CaseRow c = makeCase("a", engine, 0.01, error);
        c.preset = name;
        c.spec = engine + ":preset=" + name;
        return c;
    };
    run.cases = {preset("many", "fast", 0.09), preset("many", "default", 0.01),
                 preset("many", "accurate", 0.001), preset("few", "default", 0.02),
                 preset("few", "matched", 0.05)};
    const auto m = ViewModel(run).mechanisms().at(0);
    EXPECT_EQ(m.order, (std::vector<std::size_t>{2, 1, 3, 4, 0}));
    EXPECT_EQ(m.engines, (std::vector<std::size_t>{2, 3}));
    EXPECT_EQ(static_cast<int>(m.engines.front()), m.best);
    const std::string summary = markdownSummary(ViewModel(run));
    EXPECT_NE(summary.find("### Who to trust for what, each engine by its best preset"), std::string::npos);
    EXPECT_NE(summary.find("| friction | 2 | **many accurate** 1/1, 1x | few default 1/1, 20x | |\n"),
              std::string::npos)
        << summary;
    const std::string terminal = terminalSummary(run, 40, 160, false);
    const auto at = terminal.find("  friction ");
    ASSERT_NE(at, std::string::npos) << terminal;
    EXPECT_EQ(terminal.substr(at, terminal.find('\n', at) - at),
              "  friction  many accurate 1/1 1.0x, few default 1/1 20x");
}

/// The share within a hundredth is that of the scenarios that can be graded: piles that an engine runs as well take nothing
/// from it.
TEST(ViewModel, UngradedScenariosDoNotLowerTheShareWithinAHundredth) {
    results::Run run = twoScenarios();
    CaseRow pile = makeCase("b", "both", 0.01, 1.0);
    pile.accuracy = {};
    run.cases = {makeCase("a", "both", 0.01, 1e-9), pile, makeCase("a", "one", 0.01, 0.01)};
    const auto m = ViewModel(run).mechanisms().at(0);
    EXPECT_EQ(m.rankings[0].gradable(), 1);
    EXPECT_EQ(m.order, (std::vector<std::size_t>{0, 1})) << "both within, the smaller error first";
}

TEST(ViewModel, ErrorsAreComparedAtTheSameTimeStepAlone) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", "one", 0.001, 1e-6), makeCase("a", "two", 0.1, 1e-9)};
    const auto mechanisms = ViewModel(run).mechanisms();
    EXPECT_TRUE(std::isnan(mechanisms[0].rankings[1].toBest));
    EXPECT_EQ(mechanisms[0].best, 0);
}

TEST(ViewModel, WithoutAReferenceNoEngineIsRanked) {
    results::Run run = twoScenarios();
    for (auto& s : run.scenarios) s.reference.clear();
    run.cases = {makeCase("a", "one", 0.01, 1.0), makeCase("a", "two", 0.01, 4.0)};
    EXPECT_EQ(ViewModel(run).mechanisms()[0].best, -1);
}

TEST(ViewModel, RoundingCountsAsEqual) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", "one", 0.01, 1e-16), makeCase("a", "two", 0.01, 9e-6),
                 makeCase("a", "three", 0.01, 2e-5)};
    const auto m = ViewModel(run).mechanisms()[0];
    EXPECT_DOUBLE_EQ(m.rankings[1].toBest, 1.0) << "within 1e-6 of ten metres";
    EXPECT_DOUBLE_EQ(m.rankings[2].toBest, 2.0);
}

TEST(ViewModel, WhoNeverFinishesIsNotRanked) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", "one", 0.01, 1.0), makeCase("b", "one", 0.01, 1.0)};
    for (const char* s : {"a", "b"}) {
        auto c = makeCase(s, "two", 0.01, 0.0);
        c.outcome = Outcome::Crashed;
        c.verdict = Verdict::Crashed;
        c.metrics.clear();
        run.cases.push_back(c);
    }
    EXPECT_EQ(ViewModel(run).mechanisms()[0].best, 0);
    EXPECT_EQ(ViewModel(run).mechanisms()[0].rankings[1].lost, 2);
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

TEST(ViewModel, AnOffenderBelowItsLowerBoundSaysSo) {
    results::Run run = twoScenarios();
    run.cases = {makeCase("a", "still", 0.01, 0.5, 1.0)};
    run.cases[0].verdict = Verdict::Fail;
    run.cases[0].metrics[0].verdict = Verdict::Fail;
    run.cases[0].metrics[0].note = "less than its lower bound 0.9";
    run.cases[0].metrics[0].boundMin = 0.9;
    const ViewModel view(run);
    ASSERT_EQ(view.offenders().size(), 1u);
    EXPECT_EQ(view.offenders()[0].text, "error 0.5 m, less than its lower bound 0.9");
    EXPECT_DOUBLE_EQ(view.offenders()[0].excess, 0.9 / 0.5);
    EXPECT_EQ(excessOf(0.0, 1.0, 0.9), std::numeric_limits<double>::infinity());
    EXPECT_DOUBLE_EQ(excessOf(3.0, 2.0, 0.9), 1.5);
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
