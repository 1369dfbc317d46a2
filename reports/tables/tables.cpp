// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The tables of a run and what stands in them.
#include <algorithm>
#include <cmath>
#include <map>

#include "reports/encoding/text.hpp"
#include "reports/model/view_model.hpp"
#include "reports/tables/bench.hpp"
#include "reports/tables/table.hpp"
#include "validation/results/insertion_orders.hpp"

namespace rigor::report {
namespace {

using results::CaseRow;

/// Titles of the first columns of every table that has a row for each case.
std::vector<TableColumn> caseColumns() {
    return {{"scenario"}, {"engine"}, {"preset"}, {"options"}, {"dt", ColumnKind::TimeStep, "s"}};
}

std::vector<TableCell> caseCells(const SpecColumn& column, const CaseRow& row) {
    return {row.scenario, column.engine, column.preset, column.options, row.dt};
}

TableCell judged(const CaseRow& row, const results::MetricRow* metric, Shown verdict) {
    TableCell cell;
    cell.verdict = verdict;
    const bool lost = verdict == Shown::Crashed || verdict == Shown::Timeout || verdict == Shown::NonFinite;
    if (metric != nullptr && !lost && row.outcome == results::Outcome::Completed) {
        cell.number = metric->value;
        cell.bound = metric->bound;
        cell.boundMin = metric->boundMin;
    }
    return cell;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

/// Calls `use` with the column and the row of every case, in the order of the report.
template <class Use>
void forEachCase(const ViewModel& view, Use use) {
    for (std::size_t s = 0; s < view.run().scenarios.size(); ++s)
        for (std::size_t c = 0; c < view.columns().size(); ++c)
            for (const auto* row : view.cell(s, c).cases) use(s, view.columns()[c], *row);
}

// ---- accuracy by scenario and engine ----

std::vector<Table> scoreboard(const ViewModel& view) {
    Table table{"scoreboard",
                "Main metric of every scenario at the finest time step, with the worst verdict over all time "
                "steps",
                {{"scenario"}, {"isolates"}, {"dimension"}, {"metric"}, {"unit"}},
                {}};
    for (const auto& column : view.columns()) table.columns.push_back({column.label, ColumnKind::Judged});
    for (std::size_t s = 0; s < view.run().scenarios.size(); ++s) {
        const auto& scenario = view.run().scenarios[s];
        const MainMetric& main = view.mainMetric(s);
        std::vector<TableCell> row{scenario.name, joined(scenario.isolates),
                                   std::to_string(scenario.dimension) + "D", main.name, main.unit};
        for (std::size_t c = 0; c < view.columns().size(); ++c) {
            const Cell& cell = view.cell(s, c);
            row.push_back(
                cell.cases.empty()
                    ? TableCell()
                    : judged(*cell.cases.front(), findMetric(*cell.cases.front(), main.name), cell.worst));
        }
        table.rows.push_back(row);
    }
    return {table};
}

std::vector<Table> trust(const ViewModel& view) {
    Table table{
        "trust",
        "Who to trust for what: scenarios that isolate a mechanism, by grade of accuracy at the finest time "
        "step, and the geometric mean of the main error over the best engine's and over the in-house one's",
        {{"mechanism"},
         {"engine"},
         {"preset"},
         {"options"},
         {"scenarios", ColumnKind::Number},
         {"A", ColumnKind::Number},
         {"B", ColumnKind::Number},
         {"C", ColumnKind::Number},
         {"D", ColumnKind::Number},
         {"E", ColumnKind::Number},
         {"not graded", ColumnKind::Number},
         {"lost", ColumnKind::Number},
         {"farther than its scheme", ColumnKind::Number},
         {"error over the best", ColumnKind::Number},
         {"error over ours", ColumnKind::Number},
         {"first choice"}},
        {}};
    for (const auto& m : view.mechanisms())
        for (const std::size_t c : m.order) {
            const auto& column = view.columns()[c];
            const Ranking& s = m.rankings[c];
            const auto count = [](int n) { return TableCell(static_cast<std::int64_t>(n)); };
            const auto times = [](double ratio) {
                return std::isnan(ratio) ? TableCell() : TableCell(ratio);
            };
            std::vector<TableCell> row{m.name, column.engine, column.preset, column.options,
                                       count(s.scenarios)};
            for (const int n : s.grades) row.push_back(count(n));
            for (const int n : {s.ungraded, s.lost, s.farther}) row.push_back(count(n));
            for (const double ratio : {s.toBest, s.toOurs}) row.push_back(times(ratio));
            row.push_back(static_cast<int>(c) == m.best ? "yes" : "");
            table.rows.push_back(row);
        }
    return {table};
}

/// One row for each case: what it claims.
std::vector<Table> accuracy(const ViewModel& view) {
    Table table{
        "accuracy",
        "Grade of accuracy of every case, what it rests on, what an ideal run of the engine's scheme would "
        "have, the error beside other engines', and the change against the record",
        caseColumns(),
        {}};
    for (const char* title : {"grade", "metric"}) table.columns.push_back({title});
    for (const char* title : {"relative error", "of its scheme"})
        table.columns.push_back({title, ColumnKind::Number});
    table.columns.push_back({"beside its scheme"});
    for (const char* title : {"over the best", "over ours"})
        table.columns.push_back({title, ColumnKind::Number});
    for (const char* title : {"against the record", "change"}) table.columns.push_back({title});
    forEachCase(view, [&](std::size_t, const SpecColumn& column, const CaseRow& row) {
        const auto& a = row.accuracy;
        auto cells = caseCells(column, row);
        const auto number = [](double x) { return std::isnan(x) ? TableCell() : TableCell(x); };
        cells.emplace_back(results::gradeName(a.grade));
        cells.emplace_back(a.metric);
        cells.emplace_back(a.relative);
        cells.emplace_back(a.ideal);
        cells.emplace_back(results::againstSchemeName(results::againstScheme(a.relative, a.ideal)));
        cells.push_back(number(view.ratios(row).toBest));
        cells.push_back(number(view.ratios(row).toOurs));
        cells.emplace_back(results::regressionName(row.regression));
        cells.emplace_back(row.regressionReason);
        table.rows.push_back(cells);
    });
    return {table};
}

std::vector<Table> metricsOfScenarios(const ViewModel& view) {
    std::vector<Table> tables;
    for (std::size_t s = 0; s < view.run().scenarios.size(); ++s) {
        const auto& scenario = view.run().scenarios[s];
        Table table{scenarioTableName(scenario),
                    scenario.name + ": every metric of the whole scene, with verdict and bound",
                    {{"dt", ColumnKind::TimeStep, "s"}, {"metric"}, {"kind"}, {"unit"}},
                    {},
                    true};
        std::map<std::pair<double, std::string>, std::vector<TableCell>> rows;
        std::vector<std::pair<double, std::string>> order;
        for (std::size_t c = 0; c < view.columns().size(); ++c) {
            const auto& cases = view.cell(s, c).cases;
            if (std::all_of(cases.begin(), cases.end(), [](const auto* row) { return row->metrics.empty(); }))
                continue;  // an engine that does not take part
            table.columns.push_back({view.columns()[c].label, ColumnKind::Judged});
            for (const auto* row : cases)
                for (const auto& m : row->metrics) {
                    if (!m.subject.empty()) continue;
                    auto& cells = rows[{row->dt, m.name}];
                    if (cells.empty()) {
                        cells = {row->dt, m.name, m.kind, m.unit};
                        order.emplace_back(row->dt, m.name);
                    }
                    cells.resize(table.columns.size() - 1);
                    cells.push_back(m.value);
                    if (m.bound || m.expectation) cells.back().verdict = shownOf(m);
                    cells.back().bound = m.bound;
                    cells.back().boundMin = m.boundMin;
                }
        }
        std::stable_sort(order.begin(), order.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        for (const auto& key : order) {
            rows[key].resize(table.columns.size());
            table.rows.push_back(rows[key]);
        }
        tables.push_back(table);
    }
    return tables;
}

/// One row for each metric of the whole scene in each case that was run in several orders.
std::vector<Table> insertionOrders(const ViewModel& view) {
    Table table{"insertion_orders",
                "Least and greatest value over the orders in which bodies, shapes, joints and forces were "
                "handed over; value and grade are of the order as written",
                caseColumns(),
                {}};
    for (const char* title : {"metric", "unit"}) table.columns.push_back({title});
    for (const char* title : {"value", "least", "greatest", "orders with a value", "orders", "completed"})
        table.columns.push_back({title, ColumnKind::Number});
    for (const char* title : {"depends on the order", "grade", "best grade", "worst grade", "verdict",
                              "verdicts", "order-dependent", "note"})
        table.columns.push_back({title});
    forEachCase(view, [&](std::size_t, const SpecColumn& column, const CaseRow& row) {
        if (!row.orders.run) return;
        for (const auto& m : row.metrics) {
            if (!m.subject.empty() || !m.orderCount) continue;
            auto cells = caseCells(column, row);
            for (const auto& text : {m.name, m.unit}) cells.emplace_back(text);
            cells.emplace_back(m.value);
            cells.emplace_back(m.orderMin);
            cells.emplace_back(m.orderMax);
            for (const std::int64_t n : {*m.orderCount, *row.orders.run, row.orders.completed.value_or(0)})
                cells.emplace_back(n);
            cells.emplace_back(results::dependsOnOrder(m) ? "yes" : "no");
            for (const auto grade : {row.accuracy.grade, row.orders.best, row.orders.worst})
                cells.emplace_back(results::gradeName(grade));
            cells.emplace_back(results::verdictName(row.verdict));
            cells.emplace_back(row.orders.verdicts);
            cells.emplace_back(results::orderDependenceName(results::orderDependence(row)));
            cells.emplace_back(row.orders.note);
            table.rows.push_back(cells);
        }
    });
    return {table};
}

// ---- what it cost ----

std::vector<TableColumn> timingColumns() {
    return {{"median", ColumnKind::Duration, "s"},   {"low", ColumnKind::Duration, "s"},
            {"high", ColumnKind::Duration, "s"},     {"p10", ColumnKind::Duration, "s"},
            {"p90", ColumnKind::Duration, "s"},      {"total", ColumnKind::Duration, "s"},
            {"samples", ColumnKind::Number},         {"first", ColumnKind::Duration, "s"},
            {"mean", ColumnKind::Duration, "s"},     {"p95", ColumnKind::Duration, "s"},
            {"p99", ColumnKind::Duration, "s"},      {"worst", ColumnKind::Duration, "s"},
            {"real-time factor", ColumnKind::Number}};
}

void appendTiming(std::vector<TableCell>& cells, const results::TimingRow& t) {
    for (const TableCell& cell :
         {TableCell(t.median), TableCell(t.low), TableCell(t.high), TableCell(t.p10), TableCell(t.p90),
          TableCell(t.total), TableCell(t.samples), TableCell(t.first), TableCell(t.mean), TableCell(t.p95),
          TableCell(t.p99), TableCell(t.worst), TableCell(t.realTimeFactor)})
        cells.push_back(cell);
}

std::vector<Table> timing(const ViewModel& view) {
    Table table{
        "timing",
        "Wall time of a step with the 95 % interval of its median, beside the accuracy of the same run",
        caseColumns(),
        {}};
    table.columns.push_back({"bodies", ColumnKind::Number});
    table.columns.push_back({"mean contacts", ColumnKind::Number});
    for (const auto& column : timingColumns()) table.columns.push_back(column);
    table.columns.push_back({"metric"});
    table.columns.push_back({"unit"});
    table.columns.push_back({"value", ColumnKind::Judged});
    forEachCase(view, [&](std::size_t s, const SpecColumn& column, const CaseRow& row) {
        const auto* step = stepTiming(row);
        if (step == nullptr) return;
        auto cells = caseCells(column, row);
        cells.emplace_back(step->bodies);
        cells.emplace_back(step->meanContacts);
        appendTiming(cells, *step);
        const MainMetric& main = view.mainMetric(s);
        cells.emplace_back(main.name);
        cells.emplace_back(main.unit);
        cells.push_back(judged(row, findMetric(row, main.name), shownOf(row)));
        table.rows.push_back(cells);
    });
    return {table};
}

std::vector<Table> phases(const ViewModel& view) {
    Table table{"phases", "Phases of a step, as far as the engines report them", caseColumns(), {}};
    table.columns.push_back({"phase"});
    for (const auto& column : timingColumns()) table.columns.push_back(column);
    forEachCase(view, [&](std::size_t, const SpecColumn& column, const CaseRow& row) {
        for (const auto& t : row.timings) {
            if (t.phase == "step") continue;
            auto cells = caseCells(column, row);
            cells.emplace_back(t.phase);
            appendTiming(cells, t);
            table.rows.push_back(cells);
        }
    });
    return {table};
}

// ---- contacts and parity ----

std::vector<TableColumn> auditColumns() {
    return {{"frames", ColumnKind::Number},
            {"queries", ColumnKind::Number},
            {"overlapping", ColumnKind::Number},
            {"missed", ColumnKind::Number},
            {"spurious", ColumnKind::Number},
            {"undecided", ColumnKind::Number},
            {"normal error", ColumnKind::Number, "rad"},
            {"depth error", ColumnKind::Number, "m"},
            {"point error", ColumnKind::Number, "m"},
            {"worst normal at"},
            {"note"}};
}

void appendAudit(std::vector<TableCell>& cells, const results::AuditRow& a) {
    for (const std::int64_t n : {a.frames, a.queries, a.overlapping, a.missed, a.spurious, a.undecided})
        cells.emplace_back(n);
    for (const auto& error : {a.normalErrorMax, a.depthErrorMax, a.pointErrorMax}) cells.emplace_back(error);
    cells.emplace_back(a.worst);
    cells.emplace_back(a.note);
}

std::vector<Table> audit(const ViewModel& view) {
    Table table{"audit",
                "Contact audit: collision engines queried at the poses of all runs of a scenario, greatest "
                "errors against the exact oracle",
                {{"scenario"}, {"auditor"}, {"outcome"}},
                {}};
    for (const auto& column : auditColumns()) table.columns.push_back(column);
    for (const auto& [scenario, rows] : gatherAudit(view.run()))
        for (const auto& a : rows) {
            std::vector<TableCell> cells{scenario, a.auditor, a.outcome};
            appendAudit(cells, a);
            table.rows.push_back(cells);
        }
    return {table};
}

std::vector<Table> contactsOfRuns(const ViewModel& view) {
    Table table{"contacts",
                "The contacts that each run itself acted upon, greatest errors against the exact oracle",
                caseColumns(),
                {}};
    for (const auto& column : auditColumns()) table.columns.push_back(column);
    forEachCase(view, [&](std::size_t, const SpecColumn& column, const CaseRow& row) {
        for (const auto& a : row.audit) {
            if (a.auditor != "in_run") continue;
            auto cells = caseCells(column, row);
            appendAudit(cells, a);
            table.rows.push_back(cells);
        }
    });
    return {table};
}

std::vector<Table> ledger(const ViewModel& view) {
    Table table{"ledger",
                "Parity ledger: the requested value, what the engine really does, and why they differ",
                {{"engine"},
                 {"preset"},
                 {"topic"},
                 {"requested"},
                 {"resolved"},
                 {"realisation"},
                 {"reason"},
                 {"scenarios", ColumnKind::Number}},
                {}};
    for (const auto& l : view.ledger())
        table.rows.push_back({l.engine, l.preset, l.row.topic, l.row.requested, l.row.resolved,
                              l.row.realisation, l.row.reason,
                              static_cast<std::int64_t>(l.scenarios.size())});
    return {table};
}

}  // namespace

const std::vector<TableEntry>& tableEntries() {
    static const std::vector<TableEntry> entries{
        {"scoreboard", scoreboard}, {"trust", trust},
        {"accuracy", accuracy},     {"insertion_orders", insertionOrders},
        {"timing", timing},         {"phases", phases},
        {"audit", audit},           {"contacts", contactsOfRuns},
        {"ledger", ledger},         {"scenarios", metricsOfScenarios},
        {"bench", benchTables}};
    return entries;
}

std::string scenarioTableName(const results::ScenarioRow& scenario) {
    return "scenarios/" + fileNamePart(scenario.name);
}

std::vector<Table> allTables(const ViewModel& view) {
    std::vector<Table> tables;
    for (const auto& entry : tableEntries())
        for (auto& table : entry.make(view)) tables.push_back(std::move(table));
    return tables;
}

}  // namespace rigor::report
