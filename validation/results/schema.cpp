// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Columns that hold measured numbers have no declared type: SQLite then keeps every double as it is (a REAL
// column would turn -0.0 into 0). A number that is not finite is NULL and named in the column non_finite of
// its row; any other NULL is "no value". Stores before schema 8 have the text 'nan' for NaN.
#include "validation/results/schema.hpp"

#include <stdexcept>

#include "validation/results/bench_rows.hpp"
#include "validation/results/columns.hpp"
#include "validation/results/seals.hpp"
#include "validation/results/shared_lists.hpp"
#include "validation/results/store.hpp"

namespace rigor::results {
namespace {

constexpr int kApplicationId = 0x52494752;  // "RIGR", so that file(1) and we know the file
constexpr int kBusyMilliseconds = 10000;

constexpr const char* kTables = R"sql(
CREATE TABLE run (
    one INTEGER PRIMARY KEY CHECK (one = 1), suite TEXT, command TEXT, started TEXT, finished TEXT,
    planned_cases INTEGER);
CREATE TABLE environment (key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID;
CREATE TABLE engines (
    position INTEGER PRIMARY KEY, name TEXT, title TEXT, version TEXT, precision TEXT, build_notes TEXT, problem TEXT,
    capabilities TEXT, package TEXT);
CREATE TABLE scenarios (
    position INTEGER PRIMARY KEY, name TEXT UNIQUE, title TEXT, description TEXT, source TEXT, isolates TEXT,
    tags TEXT, observed TEXT, metrics TEXT, dimension INTEGER, duration, time_steps TEXT, reference TEXT,
    reference_title TEXT, reference_formula TEXT, reference_source TEXT, reference_problem TEXT, text TEXT,
    reference_tex TEXT, reference_outcome TEXT);
CREATE TABLE cases (
    id TEXT PRIMARY KEY, position INTEGER, scenario TEXT, spec TEXT, engine TEXT, preset TEXT, dt, outcome TEXT,
    verdict TEXT, reason TEXT, wall_seconds, cpu_seconds, steps INTEGER, peak_memory_kib INTEGER, state_hash TEXT,
    trajectory_file TEXT, command TEXT, refusal TEXT, grade TEXT, graded_by TEXT, relative_error, ideal_error, grade_note TEXT,
    regression TEXT, regression_reason TEXT, insertion_orders INTEGER, insertion_orders_completed INTEGER,
    grade_best TEXT, grade_worst TEXT, insertion_note TEXT, insertion_orders_failed INTEGER, insertion_verdicts TEXT,
    order_dependent TEXT, settings_list INTEGER, ledger_list INTEGER, read_back_list INTEGER) WITHOUT ROWID;
CREATE TABLE metrics (
    case_id TEXT REFERENCES cases ON DELETE CASCADE, ordinal INTEGER, name TEXT, subject TEXT, unit TEXT, kind TEXT,
    value, at, bound, expectation, verdict TEXT, note TEXT, scale, relative_error, ideal_error, recorded,
    non_finite TEXT, order_min, order_max, order_count INTEGER, bound_min, PRIMARY KEY (case_id, ordinal)) WITHOUT ROWID;
CREATE TABLE quantities (
    case_id TEXT REFERENCES cases ON DELETE CASCADE, ordinal INTEGER, name TEXT, unit TEXT, exact, scheme_exact,
    measured, non_finite TEXT, PRIMARY KEY (case_id, ordinal)) WITHOUT ROWID;
CREATE TABLE audit (
    case_id TEXT REFERENCES cases ON DELETE CASCADE, ordinal INTEGER, auditor TEXT, outcome TEXT, frames INTEGER,
    queries INTEGER, overlapping INTEGER, missed INTEGER, spurious INTEGER, undecided INTEGER, normal_error_max,
    normal_error_median, depth_error_max, depth_error_median, point_error_max, worst TEXT, note TEXT,
    non_finite TEXT, findings TEXT, PRIMARY KEY (case_id, ordinal)) WITHOUT ROWID;
CREATE TABLE timings (
    case_id TEXT REFERENCES cases ON DELETE CASCADE, ordinal INTEGER, phase TEXT, median, p10, p90, total,
    samples INTEGER, mean_contacts, low, high, bodies INTEGER, first, mean, p95, p99, worst, real_time_factor,
    non_finite TEXT, PRIMARY KEY (case_id, ordinal)) WITHOUT ROWID;
CREATE INDEX cases_by_scenario ON cases (scenario, engine, preset, dt);
)sql";

/// Tables since schema 2: results computed from all cases of a run together.
constexpr const char* kAnalysisTables = R"sql(
CREATE TABLE orders (
    position INTEGER PRIMARY KEY, scenario TEXT, spec TEXT, metric TEXT, unit TEXT, observed_order, low, high,
    points INTEGER, finest, coarsest, note TEXT, non_finite TEXT);
CREATE TABLE fairness (
    position INTEGER PRIMARY KEY, mode TEXT, scenario TEXT, metric TEXT, unit TEXT, competitor TEXT, case_id TEXT,
    spec TEXT, dt, error, cost, budget_or_target, non_finite TEXT);
)sql";

/// New columns stand at the end of their tables, where an older file gets them.
constexpr const char* kColumnsOfSchema3 = R"sql(
ALTER TABLE scenarios ADD COLUMN reference_tex TEXT DEFAULT '';
ALTER TABLE timings ADD COLUMN low;
ALTER TABLE timings ADD COLUMN high;
ALTER TABLE timings ADD COLUMN bodies INTEGER DEFAULT 0;
)sql";

constexpr const char* kColumnsOfSchema4 = "ALTER TABLE engines ADD COLUMN capabilities TEXT DEFAULT ''";

constexpr const char* kColumnsOfSchema6 = R"sql(
ALTER TABLE cases ADD COLUMN refusal TEXT DEFAULT '';
ALTER TABLE engines ADD COLUMN package TEXT DEFAULT '';
)sql";

constexpr const char* kColumnsOfSchema7 = R"sql(
ALTER TABLE cases ADD COLUMN grade TEXT DEFAULT '';
ALTER TABLE cases ADD COLUMN graded_by TEXT DEFAULT '';
ALTER TABLE cases ADD COLUMN relative_error;
ALTER TABLE cases ADD COLUMN ideal_error;
ALTER TABLE cases ADD COLUMN grade_note TEXT DEFAULT '';
ALTER TABLE cases ADD COLUMN regression TEXT DEFAULT 'no record';
ALTER TABLE cases ADD COLUMN regression_reason TEXT DEFAULT '';
ALTER TABLE metrics ADD COLUMN scale;
ALTER TABLE metrics ADD COLUMN relative_error;
ALTER TABLE metrics ADD COLUMN ideal_error;
ALTER TABLE metrics ADD COLUMN recorded;
)sql";

constexpr const char* kColumnsOfSchema8 = R"sql(
ALTER TABLE scenarios ADD COLUMN reference_outcome TEXT DEFAULT '';
ALTER TABLE timings ADD COLUMN first;
ALTER TABLE timings ADD COLUMN mean;
ALTER TABLE timings ADD COLUMN p95;
ALTER TABLE timings ADD COLUMN p99;
ALTER TABLE timings ADD COLUMN worst;
ALTER TABLE timings ADD COLUMN real_time_factor;
)sql";

constexpr const char* kColumnsOfSchema9 = R"sql(
ALTER TABLE cases ADD COLUMN insertion_orders INTEGER;
ALTER TABLE cases ADD COLUMN insertion_orders_completed INTEGER;
ALTER TABLE cases ADD COLUMN grade_best TEXT DEFAULT '';
ALTER TABLE cases ADD COLUMN grade_worst TEXT DEFAULT '';
ALTER TABLE cases ADD COLUMN insertion_note TEXT DEFAULT '';
ALTER TABLE metrics ADD COLUMN order_min;
ALTER TABLE metrics ADD COLUMN order_max;
ALTER TABLE metrics ADD COLUMN order_count INTEGER;
)sql";

constexpr const char* kColumnsOfSchema10 = R"sql(
ALTER TABLE cases ADD COLUMN insertion_orders_failed INTEGER;
ALTER TABLE cases ADD COLUMN insertion_verdicts TEXT DEFAULT '';
ALTER TABLE cases ADD COLUMN order_dependent TEXT DEFAULT '';
)sql";

constexpr const char* kColumnsOfSchema11 = "ALTER TABLE audit ADD COLUMN findings TEXT DEFAULT ''";

constexpr const char* kColumnsOfSchema15 = "ALTER TABLE metrics ADD COLUMN bound_min";

/// Tables with measured numbers: since schema 8 each says which of a row are not finite. A table that an
/// older file gets whole has the column already.
constexpr const char* kTablesWithNumbers[] = {
    "metrics",  "quantities",   "read_back",         "audit",           "timings",      "orders",
    "fairness", "bench_values", "bench_repetitions", "bench_summaries", "bench_changes"};

void addNonFinite(SQLite::Database& database) {
    for (const char* table : kTablesWithNumbers)
        if (!hasNonFiniteColumn(database, table))
            database.exec(std::string("ALTER TABLE ") + table + " ADD COLUMN " + kNonFiniteColumn +
                          " TEXT DEFAULT ''");
}

/// A committed transaction is on the disk: rollback journal, synced. One file, whole at rest, that can be
/// copied while no connection writes.
void prepare(SQLite::Database& database) {
    database.setBusyTimeout(kBusyMilliseconds);
    database.exec("PRAGMA foreign_keys = ON");
    database.exec("PRAGMA synchronous = FULL");
}

void checkVersion(SQLite::Database& database, const std::filesystem::path& file) {
    if (database.execAndGet("PRAGMA application_id").getInt() != kApplicationId)
        throw std::runtime_error(file.string() + ": this is not a results store of rigor");
    const int version = schemaVersionOf(database);
    if (version > kSchemaVersion)
        throw std::runtime_error(file.string() + ": written by a newer rigor: found schema " +
                                 std::to_string(version) + ", expected at most " +
                                 std::to_string(kSchemaVersion));
    if (version < 1) throw std::runtime_error(file.string() + ": the store has no schema version");
    if ((version >= kFirstSchemaWithSeals) != database.tableExists("seals") ||
        (version >= kFirstSchemaWithSharedLists) != database.tableExists("shared_settings"))
        throw std::runtime_error(file.string() + ": is damaged: its tables are not those of schema " +
                                 std::to_string(version));
}

/// A run of an older rigor that is gone on with.
void upgrade(SQLite::Database& database) {
    const int version = schemaVersionOf(database);
    if (version >= kSchemaVersion) return;
    SQLite::Transaction transaction(database);
    const Damage damage = version >= kFirstSchemaWithSeals ? findDamage(database) : Damage{};
    if (version < 2) database.exec(kAnalysisTables);
    if (version < 3) database.exec(kColumnsOfSchema3);
    if (version < 4) database.exec(kColumnsOfSchema4);
    if (version < 5) database.exec(kBenchTables);
    if (version < 6) database.exec(kColumnsOfSchema6);
    if (version < 7) database.exec(kColumnsOfSchema7);
    if (version < 8) {
        database.exec(kColumnsOfSchema8);
        addNonFinite(database);
    }
    if (version < 9) database.exec(kColumnsOfSchema9);
    if (version < 10) database.exec(kColumnsOfSchema10);
    if (version < 11) database.exec(kColumnsOfSchema11);
    if (version < 15) database.exec(kColumnsOfSchema15);
    if (version < kFirstSchemaWithSharedLists) {
        shareLists(database);
        database.exec("DROP INDEX IF EXISTS metrics_by_name");
    }
    if (version < kFirstSchemaWithSeals) {
        database.exec(kSealsTable);
        sealHeader(database);
        sealAnalysis(database);
    }
    if (version < kFirstSchemaWithBenchSeals) {
        sealBenchPlan(database);
        sealBenchAnalysis(database);
    }
    sealCases(database, damage.cases);  // Damaged ones keep their checksums, which they do not fit.
    database.exec("PRAGMA user_version = " + std::to_string(kSchemaVersion));
    transaction.commit();
}

/// A store left by a kill may have a journal to roll back, which needs writing; where the folder is
/// read-only, reading is tried.
SQLite::Database openFile(const std::filesystem::path& file, bool forWriting) {
    try {
        return SQLite::Database(file.string(), SQLite::OPEN_READWRITE);
    } catch (const SQLite::Exception&) {
        if (forWriting) throw;
        return SQLite::Database(file.string(), SQLite::OPEN_READONLY);
    }
}

}  // namespace

int schemaVersionOf(SQLite::Database& database) {
    return database.execAndGet("PRAGMA user_version").getInt();
}

SQLite::Database createDatabase(const std::filesystem::path& file) {
    SQLite::Database database(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    prepare(database);
    SQLite::Transaction transaction(database);
    database.exec(kTables);
    database.exec(kSharedListTables);
    database.exec(kAnalysisTables);
    database.exec(kBenchTables);
    database.exec(kSealsTable);
    sealHeader(database);
    sealAnalysis(database);
    sealBenchPlan(database);
    sealBenchAnalysis(database);
    database.exec("PRAGMA application_id = " + std::to_string(kApplicationId));
    database.exec("PRAGMA user_version = " + std::to_string(kSchemaVersion));
    transaction.commit();
    return database;
}

SQLite::Database openDatabase(const std::filesystem::path& file, bool forWriting) {
    try {
        SQLite::Database database = openFile(file, forWriting);
        prepare(database);
        checkVersion(database, file);
        if (forWriting) upgrade(database);
        return database;
    } catch (const SQLite::Exception& error) {
        throw std::runtime_error(file.string() + ": cannot be read as a results store: " + error.what());
    }
}

}  // namespace rigor::results
