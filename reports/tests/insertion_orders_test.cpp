// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tests of every format: cases whose result depends on the order of insertion, and the costs of steps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "reports/encoding/text.hpp"
#include "reports/model/view_model.hpp"
#include "reports/page/page_data.hpp"
#include "reports/summaries/summary.hpp"
#include "reports/summaries/terminal.hpp"
#include "reports/tables/costs.hpp"
#include "reports/tables/csv.hpp"
#include "reports/tables/table.hpp"
#include "reports/tests/csv_reader.hpp"
#include "reports/tests/synthetic_run.hpp"
#include "validation/results/insertion_orders.hpp"

namespace rigor::report {
namespace {

using results::CaseRow;
using results::Grade;
using results::MetricRow;

using testing::HasSubstr;
using testing::Not;

MetricRow ranged(double least, double greatest, std::optional<double> scale) {
    MetricRow m;
    m.name = "rest_creep";
    m.unit = "m";
    m.value = least;
    m.orderMin = least;
    m.orderMax = greatest;
    m.orderCount = 5;
    m.scale = scale;
    return m;
}

/// One scenario in one order, but for what the test gives it.
results::Run plainRun() {
    results::Run run = synthetic::makeRun(1);
    run.bench = {};
    std::erase_if(run.cases, [&](const CaseRow& c) { return c.outcome != results::Outcome::Completed; });
    return run;
}

/// The first case of the engine "ode" was run in five orders.
CaseRow& orderedCase(results::Run& run, double least, double greatest) {
    for (CaseRow& c : run.cases) {
        if (c.engine != "ode") continue;
        MetricRow m = ranged(least, greatest, 1.0);
        m.value = 0.0031;
        c.metrics.push_back(m);
        c.accuracy.grade = Grade::C;
        c.orders = {5, 5, Grade::C, greatest > 0.01 ? Grade::D : Grade::C, ""};
        return c;
    }
    throw std::runtime_error("no case of ode");
}

TEST(DependsOnOrder, WhereTheRangeIsWiderThanRounding) {
    EXPECT_FALSE(results::dependsOnOrder(ranged(1.0, 1.0 + 1.9e-6, 2.0)));
    EXPECT_TRUE(results::dependsOnOrder(ranged(1.0, 1.0 + 2.1e-6, 2.0)));
    EXPECT_FALSE(results::dependsOnOrder(ranged(1e-12, 9e-7, {}))) << "of one unit";
    EXPECT_TRUE(results::dependsOnOrder(ranged(1e-12, 2e-6, {})));
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(results::dependsOnOrder(ranged(1.0, infinite, 1.0)));
    EXPECT_FALSE(results::dependsOnOrder(ranged(infinite, infinite, 1.0)));
    EXPECT_FALSE(results::dependsOnOrder(MetricRow{}));
}

TEST(InsertionOrders, ARangeIsShownByEveryFormat) {
    results::Run run = plainRun();
    const CaseRow& c = orderedCase(run, 0.0027, 0.053);
    const ViewModel view(run);
    const std::string range = "0.0027 … 0.053 m over 5 orders";
    EXPECT_EQ(orderRangeText(c.metrics.back()), range);

    const std::string terminal = terminalSummary(run, 60, 200, false);
    EXPECT_THAT(
        terminal,
        HasSubstr("Depends on the order of insertion (1 of 1 case run in several orders: ↕ 1 in grade)"));
    EXPECT_THAT(terminal, HasSubstr("order of insertion: 1 of 1 case order-dependent (↕ 1 in grade)"));
    EXPECT_THAT(terminal,
                HasSubstr("rest_creep 0.0031 as written, " + range + "; grade C as written, C … D"));

    const std::string summary = markdownSummary(view);
    EXPECT_THAT(summary,
                HasSubstr("| " + markdownCell("rest_creep") + " | 0.0031 | " + range + " | C, C … D |"));
    EXPECT_THAT(
        orderSentence(c),
        HasSubstr("over 5 orders rest_creep is 0.0027 … 0.053 m (0.0031 as written), its grade C … D"));

    const auto csv = parseCsv(csvReport(run));
    const auto column = [&](const std::string& name) {
        return static_cast<std::size_t>(std::find(csv[0].begin(), csv[0].end(), name) - csv[0].begin());
    };
    int found = 0;
    for (const auto& line : csv) {
        ASSERT_EQ(line.size(), csv[0].size());
        if (line[column("metric")] != "rest_creep" || line[column("order_count")] != "5") continue;
        EXPECT_EQ(std::stod(line[column("order_min")]), 0.0027);
        EXPECT_EQ(std::stod(line[column("order_max")]), 0.053);
        EXPECT_EQ(line[column("command")], c.command);
        ++found;
    }
    EXPECT_EQ(found, 1);

    const auto page =
        nlohmann::json::parse(scenarioJson(view, 0, [](const CaseRow&) { return std::nullopt; }));
    bool shown = false;
    for (const auto& entry : page.at("cases")) {
        if (entry.at("id") != c.id) {
            EXPECT_TRUE(entry.at("judged").at("orders").is_null());
            continue;
        }
        EXPECT_EQ(entry.at("judged").at("orders").at("worst"), "D");
        const auto& metric = entry.at("metrics").back();
        EXPECT_EQ(metric.at("orderMax"), 0.053);
        EXPECT_EQ(metric.at("orderCount"), 5);
        shown = metric.at("dependsOnOrder").get<bool>();
    }
    EXPECT_TRUE(shown);

    const auto overview = nlohmann::json::parse(overviewJson(view)).at("insertionOrders");
    EXPECT_EQ(overview.at("heading"), ordersHeading(run, 1));
    ASSERT_EQ(overview.at("rows").size(), 1u);
    const auto& shownRow = overview.at("rows").at(0);
    EXPECT_EQ(shownRow.at("spec"), c.spec);
    EXPECT_EQ(shownRow.at("value"), 0.0031);
    EXPECT_EQ(shownRow.at("least"), 0.0027);
    EXPECT_EQ(shownRow.at("greatest"), 0.053);
    EXPECT_EQ(shownRow.at("worst"), "D");
    EXPECT_TRUE(nlohmann::json::parse(overviewJson(ViewModel(plainRun()))).at("insertionOrders").is_null())
        << "every case in one order: the page has no such section";

    for (const Table& table : allTables(view))
        if (table.name == "insertion_orders") {
            EXPECT_EQ(table.rows.size(), 1u);
        }
}

TEST(InsertionOrders, WhatIsTheSameInAllOfThemIsSaidToBe) {
    results::Run run = plainRun();
    const CaseRow& c = orderedCase(run, 0.0031, 0.0031);
    EXPECT_THAT(terminalSummary(run, 60, 200, false),
                HasSubstr("No result depends on the order of insertion (1 case run in several orders)"));
    EXPECT_THAT(markdownSummary(ViewModel(run)), HasSubstr("No result depends on the order of insertion"));
    EXPECT_EQ(orderSentence(c), "Does not depend on the order of insertion (5 orders).");
    EXPECT_TRUE(orderDependents(run).empty());
}

TEST(InsertionOrders, AnOrderThatCrashesIsReported) {
    results::Run run = plainRun();
    CaseRow& c = orderedCase(run, 0.0031, 0.0031);
    c.orders.completed = 4;
    c.orders.worst = Grade::E;
    c.orders.note = "order 3: crashed (SIGABRT)";
    EXPECT_THAT(terminalSummary(run, 60, 200, false),
                HasSubstr("grade C as written, C … E; order 3: crashed (SIGABRT)"));
    EXPECT_THAT(orderSentence(c), HasSubstr("order 3: crashed (SIGABRT)"));
}

/// The case passes as written, and two of its five orders miss a bound.
TEST(InsertionOrders, OrdersThatDisagreeAboutTheVerdictAreCountedByEveryFormat) {
    results::Run run = plainRun();
    CaseRow& c = orderedCase(run, 0.0031, 0.0031);
    c.orders.failed = 2;
    c.orders.verdicts = "pass 3, fail 2";
    c.orders.note = "order 3: fails rest_creep (0.4, bound 0.1); order 5: fails rest_creep (0.2, bound 0.1)";
    const ViewModel view(run);
    const std::string counts = "1 of 1 case order-dependent (⇅ 1 in verdict)";
    EXPECT_THAT(terminalSummary(run, 60, 200, false), HasSubstr("order of insertion: " + counts));
    EXPECT_THAT(terminalSummary(run, 60, 200, false), HasSubstr("2 of 5 orders fail (pass 3, fail 2)"));
    EXPECT_THAT(markdownSummary(view), HasSubstr("- order of insertion: " + counts));
    EXPECT_THAT(markdownSummary(view), HasSubstr("⇅ verdict"));
    EXPECT_STREQ(orderMark(c), "⇅");
    const auto csv = parseCsv(csvReport(run));
    const auto column = [&](const std::string& name) {
        return static_cast<std::size_t>(std::find(csv[0].begin(), csv[0].end(), name) - csv[0].begin());
    };
    int found = 0;
    for (const auto& line : csv) {
        if (line[column("order_dependent")] != "verdict") continue;
        EXPECT_EQ(line[column("orders_failed")], "2");
        EXPECT_EQ(line[column("orders")], "5");
        ++found;
    }
    EXPECT_EQ(found, static_cast<int>(c.metrics.size()));
    const auto overview = nlohmann::json::parse(overviewJson(view));
    EXPECT_EQ(overview.at("insertionOrders").at("rows").at(0).at("dependence"), "verdict");
    EXPECT_EQ(overview.at("insertionOrders").at("rows").at(0).at("verdicts"),
              "2 of 5 orders fail (pass 3, fail 2)");
}

TEST(InsertionOrders, OtherVerdictsThatAreNoFailuresAreNotCalledSo) {
    results::Run run = plainRun();
    CaseRow& c = orderedCase(run, 0.0031, 0.0031);
    c.orders.failed = 0;
    c.orders.verdicts = "pass 1, known deviation 4";
    EXPECT_THAT(orderSentence(c), HasSubstr("orders end in other verdicts (pass 1, known deviation 4)"));
}

/// Another order has numbers where the order as written has none.
TEST(InsertionOrders, TheRangeOfACaseThatDoesNotCompleteIsShown) {
    results::Run run = plainRun();
    CaseRow& c = orderedCase(run, 0.0031, 0.0053);
    c.outcome = results::Outcome::Crashed;
    c.verdict = results::Verdict::Crashed;
    c.metrics.back().value = std::nan("");
    c.metrics = {c.metrics.back()};
    c.orders.completed = 4;
    c.orders.failed = 1;
    c.orders.verdicts = "pass 4, crashed 1";
    EXPECT_THAT(orderSentence(c), HasSubstr("rest_creep is 0.0031 … 0.0053 m (no value as written)"));
    EXPECT_THAT(orderSentence(c), HasSubstr("1 of 5 orders fails (pass 4, crashed 1)"));
    EXPECT_THAT(markdownSummary(ViewModel(run)), HasSubstr("| no value | 0.0031 … 0.0053 m over 5 orders |"));
}

TEST(InsertionOrders, NothingIsSaidWhereOneOrderWasRun) {
    const results::Run run = plainRun();
    for (const std::string& text : {terminalSummary(run, 60, 200, false), markdownSummary(ViewModel(run))}) {
        EXPECT_THAT(text, Not(HasSubstr("order of insertion (")));
        EXPECT_THAT(text, Not(HasSubstr("Depends on the order")));
    }
    EXPECT_EQ(orderSentence(run.cases.front()), "");
}

TEST(StepCosts, MedianAndMeanStandSideBySide) {
    results::Run run = plainRun();
    for (CaseRow& c : run.cases)
        for (auto& t : c.timings) {
            if (t.phase != "step") continue;
            const double factor = c.engine == "ode" ? 2.0 : 1.0;
            t.median = 1e-5 * factor;
            t.mean = 3e-5 * factor * factor;
            t.first = 4e-3;
            t.p95 = 5e-5;
            t.p99 = 6e-5;
            t.worst = 7e-5;
            t.realTimeFactor = 500.0;
        }
    const ViewModel view(run);
    const auto costs = stepCosts(view);
    for (std::size_t i = 0; i < costs.size(); ++i) {
        if (costs[i].scenarios == 0) continue;
        const double factor = view.columns()[i].engine == "ode" ? 2.0 : 1.0;
        EXPECT_NEAR(costs[i].median, 1e-5 * factor, 1e-18);
        EXPECT_NEAR(costs[i].mean, 3e-5 * factor * factor, 1e-18);
        EXPECT_NEAR(costs[i].medianRatio, factor, 1e-12);
        EXPECT_NEAR(costs[i].meanRatio, factor * factor, 1e-12) << "a mean hides what a median does not";
        EXPECT_EQ(costs[i].first, 4e-3);
        EXPECT_EQ(costs[i].worst, 7e-5);
    }
    const auto order = byCost(costs);
    ASSERT_FALSE(order.empty());
    EXPECT_EQ(view.columns()[order.back()].engine, "ode");
    EXPECT_THAT(costMarkdown(view),
                HasSubstr("| 20 µs | 120 µs | 4 ms | 50 µs | 60 µs | 70 µs | 500 | 2x | 4x |"));
    EXPECT_THAT(
        terminalSummary(run, 60, 200, false),
        HasSubstr("median 10 µs    mean 30 µs    first 4 ms     p95 50 µs    p99 60 µs    worst 70 µs    "
                  "500x real time"));
}

TEST(StepCosts, TimesOfDifferentClocksAreNeverInOneRatio) {
    results::Run run = plainRun();
    for (auto& engine : run.engines)
        if (engine.name == "ode") engine.capabilities = R"({"clock": "guest, wasm"})";
    for (CaseRow& c : run.cases)
        for (auto& t : c.timings)
            if (t.phase == "step") t.median = c.engine == "ode" ? 1e-9 : 1e-5;
    const ViewModel view(run);
    const auto costs = stepCosts(view);
    const Mechanism overall = view.overall();
    for (std::size_t i = 0; i < costs.size(); ++i) {
        if (costs[i].scenarios == 0) continue;
        EXPECT_NEAR(costs[i].medianRatio, 1.0, 1e-12) << view.columns()[i].label;
        EXPECT_NEAR(overall.rankings[i].costRatio, 1.0, 1e-12) << view.columns()[i].label;
    }
    const auto order = byCost(costs);
    ASSERT_FALSE(order.empty());
    EXPECT_EQ(view.columns()[order.back()].engine, "ode") << "modules come first, though slower";
    EXPECT_THAT(costMarkdown(view), HasSubstr("(guest, wasm) |"));
}

}  // namespace
}  // namespace rigor::report
