// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Summaries of synthetic repetitions: medians, validity, ratios, changes.
#include "validation/bench/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace rigor::validation {
namespace {

using results::Bench;
using results::BenchCase;
using results::BenchRepetition;
using testing::ElementsAre;
using testing::HasSubstr;

/// `count` repetitions around `seconds` with noise of 2 %, and a look that must not count.
BenchCase caseOf(const std::string& engine, double seconds, int count, unsigned seed,
                 std::int64_t threads = 1) {
    BenchCase c;
    c.id = engine + std::to_string(threads);
    c.part = "scene";
    c.name = "pyramid";
    c.engine = engine;
    c.size = 10.0;
    c.threads = threads;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> noise(0.98, 1.02);
    for (int round = 0; round <= count; ++round) {
        BenchRepetition r;
        r.round = round;
        r.samples = 100;
        r.cpu = (round == 0 ? 100.0 : 1.0) * seconds * noise(random);
        r.wall = 2.0 * r.cpu;
        r.quality = {{"max_penetration", "m", 0.001, std::nullopt, 0.005, true}};
        c.repetitions.push_back(r);
    }
    return c;
}

TEST(Summary, MediansLeaveTheLookOut) {
    Bench bench;
    bench.cases = {caseOf("a", 1e-3, 9, 1)};
    summarise(bench, {}, "");
    const auto& s = bench.cases[0].summary;
    EXPECT_TRUE(s.valid) << s.reason;
    EXPECT_EQ(s.repetitions, 9);
    EXPECT_NEAR(s.cpu, 1e-3, 2e-5);
    EXPECT_NEAR(s.wall, 2e-3, 4e-5);
    ASSERT_TRUE(s.low && s.high);
    EXPECT_LE(*s.low, s.cpu);
    EXPECT_GE(*s.high, s.cpu);
    EXPECT_TRUE(s.converged);
}

TEST(Summary, ThreadsAreSummarisedByTheWall) {
    Bench bench;
    bench.cases = {caseOf("a", 1e-3, 9, 1), caseOf("a", 1e-3, 9, 2, 2)};
    summarise(bench, {}, "");
    EXPECT_EQ(bench.cases[1].summary.clock, "wall");
    EXPECT_NEAR(*bench.cases[1].summary.low, 2e-3, 1e-4);
    EXPECT_NEAR(*bench.cases[1].summary.ratio, 1.0, 0.04);  // wall against wall
}

TEST(Summary, OneBadRepetitionMakesATimingInvalid) {
    for (const int round : {0, 4}) {
        Bench bench;
        bench.cases = {caseOf("a", 1e-3, 9, 1), caseOf("b", 2e-3, 9, 2)};
        auto& quality = bench.cases[1].repetitions[round].quality[0];
        quality.value = 0.012;
        quality.ok = false;
        summarise(bench, {}, "");
        EXPECT_TRUE(bench.cases[0].summary.valid);
        EXPECT_FALSE(bench.cases[1].summary.valid);
        EXPECT_EQ(bench.cases[1].summary.reason, "max_penetration 0.012 m > 0.005");
        EXPECT_FALSE(bench.cases[1].summary.ratio) << "an invalid timing enters no ratio";
        EXPECT_GT(bench.cases[1].summary.cpu, 0.0) << "it is still reported";
    }
}

TEST(Summary, AnInvalidCaseIsNoBase) {
    Bench bench;
    bench.cases = {caseOf("a", 1e-3, 9, 1), caseOf("b", 2e-3, 9, 2), caseOf("c", 6e-3, 9, 3)};
    bench.cases[0].repetitions[3].quality[0].ok = false;
    summarise(bench, {}, "");
    EXPECT_EQ(bench.cases[2].summary.base, "b1");
    EXPECT_NEAR(*bench.cases[2].summary.ratio, 3.0, 0.1);
    summarise(bench, {}, "a");  // requested, but not valid
    EXPECT_EQ(bench.cases[2].summary.base, "a1");
    EXPECT_FALSE(bench.cases[2].summary.ratio);
    summarise(bench, {}, "c");
    EXPECT_NEAR(*bench.cases[1].summary.ratio, 1.0 / 3.0, 0.02);
}

TEST(Summary, ThePartsOfAnEngineWithManyChoicesAreHeldAgainstItsFastest) {
    Bench bench;
    bench.cases = {caseOf("a:x", 4e-3, 9, 1), caseOf("a:y", 2e-3, 9, 2), caseOf("a:z", 1e-3, 9, 3),
                   caseOf("b:x", 9e-3, 9, 4), caseOf("b:y", 8e-3, 9, 5)};
    bench.cases[2].repetitions[3].quality[0].ok = false;
    summarise(bench, {}, "");
    EXPECT_EQ(bench.cases[3].summary.base, "a:x1") << "of a scene the first";
    for (auto& c : bench.cases) c.part = "broad_phase";
    summarise(bench, {}, "");
    EXPECT_EQ(bench.cases[3].summary.base, "a:y1");
    EXPECT_NEAR(*bench.cases[0].summary.ratio, 2.0, 0.1);
    summarise(bench, {}, "b");
    EXPECT_EQ(bench.cases[0].summary.base, "b:y1");
    summarise(bench, {}, "a:x");
    EXPECT_EQ(bench.cases[0].summary.base, "a:x1") << "a spec is that spec";
}

TEST(Summary, RatiosPairTheRounds) {
    Bench bench;
    bench.cases = {caseOf("a", 1e-3, 12, 1), caseOf("b", 3e-3, 12, 2)};
    for (auto& c : bench.cases)  // the machine gets slower and slower
        for (auto& r : c.repetitions) r.cpu *= 1.0 + r.round;
    summarise(bench, {}, "a");
    const auto& s = bench.cases[1].summary;
    EXPECT_NEAR(*s.ratio, 3.0, 0.06);
    ASSERT_TRUE(s.ratioLow && s.ratioHigh);
    EXPECT_LT(*s.ratioHigh / *s.ratioLow, 1.05);
    EXPECT_GT(*s.high / *s.low, 1.5) << "the times themselves spread";
}

TEST(Summary, WhatDidNotEndIsNoTiming) {
    Bench bench;
    bench.cases = {caseOf("a", 1e-3, 3, 1), caseOf("b", 1e-3, 0, 1), {}};
    bench.cases[0].repetitions[2].outcome = "crashed";
    bench.cases[0].repetitions[2].reason = "SIGSEGV";
    summarise(bench, {}, "");
    EXPECT_EQ(bench.cases[0].summary.reason, "crashed: SIGSEGV");
    EXPECT_EQ(bench.cases[1].summary.reason, "no timed repetition");
    EXPECT_EQ(bench.cases[2].summary.reason, "not run");
}

std::vector<results::BenchChange> changes(const std::vector<double>& factors, double threshold = 0.05) {
    Bench before, after;
    for (std::size_t i = 0; i < factors.size(); ++i) {
        const std::string engine(1, static_cast<char>('a' + i));
        const auto seed = static_cast<unsigned>(i);
        before.cases.push_back(caseOf(engine, 1e-3, 10, 2 * seed));
        after.cases.push_back(caseOf(engine, 1e-3 * factors[i], 10, 2 * seed + 1));
    }
    summarise(before, {}, "");
    summarise(after, {}, "");
    return changesSince(before, after, {threshold, 0.05});
}

std::vector<std::string> verdicts(const std::vector<results::BenchChange>& list) {
    std::vector<std::string> out;
    for (const auto& c : list) out.push_back(c.verdict);
    return out;
}

TEST(Changes, AreDistinguishedFromChance) {
    const auto found = changes({1.0, 1.3, 0.6, 1.0});
    EXPECT_THAT(verdicts(found), ElementsAre("same", "slower", "faster", "same"));
    EXPECT_TRUE(becameSlower(found));
    EXPECT_NEAR(found[1].ratio, 1.3, 0.05);
    EXPECT_LT(found[1].low, found[1].ratio);
    EXPECT_GT(found[1].high, found[1].ratio);
    EXPECT_LT(found[1].p, 0.001);
    EXPECT_FALSE(becameSlower(changes({1.0, 0.5})));
}

TEST(Changes, BelowTheThresholdAreNone) {
    EXPECT_THAT(verdicts(changes({1.1})), ElementsAre("slower"));
    EXPECT_THAT(verdicts(changes({1.1}, 0.2)), ElementsAre("same"));
}

TEST(Changes, RarelyCryWolf) {
    int alarms = 0;
    for (unsigned trial = 0; trial < 60; ++trial) {
        Bench before, after;
        for (unsigned i = 0; i < 5; ++i) {
            const std::string engine(1, static_cast<char>('a' + i));
            before.cases.push_back(caseOf(engine, 1e-3, 8, 1000 + 10 * trial + i));
            after.cases.push_back(caseOf(engine, 1e-3, 8, 5000 + 10 * trial + i));
        }
        summarise(before, {}, "");
        summarise(after, {}, "");
        alarms += becameSlower(changesSince(before, after, {0.0, 0.05})) ? 1 : 0;
    }
    EXPECT_LT(alarms, 7);  // expected: at most 5 % of the 60, half of them of the other sign
}

TEST(Changes, AreOfValidTimingsAlone) {
    Bench before, after;
    before.cases = {caseOf("a", 1e-3, 10, 1), caseOf("b", 1e-3, 10, 2), caseOf("gone", 1e-3, 10, 3)};
    after.cases = {caseOf("a", 5e-3, 10, 4), caseOf("b", 5e-3, 10, 5), caseOf("new", 1e-3, 10, 6)};
    after.cases[0].repetitions[1].quality[0].ok = false;
    before.cases[1].repetitions[1].outcome = "timeout";
    summarise(before, {}, "");
    summarise(after, {}, "");
    const auto found = changesSince(before, after, {});
    EXPECT_THAT(verdicts(found), ElementsAre("not compared", "not compared"));
    EXPECT_THAT(found[1].reason, HasSubstr("timeout"));
    EXPECT_FALSE(becameSlower(found));
}

TEST(Changes, AnotherMachineIsReported) {
    results::Run before, after;
    before.environment = {{"cpu", "A"}, {"cores", "2"}, {"load", "0.1"}};
    after.environment = {{"cpu", "B"}, {"cores", "2"}, {"load", "0.9"}};
    EXPECT_THAT(otherMachine(before, after), ElementsAre("cpu: A -> B"));
}

}  // namespace
}  // namespace rigor::validation
