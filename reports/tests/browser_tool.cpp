// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Help for the tests of the page in a browser (web/tests/browser):
//   report_tool query FILE SQL    rows of a store as a JSON array of arrays, read by SQLite itself
//   report_tool bench FOLDER      the report of a synthetic bench
//   report_tool history FOLDER    the history of three synthetic runs, the last one with one worse case
//   report_tool large FOLDER      the synthetic run twice: its cases in the page, and beside it as those of a large run
//   report_tool synthetic FOLDER  the report of the synthetic run, with its bad endings, and of a synthetic study
#include <SQLiteCpp/SQLiteCpp.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "reports/encoding/data_files.hpp"
#include "reports/encoding/text.hpp"
#include "reports/model/view_model.hpp"
#include "reports/page/history.hpp"
#include "reports/page/html.hpp"
#include "reports/page/page_data.hpp"
#include "reports/plots/study.hpp"
#include "reports/replay/data.hpp"
#include "reports/report.hpp"
#include "reports/tests/synthetic_bench.hpp"
#include "reports/tests/synthetic_run.hpp"
#include "reports/tests/synthetic_study.hpp"
#include "validation/results/store.hpp"

namespace {

using namespace rigor::report;
namespace fs = std::filesystem;

int query(const std::string& file, const std::string& sql) {
    SQLite::Database database(file, SQLite::OPEN_READONLY);
    SQLite::Statement statement(database, sql);
    auto rows = nlohmann::json::array();
    while (statement.executeStep()) {
        auto row = nlohmann::json::array();
        for (int i = 0; i < statement.getColumnCount(); ++i) {
            const auto column = statement.getColumn(i);
            if (column.isNull())
                row.push_back(nullptr);
            else if (column.isInteger())
                row.push_back(column.getInt64());
            else if (column.isFloat())
                row.push_back(column.getDouble());
            else
                row.push_back(column.getString());
        }
        rows.push_back(row);
    }
    std::printf("%s\n", rows.dump().c_str());
    return 0;
}

nlohmann::ordered_json study() {
    auto rows = nlohmann::ordered_json::array(), bars = nlohmann::ordered_json::array();
    for (const char* variant : {"pgs", "tgs_soft"})
        for (const char* iterations : {"10", "20", "40"})
            rows.push_back(synthetic::studyRow("stack", variant, 0.01, {{"iterations", iterations}},
                                               {{"penetration_max", 1.0 / std::stod(iterations)}}));
    for (const char* variant : {"pgs", "tgs_soft", "xpbd"})
        bars.push_back(synthetic::studyRow("stack", variant, 0.01, {}, {{"penetration_max", 0.5}}));
    return {{"name", "solvers"},
            {"title", "Solvers side by side"},
            {"description", "What iterations buy."},
            {"findings", nlohmann::ordered_json::array()},
            {"symptoms", nlohmann::ordered_json::array()},
            {"parts", {synthetic::studyPart("sweep", rows), synthetic::studyPart("bars", bars)}}};
}

int synthesise(const fs::path& folder) {
    auto run = synthetic::makeRun();
    run.finished.clear();
    run.plannedCases += 7;  // broken off
    const ViewModel view(run);
    const auto load = synthetic::makeLoader(run);
    fs::create_directories(folder / "data");
    writeFile(folder / "index.html", htmlReport(view, studyPageJson(study())));
    const auto write = [&](const std::string& name, const std::string& content) {
        writeFile(folder / "data" / (name + ".js"), dataFile(name, content));
    };
    ReplayBudget budget = replayBudget(view);
    for (std::size_t i = 0; i < run.scenarios.size(); ++i) {
        write("scenario-" + std::to_string(i), scenarioJson(view, i, load));
        replayFiles(view, i, load, budget, write);
    }
    return 0;
}

int synthesiseLarge(const fs::path& folder) {
    const auto run = synthetic::makeRun();
    const auto write = [&](const char* name, const ReportLimits& limits) {
        {
            rigor::results::RunWriter writer(folder / name, false);
            writer.writeHeader(run);
            for (const auto& row : run.cases) writer.writeCase(row);
        }
        writeReports(folder / name, nullptr, limits);
    };
    write("whole", {});
    write("beside", {.casesInPage = 1});
    return 0;
}

int synthesiseBench(const fs::path& folder) {
    fs::create_directories(folder);
    writeFile(folder / "index.html", htmlReport(ViewModel(synthetic::makeBench())));
    return 0;
}

/// The record of `rigor compare --json` on the change below, beside fourteen small ones and a case that its engine does
/// not support any more.
std::string changeOf(const rigor::results::CaseRow& c, const rigor::results::MetricRow& m) {
    using nlohmann::json;
    const json place{{"scenario", c.scenario}, {"spec", c.spec}, {"dt", c.dt}};
    const auto metricOf = [&](const std::string& name, double factor) {
        json metric = place;
        metric.update({{"metric", name},
                       {"unit", m.unit},
                       {"before", m.value},
                       {"after", factor * m.value},
                       {"worse", true},
                       {"better", false},
                       {"size", std::log(factor)}});
        return metric;
    };
    json spec{{"name", c.spec}, {"cases", 20}, {"better", 0}, {"worse", 15}, {"same", 19}};
    spec.update({{"cases_better", 0}, {"cases_worse", 1}, {"p_cases", 1.0}});
    spec.update({{"timed", 20}, {"time_ratio", 1.2}, {"time_interval", {1.1, 1.3}}, {"p_time", 0.02}});
    json verdict = place;
    verdict.update({{"before", "pass"},
                    {"after", "unsupported"},
                    {"worse", false},
                    {"better", false},
                    {"reason", "no such joint"}});
    json change{
        {"worse", true}, {"specs", {spec}}, {"metrics", {metricOf(m.name, 4.0)}}, {"verdicts", {verdict}}};
    for (int i = 0; i < 14; ++i) change["metrics"].push_back(metricOf("metric_" + std::to_string(i), 1.1));
    for (const char* key : {"changed_scenarios", "only_before", "only_after", "unpaired", "environment"})
        change[key] = json::array();
    return change.dump();
}

int synthesiseHistory(const fs::path& folder) {
    std::vector<rigor::results::Run> runs(3, synthetic::makeRun());
    const char* const names[] = {"monday", "tuesday", "wednesday"};
    for (std::size_t i = 0; i < runs.size(); ++i) runs[i].directory = names[i];
    std::string change;
    const ViewModel view(runs[1]);
    for (auto& c : runs[2].cases) {
        if (c.outcome != rigor::results::Outcome::Completed || c.timings.empty()) continue;
        std::size_t scenario = 0;
        while (runs[2].scenarios[scenario].name != c.scenario) ++scenario;
        const auto* main = findMetric(c, view.mainMetric(scenario).name);
        if (main == nullptr || !(main->value > 0.0)) continue;
        change = changeOf(c, *main);
        for (auto& m : c.metrics)
            if (m.name == main->name) m.value *= 4.0;
        for (auto& t : c.timings) {
            t.median *= 2.0;
            if (t.low) *t.low *= 2.0;
            if (t.high) *t.high *= 2.0;
        }
        break;
    }
    fs::create_directories(folder);
    writeFile(folder / "index.html", historyPage(runs, {"", change}));
    return 0;
}

}  // namespace

int main(int count, char** arguments) {
    try {
        const std::string what = count > 2 ? arguments[1] : "";
        if (what == "query" && count == 4) return query(arguments[2], arguments[3]);
        if (what == "synthetic" && count == 3) return synthesise(arguments[2]);
        if (what == "large" && count == 3) return synthesiseLarge(arguments[2]);
        if (what == "bench" && count == 3) return synthesiseBench(arguments[2]);
        if (what == "history" && count == 3) return synthesiseHistory(arguments[2]);
        std::fputs(
            "report_tool query FILE SQL | large FOLDER | synthetic FOLDER | bench FOLDER | history FOLDER\n",
            stderr);
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "report_tool: %s\n", error.what());
        return 1;
    }
}
