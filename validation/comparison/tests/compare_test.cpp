// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/compare.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "validation/comparison/recorded.hpp"

namespace rigor::validation {
namespace {

using results::CaseRow;
using Stored = results::Run;
using results::Verdict;

/// Eight scenarios, one engine, an error of 0.1 and a step of 1 us in each.
Stored exampleRun() {
    Stored run;
    run.environment = {{"cpu", "one"}, {"date", "today"}};
    run.engines = {{"ode", "ODE", "0.16", "f64", "", ""}};
    for (int i = 0; i < 8; ++i) {
        results::ScenarioRow s;
        s.name = "s" + std::to_string(i);
        s.text = "{}";
        s.metrics = {"position_max"};
        run.scenarios.push_back(s);
        CaseRow c;
        c.scenario = s.name;
        c.spec = "ode";
        c.engine = "ode";
        c.dt = 0.01;
        c.metrics = {{"position_max", "", "m", "exact", 0.1, -1.0, {}, {}, {}, ""},
                     {"position_max", "block", "m", "exact", 0.1, -1.0, {}, {}, {}, ""},
                     {"mean_contacts", "", "1", "cost", 4.0, -1.0, {}, {}, {}, ""}};
        c.timings = {{"step", 1e-6, 1e-6, 1e-6, 1e-4, 100, 0.0}};
        run.cases.push_back(c);
    }
    return run;
}

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

/// exampleRun() with Bullet beside ODE in two presets, at two steps, Bullet's errors half of ODE's.
Stored fourWays() {
    Stored run = exampleRun();
    run.cases.resize(1);
    const CaseRow one = run.cases[0];
    run.cases.clear();
    for (const double dt : {0.02, 0.01, 0.005})
        for (const char* engine : {"ode", "bullet"})
            for (const char* preset : {"default", "matched"}) {
                CaseRow c = one;
                c.engine = engine;
                c.preset = preset;
                c.spec = std::string(engine) + ":preset=" + preset;
                c.dt = dt;
                c.position = run.cases.size();
                c.metrics[0].value = (c.engine == "ode" ? 1.0 : 0.5) * dt;
                run.cases.push_back(c);
            }
    return run;
}

CompareOptions by(PairBy pairBy) {
    CompareOptions options;
    options.pairBy = pairBy;
    return options;
}

TEST(Compare, TwoEnginesOfOneRun) {
    const std::vector<Stored> run{fourWays()};
    const auto c = compareRuns(run, run, by(PairBy::Engine));
    ASSERT_EQ(c.specs.size(), 2u) << "ode beside bullet in each preset, once";
    for (const SpecChange& s : c.specs) {
        EXPECT_EQ(s.spec.substr(0, 3), "ode");
        EXPECT_EQ(s.specAfter.substr(0, 6), "bullet");
        EXPECT_EQ(s.spec.substr(4), s.specAfter.substr(7)) << "one preset";
        EXPECT_EQ(s.cases, 3);
        EXPECT_EQ(s.better, 3);
    }
    for (const MetricChange& m : c.metrics) EXPECT_DOUBLE_EQ(m.after / m.before, 0.5);
    EXPECT_TRUE(c.onlyBefore.empty() && c.onlyAfter.empty());
    EXPECT_NE(comparisonText(c, {}, 5).find("ode:preset=default -> bullet:preset=default"),
              std::string::npos);
}

TEST(Compare, TwoEnginesOfTwoRuns) {
    Stored ode = fourWays(), bullet = ode;
    std::erase_if(ode.cases, [](const CaseRow& c) { return c.engine != "ode"; });
    std::erase_if(bullet.cases, [](const CaseRow& c) { return c.engine != "bullet"; });
    const auto c = compareRuns({bullet}, {ode}, by(PairBy::Engine));
    ASSERT_EQ(c.specs.size(), 2u);
    EXPECT_EQ(c.specs[0].spec, "bullet:preset=default");
    EXPECT_EQ(c.specs[0].worse, 3);
}

TEST(Compare, TwoSpecsAndTwoSteps) {
    const std::vector<Stored> run{fourWays()};
    EXPECT_EQ(compareRuns(run, run, by(PairBy::Spec)).specs.size(), 6u) << "every two of four, once";
    const auto steps = compareRuns(run, run, by(PairBy::TimeStep));
    ASSERT_EQ(steps.specs.size(), 8u) << "of each of four specs two pairs of neighbours";
    for (const SpecChange& s : steps.specs) {
        EXPECT_EQ(s.spec, s.specAfter);
        EXPECT_DOUBLE_EQ(s.dt / s.dtAfter, 2.0);
        EXPECT_EQ(s.better, 1);
    }
}

std::string refusalOf(const Stored& before, const Stored& after, PairBy pairBy) {
    try {
        (void)compareRuns({before}, {after}, by(pairBy));
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST(Compare, NothingInCommonIsRefusedWithWhatEachHas) {
    Stored after = exampleRun();
    for (auto& c : after.cases) {
        c.spec = "bullet";
        c.engine = "bullet";
    }
    const std::string text = refusalOf(exampleRun(), after, PairBy::Nothing);
    EXPECT_NE(text.find("no case (scenario, spec, dt) in common"), std::string::npos) << text;
    EXPECT_NE(text.find("before: scenarios: s0, s1, s2, s3, s4, s5 and 2 more; engines: ode; dt: 0.01"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("engines: bullet"), std::string::npos) << text;
    EXPECT_NE(text.find("--pair"), std::string::npos) << text;
    EXPECT_EQ(refusalOf(exampleRun(), after, PairBy::Engine), "");
    EXPECT_NE(refusalOf(exampleRun(), exampleRun(), PairBy::TimeStep).find("differ in dt alone"),
              std::string::npos);
    Stored changed = exampleRun();
    for (auto& s : changed.scenarios) s.text = "{\"changed\": 1}";
    EXPECT_NE(refusalOf(exampleRun(), changed, PairBy::Nothing).find("other physics: s0 s1"),
              std::string::npos);
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
