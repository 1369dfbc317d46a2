// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/compare.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "validation/comparison/recorded.hpp"
#include "validation/comparison/tests/example_runs.hpp"

namespace rigor::validation {
namespace {

using Stored = results::Run;
using results::Verdict;

TEST(Compare, ARunIsEqualToItself) {
    const auto c = compareRuns({exampleRun()}, {exampleRun()});
    ASSERT_EQ(c.specs.size(), 1u);
    EXPECT_EQ(c.specs[0].cases, 8);
    EXPECT_EQ(c.specs[0].same, 8) << "whole scenes, and no counts of work";
    EXPECT_EQ(c.specs[0].better + c.specs[0].worse, 0);
    EXPECT_DOUBLE_EQ(c.specs[0].timeRatio.value(), 1.0);
    EXPECT_TRUE(c.metrics.empty() && c.verdicts.empty() && c.environment.empty());
    EXPECT_FALSE(becameWorse(c));
    EXPECT_NE(comparisonText(c, {}, 5).find("No verdict and no error changed"), std::string::npos);
}

TEST(Compare, ErrorsInBothDirections) {
    Stored after = exampleRun();
    after.cases[0].metrics[0].value = 0.2;
    after.cases[1].metrics[0].value = 0.01;
    after.cases[2].metrics[0].value = 0.1005;  // a change within 1 %
    const auto c = compareRuns({exampleRun()}, {after});
    EXPECT_EQ(c.specs[0].worse, 1);
    EXPECT_EQ(c.specs[0].better, 1);
    EXPECT_EQ(c.specs[0].same, 6);
    ASSERT_EQ(c.metrics.size(), 2u);
    EXPECT_EQ(c.metrics[0].place.scenario, "s1") << "the larger change first";
    EXPECT_FALSE(c.metrics[0].worse);
    EXPECT_TRUE(c.metrics[1].worse);
    EXPECT_TRUE(becameWorse(c));
    EXPECT_EQ(compareRuns({exampleRun()}, {after}, {0.001, 1e-9}).specs[0].worse, 2);
}

TEST(Compare, RoundOffIsNoChangeAndLostNumbersAre) {
    Stored before = exampleRun(), after = exampleRun();
    before.cases[0].metrics[0].value = 1e-15;
    after.cases[0].metrics[0].value = 5e-12;
    after.cases[1].metrics[0].value = std::numeric_limits<double>::quiet_NaN();
    const auto c = compareRuns({before}, {after});
    ASSERT_EQ(c.metrics.size(), 1u);
    EXPECT_EQ(c.metrics[0].place.scenario, "s1");
    EXPECT_TRUE(c.metrics[0].worse);
    EXPECT_FALSE(becameWorse(compareRuns({after}, {before})));
}

TEST(Compare, Verdicts) {
    Stored after = exampleRun();
    after.cases[3].verdict = Verdict::Fail;
    after.cases[3].reason = "why";
    const auto c = compareRuns({exampleRun()}, {after});
    ASSERT_EQ(c.verdicts.size(), 1u);
    EXPECT_TRUE(c.verdicts[0].worse);
    EXPECT_TRUE(becameWorse(c));
    EXPECT_FALSE(becameWorse(compareRuns({after}, {exampleRun()})));
    EXPECT_NE(comparisonText(c, {}, 5).find("pass -> fail (why)"), std::string::npos);
    after.cases[3].verdict = Verdict::Unsupported;
    const auto refused = compareRuns({exampleRun()}, {after});
    ASSERT_EQ(refused.verdicts.size(), 1u);
    EXPECT_FALSE(refused.verdicts[0].worse || refused.verdicts[0].better)
        << "what can not be run is no success";
    EXPECT_NE(comparisonText(refused, {}, 5).find("other   "), std::string::npos);
    const auto listed = nlohmann::json::parse(comparisonJson(refused)).at("verdicts").at(0);
    EXPECT_FALSE(listed.at("worse"));
    EXPECT_FALSE(listed.at("better"));
    Stored failed = exampleRun();
    failed.cases[3].verdict = Verdict::Fail;
    EXPECT_FALSE(compareRuns({failed}, {after}).verdicts.at(0).better);
    EXPECT_FALSE(compareRuns({after}, {failed}).verdicts.at(0).worse) << "nor is a first result a loss";
    EXPECT_TRUE(nlohmann::json::parse(comparisonJson(compareRuns({failed}, {exampleRun()})))
                    .at("verdicts")
                    .at(0)
                    .at("better"));
}

TEST(Compare, VerdictsAreListedByTheirWeight) {
    Stored before = exampleRun(), after = exampleRun();
    after.cases[0].verdict = Verdict::Unsupported;
    before.cases[1].verdict = Verdict::Fail;
    before.cases[2].verdict = Verdict::Crashed;
    after.cases[3].verdict = Verdict::Fail;
    after.cases[4].verdict = Verdict::Crashed;
    std::string order;
    for (const VerdictChange& v : compareRuns({before}, {after}).verdicts) order += v.place.scenario + " ";
    EXPECT_EQ(order, "s4 s3 s2 s1 s0 ");
}

/// A change from nothing to rounding has an infinite ratio and is not large; a lost number is.
TEST(Compare, ErrorsAreListedByTheirSize) {
    Stored before = exampleRun(), after = exampleRun();
    before.cases[0].metrics[0].value = 0.0;
    after.cases[0].metrics[0].value = 3e-9;
    after.cases[1].metrics[0].value = 1.0;
    before.cases[2].metrics[0].value = 0.0;
    after.cases[3].metrics[0].value = std::numeric_limits<double>::infinity();
    before.cases[4].metrics[0].value = 0.0;
    after.cases[4].metrics[0].value = 4e-7;
    before.cases[4].settings["precision"] = "f32";
    std::string order;
    const auto c = compareRuns({before}, {after});
    for (const MetricChange& m : c.metrics) order += m.place.scenario + " ";
    EXPECT_EQ(order, "s3 s2 s1 s0 s4 ") << "lost, from nothing, tenfold, rounding in double and in single";
    const auto listed = nlohmann::json::parse(comparisonJson(c)).at("metrics");
    EXPECT_TRUE(listed.at(0).at("size").is_null());
    EXPECT_NEAR(listed.at(2).at("size").get<double>(), std::log(10.0), 1e-12);
}

/// Motion that is left where nothing says that it ends is a number, and no error.
TEST(Compare, WhatIsNoErrorIsNeitherBetterNorWorse) {
    Stored before = exampleRun();
    for (auto& c : before.cases) c.metrics[0].name = "kinetic_energy_final";
    for (auto& c : before.cases) c.metrics[0].kind = "rest";
    for (auto& s : before.scenarios) s.metrics.clear();
    before.scenarios[1].metrics = {"kinetic_energy_final"};
    before.scenarios[2].reference = "static_equilibrium";
    before.cases[3].metrics[0].bound = 1.0;
    Stored after = before;
    for (std::size_t i = 0; i < 5; ++i) after.cases[i].metrics[0].value = i == 4 ? 1e6 : 0.2;
    const auto c = compareRuns({before}, {after});
    std::string worse, other;
    for (const MetricChange& m : c.metrics) (m.worse ? worse : other) += m.place.scenario + " ";
    EXPECT_EQ(worse, "s1 s2 s3 ") << "named, with an exact solution, with a bound";
    EXPECT_EQ(other, "s4 s0 ");
    EXPECT_TRUE(c.metrics[3].place.scenario == "s4" && !c.metrics[3].better)
        << "errors first, whatever the size";
    EXPECT_EQ(c.specs[0].worse, 3);
    EXPECT_EQ(c.specs[0].better, 0);
    const std::string text = comparisonText(c, {}, 5);
    EXPECT_NE(text.find("Errors that changed by more than 1 % (3)"), std::string::npos) << text;
    EXPECT_NE(
        text.find("Other numbers that changed by more than 1 %, neither better nor worse (2)\n  other   s4"),
        std::string::npos)
        << text;
    for (Stored* run : {&before, &after}) run->cases.erase(run->cases.begin() + 1, run->cases.begin() + 4);
    const auto neutral = compareRuns({before}, {after});
    EXPECT_FALSE(becameWorse(neutral));
    EXPECT_NE(comparisonText(neutral, {}, 5).find("No verdict and no error changed"), std::string::npos);
    after.cases[0].metrics[0].value = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(becameWorse(compareRuns({before}, {after})))
        << "a number that is lost is worse, whichever it is";
}

/// Six errors of one case that change together are one observation, not six.
TEST(Compare, TheSignTestCountsCases) {
    Stored before = exampleRun();
    for (auto& c : before.cases)
        for (int i = 0; i < 6; ++i) {
            c.metrics.push_back(c.metrics[0]);
            c.metrics.back().name = "error_" + std::to_string(i);
        }
    Stored after = before;
    const auto scale = [&](std::size_t index, int count, double factor) {
        auto& metrics = after.cases[index].metrics;
        for (auto m = metrics.end() - count; m != metrics.end(); ++m) m->value *= factor;
    };
    scale(0, 6, 0.5);
    scale(1, 6, 0.5);
    const SpecChange two = compareRuns({before}, {after}).specs[0];
    EXPECT_EQ(two.better, 12);
    EXPECT_EQ(two.casesBetter, 2);
    EXPECT_EQ(two.casesWorse, 0);
    EXPECT_DOUBLE_EQ(two.pCases, 0.5);
    scale(2, 2, 2.0);
    scale(3, 6, 2.0);
    scale(3, 3, 0.25);  // three worse and three better: neither
    const auto c = compareRuns({before}, {after});
    EXPECT_EQ(c.specs[0].better, 15);
    EXPECT_EQ(c.specs[0].worse, 5);
    EXPECT_EQ(c.specs[0].casesBetter, 2);
    EXPECT_EQ(c.specs[0].casesWorse, 1);
    EXPECT_DOUBLE_EQ(c.specs[0].pCases, 1.0);
    const auto listed = nlohmann::json::parse(comparisonJson(c)).at("specs").at(0);
    EXPECT_EQ(listed.at("cases_better"), 2);
    EXPECT_EQ(listed.at("cases_worse"), 1);
    EXPECT_EQ(listed.at("p_cases"), 1.0);
    const std::string text = comparisonText(c, {}, 5);
    EXPECT_NE(text.find("cases better/worse  sign test of cases"), std::string::npos) << text;
    EXPECT_NE(text.find("  2/1 "), std::string::npos) << text;
}

/// 20 % slower in every case: shown. A time that is slower in half the cases and faster in half is not
///    evidence.
TEST(Compare, TimesNeedEvidence) {
    Stored slower = exampleRun(), mixed = exampleRun();
    for (std::size_t i = 0; i < 8; ++i) {
        slower.cases[i].timings[0].median = 1.2e-6;
        mixed.cases[i].timings[0].median = i % 2 ? 1.2e-6 : 0.8e-6;
    }
    const auto shown = compareRuns({exampleRun()}, {slower}).specs[0];
    EXPECT_NEAR(shown.timeRatio.value(), 1.2, 1e-12);
    EXPECT_GT(shown.timeInterval->low, 1.0);
    EXPECT_NEAR(shown.pTime, 2.0 / 256.0, 1e-15);
    const auto unclear = compareRuns({exampleRun()}, {mixed}).specs[0];
    EXPECT_LT(unclear.timeInterval->low, 1.0);
    EXPECT_GT(unclear.timeInterval->high, 1.0);
    EXPECT_EQ(unclear.pTime, 1.0);
    EXPECT_FALSE(becameWorse(compareRuns({exampleRun()}, {slower}))) << "times are reported, not judged";
}

TEST(Compare, TimesAreMediansOverTheRunsOfASide) {
    Stored fast = exampleRun(), disturbed = exampleRun();
    for (auto& c : disturbed.cases) c.timings[0].median = 50e-6;
    const auto c = compareRuns({exampleRun()}, {fast, disturbed, fast});
    EXPECT_DOUBLE_EQ(c.specs[0].timeRatio.value(), 1.0);
    EXPECT_EQ(c.runsAfter, 3);
}

TEST(Compare, NewBoundsAreNotNewPhysics) {
    Stored before = exampleRun(), after = exampleRun();
    before.scenarios[0].text = R"({"gravity": [0, -9.81], "accept": {"*": {"position_max": 1}}})";
    after.scenarios[0].text = R"({"accept": {}, "title": "t", "gravity": [0, -9.81]})";
    EXPECT_TRUE(compareRuns({before}, {after}).changedScenarios.empty());
    after.scenarios[0].text = R"({"gravity": [0, -9.82]})";
    EXPECT_EQ(compareRuns({before}, {after}).changedScenarios.size(), 1u);
}

TEST(Compare, WhatCannotBeComparedIsSaid) {
    Stored after = exampleRun();
    after.scenarios[0].text = "{\"changed\": 1}";
    after.cases[1].dt = 0.02;
    after.environment["cpu"] = "another";
    const auto c = compareRuns({exampleRun()}, {after});
    EXPECT_EQ(c.changedScenarios, std::vector<std::string>{"s0"});
    EXPECT_EQ(c.onlyBefore, std::vector<std::string>{"s1 ode dt=0.01"});
    EXPECT_EQ(c.onlyAfter, std::vector<std::string>{"s1 ode dt=0.02"});
    EXPECT_EQ(c.environment, std::vector<std::string>{"cpu: one -> another"});
    EXPECT_EQ(c.specs[0].cases, 6);
}

class Recorded : public ::testing::Test {
  protected:
    std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / "recorded";
    void SetUp() override { std::filesystem::remove_all(folder_); }
};

TEST_F(Recorded, ComesBackBitForBit) {
    Stored run = exampleRun();
    run.cases[0].metrics[0].value = 1.0 / 3.0;
    run.cases[1].outcome = results::Outcome::Crashed;
    run.cases[1].verdict = Verdict::Crashed;
    run.cases[1].metrics.clear();
    run.cases[2].metrics[0].value = std::numeric_limits<double>::infinity();
    run.cases[3].outcome = results::Outcome::Unsupported;
    run.cases[3].verdict = Verdict::Unsupported;
    run.cases[3].metrics.clear();
    const auto files = writeRecorded(run, folder_);
    ASSERT_EQ(files.size(), 1u);
    EXPECT_EQ(files[0].filename(), "ode-0.16.csv");
    std::vector<std::string> missing;
    const Stored recorded = readRecorded(folder_, run, missing);
    EXPECT_TRUE(missing.empty());
    const auto c = compareRuns({recorded}, {run}, {0.0, 0.0});
    EXPECT_EQ(c.specs.at(0).cases, 8);
    EXPECT_TRUE(c.metrics.empty() && c.verdicts.empty() && c.changedScenarios.empty());
    EXPECT_TRUE(c.onlyBefore.empty() && c.onlyAfter.empty());
}

TEST_F(Recorded, AnotherVersionHasNoRecordAndAnotherScenarioIsNotCompared) {
    Stored run = exampleRun();
    writeRecorded(run, folder_);
    run.scenarios[4].text = "{\"changed\": 1}";
    std::vector<std::string> missing;
    EXPECT_EQ(compareRuns({readRecorded(folder_, run, missing)}, {run}).changedScenarios,
              std::vector<std::string>{"s4"});
    run.engines[0].version = "0.17";
    (void)readRecorded(folder_, run, missing);
    EXPECT_EQ(missing, std::vector<std::string>{"ode 0.17"});
}

TEST_F(Recorded, ADamagedFileIsNamedWithItsLine) {
    const Stored run = exampleRun();
    const auto file = writeRecorded(run, folder_).at(0);
    std::ofstream(file, std::ios::app) << "s0;x;ode;0.01;completed;pass;position_max;m;much\n";
    std::vector<std::string> missing;
    try {
        (void)readRecorded(folder_, run, missing);
        FAIL() << "accepted";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("ode-0.16.csv:10"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("'much'"), std::string::npos);
    }
}

}  // namespace
}  // namespace rigor::validation
