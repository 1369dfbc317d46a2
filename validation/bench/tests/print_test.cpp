// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tables of a bench for a terminal: narrow whatever the specs, and nothing is lost.
#include "validation/bench/print.hpp"
#include "validation/bench/growth.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "validation/bench/growth.hpp"
#include "validation/bench/text_table.hpp"

namespace rigor::validation {
namespace {

using results::BenchCase;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string kFast =
    "rigor:box_margin=0.05,broad_phase=wide_tree,contact_frequency=45,curved_joints=off,precision=f32,preset="
    "matched,reuse_distance=1e-3,solver=wide,speculative_distance=5e-3,";

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

std::size_t occurrences(const std::string& text, const std::string& what) {
    std::size_t count = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
    return count;
}

BenchCase timed(const std::string& engine, std::int64_t threads = 1) {
    BenchCase c;
    c.id = engine + std::to_string(threads);
    c.part = "scene";
    c.name = "bench_box_pyramid_drop";
    c.engine = engine;
    c.threads = threads;
    c.sizeUnit = "bodies";
    c.size = 12400;
    c.operation = "step";
    for (int round = 0; round < 3; ++round) {
        results::BenchRepetition r;
        r.round = round;
        r.wall = r.cpu = 0.1234;
        r.ownMemoryKiB = 123456;
        if (round == 0) r.allocations = 1234.5;
        r.counts = {{"contacts", 49600.25}, {"asleep", 12400.0}, {"longest_ms", 1234.5}};
        r.quality = {{"max_penetration", "m", 0.001, std::nullopt, 0.005, true}};
        c.repetitions.push_back(r);
    }
    auto& s = c.summary;
    s.repetitions = 2;
    s.clock = "cpu";
    s.cpu = s.wall = 0.1234;
    s.low = 0.1211;
    s.high = 0.1277;
    s.valid = true;
    s.base = "base";
    s.ratio = 0.1234;
    s.ratioLow = 0.1211;
    s.ratioHigh = 0.1277;
    return c;
}

results::Run scenes() {
    results::Run run;
    run.bench.settings = {{"width", "0.05"}, {"build", "optimised"}};
    for (const char* end : {"substeps=4", "substeps=5"})
        for (const int threads : {1, 2}) run.bench.cases.push_back(timed(kFast + end, threads));
    run.bench.cases.push_back(timed("bullet:preset=matched"));
    run.bench.cases.push_back(timed("rigor:preset=matched"));
    return run;
}

/// The lines of the tables: all above the key.
std::vector<std::string> tablesOf(const std::string& text) {
    return linesOf(text.substr(0, text.find("Engines in full:")));
}

TEST(Print, RowsFitHoweverLongTheSpecs) {
    results::Run run = scenes();
    auto& bad = run.bench.cases.back().summary;
    bad.valid = false;
    bad.reason = "max_penetration 0.02 m > 0.005, and this goes on for a long while, so that it has";
    bad.reason += " to be broken into lines of which there are two or three";
    const auto lines = tablesOf(benchText(run, false));
    ASSERT_GE(lines.size(), 8u);
    for (const auto& line : lines) EXPECT_LE(line.size(), kTextWidth) << line;
    EXPECT_THAT(lines, Contains(StartsWith("      INVALID: max_penetration 0.02 m > 0.005")));
    EXPECT_THAT(lines, Contains(HasSubstr("two or three")));
}

TEST(Print, SpecsStandInFullOnceAndRowsByTheirLabels) {
    const std::string text = benchText(scenes(), false);
    for (const char* end : {
             "substeps=4\n",
             "substeps=5\n",
         })
        EXPECT_EQ(occurrences(text, kFast + end), 1u) << text;
    for (const char* label : {"  rigor[1] ", "  rigor[2] "})
        EXPECT_EQ(occurrences(text, label), 3u) << "two rows and the key\n" << text;
    EXPECT_THAT(linesOf(text), Contains("  bullet    bullet:preset=matched"));
    results::Run plain;
    plain.bench.settings = {{"width", "0.05"}};
    plain.bench.cases = {timed("bullet"), timed("rigor:solver=wide")};
    plain.bench.cases[1].engine = "rigor";
    EXPECT_THAT(benchText(plain, false), Not(HasSubstr("in full")));
}

/// Times of N log N: the exponent between N and 10 N is 1 + log10(log 10 N / log N).
TEST(Print, GrowthIsByExponents) {
    results::Run run;
    run.bench.settings = {{"width", "0.05"}, {"build", "optimised"}};
    for (const double size : {1e4, 1e2, 1e3}) {  // not in order
        results::BenchCase c = timed("bullet");
        c.size = size;
        c.summary.cpu = 1e-6 * size * std::log(size);
        for (auto& r : c.repetitions) {
            r.ownMemoryKiB = static_cast<std::int64_t>(8.0 * size);
            r.counts = {{"contacts", std::pow(size, 1.5)}};
        }
        run.bench.cases.push_back(c);
    }
    const auto growths = growthsOf(run.bench.cases);
    ASSERT_EQ(growths.size(), 2u);
    EXPECT_EQ(growths[0].from, 1e2);
    EXPECT_EQ(growths[1].to, 1e4);
    EXPECT_NEAR(growths[0].time, 1.0 + std::log10(1.5), 1e-12);
    EXPECT_NEAR(growths[1].time, 1.0 + std::log10(4.0 / 3.0), 1e-12);
    EXPECT_NEAR(growths[1].memory.value_or(0.0), 1.0, 1e-12);
    EXPECT_NEAR(growths[1].contacts.value_or(0.0), 1.5, 1e-12);
    EXPECT_FALSE(growths[1].longest) << "not measured";
    EXPECT_THAT(benchText(run, false), HasSubstr("exponents p of ~ size^p"));
    run.bench.cases[2].summary.valid = false;
    ASSERT_EQ(growthsOf(run.bench.cases).size(), 1u);
    EXPECT_NEAR(growthsOf(run.bench.cases)[0].time, 1.0 + 0.5 * std::log10(2.0), 1e-12)
        << "from 100 to 10 000";
    run.bench.cases[1].threads = 2;
    EXPECT_TRUE(growthsOf(run.bench.cases).empty());
    EXPECT_THAT(benchText(run, false), Not(HasSubstr("Growth")));
}

TEST(Print, ChangesAreNamedByLabels) {
    results::Run run = scenes();
    for (const auto& c : run.bench.cases)
        run.bench.changes.push_back({c.id, 1.0, 1.5, 1.5, 1.4, 1.6, 0.01, "slower", ""});
    run.bench.changes.back().verdict = "not compared";
    run.bench.changes.back().reason = "before: no timing";
    const std::string text = changesText(run, "runs/before", {"cpu: A -> B"});
    for (const auto& line : tablesOf(text)) EXPECT_LE(line.size(), kTextWidth) << line;
    EXPECT_THAT(text, HasSubstr("slower        1.500  1.400..1.600  p = 0.01  bench_box_pyramid_drop 12400 "
                                "bodies, rigor[1], 2 threads"));
    EXPECT_THAT(text, HasSubstr("12400 bodies, rigor: before: no timing"));
    EXPECT_EQ(occurrences(text, kFast + "substeps=4\n"), 1u);
    EXPECT_THAT(text, HasSubstr("another machine or build: cpu: A -> B"));
}

TEST(Print, WhatAllRowsOfAPartShareStandsInTheTitle) {
    results::Run run = scenes();
    run.bench.cases.resize(3);
    double missed = 0.0;
    for (auto& c : run.bench.cases) {
        c.part = "broad_phase";
        c.name = "3D";
        c.operation = "update";
        for (auto& r : c.repetitions) {
            r.counts = {{"pairs", 480.0}, {"pairs_held", 500.0 + missed}};
            r.quality = {{"missed_pairs", "1", missed, std::nullopt, 0.0, true}};
        }
        if (&c == &run.bench.cases[1]) missed = 1.0;
    }
    const auto lines = linesOf(benchText(run, false));
    EXPECT_THAT(lines[0], HasSubstr(": ms an update, pairs 480, MiB 121, malloc calls 1234"));
    EXPECT_THAT(lines[2], Not(HasSubstr("MiB")));
    EXPECT_THAT(lines, Contains(HasSubstr("missed"))) << "rows differ in it";
    EXPECT_THAT(lines[5], HasSubstr(" 501 "));
}

TEST(TextTable, BreaksHeadsAtSpacesAndAlignsWhatIsColoured) {
    EXPECT_EQ(tableText({"who", "time of a step", "n"},
                        {{"a", "1.5", "10"}, {"bcde", "\033[9m12.25\033[29m", "7"}}),
              "         time\n"
              "         of a\n"
              "  who    step   n\n"
              "  a       1.5  10\n"
              "  bcde  \033[9m12.25\033[29m   7\n");
    EXPECT_EQ(tableText({"", ""}, {{"a", "1", "said"}, {"b"}}), "  a  1  said\n  b\n");
}

TEST(TextTable, RemarksThatDoNotFitGoBelowTheirRow) {
    const std::string remark(kTextWidth - 8, 'x');
    EXPECT_EQ(tableText({""}, {{"abcd", remark}}), "  abcd  " + remark + "\n");
    EXPECT_EQ(tableText({""}, {{"abcde", remark}}), "  abcde\n      " + remark + "\n");
    EXPECT_EQ(wrapped("one two three", 10, 2), "  one two\n  three\n");
}

}  // namespace
}  // namespace rigor::validation
