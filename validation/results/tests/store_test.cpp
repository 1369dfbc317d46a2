// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/store.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "validation/results/insertion_orders.hpp"
#include "validation/results/seals.hpp"
#include "validation/results/tests/edited_store.hpp"
#include "validation/results/tests/sample_run.hpp"

namespace rigor::results {
namespace {

using sample::caseRow;
using sample::header;
using sample::kDenormal;
using sample::kInf;
using sample::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

void expectSame(const char* what, double a, double b) {
    if (std::isnan(a))
        EXPECT_TRUE(std::isnan(b)) << what;
    else
        EXPECT_TRUE(sample::sameBits(a, b)) << what << ": " << a << " and " << b;
}
void expectSame(const char* what, const std::optional<double>& a, const std::optional<double>& b) {
    ASSERT_EQ(a.has_value(), b.has_value()) << what;
    if (a) expectSame(what, *a, *b);
}

void expectSameMeasured(const CaseRow& a, const CaseRow& b) {
    ASSERT_EQ(a.metrics.size(), b.metrics.size());
    for (std::size_t i = 0; i < a.metrics.size(); ++i) {
        const MetricRow &m = a.metrics[i], &n = b.metrics[i];
        EXPECT_EQ(std::tie(m.name, m.subject, m.unit, m.kind, m.verdict, m.note),
                  std::tie(n.name, n.subject, n.unit, n.kind, n.verdict, n.note));
        expectSame("value", m.value, n.value);
        expectSame("at", m.at, n.at);
        expectSame("bound", m.bound, n.bound);
        expectSame("bound_min", m.boundMin, n.boundMin);
        expectSame("expectation", m.expectation, n.expectation);
        expectSame("scale", m.scale, n.scale);
        expectSame("relative", m.relative, n.relative);
        expectSame("ideal", m.ideal, n.ideal);
        expectSame("recorded", m.recorded, n.recorded);
        expectSame("order_min", m.orderMin, n.orderMin);
        expectSame("order_max", m.orderMax, n.orderMax);
        EXPECT_EQ(m.orderCount, n.orderCount);
    }
    ASSERT_EQ(a.quantities.size(), b.quantities.size());
    for (std::size_t i = 0; i < a.quantities.size(); ++i) {
        const QuantityRow &m = a.quantities[i], &n = b.quantities[i];
        EXPECT_EQ(std::tie(m.name, m.unit), std::tie(n.name, n.unit));
        expectSame("exact", m.exact, n.exact);
        expectSame("scheme_exact", m.schemeExact, n.schemeExact);
        expectSame("measured", m.measured, n.measured);
    }
    ASSERT_EQ(a.timings.size(), b.timings.size());
    for (std::size_t i = 0; i < a.timings.size(); ++i) {
        const TimingRow &m = a.timings[i], &n = b.timings[i];
        EXPECT_EQ(std::tie(m.phase, m.median, m.p10, m.p90, m.total, m.samples, m.meanContacts, m.low, m.high,
                           m.bodies, m.first, m.mean, m.p95, m.p99, m.worst, m.realTimeFactor),
                  std::tie(n.phase, n.median, n.p10, n.p90, n.total, n.samples, n.meanContacts, n.low, n.high,
                           n.bodies, n.first, n.mean, n.p95, n.p99, n.worst, n.realTimeFactor));
    }
}

void expectSameParity(const CaseRow& a, const CaseRow& b) {
    EXPECT_EQ(a.settings, b.settings);
    ASSERT_EQ(a.ledger.size(), b.ledger.size());
    for (std::size_t i = 0; i < a.ledger.size(); ++i) {
        const LedgerRow &m = a.ledger[i], &n = b.ledger[i];
        EXPECT_EQ(std::tie(m.topic, m.requested, m.resolved, m.realisation, m.reason),
                  std::tie(n.topic, n.requested, n.resolved, n.realisation, n.reason));
    }
    ASSERT_EQ(a.readBack.size(), b.readBack.size());
    for (std::size_t i = 0; i < a.readBack.size(); ++i) {
        const ReadBackRow &m = a.readBack[i], &n = b.readBack[i];
        EXPECT_EQ(std::tie(m.quantity, m.subject, m.expected, m.found, m.error, m.ok),
                  std::tie(n.quantity, n.subject, n.expected, n.found, n.error, n.ok));
    }
    ASSERT_EQ(a.audit.size(), b.audit.size());
    for (std::size_t i = 0; i < a.audit.size(); ++i) {
        const AuditRow &m = a.audit[i], &n = b.audit[i];
        EXPECT_EQ(std::tie(m.auditor, m.outcome, m.frames, m.queries, m.overlapping, m.missed, m.spurious,
                           m.undecided, m.worst, m.note, m.findings),
                  std::tie(n.auditor, n.outcome, n.frames, n.queries, n.overlapping, n.missed, n.spurious,
                           n.undecided, n.worst, n.note, n.findings));
        expectSame("normal max", m.normalErrorMax, n.normalErrorMax);
        expectSame("normal median", m.normalErrorMedian, n.normalErrorMedian);
        expectSame("depth max", m.depthErrorMax, n.depthErrorMax);
        expectSame("depth median", m.depthErrorMedian, n.depthErrorMedian);
        expectSame("point max", m.pointErrorMax, n.pointErrorMax);
    }
}

void expectSame(const CaseRow& a, const CaseRow& b) {
    EXPECT_EQ(std::tie(a.id, a.position, a.scenario, a.spec, a.engine, a.preset, a.dt, a.outcome, a.verdict,
                       a.reason, a.wallSeconds, a.cpuSeconds, a.steps, a.peakMemoryKiB, a.stateHash,
                       a.trajectoryFile, a.command, a.refusal),
              std::tie(b.id, b.position, b.scenario, b.spec, b.engine, b.preset, b.dt, b.outcome, b.verdict,
                       b.reason, b.wallSeconds, b.cpuSeconds, b.steps, b.peakMemoryKiB, b.stateHash,
                       b.trajectoryFile, b.command, b.refusal));
    const AccuracyRow &x = a.accuracy, &y = b.accuracy;
    EXPECT_EQ(std::tie(x.grade, x.metric, x.relative, x.ideal, x.note),
              std::tie(y.grade, y.metric, y.relative, y.ideal, y.note));
    EXPECT_EQ(std::tie(a.regression, a.regressionReason), std::tie(b.regression, b.regressionReason));
    EXPECT_EQ(std::tie(a.orders.run, a.orders.completed, a.orders.best, a.orders.worst, a.orders.note,
                       a.orders.failed, a.orders.verdicts, a.orders.dependence),
              std::tie(b.orders.run, b.orders.completed, b.orders.best, b.orders.worst, b.orders.note,
                       b.orders.failed, b.orders.verdicts, b.orders.dependence));
    expectSameMeasured(a, b);
    expectSameParity(a, b);
}

std::vector<std::string> idsOf(const Run& run) {
    std::vector<std::string> ids;
    for (const CaseRow& c : run.cases) ids.push_back(c.id);
    return ids;
}

/// The message of the exception that `work` throws.
template <class Work>
std::string refusal(Work work) {
    try {
        work();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "nothing was thrown";
}

TEST(Store, EveryFieldSurvivesBitForBit) {
    const TemporaryFolder folder;
    const auto written = header();
    {
        RunWriter writer(folder.path() / "run", false);
        writer.writeHeader(written);
        writer.writeCase(caseRow("a", 0));
        writer.finish("2026-01-01T00:01:00Z");
    }
    const auto read = readRun(folder.path() / "run");
    EXPECT_EQ(read.schemaVersion, kSchemaVersion);
    EXPECT_EQ(
        std::tie(read.suite, read.command, read.started, read.plannedCases, read.environment),
        std::tie(written.suite, written.command, written.started, written.plannedCases, written.environment));
    EXPECT_EQ(read.finished, "2026-01-01T00:01:00Z");
    ASSERT_EQ(read.engines.size(), 2u);
    EXPECT_EQ(read.engines[0].buildNotes, "flags");
    EXPECT_EQ(read.engines[0].package, "0.1.1");
    EXPECT_EQ(read.engines[1].package, "");
    EXPECT_EQ(read.engines[1].problem, "not installed");
    EXPECT_EQ(read.engines[0].capabilities, R"({"capabilities":{"planar":true}})");
    ASSERT_EQ(read.scenarios.size(), 1u);
    const ScenarioRow &s = written.scenarios[0], &r = read.scenarios[0];
    EXPECT_EQ(
        std::tie(s.name, s.title, s.description, s.source, s.isolates, s.tags, s.observed, s.metrics,
                 s.dimension, s.duration, s.timeSteps, s.reference, s.referenceTitle, s.referenceFormula,
                 s.referenceTex, s.referenceSource, s.referenceProblem, s.text, s.referenceOutcome),
        std::tie(r.name, r.title, r.description, r.source, r.isolates, r.tags, r.observed, r.metrics,
                 r.dimension, r.duration, r.timeSteps, r.reference, r.referenceTitle, r.referenceFormula,
                 r.referenceTex, r.referenceSource, r.referenceProblem, r.text, r.referenceOutcome));
    ASSERT_EQ(read.cases.size(), 1u);
    expectSame(caseRow("a", 0), read.cases[0]);
}

TEST(Store, CasesComeInTheOrderOfThePlan) {
    const TemporaryFolder folder;
    RunWriter writer(folder.path(), false);
    writer.writeHeader(header());
    writer.writeCase(caseRow("a", 2));
    writer.writeCase(caseRow("c", 0));
    writer.writeCase(caseRow("b", 1));
    EXPECT_THAT(idsOf(readRun(folder.path())), ElementsAre("c", "b", "a")) << "read while the writer is open";
    EXPECT_THAT(writer.finishedCases(), ElementsAre("c", "b", "a"));
}

TEST(Store, AnOutlineNamesTheCasesWithoutTheirRows) {
    const TemporaryFolder folder;
    {
        RunWriter writer(folder.path(), false);
        writer.writeHeader(header());
        writer.writeCase(caseRow("a", 1));
        writer.writeCase(caseRow("b", 0));
    }
    const auto run = readRun(folder.path());
    const RunOutline outline = readOutline(folder.path());
    EXPECT_EQ(outline.suite, run.suite);
    EXPECT_EQ(outline.command, run.command);
    ASSERT_EQ(outline.cases.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(outline.cases[i].id, run.cases[i].id);
        EXPECT_EQ(outline.cases[i].scenario, run.cases[i].scenario);
        EXPECT_EQ(outline.cases[i].spec, run.cases[i].spec);
    }
    EXPECT_THROW(readOutline(folder.path() / "none"), std::runtime_error);
}

TEST(Store, ReadingIsInterrupted) {
    const TemporaryFolder folder;
    RunWriter writer(folder.path(), false);
    writer.writeHeader(header());
    for (int i = 0; i < 100; ++i) writer.writeCase(caseRow("a" + std::to_string(i), i));
    std::atomic<bool> interrupted{false};
    EXPECT_EQ(readRun(folder.path(), &interrupted).cases.size(), 100u);
    interrupted = true;
    EXPECT_THROW(readRun(folder.path(), &interrupted), ReadingInterrupted);
}

TEST(Store, WritingACaseAgainReplacesItWhole) {
    const TemporaryFolder folder;
    RunWriter writer(folder.path(), false);
    writer.writeHeader(header());
    writer.writeCase(caseRow("a", 0));
    CaseRow second = caseRow("a", 0);
    second.metrics.pop_back();
    second.audit.clear();
    second.outcome = Outcome::Crashed;
    writer.writeCase(second);
    const auto run = readRun(folder.path());
    ASSERT_EQ(run.cases.size(), 1u);
    expectSame(second, run.cases[0]);
}

TEST(Store, ResumeKeepsCasesAndKeepOnlyForgets) {
    const TemporaryFolder folder;
    {
        RunWriter writer(folder.path(), false);
        writer.writeHeader(header());
        writer.writeCase(caseRow("a", 0));
        writer.writeCase(caseRow("b", 1));
    }
    RunWriter writer(folder.path(), true);
    writer.writeHeader(header());
    EXPECT_THAT(writer.finishedCases(), ElementsAre("a", "b"));
    writer.keepOnly({"b", "c"});
    const auto run = readRun(folder.path());
    ASSERT_THAT(idsOf(run), ElementsAre("b"));
    expectSame(caseRow("b", 1), run.cases[0]);
    SQLite::Database database((folder.path() / "results.sqlite").string());
    EXPECT_EQ(database.execAndGet("SELECT count(*) FROM metrics WHERE case_id = 'a'").getInt(), 0);
}

TEST(Store, RefusesToOverwriteAndToResumeNothing) {
    const TemporaryFolder folder;
    EXPECT_THAT(refusal([&] { RunWriter(folder.path(), true); }), HasSubstr("holds no run"));
    { RunWriter(folder.path(), false).writeHeader(header()); }
    EXPECT_THAT(refusal([&] { RunWriter(folder.path(), false); }), HasSubstr("holds a run already"));
    EXPECT_THAT(refusal([&] { readRun(folder.path() / "nowhere"); }), HasSubstr("is no run folder"));
}

Run analysed() {
    Run run;
    run.orders = {{"slide", "ode", "position_final", "m", 0.1 + 0.2, -kInf, {}, 3, 1e-3, 1e-2, "left out"},
                  {"slide", "rigor", "energy_drift", "1", {}, {}, 1.5, 0, 0.0, 0.0, ""}};
    run.fairness = {
        {"equal_time", "slide", "position_final", "m", "ode", "a", "ode:n=3", 1.0 / 60.0, kDenormal,
         1.0 / 3.0, 0.25},
        {"engine_defaults", "slide", "position_final", "m", "rigor", "b", "rigor", 0.1, 1.0, 2.0, {}}};
    return run;
}

void expectAnalysed(const Run& read) {
    const Run written = analysed();
    ASSERT_EQ(read.orders.size(), 2u);
    ASSERT_EQ(read.fairness.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const OrderRow &a = written.orders[i], &b = read.orders[i];
        EXPECT_EQ(std::tie(a.scenario, a.spec, a.metric, a.unit, a.order, a.low, a.high, a.points, a.finest,
                           a.coarsest, a.note),
                  std::tie(b.scenario, b.spec, b.metric, b.unit, b.order, b.low, b.high, b.points, b.finest,
                           b.coarsest, b.note));
        const FairnessRow &f = written.fairness[i], &g = read.fairness[i];
        EXPECT_EQ(std::tie(f.mode, f.scenario, f.metric, f.unit, f.competitor, f.caseId, f.spec, f.dt,
                           f.error, f.cost, f.limit),
                  std::tie(g.mode, g.scenario, g.metric, g.unit, g.competitor, g.caseId, g.spec, g.dt,
                           g.error, g.cost, g.limit));
    }
}

TEST(Store, AnalysisIsReplacedAsAWhole) {
    const TemporaryFolder folder;
    RunWriter writer(folder.path(), false);
    writer.writeHeader(header());
    writer.writeAnalysis(analysed());
    writer.writeAnalysis(analysed());
    expectAnalysed(readRun(folder.path()));
}

void takeBackSeals(SQLite::Database& database) {
    sample::takeBackSharedLists(database);
    database.exec("DROP TABLE seals");
}

void takeBackFindings(SQLite::Database& database) {
    takeBackSeals(database);
    database.exec("ALTER TABLE audit DROP COLUMN findings");
}

void takeBackVerdictsOfOrders(SQLite::Database& database) {
    takeBackFindings(database);
    for (const char* column : {"insertion_orders_failed", "insertion_verdicts", "order_dependent"})
        database.exec(std::string("ALTER TABLE cases DROP COLUMN ") + column);
}

void takeBackInsertionOrders(SQLite::Database& database) {
    takeBackVerdictsOfOrders(database);
    for (const char* column :
         {"insertion_orders", "insertion_orders_completed", "grade_best", "grade_worst", "insertion_note"})
        database.exec(std::string("ALTER TABLE cases DROP COLUMN ") + column);
    for (const char* column : {"order_min", "order_max", "order_count"})
        database.exec(std::string("ALTER TABLE metrics DROP COLUMN ") + column);
    database.exec("UPDATE metrics SET non_finite = replace(non_finite, '; order_max is infinite', '')");
}

void takeBackGrades(SQLite::Database& database) {
    takeBackInsertionOrders(database);
    database.exec("ALTER TABLE scenarios DROP COLUMN reference_outcome");
    for (const char* column : {"first", "mean", "p95", "p99", "worst", "real_time_factor"})
        database.exec(std::string("ALTER TABLE timings DROP COLUMN ") + column);
    database.exec("UPDATE metrics SET value = 'nan' WHERE non_finite = 'value is not a number'");
    for (const char* table : {"metrics", "quantities", "read_back", "audit", "timings", "orders", "fairness"})
        database.exec(std::string("ALTER TABLE ") + table + " DROP COLUMN non_finite");
    for (const char* column : {"grade", "graded_by", "relative_error", "ideal_error", "grade_note",
                               "regression", "regression_reason"})
        database.exec(std::string("ALTER TABLE cases DROP COLUMN ") + column);
    for (const char* column : {"scale", "relative_error", "ideal_error", "recorded"})
        database.exec(std::string("ALTER TABLE metrics DROP COLUMN ") + column);
}

/// A text among numbers makes pandas take the whole column for objects.
TEST(Store, WhatIsNotFiniteIsNullAndNamed) {
    const TemporaryFolder folder;
    CaseRow c = caseRow("a", 0);
    c.readBack[0].error = sample::kNanValue;
    {
        RunWriter writer(folder.path(), false);
        writer.writeHeader(header());
        writer.writeCase(c);
    }
    SQLite::Database database((folder.path() / "results.sqlite").string(), SQLite::OPEN_READONLY);
    for (const char* column : {"value", "at", "bound", "expectation"})
        EXPECT_EQ(database
                      .execAndGet(std::string("SELECT count(*) FROM metrics WHERE typeof(") + column +
                                  ") = 'text' OR abs(" + column + ") > 1e308")
                      .getInt(),
                  0)
            << column;
    const auto reasonOf = [&](const std::string& table, int ordinal) {
        return database
            .execAndGet("SELECT non_finite FROM " + table + " WHERE ordinal = " + std::to_string(ordinal))
            .getString();
    };
    EXPECT_EQ(reasonOf("metrics", 0), "relative_error is infinite; order_max is infinite");
    EXPECT_EQ(reasonOf("metrics", 1), "value is not a number");
    EXPECT_EQ(reasonOf("metrics", 2), "value is infinite; bound is minus infinite");
    EXPECT_EQ(reasonOf("quantities", 1), "measured is not a number");
    EXPECT_EQ(reasonOf("read_back", 0), "error is not a number");
    EXPECT_EQ(reasonOf("timings", 0), "worst is infinite");
    EXPECT_TRUE(std::isnan(readRun(folder.path()).cases.at(0).readBack.at(0).error));
}

/// Makes the store what an older rigor would have written.
void takeBackTo(SQLite::Database& database, int version) {
    takeBackGrades(database);
    for (const char* table : {"bench_values", "bench_repetitions", "bench_summaries", "bench_changes",
                              "bench_cases", "bench_settings"})
        database.exec(std::string("DROP TABLE ") + table);
    for (const char* column : {"capabilities", "package"})
        database.exec(std::string("ALTER TABLE engines DROP COLUMN ") + column);
    database.exec("ALTER TABLE cases DROP COLUMN refusal");
    if (version < 3) {
        database.exec("ALTER TABLE scenarios DROP COLUMN reference_tex");
        for (const char* column : {"low", "high", "bodies"})
            database.exec(std::string("ALTER TABLE timings DROP COLUMN ") + column);
    }
    if (version < 2)
        for (const char* table : {"orders", "fairness"}) database.exec(std::string("DROP TABLE ") + table);
    database.exec("PRAGMA user_version = " + std::to_string(version));
}

TEST(Store, AnOlderSchemaIsReadAndGoneOnWith) {
    const TemporaryFolder folder;
    {
        RunWriter writer(folder.path(), false);
        writer.writeHeader(header());
        writer.writeCase(caseRow("a", 0));
    }
    {
        SQLite::Database database((folder.path() / "results.sqlite").string(), SQLite::OPEN_READWRITE);
        takeBackTo(database, 1);
    }
    const auto old = readRun(folder.path());
    EXPECT_EQ(old.schemaVersion, 1);
    ASSERT_EQ(old.cases.size(), 1u);
    {
        RunWriter writer(folder.path(), true);
        writer.writeCase(caseRow("b", 1));
        writer.writeAnalysis(analysed());
    }
    const auto read = readRun(folder.path());
    EXPECT_EQ(read.schemaVersion, kSchemaVersion);
    ASSERT_EQ(read.cases.size(), 2u);
    expectSame(caseRow("b", 1), read.cases[1]);
    expectAnalysed(read);
}

TEST(Store, WhatOlderSchemasLackedIsEmpty) {
    const TemporaryFolder folder;
    {
        RunWriter writer(folder.path(), false);
        writer.writeHeader(header());
        writer.writeCase(caseRow("a", 0));
    }
    {
        SQLite::Database database((folder.path() / "results.sqlite").string(), SQLite::OPEN_READWRITE);
        takeBackTo(database, 2);
    }
    const auto expectOld = [&](int version) {
        const auto run = readRun(folder.path());
        EXPECT_EQ(run.schemaVersion, version);
        ASSERT_EQ(run.scenarios.size(), 1u);
        EXPECT_EQ(run.scenarios[0].referenceFormula, header().scenarios[0].referenceFormula);
        EXPECT_EQ(run.scenarios[0].referenceTex, "");
        EXPECT_EQ(run.engines.at(0).capabilities, "");
        EXPECT_EQ(run.cases.at(0).refusal, "");
        const TimingRow& timing = run.cases.at(0).timings.at(0);
        EXPECT_EQ(timing.median, caseRow("a", 0).timings[0].median);
        EXPECT_EQ(timing.low, std::nullopt);
        EXPECT_EQ(timing.high, std::nullopt);
        EXPECT_EQ(timing.bodies, 0);
        EXPECT_EQ(run.cases[0].accuracy.grade, Grade::None);
        EXPECT_EQ(run.cases[0].regression, Regression::NoRecord);
        EXPECT_EQ(run.cases[0].orders.run, std::nullopt);
        EXPECT_EQ(run.cases[0].orders.worst, Grade::None);
        EXPECT_EQ(run.cases[0].metrics.at(0).orderCount, std::nullopt);
        EXPECT_EQ(run.cases[0].metrics.at(0).relative, std::nullopt);
        EXPECT_EQ(timing.mean, std::nullopt);
        EXPECT_EQ(timing.worst, std::nullopt);
        EXPECT_EQ(run.scenarios[0].referenceOutcome, "");
        EXPECT_TRUE(std::isnan(run.cases.at(0).metrics.at(1).value)) << "the text nan";
    };
    expectOld(2);
    { RunWriter(folder.path(), true); }
    expectOld(kSchemaVersion);
    { RunWriter(folder.path(), true).writeHeader(header()); }
    EXPECT_EQ(readRun(folder.path()).scenarios[0].referenceTex, header().scenarios[0].referenceTex);
    EXPECT_EQ(readRun(folder.path()).engines[0].capabilities, header().engines[0].capabilities);
}

TEST(Store, TheColumnsOfTheSchemaBeforeAreKept) {
    const TemporaryFolder folder;
    { RunWriter(folder.path(), false).writeHeader(header()); }
    {
        SQLite::Database database((folder.path() / "results.sqlite").string(), SQLite::OPEN_READWRITE);
        takeBackTo(database, 3);
    }
    { RunWriter(folder.path(), true); }
    const auto run = readRun(folder.path());
    EXPECT_EQ(run.schemaVersion, kSchemaVersion);
    EXPECT_EQ(run.scenarios.at(0).referenceTex, header().scenarios[0].referenceTex);
}

/// A store of schema 8 has all but the orders of insertion.
TEST(Store, OfSchema8HasEverythingButOrdersOfInsertion) {
    const TemporaryFolder folder;
    {
        RunWriter writer(folder.path(), false);
        writer.writeHeader(header());
        writer.writeCase(caseRow("a", 0));
    }
    {
        SQLite::Database database((folder.path() / "results.sqlite").string(), SQLite::OPEN_READWRITE);
        takeBackInsertionOrders(database);
        database.exec("PRAGMA user_version = 8");
    }
    CaseRow expected = caseRow("a", 0);
    expected.audit.at(0).findings = "";
    expected.orders = {};
    for (MetricRow& m : expected.metrics) {
        m.orderMin = m.orderMax = m.boundMin = {};
        m.orderCount = {};
    }
    expectSame(expected, readRun(folder.path()).cases.at(0));
    { RunWriter(folder.path(), true).writeCase(caseRow("b", 1)); }
    const auto run = readRun(folder.path());
    EXPECT_EQ(run.schemaVersion, kSchemaVersion);
    expectSame(expected, run.cases.at(0));
    expectSame(caseRow("b", 1), run.cases.at(1));
}

TEST(Store, OfSchema9HasEverythingButVerdictsOfOrders) {
    const TemporaryFolder folder;
    {
        RunWriter writer(folder.path(), false);
        writer.writeHeader(header());
        writer.writeCase(caseRow("a", 0));
    }
    {
        SQLite::Database database((folder.path() / "results.sqlite").string(), SQLite::OPEN_READWRITE);
        takeBackVerdictsOfOrders(database);
        database.exec("PRAGMA user_version = 9");
    }
    CaseRow expected = caseRow("a", 0);
    expected.audit.at(0).findings = "";
    expected.orders.failed = {};
    expected.orders.verdicts = "";
    expected.orders.dependence = OrderDependence::Unknown;
    expected.metrics.at(0).boundMin = {};
    expectSame(expected, readRun(folder.path()).cases.at(0));
    EXPECT_EQ(orderDependence(readRun(folder.path()).cases.at(0)), OrderDependence::Verdict)
        << "one of its orders did not complete";
    { RunWriter(folder.path(), true).writeCase(caseRow("b", 1)); }
    expectSame(expected, readRun(folder.path()).cases.at(0));
    expectSame(caseRow("b", 1), readRun(folder.path()).cases.at(1));
}

/// A store of schema 12 has lists of every case; before 15 there are no lower bounds.
TEST(Store, OfSchemas12And14LacksLowerBoundsAlone) {
    for (const int version : {12, 14}) {
        const TemporaryFolder folder;
        {
            RunWriter writer(folder.path(), false);
            writer.writeHeader(header());
            for (const int i : {0, 1}) writer.writeCase(caseRow(std::to_string(i), i));
            SQLite::Database database((folder.path() / "results.sqlite").string(), SQLite::OPEN_READWRITE);
            (version < 13 ? sample::takeBackSharedLists : sample::takeBackLowerBounds)(database);
            for (const char* id : {"0", "1"}) sealCase(database, id);
            database.exec("PRAGMA user_version = " + std::to_string(version));
        }
        for (const int read : {version, kSchemaVersion}) {
            const auto run = readRun(folder.path());
            EXPECT_EQ(run.schemaVersion, read);
            EXPECT_THAT(run.damage, testing::IsEmpty());
            ASSERT_EQ(run.cases.size(), 2u);
            for (const int i : {0, 1}) {
                CaseRow expected = caseRow(std::to_string(i), i);
                expected.metrics.at(0).boundMin = {};
                expectSame(expected, run.cases[i]);
            }
            { RunWriter(folder.path(), true); }
        }
    }
}

int countIn(const TemporaryFolder& folder, const std::string& table) {
    SQLite::Database database((folder.path() / "results.sqlite").string(), SQLite::OPEN_READONLY);
    return database.execAndGet("SELECT count(*) FROM " + table).getInt();
}

TEST(Store, EqualListsAreStoredOnce) {
    const TemporaryFolder folder;
    std::vector<CaseRow> rows;
    for (int i = 0; i < 5; ++i) rows.push_back(caseRow(std::to_string(i), i));
    rows[3].settings["iterations"] = "21";
    rows[3].readBack[0].found = 2.0;
    rows[3].readBack[1].error = sample::kNanValue;
    rows[4].ledger.clear();
    {
        RunWriter writer(folder.path(), false);
        writer.writeHeader(header());
        for (const CaseRow& row : rows) writer.writeCase(row);
        for (const CaseRow& row : rows) writer.writeCase(row);  // The audit writes every case again.
    }
    EXPECT_EQ(countIn(folder, "shared_settings"), 4);
    EXPECT_EQ(countIn(folder, "shared_ledger"), 1);
    EXPECT_EQ(countIn(folder, "shared_read_back"), 4);
    EXPECT_EQ(countIn(folder, "settings"), 10);
    EXPECT_EQ(countIn(folder, "ledger"), 4);
    EXPECT_EQ(countIn(folder, "read_back"), 10);
    const auto run = readRun(folder.path());
    ASSERT_EQ(run.cases.size(), 5u);
    for (int i = 0; i < 5; ++i) {
        expectSame("error", rows[i].readBack[1].error, run.cases[i].readBack[1].error);
        if (i != 3) expectSame(rows[i], run.cases[i]);
    }
    EXPECT_EQ(run.cases[3].settings, rows[3].settings);
    EXPECT_EQ(run.cases[3].readBack[0].found, 2.0);
}

TEST(Store, ListsGoWithTheirLastCase) {
    const TemporaryFolder folder;
    CaseRow other = caseRow("b", 1);
    other.settings = {{"solver", "pgs"}};
    RunWriter writer(folder.path(), false);
    writer.writeHeader(header());
    writer.writeCase(caseRow("a", 0));
    writer.writeCase(other);
    writer.keepOnly({"b"});
    EXPECT_EQ(countIn(folder, "shared_settings"), 1);
    EXPECT_EQ(countIn(folder, "shared_ledger"), 1) << "b has it still";
    expectSame(other, readRun(folder.path()).cases.at(0));
}

TEST(Store, OneWriterAtATime) {
    const TemporaryFolder folder;
    RunWriter first(folder.path(), false);
    EXPECT_THAT(refusal([&] { RunWriter(folder.path(), true); }), HasSubstr("another rigor"));
}

TEST(Store, RefusesANewerSchema) {
    const TemporaryFolder folder;
    { RunWriter(folder.path(), false).writeHeader(header()); }
    {
        SQLite::Database database((folder.path() / "results.sqlite").string(), SQLite::OPEN_READWRITE);
        database.exec("PRAGMA user_version = " + std::to_string(kSchemaVersion + 1));
    }
    EXPECT_THAT(refusal([&] { readRun(folder.path()); }), HasSubstr("newer rigor"));
    EXPECT_THAT(refusal([&] { RunWriter(folder.path(), true); }), HasSubstr("newer rigor"));
}

TEST(Store, DamagedFilesAreNamed) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "results.sqlite";
    std::ofstream(file) << "this is no database, though long enough to be looked at as if it were one";
    EXPECT_THAT(refusal([&] { readRun(folder.path()); }), HasSubstr(file.string()));
    std::filesystem::remove(file);
    {
        RunWriter writer(folder.path(), false);
        writer.writeHeader(header());
        for (int i = 0; i < 200; ++i) writer.writeCase(caseRow(std::to_string(i), i));
    }
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    EXPECT_THAT(refusal([&] { readRun(folder.path()); }), HasSubstr(file.string()));
    std::ofstream(file,
                  std::ios::trunc);  // an empty file is a valid, empty database without the mark of a store
    EXPECT_THAT(refusal([&] { readRun(folder.path()); }), HasSubstr("not a results store"));
}

/// kill -9 right after a case was written: everything that was returned is there, and the store opens again.
TEST(Store, WhatReturnedSurvivesAKill) {
    const TemporaryFolder folder;
    int ready[2];
    ASSERT_EQ(pipe(ready), 0);
    const pid_t child = fork();
    if (child == 0) {
        RunWriter writer(folder.path(), false);
        writer.writeHeader(header());
        for (int i = 0;; ++i) {
            writer.writeCase(caseRow(std::to_string(i), i));
            const char done = 'x';
            if (write(ready[1], &done, 1) != 1) _exit(1);
        }
    }
    close(ready[1]);
    char done[8];
    std::size_t written = 0;
    while (written < sizeof done) {
        const auto n = read(ready[0], done, sizeof done - written);
        ASSERT_GT(n, 0);
        written += n;
    }
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    close(ready[0]);
    ASSERT_TRUE(WIFSIGNALED(status));
    const auto run = readRun(folder.path());
    ASSERT_GE(run.cases.size(), written);
    for (std::size_t i = 0; i < run.cases.size(); ++i)
        expectSame(caseRow(std::to_string(i), i), run.cases[i]);
    EXPECT_NO_THROW(RunWriter(folder.path(), true).finishedCases());
}

TEST(Store, ManifestDescribesTheFolder) {
    const TemporaryFolder folder;
    RunWriter writer(folder.path(), false);
    writer.writeHeader(header());
    writer.finish("2026-01-01T00:01:00Z");
    const auto manifest = nlohmann::json::parse(std::ifstream(folder.path() / "manifest.json"));
    EXPECT_EQ(manifest.at("rigor_run"), kSchemaVersion);
    EXPECT_EQ(manifest.at("suite"), "smoke");
    EXPECT_EQ(manifest.at("finished"), "2026-01-01T00:01:00Z");
    EXPECT_TRUE(std::filesystem::exists(folder.path() / manifest.at("store").get<std::string>()));
}

TEST(Names, AreTheDocumentedOnesAndParseBack) {
    EXPECT_STREQ(outcomeName(Outcome::NonFinite), "non_finite");
    EXPECT_STREQ(verdictName(Verdict::KnownDeviation), "known deviation");
    for (int i = 0; i < 7; ++i) {
        EXPECT_EQ(parseOutcome(outcomeName(static_cast<Outcome>(i))), static_cast<Outcome>(i));
        EXPECT_EQ(parseVerdict(verdictName(static_cast<Verdict>(i))), static_cast<Verdict>(i));
    }
    EXPECT_THAT(refusal([] { parseVerdict("green"); }), HasSubstr("known deviation"));
}

}  // namespace
}  // namespace rigor::results
