// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A bench in the report: data of the page, tables, summary.
#include "reports/tables/bench.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/model/view_model.hpp"
#include "reports/page/html.hpp"
#include "reports/summaries/summary.hpp"
#include "reports/tests/find_table.hpp"
#include "reports/tests/synthetic_bench.hpp"
#include "reports/tests/synthetic_run.hpp"

namespace rigor::report {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(BenchReport, ThePageGetsWhatTheStoreHas) {
    const results::Run run = synthetic::makeBench();
    const Json json = benchJson(run);
    ASSERT_EQ(json.at("cases").size(), run.bench.cases.size());
    const Json& rigor = json.at("cases").at(1);
    EXPECT_EQ(rigor.at("engine"), "rigor:preset=matched");
    EXPECT_EQ(rigor.at("label"), "rigor");
    for (const Json& c : json.at("cases"))
        EXPECT_EQ(c.at("engine") == synthetic::kLengthySpec, c.at("label") == "rigor[1]");
    EXPECT_DOUBLE_EQ(rigor.at("time").get<double>(), 55e-6);
    EXPECT_DOUBLE_EQ(rigor.at("counts").at("contacts").get<double>(), 220.0);
    EXPECT_DOUBLE_EQ(rigor.at("allocations").get<double>(), 3.0);
    EXPECT_DOUBLE_EQ(rigor.at("memoryKiB").get<double>(), 2048.0);
    EXPECT_DOUBLE_EQ(rigor.at("phases").at("solve").get<double>(), 27.5e-6);
    const Json& threads = json.at("cases").at(2);
    EXPECT_DOUBLE_EQ(threads.at("time").get<double>(), threads.at("wall").get<double>());
    EXPECT_EQ(json.at("changes").size(), 3u);
    EXPECT_TRUE(benchJson(synthetic::makeRun(1)).is_null());
}

TEST(BenchReport, TheQualityShownIsThatWhichFailed) {
    const Json json = benchJson(synthetic::makeBench());
    for (const Json& c : json.at("cases"))
        if (c.at("engine") == "bullet:preset=matched") {
            EXPECT_FALSE(c.at("valid").get<bool>());
            EXPECT_DOUBLE_EQ(c.at("quality").at(0).at("value").get<double>(), 0.02);
            EXPECT_FALSE(c.at("quality").at(0).at("ok").get<bool>());
        }
}

TEST(BenchReport, TablesSayWhatIsNoTiming) {
    const results::Run run = synthetic::makeBench();
    const auto tables = benchTables(ViewModel(run));
    const Table& times = named(tables, "bench");
    ASSERT_EQ(times.rows.size(), run.bench.cases.size());
    for (const auto& row : times.rows) EXPECT_EQ(row.size(), times.columns.size());
    const std::string csv = tableCsv(times);
    EXPECT_THAT(csv, HasSubstr("invalid: max_penetration 0.02 m > 0.005"));
    EXPECT_THAT(csv, HasSubstr("invalid: crashed: SIGSEGV"));
    EXPECT_EQ(named(tables, "bench_changes").rows.size(), 3u);
    for (const char* name : {"bench_work", "bench_quality"}) {
        const Table& table = named(tables, name);
        EXPECT_FALSE(table.rows.empty());
        for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << name;
    }
    const results::Run plain = synthetic::makeRun(1);
    EXPECT_TRUE(benchTables(ViewModel(plain)).empty());
}

TEST(BenchReport, TheSummaryStrikesOutWhatIsInvalid) {
    const results::Run run = synthetic::makeBench();
    const std::string text = markdownSummary(ViewModel(run));
    EXPECT_THAT(text, HasSubstr("### Bench"));
    EXPECT_THAT(text, HasSubstr("~~1 ms~~"));
    EXPECT_THAT(text, HasSubstr("phase: moving boxes"));
    EXPECT_THAT(text, Not(HasSubstr("<b>dead</b>")));
    EXPECT_THAT(markdownSummary(ViewModel(synthetic::makeRun(1))), Not(HasSubstr("### Bench")));
}

TEST(BenchReport, APageWithoutCasesIsMade) {
    const results::Run run = synthetic::makeBench();
    const std::string page = htmlReport(ViewModel(run));
    EXPECT_THAT(page, HasSubstr("\"bench\":{"));
    EXPECT_THAT(page, Not(HasSubstr("<b>dead</b>")));
}

}  // namespace
}  // namespace rigor::report
