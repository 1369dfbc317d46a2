// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/bench_rows.hpp"

#include <set>
#include <stdexcept>
#include <unordered_map>

#include "validation/results/columns.hpp"

namespace rigor::results {

const char* const kBenchTables = R"sql(
CREATE TABLE bench_settings (key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID;
CREATE TABLE bench_cases (
    id TEXT PRIMARY KEY, position INTEGER, part TEXT, name TEXT, engine TEXT, size_unit TEXT, size, threads INTEGER,
    operation TEXT, command TEXT, parameters TEXT) WITHOUT ROWID;
CREATE TABLE bench_repetitions (
    case_id TEXT REFERENCES bench_cases ON DELETE CASCADE, round INTEGER, run_order INTEGER, outcome TEXT, reason TEXT,
    wall, cpu, samples INTEGER, state_hash TEXT, peak_memory_kib INTEGER, own_memory_kib INTEGER, allocations,
    allocated_bytes, process_seconds, load, non_finite TEXT, PRIMARY KEY (case_id, round)) WITHOUT ROWID;
CREATE TABLE bench_values (
    case_id TEXT, round INTEGER, ordinal INTEGER, kind TEXT, name TEXT, unit TEXT, value, min, max, ok INTEGER,
    non_finite TEXT, PRIMARY KEY (case_id, round, ordinal),
    FOREIGN KEY (case_id, round) REFERENCES bench_repetitions ON DELETE CASCADE) WITHOUT ROWID;
CREATE TABLE bench_summaries (
    case_id TEXT PRIMARY KEY REFERENCES bench_cases ON DELETE CASCADE, repetitions INTEGER, clock TEXT, wall, cpu, low,
    high, converged INTEGER, valid INTEGER, reason TEXT, base TEXT, ratio, ratio_low, ratio_high,
    non_finite TEXT) WITHOUT ROWID;
CREATE TABLE bench_changes (
    case_id TEXT PRIMARY KEY REFERENCES bench_cases ON DELETE CASCADE, before, after, ratio, low, high, p, verdict TEXT,
    reason TEXT, non_finite TEXT) WITHOUT ROWID;
)sql";

namespace {

constexpr const char* kCount = "count";
constexpr const char* kPhase = "phase";
constexpr const char* kQuality = "quality";

using Cases = std::unordered_map<std::string, BenchCase*>;

void writeCase(SQLite::Database& database, const BenchCase& c) {
    SQLite::Statement insert(
        database,
        "INSERT INTO bench_cases VALUES (?,?,?,?,?,?,?,?,?,?,?) ON CONFLICT (id) DO UPDATE SET position = "
        "excluded.position, command = excluded.command");
    (Binder(insert) << c.id << c.position << c.part << c.name << c.engine << c.sizeUnit << c.size << c.threads
                    << c.operation << c.command << c.parameters)
        .run();
}

void writeValues(SQLite::Database& database, const std::string& caseId, const BenchRepetition& r) {
    const auto names = tableColumns(database, "bench_values");
    SQLite::Statement insert(database, insertInto("bench_values", names.size()));
    int ordinal = 0;
    const auto add = [&](const char* kind, const std::string& name, const std::string& unit, double value,
                         const std::optional<double>& min, const std::optional<double>& max, bool ok) {
        (Binder(insert, names) << caseId << r.round << ordinal++ << kind << name << unit << value << min
                               << max << ok)
            .run();
    };
    for (const BenchCount& c : r.counts) add(kCount, c.name, "1", c.value, {}, {}, true);
    for (const BenchPhase& p : r.phases) add(kPhase, p.name, "s", p.seconds, {}, {}, true);
    for (const BenchQuality& q : r.quality) add(kQuality, q.name, q.unit, q.value, q.min, q.max, q.ok);
}

/// The case of a row; nullptr if that is left out.
BenchCase* caseOfRow(const Cases& cases, const std::string& id, const Damage& damage) {
    if (const auto it = cases.find(id); it != cases.end()) return it->second;
    if (damage.benchCases.empty()) throw std::runtime_error("bench: found a row of a case that is not there");
    return nullptr;
}

void readRepetitions(SQLite::Database& database, const Cases& cases, const Damage& damage) {
    SQLite::Statement rows(
        database, std::string("SELECT case_id, round, run_order, outcome, reason, wall, cpu, samples, "
                              "state_hash, peak_memory_kib, "
                              "own_memory_kib, allocations, allocated_bytes, process_seconds, load") +
                      nonFiniteOf(database, "bench_repetitions") +
                      " FROM bench_repetitions ORDER BY case_id, round");
    while (rows.executeStep()) {
        std::string id;
        Taker taker(rows);
        taker >> id;
        BenchCase* c = caseOfRow(cases, id, damage);
        if (c == nullptr) continue;
        BenchRepetition& r = c->repetitions.emplace_back();
        taker >> r.round >> r.order >> r.outcome >> r.reason >> r.wall >> r.cpu >> r.samples >> r.stateHash >>
            r.peakMemoryKiB >> r.ownMemoryKiB >> r.allocations >> r.allocatedBytes >> r.processSeconds >>
            r.load;
    }
}

BenchRepetition& repetitionOf(BenchCase& c, std::int64_t round) {
    for (BenchRepetition& r : c.repetitions)
        if (r.round == round) return r;
    throw std::runtime_error("bench: values of a repetition that is not there");
}

void readValues(SQLite::Database& database, const Cases& cases, const Damage& damage) {
    SQLite::Statement rows(database, "SELECT case_id, round, kind, name, unit, value, min, max, ok" +
                                         nonFiniteOf(database, "bench_values") +
                                         " FROM bench_values ORDER BY case_id, round, ordinal");
    while (rows.executeStep()) {
        std::string id, kind;
        std::int64_t round = 0;
        BenchQuality q;
        Taker(rows) >> id >> round >> kind >> q.name >> q.unit >> q.value >> q.min >> q.max >> q.ok;
        BenchCase* c = caseOfRow(cases, id, damage);
        if (c == nullptr) continue;
        BenchRepetition& r = repetitionOf(*c, round);
        if (kind == kCount)
            r.counts.push_back({q.name, q.value});
        else if (kind == kPhase)
            r.phases.push_back({q.name, q.value});
        else if (kind == kQuality)
            r.quality.push_back(q);
        else
            throw std::runtime_error("bench: found a value of kind '" + kind + "'");
    }
}

void readSummaries(SQLite::Database& database, const Cases& cases, const Damage& damage) {
    SQLite::Statement rows(
        database,
        std::string("SELECT case_id, repetitions, clock, wall, cpu, low, high, converged, valid, reason, "
                    "base, ratio, ratio_low, ratio_high") +
            nonFiniteOf(database, "bench_summaries") + " FROM bench_summaries");
    while (rows.executeStep()) {
        std::string id;
        Taker taker(rows);
        taker >> id;
        BenchCase* c = caseOfRow(cases, id, damage);
        if (c == nullptr) continue;
        BenchSummary& s = c->summary;
        taker >> s.repetitions >> s.clock >> s.wall >> s.cpu >> s.low >> s.high >> s.converged >> s.valid >>
            s.reason >> s.base >> s.ratio >> s.ratioLow >> s.ratioHigh;
    }
}

void readChanges(SQLite::Database& database, Bench& bench, const Cases& cases) {
    SQLite::Statement changes(database,
                              "SELECT case_id, before, after, ratio, low, high, p, verdict, reason" +
                                  nonFiniteOf(database, "bench_changes") +
                                  " FROM bench_changes JOIN bench_cases ON id = case_id ORDER BY position");
    while (changes.executeStep()) {
        if (!cases.contains(changes.getColumn(0).getString())) continue;
        BenchChange& c = bench.changes.emplace_back();
        Taker(changes) >> c.caseId >> c.before >> c.after >> c.ratio >> c.low >> c.high >> c.p >> c.verdict >>
            c.reason;
    }
}

}  // namespace

void writeBenchPlan(SQLite::Database& database, const Bench& bench) {
    database.exec("DELETE FROM bench_settings");
    SQLite::Statement settings(database, "INSERT INTO bench_settings VALUES (?,?)");
    for (const auto& [key, value] : bench.settings) (Binder(settings) << key << value).run();
    std::set<std::string> planned;
    for (const BenchCase& c : bench.cases) planned.insert(c.id);
    SQLite::Statement forget(database, "DELETE FROM bench_cases WHERE id = ?");
    for (const std::string& id : idsOfCases(database, kBenchCases))
        if (!planned.contains(id)) (Binder(forget) << id).run();
    for (const BenchCase& c : bench.cases) writeCase(database, c);
}

void writeBenchRepetition(SQLite::Database& database, const std::string& caseId, const BenchRepetition& r) {
    SQLite::Statement forget(database, "DELETE FROM bench_repetitions WHERE case_id = ? AND round = ?");
    (Binder(forget) << caseId << r.round).run();
    const auto names = tableColumns(database, "bench_repetitions");
    SQLite::Statement insert(database, insertInto("bench_repetitions", names.size()));
    (Binder(insert, names) << caseId << r.round << r.order << r.outcome << r.reason << r.wall << r.cpu
                           << r.samples << r.stateHash << r.peakMemoryKiB << r.ownMemoryKiB << r.allocations
                           << r.allocatedBytes << r.processSeconds << r.load)
        .run();
    writeValues(database, caseId, r);
}

void writeBenchAnalysis(SQLite::Database& database, const Bench& bench) {
    for (const char* table : {"bench_summaries", "bench_changes"})
        database.exec(std::string("DELETE FROM ") + table);
    const auto summaryNames = tableColumns(database, "bench_summaries");
    SQLite::Statement summary(database, insertInto("bench_summaries", summaryNames.size()));
    for (const BenchCase& c : bench.cases) {
        const BenchSummary& s = c.summary;
        (Binder(summary, summaryNames)
         << c.id << s.repetitions << s.clock << s.wall << s.cpu << s.low << s.high << s.converged << s.valid
         << s.reason << s.base << s.ratio << s.ratioLow << s.ratioHigh)
            .run();
    }
    const auto changeNames = tableColumns(database, "bench_changes");
    SQLite::Statement change(database, insertInto("bench_changes", changeNames.size()));
    for (const BenchChange& c : bench.changes)
        (Binder(change, changeNames) << c.caseId << c.before << c.after << c.ratio << c.low << c.high << c.p
                                     << c.verdict << c.reason)
            .run();
}

Bench readBench(SQLite::Database& database, const Damage& damage) {
    Bench bench;
    SQLite::Statement settings(database, "SELECT key, value FROM bench_settings");
    while (settings.executeStep())
        bench.settings[settings.getColumn(0).getString()] = settings.getColumn(1).getString();
    SQLite::Statement rows(database,
                           "SELECT id, position, part, name, engine, size_unit, size, threads, operation, "
                           "command, parameters FROM bench_cases ORDER BY position, id");
    while (rows.executeStep()) {
        if (damage.benchCases.contains(rows.getColumn(0).getString())) continue;
        BenchCase& c = bench.cases.emplace_back();
        Taker(rows) >> c.id >> c.position >> c.part >> c.name >> c.engine >> c.sizeUnit >> c.size >>
            c.threads >> c.operation >> c.command >> c.parameters;
    }
    Cases cases;
    for (BenchCase& c : bench.cases) cases[c.id] = &c;
    readRepetitions(database, cases, damage);
    readValues(database, cases, damage);
    if (damage.hits({kBenchSummaries, kBenchChanges})) return bench;
    readSummaries(database, cases, damage);
    readChanges(database, bench, cases);
    return bench;
}

}  // namespace rigor::results
