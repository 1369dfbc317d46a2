// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/rows.hpp"

#include <functional>
#include <stdexcept>
#include <unordered_map>

#include "validation/results/bench_rows.hpp"
#include "validation/results/columns.hpp"
#include "validation/results/schema.hpp"

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

void writeMeasured(SQLite::Database& database, const CaseRow& c) {
    writeList(database, "metrics", c.id, c.metrics, [](Binder& b, const MetricRow& m) {
        b << m.name << m.subject << m.unit << m.kind << m.value << m.at << m.bound << m.expectation
          << verdictName(m.verdict) << m.note << m.scale << m.relative << m.ideal << m.recorded;
    });
    writeList(database, "quantities", c.id, c.quantities, [](Binder& b, const QuantityRow& q) {
        b << q.name << q.unit << q.exact << q.schemeExact << q.measured;
    });
    writeList(database, "audit", c.id, c.audit, [](Binder& b, const AuditRow& a) {
        b << a.auditor << a.outcome << a.frames << a.queries << a.overlapping << a.missed << a.spurious
          << a.undecided << a.normalErrorMax << a.normalErrorMedian << a.depthErrorMax << a.depthErrorMedian
          << a.pointErrorMax << a.worst << a.note;
    });
    writeList(database, "timings", c.id, c.timings, [](Binder& b, const TimingRow& t) {
        b << t.phase << t.median << t.p10 << t.p90 << t.total << t.samples << t.meanContacts << t.low
          << t.high << t.bodies << t.first << t.mean << t.p95 << t.p99 << t.worst << t.realTimeFactor;
    });
}

void writeParity(SQLite::Database& database, const CaseRow& c) {
    writeList(database, "settings", c.id, c.settings,
              [](Binder& b, const auto& setting) { b << setting.first << setting.second; });
    writeList(database, "ledger", c.id, c.ledger, [](Binder& b, const LedgerRow& l) {
        b << l.topic << l.requested << l.resolved << l.realisation << l.reason;
    });
    writeList(database, "read_back", c.id, c.readBack, [](Binder& b, const ReadBackRow& r) {
        b << r.quantity << r.subject << r.expected << r.found << r.error << r.ok;
    });
}

std::vector<CaseRow> readCases(SQLite::Database& database) {
    std::vector<CaseRow> cases;
    const bool isGraded = schemaVersionOf(database) >= kSchemaOfGrades;
    SQLite::Statement select(
        database,
        std::string("SELECT id, position, scenario, spec, engine, preset, dt, outcome, verdict, reason, "
                    "wall_seconds, cpu_seconds, steps, peak_memory_kib, state_hash, trajectory_file, "
                    "command, ") +
            (schemaVersionOf(database) >= 6 ? "refusal, " : "'', ") +
            (isGraded
                 ? "grade, graded_by, relative_error, ideal_error, grade_note, regression, regression_reason"
                 : "'', '', NULL, NULL, '', 'no record', ''") +
            " FROM cases ORDER BY position, id");
    while (select.executeStep()) {
        CaseRow& c = cases.emplace_back();
        std::string outcome, verdict, grade, regression;
        Taker(select) >> c.id >> c.position >> c.scenario >> c.spec >> c.engine >> c.preset >> c.dt >>
            outcome >> verdict >> c.reason >> c.wallSeconds >> c.cpuSeconds >> c.steps >> c.peakMemoryKiB >>
            c.stateHash >> c.trajectoryFile >> c.command >> c.refusal >> grade >> c.accuracy.metric >>
            c.accuracy.relative >> c.accuracy.ideal >> c.accuracy.note >> regression >> c.regressionReason;
        c.accuracy.grade = parseGrade(grade);
        c.regression = parseRegression(regression);
        c.outcome = parseOutcome(outcome);
        c.verdict = parseVerdict(verdict);
    }
    return cases;
}

using CaseIndex = std::unordered_map<std::string, CaseRow*>;

/// Hands every row of `table` to its case, in order.
void readList(SQLite::Database& database, const CaseIndex& cases, const char* table, const char* columns,
              const std::function<void(CaseRow&, Taker&)>& take) {
    SQLite::Statement select(database, std::string("SELECT case_id, ") + columns +
                                           nonFiniteOf(database, table) + " FROM " + table +
                                           " ORDER BY case_id, ordinal");
    while (select.executeStep()) {
        Taker taker(select);
        std::string id;
        taker >> id;
        const auto it = cases.find(id);
        if (it == cases.end())
            throw std::runtime_error(std::string("table ") + table + ": row of an unknown case " + id);
        take(*it->second, taker);
    }
}

void readMeasured(SQLite::Database& database, const CaseIndex& cases) {
    const bool isGraded = schemaVersionOf(database) >= kSchemaOfGrades;
    readList(database, cases, "metrics",
             isGraded
                 ? "name, subject, unit, kind, value, at, bound, expectation, verdict, note, scale, "
                   "relative_error, ideal_error, recorded"
                 : "name, subject, unit, kind, value, at, bound, expectation, verdict, note, NULL, NULL, "
                   "NULL, NULL",
             [](CaseRow& c, Taker& t) {
                 MetricRow& m = c.metrics.emplace_back();
                 std::string verdict;
                 t >> m.name >> m.subject >> m.unit >> m.kind >> m.value >> m.at >> m.bound >>
                     m.expectation >> verdict >> m.note >> m.scale >> m.relative >> m.ideal >> m.recorded;
                 m.verdict = parseVerdict(verdict);
             });
    readList(database, cases, "quantities", "name, unit, exact, scheme_exact, measured",
             [](CaseRow& c, Taker& t) {
                 QuantityRow& q = c.quantities.emplace_back();
                 t >> q.name >> q.unit >> q.exact >> q.schemeExact >> q.measured;
             });
    readList(database, cases, "audit",
             "auditor, outcome, frames, queries, overlapping, missed, spurious, undecided, normal_error_max, "
             "normal_error_median, depth_error_max, depth_error_median, point_error_max, worst, note",
             [](CaseRow& c, Taker& t) {
                 AuditRow& a = c.audit.emplace_back();
                 t >> a.auditor >> a.outcome >> a.frames >> a.queries >> a.overlapping >> a.missed >>
                     a.spurious >> a.undecided >> a.normalErrorMax >> a.normalErrorMedian >>
                     a.depthErrorMax >> a.depthErrorMedian >> a.pointErrorMax >> a.worst >> a.note;
             });
    const int schema = schemaVersionOf(database);
    const std::string timings = std::string("phase, median, p10, p90, total, samples, mean_contacts, ") +
                                (schema >= 3 ? "low, high, bodies, " : "NULL, NULL, 0, ") +
                                (schema >= 8 ? "first, mean, p95, p99, worst, real_time_factor"
                                             : "NULL, NULL, NULL, NULL, NULL, NULL");
    readList(database, cases, "timings", timings.c_str(), [](CaseRow& c, Taker& t) {
        TimingRow& r = c.timings.emplace_back();
        t >> r.phase >> r.median >> r.p10 >> r.p90 >> r.total >> r.samples >> r.meanContacts >> r.low >>
            r.high >> r.bodies >> r.first >> r.mean >> r.p95 >> r.p99 >> r.worst >> r.realTimeFactor;
    });
}

void readParity(SQLite::Database& database, const CaseIndex& cases) {
    readList(database, cases, "settings", "key, value", [](CaseRow& c, Taker& t) {
        std::string key, value;
        t >> key >> value;
        c.settings[key] = value;
    });
    readList(database, cases, "ledger", "topic, requested, resolved, realisation, reason",
             [](CaseRow& c, Taker& t) {
                 LedgerRow& l = c.ledger.emplace_back();
                 t >> l.topic >> l.requested >> l.resolved >> l.realisation >> l.reason;
             });
    readList(database, cases, "read_back", "quantity, subject, expected, found, error, ok",
             [](CaseRow& c, Taker& t) {
                 ReadBackRow& r = c.readBack.emplace_back();
                 t >> r.quantity >> r.subject >> r.expected >> r.found >> r.error >> r.ok;
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
    SQLite::Statement insert(database, insertInto("cases", 25));
    (Binder(insert) << c.id << c.position << c.scenario << c.spec << c.engine << c.preset << c.dt
                    << outcomeName(c.outcome) << verdictName(c.verdict) << c.reason << c.wallSeconds
                    << c.cpuSeconds << c.steps << c.peakMemoryKiB << c.stateHash << c.trajectoryFile
                    << c.command << c.refusal << gradeName(c.accuracy.grade) << c.accuracy.metric
                    << c.accuracy.relative << c.accuracy.ideal << c.accuracy.note
                    << regressionName(c.regression) << c.regressionReason)
        .run();
    writeMeasured(database, c);
    writeParity(database, c);
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

Run readRows(SQLite::Database& database) {
    Run run;
    readHeader(database, run);
    run.cases = readCases(database);
    CaseIndex index;
    for (CaseRow& c : run.cases) index[c.id] = &c;
    readMeasured(database, index);
    readParity(database, index);
    if (schemaVersionOf(database) >= 2) readAnalysis(database, run);
    if (schemaVersionOf(database) >= 5) run.bench = readBench(database);
    return run;
}

}  // namespace rigor::results
