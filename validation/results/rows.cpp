// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/rows.hpp"

#include <functional>
#include <stdexcept>
#include <unordered_map>

#include "validation/results/bench_rows.hpp"
#include "validation/results/columns.hpp"
#include "validation/results/schema.hpp"
#include "validation/results/seals.hpp"
#include "validation/results/shared_lists.hpp"

namespace rigor::results {
namespace {

/// Writes each element of `rows` with the case's id and its ordinal in front.
template <class Rows, class Bind>
void writeList(SQLite::Database& database, const char* table, const std::string& caseId, const Rows& rows,
               Bind bind) {
    if (rows.empty()) return;
    const auto names = tableColumns(database, table);
    SQLite::Statement insert(database, insertInto(table, names.size()));
    int ordinal = 0;
    for (const auto& row : rows) {
        Binder binder(insert, names);
        binder << caseId << ordinal++;
        bind(binder, row);
        binder.run();
    }
}

void writeLists(SQLite::Database& database, const CaseRow& c) {
    eachOwnList(c, [&](const char* table, const auto& rows) {
        writeList(database, table, c.id, rows,
                  [](Binder& binder, const auto& row) { eachField(row, BindFields{binder}); });
    });
}

std::vector<CaseRow> readCases(SQLite::Database& database, const std::set<std::string>& skipped) {
    std::vector<CaseRow> cases;
    ColumnList columns(schemaVersionOf(database));
    const CaseRow like;
    eachField(like, columns);
    SQLite::Statement select(database,
                             "SELECT " + columns.text.substr(2) + " FROM cases ORDER BY position, id");
    while (select.executeStep()) {
        if (skipped.contains(select.getColumn("id").getString())) continue;
        Taker taker(select);
        eachField(cases.emplace_back(), TakeFields{taker});
    }
    return cases;
}

using CaseIndex = std::unordered_map<std::string, CaseRow*>;

/// Hands every row of `table` to its case, in order. `columns` begins with a comma.
void readList(SQLite::Database& database, const CaseIndex& cases, const char* table,
              const std::string& columns, const std::function<void(CaseRow&, Taker&)>& take) {
    SQLite::Statement select(database, "SELECT case_id" + columns + nonFiniteOf(database, table) + " FROM " +
                                           table + " ORDER BY case_id, ordinal");
    while (select.executeStep()) {
        Taker taker(select);
        std::string id;
        taker >> id;
        const auto it = cases.find(id);
        if (it == cases.end() && schemaVersionOf(database) >= kFirstSchemaWithSeals)
            continue;  // its case is named as damaged
        if (it == cases.end())
            throw std::runtime_error(std::string("table ") + table + ": row of an unknown case " + id);
        take(*it->second, taker);
    }
}

/// A list of records whose table is `table`; `list`: which of a case it is.
template <class Row>
void readRecords(SQLite::Database& database, const CaseIndex& cases, const char* table,
                 std::vector<Row> CaseRow::*list) {
    ColumnList columns(schemaVersionOf(database));
    const Row like{};
    eachField(like, columns);
    readList(database, cases, table, columns.text,
             [&](CaseRow& c, Taker& taker) { eachField((c.*list).emplace_back(), TakeFields{taker}); });
}

void readLists(SQLite::Database& database, const CaseIndex& cases) {
    readRecords(database, cases, "metrics", &CaseRow::metrics);
    readRecords(database, cases, "quantities", &CaseRow::quantities);
    readRecords(database, cases, "ledger", &CaseRow::ledger);
    readRecords(database, cases, "read_back", &CaseRow::readBack);
    readRecords(database, cases, "audit", &CaseRow::audit);
    readRecords(database, cases, "timings", &CaseRow::timings);
    readList(database, cases, "settings", ", key, value", [](CaseRow& c, Taker& t) {
        std::string key, value;
        t >> key >> value;
        c.settings[key] = value;
    });
}

void readHeader(SQLite::Database& database, Run& run) {
    SQLite::Statement one(database, "SELECT suite, command, started, finished, planned_cases FROM run");
    if (one.executeStep())
        Taker(one) >> run.suite >> run.command >> run.started >> run.finished >> run.plannedCases;
    SQLite::Statement environment(database, "SELECT key, value FROM environment");
    while (environment.executeStep())
        run.environment[environment.getColumn(0).getString()] = environment.getColumn(1).getString();
    SQLite::Statement engines(database,
                              std::string("SELECT name, title, version, precision, build_notes, problem, ") +
                                  (schemaVersionOf(database) >= 4 ? "capabilities, " : "'', ") +
                                  (schemaVersionOf(database) >= 6 ? "package" : "''") +
                                  " FROM engines ORDER BY position");
    while (engines.executeStep()) {
        EngineRow& e = run.engines.emplace_back();
        Taker(engines) >> e.name >> e.title >> e.version >> e.precision >> e.buildNotes >> e.problem >>
            e.capabilities >> e.package;
    }
    SQLite::Statement scenarios(
        database,
        std::string("SELECT name, title, description, source, isolates, tags, observed, metrics, dimension, "
                    "duration, time_steps, reference, reference_title, reference_formula, reference_source, "
                    "reference_problem, text, ") +
            (schemaVersionOf(database) >= 3 ? "reference_tex" : "''") + ", " +
            (schemaVersionOf(database) >= 8 ? "reference_outcome" : "''") +
            " FROM scenarios ORDER BY position");
    while (scenarios.executeStep()) {
        ScenarioRow& s = run.scenarios.emplace_back();
        Taker(scenarios) >> s.name >> s.title >> s.description >> s.source >> s.isolates >> s.tags >>
            s.observed >> s.metrics >> s.dimension >> s.duration >> s.timeSteps >> s.reference >>
            s.referenceTitle >> s.referenceFormula >> s.referenceSource >> s.referenceProblem >> s.text >>
            s.referenceTex >> s.referenceOutcome;
    }
}

void readAnalysis(SQLite::Database& database, Run& run) {
    SQLite::Statement orders(
        database,
        std::string("SELECT scenario, spec, metric, unit, observed_order, low, high, points, finest, "
                    "coarsest, note") +
            nonFiniteOf(database, "orders") + " FROM orders ORDER BY position");
    while (orders.executeStep()) {
        OrderRow& o = run.orders.emplace_back();
        Taker(orders) >> o.scenario >> o.spec >> o.metric >> o.unit >> o.order >> o.low >> o.high >>
            o.points >> o.finest >> o.coarsest >> o.note;
    }
    SQLite::Statement fairness(database,
                               std::string("SELECT mode, scenario, metric, unit, competitor, case_id, spec, "
                                           "dt, error, cost, budget_or_target") +
                                   nonFiniteOf(database, "fairness") + " FROM fairness ORDER BY position");
    while (fairness.executeStep()) {
        FairnessRow& f = run.fairness.emplace_back();
        Taker(fairness) >> f.mode >> f.scenario >> f.metric >> f.unit >> f.competitor >> f.caseId >> f.spec >>
            f.dt >> f.error >> f.cost >> f.limit;
    }
}

}  // namespace

void writeHeaderRows(SQLite::Database& database, const Run& run) {
    for (const char* table : {"run", "environment", "engines", "scenarios"})
        database.exec(std::string("DELETE FROM ") + table);
    SQLite::Statement one(database, insertInto("run", 6));
    (Binder(one) << 1 << run.suite << run.command << run.started << run.finished << run.plannedCases).run();
    SQLite::Statement environment(database, insertInto("environment", 2));
    for (const auto& [key, value] : run.environment) (Binder(environment) << key << value).run();
    SQLite::Statement engines(database, insertInto("engines", 9));
    int position = 0;
    for (const EngineRow& e : run.engines)
        (Binder(engines) << position++ << e.name << e.title << e.version << e.precision << e.buildNotes
                         << e.problem << e.capabilities << e.package)
            .run();
    SQLite::Statement scenarios(database, insertInto("scenarios", 20));
    position = 0;
    for (const ScenarioRow& s : run.scenarios)
        (Binder(scenarios) << position++ << s.name << s.title << s.description << s.source << s.isolates
                           << s.tags << s.observed << s.metrics << s.dimension << s.duration << s.timeSteps
                           << s.reference << s.referenceTitle << s.referenceFormula << s.referenceSource
                           << s.referenceProblem << s.text << s.referenceTex << s.referenceOutcome)
            .run();
}

void writeCaseRows(SQLite::Database& database, const CaseRow& c) {
    SQLite::Statement forget(database, "DELETE FROM cases WHERE id = ?");
    (Binder(forget) << c.id).run();
    SQLite::Statement insert(database, insertInto("cases", tableColumns(database, "cases").size()));
    const SharedLists lists = storeSharedLists(database, c);
    Binder binder(insert);
    eachField(c, BindFields{binder});
    binder << lists.settings << lists.ledger << lists.readBack;
    binder.run();
    writeLists(database, c);
}

void writeAnalysisRows(SQLite::Database& database, const Run& run) {
    for (const char* table : {"orders", "fairness"}) database.exec(std::string("DELETE FROM ") + table);
    const auto ordersColumns = tableColumns(database, "orders");
    SQLite::Statement orders(database, insertInto("orders", ordersColumns.size()));
    int position = 0;
    for (const OrderRow& o : run.orders)
        (Binder(orders, ordersColumns) << position++ << o.scenario << o.spec << o.metric << o.unit << o.order
                                       << o.low << o.high << o.points << o.finest << o.coarsest << o.note)
            .run();
    const auto fairnessColumns = tableColumns(database, "fairness");
    SQLite::Statement fairness(database, insertInto("fairness", fairnessColumns.size()));
    position = 0;
    for (const FairnessRow& f : run.fairness)
        (Binder(fairness, fairnessColumns)
         << position++ << f.mode << f.scenario << f.metric << f.unit << f.competitor << f.caseId << f.spec
         << f.dt << f.error << f.cost << f.limit)
            .run();
}

Run readHeaderRows(SQLite::Database& database) {
    Run run;
    readHeader(database, run);
    return run;
}

Run readRows(SQLite::Database& database, const Damage& damage) {
    Run run;
    readHeader(database, run);
    run.cases = readCases(database, damage.cases);
    CaseIndex index;
    for (CaseRow& c : run.cases) index[c.id] = &c;
    readLists(database, index);
    if (!damage.hits({"orders", "fairness"}) && schemaVersionOf(database) >= 2) readAnalysis(database, run);
    if (schemaVersionOf(database) >= 5) run.bench = readBench(database, damage);
    return run;
}

}  // namespace rigor::results
