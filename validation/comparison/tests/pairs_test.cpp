// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Comparison of cases that differ on purpose: engines, specs, time steps.
#include "validation/comparison/pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "validation/comparison/tests/example_runs.hpp"

namespace rigor::validation {
namespace {

using results::CaseRow;
using Stored = results::Run;

TEST(Pairs, TwoEnginesOfOneRun) {
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

TEST(Pairs, TwoEnginesOfTwoRuns) {
    Stored ode = fourWays(), bullet = ode;
    std::erase_if(ode.cases, [](const CaseRow& c) { return c.engine != "ode"; });
    std::erase_if(bullet.cases, [](const CaseRow& c) { return c.engine != "bullet"; });
    const auto c = compareRuns({bullet}, {ode}, by(PairBy::Engine));
    ASSERT_EQ(c.specs.size(), 2u);
    EXPECT_EQ(c.specs[0].spec, "bullet:preset=default");
    EXPECT_EQ(c.specs[0].worse, 3);
}

TEST(Pairs, TwoSpecsAndTwoSteps) {
    const std::vector<Stored> run{fourWays()};
    EXPECT_EQ(compareRuns(run, run, by(PairBy::Spec)).specs.size(), 2u) << "two presets of each engine";
    const auto steps = compareRuns(run, run, by(PairBy::TimeStep));
    ASSERT_EQ(steps.specs.size(), 8u) << "of each of four specs two pairs of neighbours";
    for (const SpecChange& s : steps.specs) {
        EXPECT_EQ(s.spec, s.specAfter);
        EXPECT_DOUBLE_EQ(s.dt / s.dtAfter, 2.0);
        EXPECT_EQ(s.better, 1);
    }
}

/// The default preset is what other specs of its engine are compared with, wherever it is in the run.
TEST(Pairs, SpecsOfAnEngineAreComparedWithItsDefault) {
    Stored run = fourWays();
    std::reverse(run.cases.begin(), run.cases.end());
    for (std::size_t i = 0; i < run.cases.size(); ++i) run.cases[i].position = static_cast<std::int64_t>(i);
    const std::vector<Stored> runs{run};
    const auto c = compareRuns(runs, runs, by(PairBy::Spec));
    ASSERT_EQ(c.specs.size(), 2u);
    for (const SpecChange& s : c.specs) {
        EXPECT_EQ(s.spec.substr(0, s.spec.find(':')), s.specAfter.substr(0, s.specAfter.find(':')));
        EXPECT_TRUE(s.spec.ends_with("preset=default")) << s.spec;
        EXPECT_TRUE(s.specAfter.ends_with("preset=matched")) << s.specAfter;
    }
}

/// Two settings in two presets, each in a run of its own, are two pairs; presets are compared where they alone differ.
TEST(Pairs, SpecsOfTwoRunsAreComparedWithinAPreset) {
    Stored ode = fourWays();
    std::erase_if(ode.cases, [](const CaseRow& c) { return c.engine != "ode"; });
    Stored quick = ode;
    for (CaseRow& c : quick.cases) c.spec += ",stepper=quickstep";
    const auto c = compareRuns({ode}, {quick}, by(PairBy::Spec));
    ASSERT_EQ(c.specs.size(), 2u);
    for (const SpecChange& s : c.specs) EXPECT_EQ(s.specAfter, s.spec + ",stepper=quickstep");
    EXPECT_EQ(compareRuns({ode}, {ode}, by(PairBy::Spec)).specs.size(), 2u)
        << "default and matched, either way";
}

/// A case that nothing can be compared with is listed, in text and JSON; of two runs with its side.
TEST(Pairs, CasesWithoutAPartnerAreListed) {
    Stored run = fourWays();
    std::erase_if(run.cases, [](const CaseRow& c) {
        return c.spec == "ode:preset=matched" && c.dt != 0.01;  // a single step of it is left
    });
    const std::vector<Stored> runs{run};
    const auto steps = compareRuns(runs, runs, by(PairBy::TimeStep));
    EXPECT_EQ(steps.unpaired, std::vector<std::string>{"s0 ode:preset=matched dt=0.01"});
    EXPECT_NE(
        comparisonText(steps, {}, 5)
            .find("Cases without another time step, not compared (1)\n  s0 ode:preset=matched dt=0.01\n"),
        std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(comparisonJson(steps)).at("unpaired").size(), 1u);
    const auto specs = compareRuns(runs, runs, by(PairBy::Spec));
    EXPECT_EQ(specs.unpaired,
              (std::vector<std::string>{"s0 ode:preset=default dt=0.02", "s0 ode:preset=default dt=0.005"}));
    Stored one = run, other = run;
    one.cases.resize(1);
    const auto sides = compareRuns({one}, {other}, by(PairBy::Engine));
    EXPECT_EQ(sides.specs.size(), 1u);
    EXPECT_EQ(sides.unpaired.size(), other.cases.size() - 1);
    EXPECT_TRUE(sides.unpaired.at(0).ends_with(", after")) << sides.unpaired.at(0);
    EXPECT_TRUE(compareRuns({run}, {run}).unpaired.empty());
}

/// Two readings of one folder are one run: each pair appears once.
TEST(Pairs, AFolderAgainstItselfIsOneRun) {
    Stored run = fourWays();
    run.directory = "runs/a";
    const auto twice = compareRuns({run}, {run}, by(PairBy::Engine));
    EXPECT_EQ(twice.specs.size(), 2u);
    EXPECT_TRUE(twice.unpaired.empty());
}

std::string refusalOf(const Stored& before, const Stored& after, PairBy pairBy) {
    try {
        (void)compareRuns({before}, {after}, by(pairBy));
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST(Pairs, NothingInCommonIsRefusedWithWhatEachHas) {
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
    EXPECT_NE(text.find("--pair engine|spec|dt compares"), std::string::npos) << text;
    EXPECT_NE(text.find("rigor history RUN RUN --pair"), std::string::npos) << text;
    EXPECT_EQ(refusalOf(exampleRun(), after, PairBy::Engine), "");
    EXPECT_NE(refusalOf(exampleRun(), exampleRun(), PairBy::TimeStep).find("differ in dt alone"),
              std::string::npos);
    Stored changed = exampleRun();
    for (auto& s : changed.scenarios) s.text = "{\"changed\": 1}";
    EXPECT_NE(refusalOf(exampleRun(), changed, PairBy::Nothing).find("other physics: s0 s1"),
              std::string::npos);
}

}  // namespace
}  // namespace rigor::validation
