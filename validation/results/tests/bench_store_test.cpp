// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "validation/results/store.hpp"
#include "validation/results/tests/edited_store.hpp"
#include "validation/results/tests/sample_run.hpp"

namespace rigor::results {
namespace {

using sample::kDenormal;
using sample::kInf;
using sample::kNanValue;
using sample::TemporaryFolder;

BenchRepetition repetition(std::int64_t round) {
    BenchRepetition r;
    r.round = round;
    r.order = 7 + round;
    r.outcome = "crashed";
    r.reason = "SIGSEGV ' \"";
    r.wall = 0.1 + 0.2;
    r.cpu = kDenormal;
    r.samples = 1ll << 40;
    r.stateHash = "00ff";
    r.peakMemoryKiB = 12345;
    r.ownMemoryKiB = 678;
    r.allocations = -0.0;
    r.processSeconds = 1.0 / 3.0;
    r.load = 0.5;
    r.counts = {{"contacts", 17140.5}, {"pairs", kInf}};
    r.phases = {{"solve", 1e-3}};
    r.quality = {{"max_penetration", "m", kNanValue, std::nullopt, 0.005, false},
                 {"top_height", "m", 14.5, 13.0, 14.51, true},
                 {"kinetic_energy", "J", 1.0, std::nullopt, std::nullopt, true}};
    return r;
}

Bench bench() {
    Bench b;
    b.settings = {{"seed", "1"}, {"width", "0.05"}};
    for (const char* id : {"a", "b"}) {
        BenchCase c;
        c.id = id;
        c.position = b.cases.size();
        c.part = "scene";
        c.name = "pyramid";
        c.engine = "ode:preset=matched";
        c.sizeUnit = "bodies";
        c.size = 1240.0;
        c.threads = 2;
        c.operation = "step";
        c.command = "./rigor bench pyramid";
        c.parameters = "{}";
        c.summary.repetitions = 3;
        c.summary.clock = "wall";
        c.summary.wall = 0.3;
        c.summary.cpu = 0.5;
        c.summary.low = 0.2;
        c.summary.converged = true;
        c.summary.reason = "max_penetration 1 m > 0.005";
        c.summary.base = "a";
        c.summary.ratio = 1.25;
        c.summary.ratioHigh = kInf;
        b.cases.push_back(c);
    }
    b.changes = {{"b", 0.1, 0.2, 2.0, 1.9, 2.1, 1e-9, "slower", ""},
                 {"a", 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, "not compared", "crashed"}};
    return b;
}

void expectSame(const BenchRepetition& a, const BenchRepetition& b) {
    EXPECT_EQ(std::tie(a.round, a.order, a.outcome, a.reason, a.wall, a.cpu, a.samples, a.stateHash,
                       a.peakMemoryKiB, a.ownMemoryKiB, a.allocatedBytes, a.processSeconds, a.load),
              std::tie(b.round, b.order, b.outcome, b.reason, b.wall, b.cpu, b.samples, b.stateHash,
                       b.peakMemoryKiB, b.ownMemoryKiB, b.allocatedBytes, b.processSeconds, b.load));
    EXPECT_TRUE(b.allocations && sample::sameBits(*a.allocations, *b.allocations));
    ASSERT_EQ(a.counts.size(), b.counts.size());
    for (std::size_t i = 0; i < a.counts.size(); ++i)
        EXPECT_EQ(std::tie(a.counts[i].name, a.counts[i].value),
                  std::tie(b.counts[i].name, b.counts[i].value));
    ASSERT_EQ(a.phases.size(), b.phases.size());
    EXPECT_EQ(std::tie(a.phases[0].name, a.phases[0].seconds),
              std::tie(b.phases[0].name, b.phases[0].seconds));
    ASSERT_EQ(a.quality.size(), b.quality.size());
    for (std::size_t i = 0; i < a.quality.size(); ++i) {
        const BenchQuality &p = a.quality[i], &q = b.quality[i];
        EXPECT_EQ(std::tie(p.name, p.unit, p.min, p.max, p.ok), std::tie(q.name, q.unit, q.min, q.max, q.ok));
        EXPECT_TRUE(p.value == q.value || (std::isnan(p.value) && std::isnan(q.value)));
    }
}

void expectSame(const BenchSummary& a, const BenchSummary& b) {
    EXPECT_EQ(std::tie(a.repetitions, a.clock, a.wall, a.cpu, a.low, a.high, a.converged, a.valid, a.reason,
                       a.base, a.ratio, a.ratioLow, a.ratioHigh),
              std::tie(b.repetitions, b.clock, b.wall, b.cpu, b.low, b.high, b.converged, b.valid, b.reason,
                       b.base, b.ratio, b.ratioLow, b.ratioHigh));
}

TEST(BenchStore, EveryFieldSurvives) {
    const TemporaryFolder folder;
    RunWriter writer(folder.path(), false);
    writer.writeHeader(sample::header());
    const Bench written = bench();
    writer.writeBenchPlan(written);
    writer.writeBenchRepetition("b", repetition(1));
    writer.writeBenchRepetition("b", repetition(0));
    writer.writeBenchAnalysis(written);
    writer.writeBenchAnalysis(written);  // replaced, not added
    const Bench read = readRun(folder.path()).bench;
    EXPECT_EQ(read.settings, written.settings);
    ASSERT_EQ(read.cases.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const BenchCase &a = written.cases[i], &b = read.cases[i];
        EXPECT_EQ(std::tie(a.id, a.position, a.part, a.name, a.engine, a.sizeUnit, a.size, a.threads,
                           a.operation, a.command, a.parameters),
                  std::tie(b.id, b.position, b.part, b.name, b.engine, b.sizeUnit, b.size, b.threads,
                           b.operation, b.command, b.parameters));
        expectSame(a.summary, b.summary);
    }
    EXPECT_TRUE(read.cases[0].repetitions.empty());
    ASSERT_EQ(read.cases[1].repetitions.size(), 2u);
    expectSame(repetition(0), read.cases[1].repetitions[0]);
    expectSame(repetition(1), read.cases[1].repetitions[1]);
    ASSERT_EQ(read.changes.size(), 2u);  // changes are in the order of the plan
    EXPECT_EQ(read.changes[0].reason, "crashed");
    const BenchChange &c = written.changes[0], &d = read.changes[1];
    EXPECT_EQ(std::tie(c.caseId, c.before, c.after, c.ratio, c.low, c.high, c.p, c.verdict, c.reason),
              std::tie(d.caseId, d.before, d.after, d.ratio, d.low, d.high, d.p, d.verdict, d.reason));
}

TEST(BenchStore, RepetitionsStayWithTheirCases) {
    const TemporaryFolder folder;
    RunWriter writer(folder.path(), false);
    writer.writeHeader(sample::header());
    Bench written = bench();
    writer.writeBenchPlan(written);
    writer.writeBenchRepetition("a", repetition(0));
    writer.writeBenchRepetition("b", repetition(0));
    BenchRepetition again = repetition(0);
    again.wall = 5.0;
    again.counts.clear();
    writer.writeBenchRepetition("b", again);
    written.cases.erase(written.cases.begin());  // another plan, without "a"
    written.cases[0].command = "./rigor bench other";
    writer.writeBenchPlan(written);
    const Bench read = readRun(folder.path()).bench;
    ASSERT_EQ(read.cases.size(), 1u);
    EXPECT_EQ(read.cases[0].id, "b");
    EXPECT_EQ(read.cases[0].command, "./rigor bench other");
    ASSERT_EQ(read.cases[0].repetitions.size(), 1u);
    EXPECT_EQ(read.cases[0].repetitions[0].wall, 5.0);
    EXPECT_TRUE(read.cases[0].repetitions[0].counts.empty());
    EXPECT_EQ(read.cases[0].repetitions[0].quality.size(), 3u);
}

/// A store with two repetitions of each of its cases, changed from outside.
class DamagedBench {
  public:
    explicit DamagedBench(const std::string& change) {
        RunWriter writer(folder_.path(), false);
        writer.writeHeader(sample::header());
        writer.writeBenchPlan(bench());
        for (const char* id : {"a", "b"})
            for (const std::int64_t round : {0, 1}) writer.writeBenchRepetition(id, repetition(round));
        writer.writeBenchAnalysis(bench());
        sql(change);
    }
    void sql(const std::string& change) {
        SQLite::Database database((folder_.path() / "results.sqlite").string(), SQLite::OPEN_READWRITE);
        database.exec(change);
    }
    Run read() const { return readRun(folder_.path()); }
    RunWriter resumed() const { return {folder_.path(), true}; }

  private:
    TemporaryFolder folder_;
};

TEST(BenchStore, ADamagedCaseIsLeftOutAndNamed) {
    for (const char* change :
         {"UPDATE bench_repetitions SET wall = wall / 2 WHERE case_id = 'a' AND round = 1",
          "UPDATE bench_values SET value = 1 WHERE case_id = 'a' AND round = 0 AND ordinal = 2",
          "DELETE FROM bench_values WHERE case_id = 'a' AND round = 0 AND ordinal = 2",
          "DELETE FROM bench_repetitions WHERE case_id = 'a' AND round = 1",
          "UPDATE bench_cases SET engine = 'bullet' WHERE id = 'a'", "DELETE FROM bench_cases WHERE id = 'a'",
          "DELETE FROM seals WHERE name = 'bench case a'"}) {
        const results::Run run = DamagedBench(change).read();
        ASSERT_EQ(run.damage.size(), 1u) << change;
        EXPECT_THAT(run.damage[0], testing::HasSubstr("results.sqlite: the rows of the bench's case a"))
            << change;
        ASSERT_EQ(run.bench.cases.size(), 1u) << change;
        EXPECT_EQ(run.bench.cases[0].id, "b");
        ASSERT_EQ(run.bench.cases[0].repetitions.size(), 2u);
        expectSame(repetition(1), run.bench.cases[0].repetitions[1]);
        EXPECT_EQ(run.bench.cases[0].summary.ratio, 1.25);
        ASSERT_EQ(run.bench.changes.size(), 1u);
        EXPECT_EQ(run.bench.changes[0].caseId, "b");
    }
}

TEST(BenchStore, DamagedSummariesAreLeftOutAndDamagedSettingsAreRefused) {
    for (const char* change : {"UPDATE bench_summaries SET ratio = 2", "UPDATE bench_changes SET p = 0.5"}) {
        const results::Run run = DamagedBench(change).read();
        ASSERT_EQ(run.damage.size(), 1u) << change;
        EXPECT_THAT(run.damage[0], testing::HasSubstr("the bench's summaries and changes")) << change;
        EXPECT_EQ(run.bench.cases.size(), 2u);
        EXPECT_EQ(run.bench.cases[0].summary.repetitions, 0);
        EXPECT_TRUE(run.bench.changes.empty());
    }
    const DamagedBench damaged("UPDATE bench_settings SET value = '2' WHERE key = 'seed'");
    EXPECT_THROW((void)damaged.read(), std::runtime_error);
}

TEST(BenchStore, ADamagedCaseIsRepeatedAndTheOthersStay) {
    for (const char* change :
         {"UPDATE bench_repetitions SET wall = wall / 2 WHERE case_id = 'a' AND round = 1",
          "DELETE FROM bench_cases WHERE id = 'a'"}) {
        DamagedBench damaged(change);
        damaged.sql("UPDATE bench_summaries SET ratio = 2 WHERE case_id = 'b'");
        {
            RunWriter writer = damaged.resumed();
            writer.writeBenchPlan(bench());
            EXPECT_TRUE(damaged.read().damage.empty()) << change;
            EXPECT_TRUE(damaged.read().bench.cases[0].repetitions.empty()) << change;
            EXPECT_EQ(damaged.read().bench.cases[1].summary.ratio, std::nullopt)
                << "no good one of the damaged";
            writer.writeBenchRepetition("a", repetition(0));
        }
        const results::Run run = damaged.read();
        EXPECT_TRUE(run.damage.empty()) << change;
        EXPECT_EQ(run.bench.cases[0].repetitions.size(), 1u) << change;
        EXPECT_EQ(run.bench.cases[1].repetitions.size(), 2u) << change;
    }
}

TEST(BenchStore, AStoreWithoutChecksumsGetsThemWhenItIsGoneOnWith) {
    DamagedBench old(
        "DELETE FROM seals WHERE name LIKE 'bench%'; ALTER TABLE metrics DROP COLUMN bound_min; PRAGMA "
        "user_version = 13");
    EXPECT_TRUE(old.read().damage.empty());
    EXPECT_EQ(old.read().bench.cases.size(), 2u);
    (void)old.resumed();
    EXPECT_TRUE(old.read().damage.empty());
    old.sql("UPDATE bench_values SET unit = 'mm' WHERE case_id = 'b' AND name = 'top_height'");
    EXPECT_EQ(old.read().damage.size(), 1u);
}

TEST(BenchStore, ARunOfTheSchemaBeforeHasNone) {
    const TemporaryFolder folder;
    { RunWriter(folder.path(), false).writeHeader(sample::header()); }
    {
        SQLite::Database database((folder.path() / "results.sqlite").string(), SQLite::OPEN_READWRITE);
        for (const char* table : {"bench_values", "bench_repetitions", "bench_summaries", "bench_changes",
                                  "bench_cases", "bench_settings"})
            database.exec(std::string("DROP TABLE ") + table);
        database.exec("ALTER TABLE engines DROP COLUMN package");
        database.exec("ALTER TABLE scenarios DROP COLUMN reference_outcome");
        for (const char* column : {"first", "mean", "p95", "p99", "worst", "real_time_factor", "non_finite"})
            database.exec(std::string("ALTER TABLE timings DROP COLUMN ") + column);
        database.exec("ALTER TABLE cases DROP COLUMN refusal");
        database.exec("ALTER TABLE audit DROP COLUMN findings");
        for (const char* column :
             {"grade", "graded_by", "relative_error", "ideal_error", "grade_note", "regression",
              "regression_reason", "insertion_orders", "insertion_orders_completed", "grade_best",
              "grade_worst", "insertion_note", "insertion_orders_failed", "insertion_verdicts",
              "order_dependent"})
            database.exec(std::string("ALTER TABLE cases DROP COLUMN ") + column);
        for (const char* column :
             {"scale", "relative_error", "ideal_error", "recorded", "order_min", "order_max", "order_count"})
            database.exec(std::string("ALTER TABLE metrics DROP COLUMN ") + column);
        sample::takeBackSharedLists(database);
        database.exec("DROP TABLE seals");
        database.exec("PRAGMA user_version = 4");
    }
    EXPECT_TRUE(readRun(folder.path()).bench.empty());
    RunWriter writer(folder.path(), true);  // brought up to date
    writer.writeBenchPlan(bench());
    EXPECT_EQ(readRun(folder.path()).bench.cases.size(), 2u);
}

}  // namespace
}  // namespace rigor::results
